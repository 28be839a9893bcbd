// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of many pairs at once, per pair, as ratios to Eigen's 3x3 inverse: every instruction set of
// the machine, forced one after the other. Answers are checked against the manufactured truth
// before anything is timed.
//
// By class and level: cold (signed_gaps), following (follow_gaps from the normal of a moment ago),
// and overlaps; gap, normal, error and status by columns unless the name says more. "scattered" is
// cold on the 100,000 bodies of 50,000 pairs, bodies and pairs in random order, and "two_threads"
// the same with half of the list for each of two; "plain" is two arrays of ellipsoids and whole
// answers.
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <tangency/bench/instruction_set.hpp>
#include <tangency/bench/moved_back.hpp>
#include <tangency/bench/yardstick.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>

namespace {

using tangency::BodyArray;
using tangency::Ellipsoid;
using tangency::Gap;
using tangency::GapColumns;
using tangency::GapStatus;
using tangency::IndexedPair;
using tangency::PairList;
using tangency::Vec3;
using tangency::bench::force_level;
using tangency::bench::kInCache;
using tangency::bench::moment_ago;

constexpr std::uint64_t kSeed = 20261122;

struct Family {
  std::string name;
  std::vector<Ellipsoid> bodies;  ///< A and B of every pair in turn
  std::vector<IndexedPair> pairs;
  std::vector<double> truth, smallest_semi_axis;
  std::vector<Vec3> previous_normal;
};

struct Answers {
  std::vector<double> gap, gap_error;
  std::vector<Vec3> normal, arm_a, arm_b;
  std::vector<GapStatus> status;

  explicit Answers(std::size_t count)
      : gap(count), gap_error(count), normal(count), arm_a(count), arm_b(count), status(count) {}
  GapColumns usual() { return {gap, gap_error, normal, {}, {}, status}; }
  GapColumns with_arms() { return {gap, gap_error, normal, arm_a, arm_b, status}; }
};

Family make_family(const tangency::verify::ContactFamily& shape, std::size_t count) {
  Family f{shape.name, {}, {}, {}, {}, {}};
  tangency::verify::ManufacturedContacts contacts(shape, kSeed);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto c = contacts.next();
    f.bodies.push_back(tangency::verify::to_ellipsoid(c.a));
    f.bodies.push_back(tangency::verify::to_ellipsoid(c.b));
    f.pairs.push_back({2 * i, 2 * i + 1});
    f.truth.push_back(c.gap);
    f.smallest_semi_axis.push_back(c.smallest_semi_axis);
    f.previous_normal.push_back(
        signed_gap(f.bodies[2 * i], moment_ago(f.bodies[2 * i + 1], c.smallest_semi_axis, i))
            .normal);
  }
  return f;
}

/// Prints the largest error of what a method answers; ends the program where it is wrong.
void check(const std::string& name, const Family& f, const Answers& answers) {
  double worst = 0.0, certified = 0.0;
  for (std::size_t i = 0; i < f.truth.size(); ++i) {
    worst = std::max(worst, std::abs(answers.gap[i] - f.truth[i]) / f.smallest_semi_axis[i]);
    certified = std::max(certified, answers.gap_error[i] / f.smallest_semi_axis[i]);
  }
  std::printf("%-28s gap error %.2e of the smallest semi-axis, certified %.2e\n", name.c_str(),
              worst, certified);
  // Class 3 is of aspect and size ratio to 1000, where rounding is as many times larger.
  if (!(worst < (f.name.find('3') == std::string::npos ? 5e-15 : 1e-9))) {
    std::fprintf(stderr, "%s: wrong: no timing\n", name.c_str());
    std::exit(1);
  }
}

/// Registers a benchmark of one call for all pairs, reported per pair.
template <class Call>
benchmark::internal::Benchmark* add(const std::string& name, std::int64_t level, std::size_t count,
                                    const Call& call) {
  return benchmark::RegisterBenchmark(
             name.c_str(),
             [level, count, call](benchmark::State& state) {
               force_level(level);
               while (state.KeepRunningBatch(static_cast<std::int64_t>(count))) {
                 call();
                 benchmark::ClobberMemory();
               }
               force_level(0);
             })
      ->Apply(tangency::bench::least_of_repetitions);
}

