// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of many pairs at once, per pair, as ratios to Eigen's 3x3 inverse: every instruction set of
// the machine, forced one after the other. Answers are checked against the manufactured truth
// before anything is timed.
//
// By class and level: cold (signed_gaps), following (follow_gaps from the normal of a moment ago),
// and overlaps; gap, normal, error and status by columns unless the name says more. "scattered" is
// cold on the 100,000 bodies of 50,000 pairs, bodies and pairs in random order, and "two_threads"
// the same with half of the list for each of two; "plain" is two arrays of ellipsoids and whole
// answers. "following_moving" is following of bodies by columns; the two refreshes, per body, are
// what a simulator does after each step to have that, and to have "following". "listed" is cold on
// pairs as a neighbour list has them, whose gaps are spread up to the smallest semi-axis; with
// "up_to" no answer is wanted beyond an eighth of that, and "far_up_to" is of pairs that are all
// beyond.
#include <hwy/targets.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <tangency/bench/pairs.hpp>
#include <tangency/bench/timing.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>

namespace {

using namespace tangency::bench;
using tangency::Ellipsoid;
using tangency::Gap;
using tangency::GapColumns;
using tangency::IndexedPair;
using tangency::verify::CallAnswer;

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
      ->Apply(least_of_repetitions);
}

/// The same for a call that fills `columns`, once its answers are right.
template <class Call>
benchmark::internal::Benchmark* add_checked(const std::string& name, std::int64_t level,
                                            const Pairs& pairs, const Columns& columns,
                                            const Call& call) {
  force_level(level);
  call();
  force_level(0);
  std::vector<std::optional<CallAnswer>> answers;
  for (std::size_t i = 0; i < pairs.size(); ++i) answers.push_back(columns.answer(i));
  std::printf("%s\n", require_right(name, pairs, answers).c_str());
  return add(name, level, pairs.size(), call);
}

/// Bodies and pairs in random order.
void scatter(Pairs& pairs) {
  std::mt19937_64 random(kSeed);
  std::vector<std::uint32_t> place(pairs.bodies.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
  std::shuffle(place.begin(), place.end(), random);
  std::vector<Ellipsoid> moved = pairs.bodies;
  for (std::uint32_t i = 0; i < place.size(); ++i) moved[place[i]] = pairs.bodies[i];
  pairs.bodies = std::move(moved);
  for (IndexedPair& pair : pairs.list) pair = {place[pair.a], place[pair.b]};
  pairs.array.emplace(pairs.bodies);
}

/// Cold, the first or the second half of the pairs.
void signed_half(const Pairs& pairs, Columns& columns, std::size_t which) {
  const std::size_t half = pairs.size() / 2, first = which * half;
  const auto part = [&](auto& column) { return std::span(column).subspan(first, half); };
  signed_gaps(*pairs.array, {part(pairs.list), {}},
              {part(columns.gap),
               part(columns.gap_error),
               part(columns.normal),
               {},
               {},
               part(columns.status)});
}

void add_overlaps(const Pairs& pairs, const std::string& name, std::int64_t level) {
  const std::size_t count = pairs.size();
  const std::shared_ptr<bool[]> meet(new bool[count]);
  const auto call = [&pairs, meet, count] {
    overlaps(*pairs.array, {pairs.list, {}}, std::span(meet.get(), count));
  };
  force_level(level);
  call();
  force_level(0);
  std::vector<std::optional<CallAnswer>> answers;
  for (std::size_t i = 0; i < count; ++i) answers.push_back(CallAnswer{.overlaps = meet.get()[i]});
  require_right(name, pairs, answers);
  add(name, level, count, call);
}

/// The bodies of a family by columns.
struct Moving {
  explicit Moving(const Pairs& pairs) : ellipsoids(pairs.bodies), array(ellipsoids) {
    for (const Ellipsoid& body : pairs.bodies) {
      semi_axes.push_back(body.semi_axes());
      orientations.push_back(body.orientation());
    }
    for (const IndexedPair& pair : pairs.list)
      separations.push_back(pairs.bodies[pair.b].centre() - pairs.bodies[pair.a].centre());
    bodies = tangency::MovingBodies(semi_axes, orientations);
  }
  /// As it is done where there are no columns.
  void refresh_array() {
    for (std::size_t i = 0; i < ellipsoids.size(); ++i) {
      ellipsoids[i] = Ellipsoid(ellipsoids[i].centre(), semi_axes[i], orientations[i]);
      array.refresh(i);
    }
  }

  std::vector<tangency::Vec3> semi_axes, separations;
  std::vector<tangency::Quaternion> orientations;
  std::vector<Ellipsoid> ellipsoids;
  tangency::MovingBodies bodies;
  tangency::BodyArray array;
};

void add_moving(const Pairs& pairs, const std::string& end, std::int64_t level) {
  const auto moving = std::make_shared<Moving>(pairs);
  const auto columns = std::make_shared<Columns>(pairs.size());
  const auto refresh = [moving] { moving->bodies.refresh(0, moving->bodies.size()); };
  force_level(level);
  refresh();  // so that it is these rows whose answers are checked
  force_level(0);
  add_checked("following_moving" + end, level, pairs, *columns, [&pairs, moving, columns] {
    follow_gaps(moving->bodies, {pairs.list, moving->separations}, pairs.previous_normal,
                columns->usual(pairs.size()));
  });
  add("refresh_moving" + end, level, moving->bodies.size(), refresh);
  add("refresh_array" + end, level, moving->bodies.size(), [moving] { moving->refresh_array(); });
}

void add_plain(const Pairs& pairs, const std::string& name, std::int64_t level) {
  const auto a = std::make_shared<std::vector<Ellipsoid>>();
  const auto b = std::make_shared<std::vector<Ellipsoid>>();
  for (const IndexedPair& pair : pairs.list) {
    a->push_back(pairs.bodies[pair.a]);
    b->push_back(pairs.bodies[pair.b]);
  }
  const auto gaps = std::make_shared<std::vector<Gap>>(pairs.size());
  add(name, level, pairs.size(), [a, b, gaps] { signed_gaps(*a, *b, *gaps); });
}

void add_family(const Pairs& p, std::int64_t level) {
  const std::string end = "/" + p.name + "/" + hwy::TargetName(level);
  const std::size_t count = p.size();
  const auto columns = std::make_shared<Columns>(count);
  const auto cold = [&p, columns, count] {
    signed_gaps(*p.array, {p.list, {}}, columns->usual(count));
  };
  const auto with_arms = [&p, columns, count] {
    GapColumns all = columns->usual(count);
    all.arm_a = columns->arms(count).arm_a, all.arm_b = columns->arms(count).arm_b;
    signed_gaps(*p.array, {p.list, {}}, all);
  };
  const auto following = [&p, columns, count] {
    follow_gaps(*p.array, {p.list, {}}, p.previous_normal, columns->usual(count));
  };
  add_checked("cold" + end, level, p, *columns, cold);
  add("cold_with_arms" + end, level, count, with_arms);
  add_checked("following" + end, level, p, *columns, following);
  add_moving(p, end, level);
  add_overlaps(p, "overlaps" + end, level);
  add_plain(p, "plain" + end, level);
}

/// Contacts of a class, B moved away along the normal: by `least` to `least` + 1 of the smallest
/// semi-axis.
std::unique_ptr<Pairs> moved_apart(const tangency::verify::ContactFamily& kind, double least) {
  const auto contacts = contacts_of(kind, kInCache);
  auto pairs = std::make_unique<Pairs>();
  pairs->name = contacts->name;
  std::mt19937_64 random(kSeed);
  for (std::size_t i = 0; i < contacts->size(); ++i) {
    const Ellipsoid &a = contacts->a(i), &b = contacts->b(i);
    const double part = static_cast<double>(random() >> 11) * 0x1p-53;
    const double way = (least + part) * contacts->smallest[i];
    pairs->add(a, b.moved_to(b.centre() + way * signed_gap(a, b).normal));
    pairs->truth.push_back(contacts->truth[i]);
    pairs->truth.back().gap.high += way;
  }
  pairs->array.emplace(pairs->bodies);
  return pairs;
}

/// What is said of pairs beyond a cutoff, held against the truth; the others against all answers.
void require_cutoff(const Pairs& pairs, const Columns& limited, const Columns& all, double cutoff) {
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double truth = pairs.truth[i].gap.high;
    if (limited.status[i] == tangency::GapStatus::beyond) {
      ++beyond;
      if (limited.gap[i] > cutoff && limited.gap[i] < truth * (1 + 1e-12)) continue;
    } else if (limited.gap[i] == all.gap[i] && truth < cutoff * (1 + 1e-12)) {
      continue;
    }
    std::fprintf(stderr, "up_to: pair %zu is wrong: no timing\n", i);
    std::exit(1);
  }
  std::printf("%-28s beyond %zu of %zu\n", pairs.name.c_str(), beyond, pairs.size());
}

