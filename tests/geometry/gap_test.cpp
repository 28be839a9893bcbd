// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap/proof.hpp>
#include <tangency/geometry/normals/factored.hpp>
#include <tangency/geometry/normals/newton.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>

namespace tangency {
namespace {

using Eigen::Quaterniond;
using verify::ContactFamily;
using verify::ManufacturedContact;
using verify::to_ellipsoid;

constexpr double kU = kUnitRoundoff;
constexpr std::uint64_t kSeed = 20261122;

struct Worst {
  int wrong_sign = 0;
  int not_ok = 0;
  double error_over_smallest_axis = 0;
  double error_over_u_size = 0;
  ManufacturedContact row;
};

/// Solves `count` contacts of a family and prints the worst.
Worst run(const ContactFamily& family, int count) {
  verify::ManufacturedContacts contacts(family, kSeed);
  Worst worst;
  for (int i = 0; i < count; ++i) {
    const ManufacturedContact c = contacts.next();
    const Ellipsoid a = to_ellipsoid(c.a), b = to_ellipsoid(c.b);
    const Gap gap = signed_gap(a, b);
    const double error = std::abs(gap.gap - c.gap);
    worst.wrong_sign += overlaps(a, b) != (c.gap < 0);
    worst.not_ok += gap.status != GapStatus::ok;
    worst.error_over_u_size = std::max(worst.error_over_u_size, error / (kU * c.size));
    if (!(error / c.smallest_semi_axis <= worst.error_over_smallest_axis)) {
      worst.error_over_smallest_axis = error / c.smallest_semi_axis;
      worst.row = c;
    }
  }
  const auto& [ac, ar, aq] = worst.row.a;
  const auto& [bc, br, bq] = worst.row.b;
  std::printf(
      "%s aspect %g, %d contacts, seed %llu: wrong signs %d, not ok %d, largest error %.3g of "
      "the smallest semi-axis, %.3g u L\n  worst row: "
      "%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a,%a gap %a\n",
      family.name.c_str(), family.aspect, count, static_cast<unsigned long long>(kSeed),
      worst.wrong_sign, worst.not_ok, worst.error_over_smallest_axis, worst.error_over_u_size,
      ac[0], ac[1], ac[2], ar[0], ar[1], ar[2], aq[0], aq[1], aq[2], aq[3], bc[0], bc[1], bc[2],
      br[0], br[1], br[2], bq[0], bq[1], bq[2], bq[3], worst.row.gap);
  return worst;
}

ContactFamily one_percent(double aspect) {
  return {"one percent",
          ContactFamily::Shape::triaxial,
          aspect,
          3,
          ContactFamily::GapUnit::smallest_semi_axis,
          0.01};
}

TEST(GapOfManufacturedContacts, IsWithin1e12OfTheSmallestSemiAxisAtOrdinaryAspects) {
  for (const double aspect : {1.43, 5.0}) {
    const Worst worst = run(one_percent(aspect), 10000);
    EXPECT_EQ(worst.wrong_sign, 0);
    EXPECT_EQ(worst.not_ok, 0);
    EXPECT_LT(worst.error_over_smallest_axis, 1e-12);
  }
}

TEST(GapOfManufacturedContacts, IsWithin8uLAtAspect100) {
  const Worst worst = run(one_percent(100), 10000);
  EXPECT_EQ(worst.wrong_sign, 0);
  EXPECT_EQ(worst.not_ok, 0);
  EXPECT_LT(worst.error_over_u_size, 8);
}

TEST(GapOfManufacturedContacts, IsWithin8uLInEveryClass) {
  for (const ContactFamily& family : verify::contact_classes()) {
    const Worst worst = run(family, 10000);
    EXPECT_EQ(worst.wrong_sign, 0) << family.name;
    EXPECT_EQ(worst.not_ok, 0) << family.name;
    EXPECT_LT(worst.error_over_u_size, 8) << family.name;
  }
}

TEST(Gap, OfSpheresIsDistanceOfCentresLessRadii) {
  const Ellipsoid a({1, 2, 3}, {2, 2, 2}), b({1, 2 + 12, 3 + 5}, {4, 4, 4});
  const Gap gap = signed_gap(a, b);
  EXPECT_EQ(gap.gap, 7);
  EXPECT_LE((gap.normal - Vec3(0, 12, 5) / 13).norm(), 2 * kU);
  EXPECT_LE((gap.arm_a - 2 * Vec3(0, 12, 5) / 13).norm(), 8 * kU);
  EXPECT_LE((gap.arm_b + 4 * Vec3(0, 12, 5) / 13).norm(), 8 * kU);
}

TEST(Gap, OfConcentricSpheresIsMinusTheSumOfRadiiAlongTheFirstAxisOfA) {
  const Ellipsoid a({0, 0, 0}, {2, 2, 2}), b({0, 0, 0}, {3, 3, 3});
  const Gap gap = signed_gap(a, b);
  EXPECT_EQ(gap.gap, -5);
  EXPECT_EQ(gap.normal, Vec3(1, 0, 0));
  EXPECT_EQ(gap.status, GapStatus::ok);
}

TEST(Gap, OfConcentricBodiesIsAlongTheLeastSumOfWidths) {
  // Parallel axes: h_A + h_B is least along the second axis, 2 + 1.
  const Ellipsoid a({5, 5, 5}, {4, 2, 3}), b({5, 5, 5}, {1, 1, 9});
  const Gap gap = signed_gap(a, b);
  EXPECT_NEAR(gap.gap, -3, 64 * kU);
  EXPECT_NEAR(std::abs(gap.normal.y()), 1, 64 * kU);
}

TEST(Gap, OfCoaxialSpheroidsIsAlongTheAxis) {
  const Ellipsoid a({0, 0, 0}, {1, 1, 3}), b({0, 0, 10}, {2, 2, 5});
  const Gap gap = signed_gap(a, b);
  EXPECT_NEAR(gap.gap, 2, 16 * 18 * kU);
  EXPECT_LE((gap.normal - Vec3(0, 0, 1)).norm(), 16 * kU);
}

TEST(Gap, OfABodyWithItselfIsMinusItsLeastWidth) {
  const Ellipsoid a({1, 1, 1}, {3, 1, 2}, {0.1, 0.7, -0.3, 0.5});
  const Gap gap = signed_gap(a, a);
  EXPECT_NEAR(gap.gap, -2, 128 * kU);
  EXPECT_TRUE(overlaps(a, a));
}

TEST(Gap, SmallBodyDeepInsideALargeOneLeavesByTheNearestSide) {
  const Ellipsoid a({0, 0, 0}, {10, 8, 6}), b({0.5, 0, 1}, {0.1, 0.2, 0.3});
  const Gap gap = signed_gap(a, b);
  EXPECT_EQ(gap.status, GapStatus::ok);
  // Straight up, A's top is 6 - 1 away and B's half height 0.3: no shorter way than the best found.
  EXPECT_LT(gap.gap, -4.5);
  EXPECT_GE(gap.gap, -5.3);
}

ContactFamily extreme(double aspect, double largest_gap_over_rho) {
  return {"extreme", ContactFamily::Shape::drawn, aspect,
          1e4,       ContactFamily::GapUnit::rho, largest_gap_over_rho};
}

TEST(Gap, IsRightForEveryAspectRatioTo1e8) {
  for (const double aspect : {1e2, 1e4, 1e6, 1e8}) {
    for (const double largest_gap : {1e-3, 1.0, 1e3, 1e6}) {
      const Worst worst = run(extreme(aspect, largest_gap), 1000);
      // Gaps down to -rho itself are drawn, and rho may be less than rounding: there an answer is
      // right and not proven.
      if (largest_gap < 1 && aspect <= 1e6) {
        EXPECT_EQ(worst.not_ok, 0) << aspect << ' ' << largest_gap;
      }
      EXPECT_LT(worst.error_over_u_size, 8) << aspect << ' ' << largest_gap;
    }
  }
}

TEST(Gap, FastPathRefusesWhatItWouldGetWrong) {
  // Flat bodies apart have false local maxima with gap < 0, and products of squares of semi-axes
  // hide the short ones: proven must mean the known answer.
  int refused = 0;
  for (const double aspect : {1e3, 1e5}) {
    verify::ManufacturedContacts contacts(extreme(aspect, 1e3), kSeed);
    for (int i = 0; i < 5000; ++i) {
      const ManufacturedContact c = contacts.next();
      const Ellipsoid a = to_ellipsoid(c.a), b = to_ellipsoid(c.b);
      const Vec3 d = b.centre() - a.centre();
      const detail::Stationary found = detail::newton_from(a, b, d, detail::newton_start(a, b, d));
      detail::GapProof proof;
      if (found.accepted) detail::prove_gap(detail::Pair({a, b, &d}), found.normal, proof);
      refused += !found.accepted || !(proof.high - proof.gap <= 16 * kU * c.size);
      if (!found.accepted || !proof.global) continue;
      // The truth is manufactured to second order of rounding.
      ASSERT_LE(c.gap, proof.high + 2 * kU * c.size) << aspect << ' ' << i;
      ASSERT_GE(c.gap, proof.low - 2 * kU * c.size) << aspect << ' ' << i;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(Gap, OfCentresFurtherApartThanTheLargestDoubleIsInfiniteAlongTheirLine) {
  const double far = 1.5e308;
  const Gap gap = signed_gap(Ellipsoid({-far, 0, 0}, {1, 2, 3}), Ellipsoid({far, 0, 0}, {3, 2, 1}));
  EXPECT_EQ(gap.gap, std::numeric_limits<double>::infinity());
  EXPECT_LE((gap.normal - Vec3(1, 0, 0)).norm(), 16 * kU);
  EXPECT_LE((gap.arm_a - Vec3(1, 0, 0)).norm(), 16 * kU);
  EXPECT_EQ(gap.status, GapStatus::ok);
}

TEST(Gap, AscentLeavesASaddleAndAMinimum) {
  // Concentric with parallel axes: -(h_A + h_B) is least along x, a saddle along z, greatest along
  // y.
  const Ellipsoid a({0, 0, 0}, {4, 2, 3}), b({0, 0, 0}, {5, 1, 2});
  const detail::FactoredPair pair(a, b, Vec3::Zero());
  for (const Vec3& start : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitZ())}) {
    const detail::Stationary found = pair.climb(start);
    ASSERT_TRUE(found.accepted);
    EXPECT_NEAR(pair.value(found.normal), -3, 64 * kU);
  }
}

// geometry/gap.hpp (3)
TEST(Gap, OfScaledPairsScales) {
  verify::ManufacturedContacts contacts(verify::contact_classes()[1], kSeed);
  for (int i = 0; i < 200; ++i) {
    const ManufacturedContact c = contacts.next();
    const Ellipsoid a = to_ellipsoid(c.a), b = to_ellipsoid(c.b);
    const Gap gap = signed_gap(a, b);
    for (const double scale : {0x1p-1000, 0x1p-200, 0x1p200, 0x1p1000}) {
      const Ellipsoid sa(scale * a.centre(), scale * a.semi_axes(), a.orientation());
      const Ellipsoid sb(scale * b.centre(), scale * b.semi_axes(), b.orientation());
      const Gap scaled = signed_gap(sa, sb);
      ASSERT_EQ(scaled.status, GapStatus::ok);
      const double bound = 16 * kU * c.size;
      ASSERT_LE(std::abs(scaled.gap / scale - gap.gap), bound) << scale;
      // The points move as fast as the normal, whose error is amplified by the shape: as in the
      // property tests, along n they are as good as the gap.
      ASSERT_LE(std::abs(scaled.normal.dot(scaled.arm_a / scale) - a.support(scaled.normal)),
                bound);
      ASSERT_LE(std::abs(scaled.normal.dot(scaled.arm_b / scale) + b.support(scaled.normal)),
                bound);
    }
  }
}

}  // namespace
}  // namespace tangency
