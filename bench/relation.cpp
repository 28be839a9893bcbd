// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of the exact yes/no question, as ratios to the throughput of Eigen's 3x3 inverse over 1024
// distinct matrices in cache, timed in the same run. Answers are checked before anything is timed.
//
// By family: which tier answered, what overlaps() costs, what the filter alone costs (where the
// pair is in its range), and what the exact tier costs.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <tangency/bench/timing.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/relation/exact_pair.hpp>
#include <tangency/geometry/relation/overlap_filter.hpp>
#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace {

using tangency::Ellipsoid;
using tangency::Tier;
using tangency::verify::to_ellipsoid;

using tangency::bench::kInCache;
constexpr std::uint64_t kSeed = 20261122;

struct Family {
  std::string name;
  std::vector<Ellipsoid> a, b;
  std::vector<double> relative_gap;  ///< |gap| over the smallest semi-axis; empty where unknown
};

std::vector<Family> make_families() {
  std::vector<Family> families;
  for (const auto& shape : tangency::verify::contact_classes()) {
    Family family{shape.name, {}, {}, {}};
    tangency::verify::ManufacturedContacts contacts(shape, kSeed);
    for (std::size_t i = 0; i < kInCache; ++i) {
      const auto c = contacts.next();
      family.a.push_back(to_ellipsoid(c.a));
      family.b.push_back(to_ellipsoid(c.b));
      family.relative_gap.push_back(std::abs(c.gap) / c.smallest_semi_axis);
      if (tangency::overlaps(family.a.back(), family.b.back()) != (c.gap < 0)) {
        std::fprintf(stderr, "%s: pair %zu answered wrongly: no timing\n", shape.name.c_str(), i);
        std::exit(1);
      }
    }
    families.push_back(std::move(family));
  }
  std::map<std::string, Family> hostile;
  tangency::verify::for_each_adversarial_pair(
      kSeed, 2000, [&](const tangency::verify::AdversarialPair& p) {
        Family& family = hostile[std::string(p.family)];
        family.name = p.family;
        family.a.push_back(to_ellipsoid(p.a));
        family.b.push_back(to_ellipsoid(p.b));
        if (tangency::overlaps(family.a.back(), family.b.back()) !=
            tangency::verify::exact_overlaps(p.a, p.b)) {
          std::fprintf(stderr, "%s: a pair answered wrongly: no timing\n", family.name.c_str());
          std::exit(1);
        }
      });
  for (auto& [name, family] : hostile) families.push_back(std::move(family));
  return families;
}

/// Registers a benchmark of one call per pair of the family.
template <class Call>
void add(const std::string& name, const Family& family, const Call& call, double exact_share) {
  std::printf("%-44s %.1f %% of the answers from the exact tier\n", name.c_str(),
              100.0 * exact_share);
  tangency::bench::add_calls(name, family.a.size(), [&family, call](std::size_t i) {
    return call(family.a[i], family.b[i]);
  });
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;

  tangency::bench::add_inverse();
  const std::vector<Family> families = make_families();
  std::vector<Family> distant;
  for (const Family& family : families) {
    if (family.relative_gap.empty()) continue;
    Family far{family.name, {}, {}, {}};
    for (std::size_t i = 0; i < family.a.size(); ++i) {
      if (family.relative_gap[i] < 1e-6) continue;
      far.a.push_back(family.a[i]);
      far.b.push_back(family.b[i]);
    }
    distant.push_back(std::move(far));
  }
  const auto share_of_exact = [](const Family& family) {
    double exact = 0;
    for (std::size_t i = 0; i < family.a.size(); ++i) {
      exact += tangency::overlap_answer(family.a[i], family.b[i]).tier == Tier::exact;
    }
    return exact / static_cast<double>(family.a.size());
  };
  const auto overlaps = [](const Ellipsoid& a, const Ellipsoid& b) {
    return tangency::overlaps(a, b);
  };
  for (const Family& family : families) {
    add("overlaps/" + family.name, family, overlaps, share_of_exact(family));
  }
  for (const Family& family : distant) {
    add("overlaps_gap_above_1e-6/" + family.name, family, overlaps, share_of_exact(family));
    add(
        "filter_alone_gap_above_1e-6/" + family.name, family,
        [](const Ellipsoid& a, const Ellipsoid& b) {
          return tangency::detail::OverlapFilter(a, b, b.centre() - a.centre()).answer();
        },
        0);
    add(
        "exact_alone/" + family.name, family,
        [](const Ellipsoid& a, const Ellipsoid& b) {
          return tangency::exact::ExactPair(a, b).position();
        },
        1);
  }
  tangency::bench::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
