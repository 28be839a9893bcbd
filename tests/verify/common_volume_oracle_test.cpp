// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle of common volumes against lenses of balls worked out by hand, against rays from a
// point inside, against points drawn at random, and its gradient against its own differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <tangency/tests/verify/raw_sampler.hpp>
#include <tangency/verify/oracles/common_volume.hpp>

namespace tangency::verify {
namespace {

constexpr unsigned kSeed = 20261130;

double plain(const Real& x) { return static_cast<double>(x); }

class Sampler : public RawSampler {
 public:
  using RawSampler::RawSampler;

  /// That overlap.
  std::array<RawEllipsoid, 2> pair(double aspect) {
    const RawEllipsoid a = body(1, aspect);
    RawEllipsoid b = body(log_uniform(0.7, 1.5), aspect);
    const auto way = vector();
    const double far = uniform(0, 1.2) / std::hypot(way[0], way[1], way[2]);
    for (std::size_t i = 0; i < 3; ++i) b.centre[i] = a.centre[i] + far * way[i];
    return {a, b};
  }
};

TEST(CommonVolumeOracle, OfTwoBallsIsTheLensBetweenThem) {
  const Real pi = acos(Real(-1));
  for (const double d : {0.75, 1.5, 3 - 0x1p-30}) {
    const RawEllipsoid a{{0, 0, 0}, {1, 1, 1}}, b{{0, 0, d}, {2, 2, 2}, {1, 2, 3, 4}};
    // pi (R + r - d)^2 (d^2 + 2 d (R + r) - 3 (R - r)^2) / (12 d); its chord is a circle.
    const Real x = d, depth = 3 - x;
    const Real lens =
        d <= 1 ? Real(4 * pi / 3) : Real(pi * depth * depth * (x * x + 6 * x - 3) / (12 * x));
    const Real half = (x * x + 1 - 4) / (2 * x),
               disc = d <= 1 ? Real(0) : Real(pi * (1 - half * half));
    const CommonVolumeTruth found = common_volume(a, b);
    EXPECT_LE(plain(abs(found.volume - lens)), 1e-20) << d;
    EXPECT_LE(plain(abs(found.gradient[2] + disc)), 1e-20) << d;
    EXPECT_LE(plain(abs(found.gradient[0]) + abs(found.gradient[1])), 1e-20) << d;
  }
}

TEST(CommonVolumeOracle, AgreesWithRaysAndWithPointsAtRandom) {
  Sampler sampler(kSeed);
  for (int i = 0; i < 4; ++i) {
    const auto [a, b] = sampler.pair(3);
    const double truth = plain(common_volume(a, b).volume);
    ASSERT_GT(truth, 0);
    constexpr int kSteps = 200;
    EXPECT_NEAR(common_volume_by_rays(a, b, kSteps), truth, 3e-4 * truth);
    // Points of the cube about A: the share of those in both.
    const auto inside = [](const RawEllipsoid& e, const Real3& p) {
      const Separation<Real> s = separation(real(e), {p, {1, 1, 1}, {1, 0, 0, 0}});
      Real level = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        Real along = 0;
        for (std::size_t j = 0; j < 3; ++j) along += s.a.axes[k][j] * s.d[j];
        level += along * along / (s.a.semi_axes[k] * s.a.semi_axes[k]);
      }
      return level <= 1;
    };
    double reach = 0;
    for (const double axis : a.semi_axes) reach = std::max(reach, axis);
    constexpr int kPoints = 4000;
    int hits = 0;
    for (int k = 0; k < kPoints; ++k) {
      Real3 p;
      for (std::size_t j = 0; j < 3; ++j) p[j] = a.centre[j] + reach * sampler.uniform(-1, 1);
      hits += inside(a, p) && inside(b, p);
    }
    const double cube = 8 * reach * reach * reach, share = truth / cube;
    const double deviation = std::sqrt(share * (1 - share) / kPoints);
    EXPECT_NEAR(hits / static_cast<double>(kPoints), share, 4.5 * deviation);
  }
}

TEST(CommonVolumeOracle, HasTheGradientOfItsVolume) {
  Sampler sampler(kSeed + 1);
  for (int i = 0; i < 4; ++i) {
    const auto [a, b] = sampler.pair(5);
    const CommonVolumeTruth found = common_volume(a, b);
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double kStep = 0x1p-20;
      RawEllipsoid ahead = b, back = b;
      ahead.centre[k] += kStep, back.centre[k] -= kStep;
      const Real way = Real(ahead.centre[k]) - back.centre[k];
      const Real slope = (common_volume(a, ahead).volume - common_volume(a, back).volume) / way;
      EXPECT_LE(plain(abs(slope - found.gradient[k])), 1e-9);
    }
  }
}

}  // namespace
}  // namespace tangency::verify
