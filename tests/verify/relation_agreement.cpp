// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the kernel's relation against the exact oracle on as many pairs as asked for, and tallies
// by family and by tier. The merge gate runs a part of it; docs/testing.md names the whole.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <tangency/geometry/relation.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace {

using tangency::Tier;
using tangency::verify::RawEllipsoid;

double processor_time() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Tally {
  double slowest = 0.0;  ///< s of one relation()
  long pairs = 0;
  long disagreements = 0;
  long overlaps_filter = 0;
  long relation_filter = 0;

  void add(const Tally& other) {
    slowest = std::max(slowest, other.slowest);
    pairs += other.pairs;
    disagreements += other.disagreements;
    overlaps_filter += other.overlaps_filter;
    relation_filter += other.relation_filter;
  }
};

using Tallies = std::map<std::string, Tally, std::less<>>;

void print_hex(const RawEllipsoid& e) {
  for (const double x : e.centre) std::printf("%a,", x);
  for (const double x : e.semi_axes) std::printf("%a,", x);
  for (const double x : e.orientation) std::printf("%a,", x);
}

void compare(const RawEllipsoid& raw_a, const RawEllipsoid& raw_b, std::string_view family,
             Tallies& tallies) {
  const auto a = tangency::verify::to_ellipsoid(raw_a), b = tangency::verify::to_ellipsoid(raw_b);
  const double before = processor_time();
  const auto relation = tangency::relation(a, b);
  const double taken = processor_time() - before;
  const auto overlap = tangency::overlap_answer(a, b);
  const auto truth = tangency::verify::exact_relation(raw_a, raw_b);

  using TrueRelation = tangency::verify::Relation;
  const bool meet =
      truth.relation != TrueRelation::separate && truth.relation != TrueRelation::external_touch;
  const bool same_inner =
      (relation.inner == tangency::Inner::a) == (truth.inner == tangency::verify::Inner::a) &&
      (relation.inner == tangency::Inner::b) == (truth.inner == tangency::verify::Inner::b);
  const bool agree = to_string(relation.relation) == tangency::verify::name(truth.relation) &&
                     same_inner && overlap.overlaps == meet;

  auto found = tallies.find(family);
  if (found == tallies.end()) found = tallies.emplace(family, Tally{}).first;
  Tally& tally = found->second;
  ++tally.pairs;
  tally.slowest = std::max(tally.slowest, taken);
  tally.overlaps_filter += overlap.tier == Tier::filter;
  tally.relation_filter += relation.tier == Tier::filter;
  if (agree) return;
  ++tally.disagreements;
  static std::mutex printing;
  const std::lock_guard lock(printing);
  std::printf("DISAGREE %s: relation %s (overlaps %d), oracle %s: ", std::string(family).c_str(),
              std::string(to_string(relation.relation)).c_str(), overlap.overlaps,
              std::string(tangency::verify::name(truth.relation)).c_str());
  print_hex(raw_a);
  print_hex(raw_b);
  std::printf("\n");
}

/// One part of the work, whose outcome depends on nothing but its own seed and count.
struct Job {
  const tangency::verify::ContactFamily* family;  ///< none: adversarial or heaviest pairs
  bool heaviest;
  std::uint64_t seed;
  long count;
};

void run(const Job& job, Tallies& tallies) {
  if (job.heaviest) {
    tangency::verify::HeaviestPairs pairs({1074}, job.seed);
    for (long i = 0; i < job.count; ++i) {
      const auto pair = pairs.next();
      compare(pair.a, pair.b, "heaviest", tallies);
    }
    return;
  }
  if (job.family == nullptr) {
    tangency::verify::for_each_adversarial_pair(
        job.seed, static_cast<std::size_t>(job.count),
        [&](const tangency::verify::AdversarialPair& p) { compare(p.a, p.b, p.family, tallies); });
    return;
  }
  tangency::verify::ManufacturedContacts contacts(*job.family, job.seed);
  for (long i = 0; i < job.count; ++i) {
    const auto contact = contacts.next();
    compare(contact.a, contact.b, job.family->name, tallies);
  }
}

/// Pairs of each class, adversarial ones and those over the whole range of doubles.
struct Counts {
  long per_class = 1'000'000, adversarial = 100'000, heaviest = 0;
};

bool agree(std::uint64_t seed, unsigned threads, const Counts& counts) {
  const auto& [per_class, adversarial, heaviest] = counts;
  constexpr long kPart = 10'000;
  std::vector<Job> jobs;
  const auto split = [&](const tangency::verify::ContactFamily* family, long count,
                         bool heavy = false) {
    const long part = heavy ? kPart / 100 : kPart;
    for (long done = 0; done < count; done += part) {
      jobs.push_back({family, heavy, seed + jobs.size(), std::min(part, count - done)});
    }
  };
  split(nullptr, heaviest, true);
  split(nullptr, adversarial);
  for (const auto& family : tangency::verify::contact_classes()) split(&family, per_class);

  Tallies total;
  std::mutex adding;
  tangency::testing::for_each_part(threads, jobs.size(), [&](std::size_t i) {
    Tallies part;
    run(jobs[i], part);
    const std::lock_guard lock(adding);
    for (const auto& [family, tally] : part) total[family].add(tally);
  });

  Tally all;
  std::printf("%-28s %9s %13s %16s %16s %11s\n", "family", "pairs", "disagreements",
              "overlaps filter", "relation filter", "slowest");
  const auto print = [](const char* name, const Tally& t) {
    std::printf("%-28s %9ld %13ld %14.3f %% %14.3f %% %8.3f ms\n", name, t.pairs, t.disagreements,
                100.0 * static_cast<double>(t.overlaps_filter) / static_cast<double>(t.pairs),
                100.0 * static_cast<double>(t.relation_filter) / static_cast<double>(t.pairs),
                1e3 * t.slowest);
  };
  for (const auto& [family, tally] : total) {
    print(family.c_str(), tally);
    all.add(tally);
  }
  print("all", all);
  return all.disagreements == 0 && all.pairs == heaviest + adversarial + 3 * per_class;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "relation_agreement", "Hold the kernel's exact relation against the oracle's");
  Counts counts;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  program.option("--per-class", counts.per_class, "random pairs of each class");
  program.option("--adversarial", counts.adversarial, "adversarial pairs");
  program.option(
      "--heaviest", counts.heaviest,
      "pairs of numbers over the whole range of doubles; the oracle takes a second a pair");
  program.option("--threads", threads);
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(seed, threads, counts); });
}
