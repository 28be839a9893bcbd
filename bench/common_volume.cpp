// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of the common volume and its gradient, by family of overlapping pairs and by tolerance, as
// ratios to the throughput of Eigen's 3x3 inverse, timed in the same run. Before anything is timed,
// volumes and gradients of four pairs of each family are held against the oracle at each tolerance.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <tangency/bench/timing.hpp>
#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/pair.hpp>
#include <tangency/verify/oracles/common_volume.hpp>

namespace {

using namespace tangency;

constexpr std::uint64_t kSeed = 20261130;
constexpr std::size_t kPairs = 64, kChecked = 4;
constexpr double kTolerances[] = {1e-12, 1e-6};

struct Family {
  const char* name;
  double aspect, from, to;  ///< how far apart, over the distance at which they touch
};
constexpr Family kFamilies[] = {{"spheres", 1, 0.5, 0.95},
                                {"aspect-3-deep", 3, 0.1, 0.9},
                                {"aspect-3-contacts", 3, 0.98, 0.9999},
                                {"aspect-100", 100, 0.1, 0.9},
                                {"aspect-1e6", 1e6, 0.1, 0.9},
                                {"aspect-1e8", 1e8, 0.1, 0.9}};

struct Pairs {
  std::vector<Ellipsoid> a, b;
};

/// That overlap, along the normal of a drawn touch.
Pairs pairs_of(const Family& family) {
  verify::Draw draw(kSeed);
  Pairs pairs;
  while (pairs.a.size() < kPairs) {
    const auto body = [&] {
      return verify::to_ellipsoid(
          verify::turned_body(draw, verify::triaxial_axes(draw, 1.0, family.aspect)));
    };
    const Ellipsoid a = body(), b = body();
    const double x = draw.real(-1, 1), y = draw.real(-1, 1), z = draw.real(0.1, 1);
    const Vec3 n = Vec3(x, y, z).normalized();
    const double far = draw.real(family.from, family.to);
    const Vec3 touch = a.support_point(n) + b.support_point(n);
    const Ellipsoid moved = b.moved_to(Vec3(a.centre() + far * touch));
    if (relation(a, moved).relation != Relation::overlap) continue;
    pairs.a.push_back(a), pairs.b.push_back(moved);
  }
  return pairs;
}

void require_right(const Family& family, const Pairs& pairs) {
  for (std::size_t i = 0; i < kChecked; ++i) {
    const auto truth =
        verify::common_volume(verify::to_raw(pairs.a[i]), verify::to_raw(pairs.b[i]));
    const auto volume = static_cast<double>(truth.volume);
    Vec3 gradient;
    for (int k = 0; k < 3; ++k) gradient[k] = static_cast<double>(truth.gradient[std::size_t(k)]);
    for (const double tolerance : kTolerances) {
      const CommonVolume found = common_volume(pairs.a[i], pairs.b[i], tolerance);
      // The truth is rounded to doubles here.
      const bool right =
          std::abs(found.volume - volume) <= found.volume_error + 1e-15 * volume &&
          (found.gradient - gradient).norm() <= found.gradient_error + 1e-15 * gradient.norm();
      if (right) continue;
      std::fprintf(stderr, "%s: pair %zu, tolerance %g: volume %.17g, gradient %.17g %.17g %.17g, ",
                   family.name, i, tolerance, found.volume, found.gradient[0], found.gradient[1],
                   found.gradient[2]);
      std::fprintf(stderr, "and they are %.17g, %.17g %.17g %.17g: no timing\n", volume,
                   gradient[0], gradient[1], gradient[2]);
      std::exit(1);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  bench::add_inverse();
  for (const Family& family : kFamilies) {
    const Pairs pairs = pairs_of(family);
    require_right(family, pairs);
    for (const double tolerance : kTolerances) {
      const std::string name = std::string(family.name) + (tolerance < 1e-9 ? "/1e-12" : "/1e-6");
      bench::add_calls(name, kPairs, [pairs, tolerance](std::size_t i) {
        return common_volume(pairs.a[i], pairs.b[i], tolerance).volume;
      });
    }
  }
  bench::RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
