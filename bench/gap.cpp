// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of the signed gap of one pair at a time, as ratios to Eigen's 3x3 inverse. Answers are
// checked against the manufactured truth before anything is timed.
//
// By class: cold with the certificate (signed_gap), cold without (estimate_gap), and warm
// (follow_gap from the normal of a moment ago, when B was 1e-4 of the smallest semi-axis
// away and turned by as much in rad).
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <tangency/bench/moved_back.hpp>
#include <tangency/bench/yardstick.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>

namespace {

using tangency::Ellipsoid;
using tangency::Gap;
using tangency::Vec3;
using tangency::bench::kInCache;
using tangency::bench::moment_ago;

constexpr std::uint64_t kSeed = 20261122;

struct Family {
  std::string name;
  std::vector<Ellipsoid> a, b;
  std::vector<double> gap, smallest_semi_axis;
  std::vector<Vec3> previous_normal;
};

Family make_family(const tangency::verify::ContactFamily& shape) {
  Family f{shape.name, {}, {}, {}, {}, {}};
  tangency::verify::ManufacturedContacts contacts(shape, kSeed);
  for (std::size_t i = 0; i < kInCache; ++i) {
    const auto c = contacts.next();
    f.a.push_back(tangency::verify::to_ellipsoid(c.a));
    f.b.push_back(tangency::verify::to_ellipsoid(c.b));
    f.gap.push_back(c.gap);
    f.smallest_semi_axis.push_back(c.smallest_semi_axis);
    f.previous_normal.push_back(
        signed_gap(f.a[i], moment_ago(f.b[i], c.smallest_semi_axis, i)).normal);
  }
  return f;
}

/// Prints the largest error of what a method answers; ends the program where it is wrong.
template <class Call>
void check(const std::string& name, const Family& f, const Call& call) {
  double worst = 0.0, certified = 0.0;
  std::map<int, int> tiers;
  for (std::size_t i = 0; i < f.gap.size(); ++i) {
    const Gap gap = call(i);
    worst = std::max(worst, std::abs(gap.gap - f.gap[i]) / f.smallest_semi_axis[i]);
    certified = std::max(certified, gap.gap_error / f.smallest_semi_axis[i]);
    ++tiers[static_cast<int>(gap.tier)];
  }
  std::printf("%-28s gap error %.2e of the smallest semi-axis, certified %.2e; answers by tier:",
              name.c_str(), worst, certified);
  for (const auto& [tier, count] : tiers) std::printf(" %d: %d", tier, count);
  std::printf("\n");
  // Class 3 is of aspect and size ratio to 1000, where rounding is as many times larger.
  if (!(worst < (f.name.find('3') == std::string::npos ? 5e-15 : 1e-9))) {
    std::fprintf(stderr, "%s: wrong: no timing\n", name.c_str());
    std::exit(1);
  }
}

template <class Call>
void add(const std::string& name, const Family& f, const Call& call) {
  check(name, f, call);
  tangency::bench::add_calls(name, f.a.size(), call);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::vector<Family> families;
  for (const auto& shape : tangency::verify::contact_classes())
    families.push_back(make_family(shape));
  tangency::bench::add_inverse();
  for (const Family& f : families) {
    add("cold/" + f.name, f, [&f](std::size_t i) { return signed_gap(f.a[i], f.b[i]); });
    add("warm/" + f.name, f, [&f](std::size_t i) {
      return follow_gap(f.a[i], f.b[i], f.b[i].centre() - f.a[i].centre(), f.previous_normal[i]);
    });
  }
  tangency::bench::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