void add_listed(const Pairs& p, const std::string& name, std::int64_t level) {
  const std::string end = "/" + p.name + "/" + hwy::TargetName(level);
  const auto columns = std::make_shared<Columns>(p.size());
  const double cutoff = 0.125 * p.smallest[0];
  const auto ask = [&p, columns](tangency::Accuracy accuracy) {
    signed_gaps(*p.array, {p.list, {}}, columns->usual(p.size()), accuracy);
  };
  const auto follow = [&p, columns, cutoff] {
    follow_gaps(*p.array, {p.list, {}}, p.previous_normal, columns->usual(p.size()),
                tangency::Accuracy::standard().up_to(cutoff));
  };
  const auto up_to = [ask, cutoff] { ask(tangency::Accuracy::standard().up_to(cutoff)); };
  add_checked(name + end, level, p, *columns, [ask] { ask(tangency::Accuracy::standard()); });
  const Columns all = *columns;
  force_level(level);
  up_to();
  force_level(0);
  require_cutoff(p, *columns, all, cutoff);
  add(name + "_up_to" + end, level, p.size(), up_to);
  add(name + "_following_up_to" + end, level, p.size(), follow);
}

void add_scattered(const Pairs& large, std::int64_t level) {
  const std::string end = std::string("/class1/") + hwy::TargetName(level);
  const auto columns = std::make_shared<Columns>(large.size());
  add_checked("scattered" + end, level, large, *columns, [&large, columns] {
    signed_gaps(*large.array, {large.list, {}}, columns->usual(large.size()));
  });
  add_checked("two_threads" + end, level, large, *columns, [&large, columns] {
    const std::jthread helper([&] { signed_half(large, *columns, 0); });
    signed_half(large, *columns, 1);
  })->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::vector<std::unique_ptr<Pairs>> families;
  for (const auto& kind : tangency::verify::contact_classes())
    families.push_back(contacts_of(kind, kInCache));
  const auto listed = moved_apart(tangency::verify::contact_classes()[0], 0.0);
  const auto far = moved_apart(tangency::verify::contact_classes()[0], 0.25);
  const auto large = contacts_of(tangency::verify::contact_classes()[0], 50000);
  scatter(*large);
  add_inverse();
  for (const std::int64_t level : hwy::SupportedAndGeneratedTargets()) {
    for (const auto& family : families) add_family(*family, level);
    add_listed(*listed, "listed", level);
    add_listed(*far, "far", level);
    add_scattered(*large, level);
  }
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
