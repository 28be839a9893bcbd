// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle for gaps by the Perram-Wertheim function against spheres, worked out by hand, and
// against what moving a body makes of it.
#include <gtest/gtest.h>

#include <cmath>

#include <tangency/tests/verify/raw_sampler.hpp>
#include <tangency/verify/oracles/perram_wertheim.hpp>

namespace tangency::verify {
namespace {

const Real kTight("1e-90");

TEST(PerramWertheimOracle, AllItsGapsAreThoseOfTheCommonNormalForSpheres) {
  for (const double apart : {0.25, 5.0, 20.0}) {
    const auto truth =
        perram_wertheim(RawEllipsoid{{1, 2, 3}, {2, 2, 2}},
                        RawEllipsoid{{1 + 0.6 * apart, 2, 3 + 0.8 * apart}, {3, 3, 3}});
    ASSERT_TRUE(truth);
    const Real dx = Real(1 + 0.6 * apart) - 1, dz = Real(3 + 0.8 * apart) - 3;
    const Real gap = sqrt(dx * dx + dz * dz) - 5;
    EXPECT_LT(abs(truth->tangent_planes.gap - gap), kTight);
    EXPECT_LT(abs(truth->centre_line - gap), kTight);
    ASSERT_TRUE(truth->midpoint);
    EXPECT_LT(abs(truth->midpoint->gap - gap), kTight);
  }
}

TEST(PerramWertheimOracle, MovedByTheGapAlongTheLineOfCentresBodiesTouch) {
  RawSampler draw(3);
  for (int i = 0; i < 40; ++i) {
    const RealEllipsoid a = real(draw.body(1, 5));
    RealEllipsoid b = real(draw.body(2, 5));
    const auto truth = perram_wertheim(a, b);
    ASSERT_TRUE(truth);
    Real3 d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = b.centre[k] - a.centre[k];
    const Real length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (std::size_t k = 0; k < 3; ++k) b.centre[k] -= truth->centre_line * d[k] / length;
    const auto moved = perram_wertheim(a, b);
    ASSERT_TRUE(moved);
    EXPECT_LT(abs(moved->contact_function - 1), kTight);
    EXPECT_LT(abs(moved->tangent_planes.gap), kTight);
  }
}

TEST(PerramWertheimOracle, SaysNothingOfCoincidingCentres) {
  EXPECT_FALSE(
      perram_wertheim(RawEllipsoid{{1, 2, 3}, {1, 2, 3}}, RawEllipsoid{{1, 2, 3}, {3, 3, 3}}));
}

}  // namespace
}  // namespace tangency::verify