/// Bodies and pairs in random order.
void scatter(Family& f) {
  std::mt19937_64 random(kSeed);
  std::vector<std::uint32_t> place(f.bodies.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
  std::shuffle(place.begin(), place.end(), random);
  std::vector<Ellipsoid> moved = f.bodies;
  for (std::uint32_t i = 0; i < place.size(); ++i) moved[place[i]] = f.bodies[i];
  f.bodies = std::move(moved);
  for (IndexedPair& pair : f.pairs) pair = {place[pair.a], place[pair.b]};
}

/// Cold, the first or the second half of the pairs.
void signed_half(const Family& f, const BodyArray& bodies, Answers& answers, std::size_t which) {
  const std::size_t half = f.pairs.size() / 2, first = which * half;
  const auto part = [&](auto& column) { return std::span(column).subspan(first, half); };
  signed_gaps(bodies, {part(f.pairs), {}},
              {part(answers.gap),
               part(answers.gap_error),
               part(answers.normal),
               {},
               {},
               part(answers.status)});
}

void check_overlaps(const std::string& name, const Family& f, const bool* answers) {
  for (std::size_t i = 0; i < f.truth.size(); ++i) {
    if (answers[i] == (f.truth[i] < 0.0)) continue;
    std::fprintf(stderr, "%s: pair %zu answered wrongly: no timing\n", name.c_str(), i);
    std::exit(1);
  }
}

void add_plain(const Family& f, std::int64_t level) {
  const std::size_t count = f.pairs.size();
  const auto a = std::make_shared<std::vector<Ellipsoid>>();
  const auto b = std::make_shared<std::vector<Ellipsoid>>();
  for (const IndexedPair& pair : f.pairs) {
    a->push_back(f.bodies[pair.a]);
    b->push_back(f.bodies[pair.b]);
  }
  const auto gaps = std::make_shared<std::vector<Gap>>(count);
  add(std::string("plain/") + f.name + "/" + hwy::TargetName(level), level, count,
      [a, b, gaps] { signed_gaps(*a, *b, *gaps); });
}

void add_family(const Family& f, const BodyArray& bodies, std::int64_t level) {
  const std::string end = "/" + f.name + "/" + hwy::TargetName(level);
  const auto answers = std::make_shared<Answers>(f.pairs.size());
  const auto cold = [&f, &bodies, answers] {
    signed_gaps(bodies, {f.pairs, {}}, answers->usual());
  };
  const auto with_arms = [&f, &bodies, answers] {
    signed_gaps(bodies, {f.pairs, {}}, answers->with_arms());
  };
  const auto following = [&f, &bodies, answers] {
    follow_gaps(bodies, {f.pairs, {}}, f.previous_normal, answers->usual());
  };
  const std::shared_ptr<bool[]> meet(new bool[f.pairs.size()]);
  const auto yes_or_no = [&f, &bodies, meet] {
    overlaps(bodies, {f.pairs, {}}, std::span<bool>(meet.get(), f.pairs.size()));
  };
  force_level(level);
  yes_or_no();
  check_overlaps("overlaps" + end, f, meet.get());
  cold();
  check("cold" + end, f, *answers);
  following();
  check("following" + end, f, *answers);
  force_level(0);
  add("cold" + end, level, f.pairs.size(), cold);
  add("cold_with_arms" + end, level, f.pairs.size(), with_arms);
  add("following" + end, level, f.pairs.size(), following);
  add("overlaps" + end, level, f.pairs.size(), yes_or_no);
  add_plain(f, level);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::vector<Family> families;
  std::vector<BodyArray> arrays;
  for (const auto& shape : tangency::verify::contact_classes())
    families.push_back(make_family(shape, kInCache));
  for (const Family& f : families) arrays.emplace_back(f.bodies);
  Family large = make_family(tangency::verify::contact_classes()[0], 50000);
  scatter(large);
  const BodyArray large_array(large.bodies);
  tangency::bench::add_inverse();
  for (const std::int64_t level : hwy::SupportedAndGeneratedTargets()) {
    for (std::size_t i = 0; i < families.size(); ++i) add_family(families[i], arrays[i], level);
    const auto answers = std::make_shared<Answers>(large.pairs.size());
    const auto scattered = [&large, &large_array, answers] {
      signed_gaps(large_array, {large.pairs, {}}, answers->usual());
    };
    scattered();
    check("scattered", large, *answers);
    add(std::string("scattered/class1/") + hwy::TargetName(level), level, large.pairs.size(),
        scattered);
    const auto two_threads = [&large, &large_array, answers] {
      const std::jthread helper([&] { signed_half(large, large_array, *answers, 0); });
      signed_half(large, large_array, *answers, 1);
    };
    two_threads();
    check("two_threads", large, *answers);
    add(std::string("two_threads/class1/") + hwy::TargetName(level), level, large.pairs.size(),
        two_threads)
        ->UseRealTime();
  }
  tangency::bench::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
