// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <tangency/geometry/closest_point.hpp>
#include <tangency/tests/support/generators.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/oracles/primitives.hpp>

namespace tangency {
namespace {

using Eigen::Quaterniond;

constexpr double kU = kUnitRoundoff;

double size_of(const Ellipsoid& e, const Vec3& p) {
  return (p - e.centre()).norm() + e.largest_semi_axis();
}

TEST(ClosestPoint, OfASphereLiesOnTheRayFromTheCentre) {
  const Ellipsoid sphere({1, 2, 3}, {2, 2, 2});
  const ClosestPoint found = closest_point(sphere, {1, 2 + 12, 3 + 5});
  EXPECT_EQ(found.distance, 11);
  EXPECT_LE((found.normal - Vec3(0, 12, 5) / 13).norm(), 2 * kU);
  EXPECT_LE((found.arm - 2 * Vec3(0, 12, 5) / 13).norm(), 4 * kU);
}

TEST(ClosestPoint, OnAnAxisOutsideIsTheTip) {
  const Ellipsoid e({0, 0, 0}, {3, 2, 1});
  for (int i = 0; i < 3; ++i) {
    const ClosestPoint found = closest_point(e, -7 * Vec3::Unit(i));
    EXPECT_EQ(found.distance, 7 - e.semi_axes()[i]);
    EXPECT_EQ(found.normal, Vec3(-Vec3::Unit(i)));
    EXPECT_EQ(found.arm, Vec3(-e.semi_axes()[i] * Vec3::Unit(i)));
  }
}

TEST(ClosestPoint, OfTheCentreIsThePositiveEndOfTheFirstSmallestAxis) {
  const ClosestPoint triaxial = closest_point(Ellipsoid({5, 5, 5}, {3, 1, 2}), {5, 5, 5});
  EXPECT_EQ(triaxial.distance, -1);
  EXPECT_EQ(triaxial.arm, Vec3(0, 1, 0));
  const ClosestPoint prolate = closest_point(Ellipsoid({0, 0, 0}, {3, 2, 2}), {0, 0, 0});
  EXPECT_EQ(prolate.arm, Vec3(0, 2, 0));
  const ClosestPoint sphere = closest_point(Ellipsoid({0, 0, 0}, {2, 2, 2}), {0, 0, 0});
  EXPECT_EQ(sphere.arm, Vec3(2, 0, 0));
  EXPECT_EQ(sphere.distance, -2);
}

TEST(ClosestPoint, InsideTheFocalEllipseTiesToThePositiveSideOfTheSmallestAxis) {
  // From (x, 0) in the plane across the axis b the two closest points of an ellipse of semi-axes
  // a > b are at x a^2 / (a^2 - b^2) while that is below a.
  const Ellipsoid e({0, 0, 0}, {5, 6, 4});
  const ClosestPoint found = closest_point(e, {0.9, 0, 0});
  EXPECT_LE((found.arm - Vec3(2.5, 0, 4 * std::sqrt(0.75))).norm(), 8 * kU);
  EXPECT_GT(found.arm.z(), 0);
  EXPECT_LT(found.distance, 0);
  // Beyond the focal ellipse it is the tip.
  EXPECT_EQ(closest_point(e, {1.9, 0, 0}).arm, Vec3(5, 0, 0));
}

TEST(ClosestPoint, LeavesASymmetryPlaneBySign) {
  const Ellipsoid e({0, 0, 0}, {5, 6, 4});
  const Vec3 above = closest_point(e, {0.9, 0, 1e-200}).arm;
  const Vec3 below = closest_point(e, {0.9, 0, -1e-80}).arm;
  EXPECT_GT(above.z(), 3);
  EXPECT_LT(below.z(), -3);
}

// geometry/closest_point.hpp (1)
TEST(ClosestPoint, OfASurfacePointIsItselfAtDistanceZero) {
  const Ellipsoid e({0, 0, 0}, {3, 4, 5});
  EXPECT_EQ(closest_point(e, {3, 0, 0}).distance, 0);
  EXPECT_EQ(closest_point(e, {0, -4, 0}).arm, Vec3(0, -4, 0));
  // 9/25 + 16/25 = 1, on the ellipse of semi-axes 5 and 10.
  EXPECT_LE(std::abs(closest_point(Ellipsoid({0, 0, 0}, {5, 10, 7}), {3, 8, 0}).distance), 0x1p-80);
}

TEST(ClosestPoint, SignIsRightNextToTheSurface) {
  const Ellipsoid e({0, 0, 0}, {5, 10, 7});
  EXPECT_GT(closest_point(e, {std::nextafter(3, 4), 8, 0}).distance, 0);
  EXPECT_LT(closest_point(e, {std::nextafter(3, 2), 8, 0}).distance, 0);
}

TEST(ClosestPoint, KeepsItsAccuracyWhereTheSeparationOfTheCoordinatesOverflows) {
  const double huge = std::numeric_limits<double>::max();
  const Ellipsoid e({huge, 0, 0}, {1e300, 2e300, 3e300});
  EXPECT_EQ(closest_point(e, {-huge, 0, 0}).distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(closest_point(e, {-huge, 0, 0}).normal, Vec3(-1, 0, 0));
}

// geometry/closest_point.hpp (5)
TEST(ClosestPoint, DoesNotChangeWithAPowerOfTwoUnit) {
  const Quaterniond q(0.3, -0.5, 0.1, 0.8);
  const Vec3 p(0.7, -0.2, 1.1), a(1, 0.01, 0.3);
  const ClosestPoint one = closest_point(Ellipsoid({0, 0, 0}, a, q), p);
  for (const double s : {0x1p-500, 0x1p500}) {
    const ClosestPoint scaled = closest_point(Ellipsoid({0, 0, 0}, s * a, q), s * p);
    EXPECT_EQ(scaled.distance, s * one.distance);
    EXPECT_EQ(scaled.arm, Vec3(s * one.arm));
    EXPECT_EQ(scaled.normal, one.normal);
  }
}

/// A point anywhere about a body: at its centre, on its surface or axes, inside, far away.
rc::Gen<std::pair<Ellipsoid, Vec3>> body_and_point() {
  return rc::gen::map(
      rc::gen::tuple(testing::ellipsoid(1e6), testing::direction(),
                     rc::gen::weightedOneOf<double>({{1, rc::gen::just(0.0)},
                                                     {1, rc::gen::just(1.0)},
                                                     {4, testing::uniform(0, 2)},
                                                     {2, testing::log_uniform(1, 1e6)}})),
      [](const std::tuple<Ellipsoid, Vec3, double>& t) {
        const auto& [e, n, f] = t;
        return std::pair<Ellipsoid, Vec3>(e, e.centre() + f * e.support_point(n));
      });
}

/// How far a closest point's normal moves where point and body move by 1 each (a turn counts as
/// what it moves the body's ends): the distance from the centre of curvature is at least the least
/// radius of curvature + distance. Above 0 no other point of the surface is as close.
double sensitivity(const Ellipsoid& e, double distance) {
  const double radius = e.least_radius() + distance;
  return radius > 0 ? 2 / radius : std::numeric_limits<double>::infinity();
}

constexpr double kComparable = 1e-3;  // rad; chosen: normals that rounding may turn by more tie

// geometry/closest_point.hpp (1)
RC_GTEST_PROP(ClosestPointProperty, OfASurfacePointIsItself, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e6);
  const Vec3 n = *testing::direction(), p = e.centre() + e.support_point(n);
  const ClosestPoint found = closest_point(e, p);
  // The point is on the surface but for the rounding of its unit coordinates, R and the sum.
  const double rounding = 16 * kU * e.largest_semi_axis() + 2 * kU * e.centre().norm();
  RC_ASSERT(std::abs(found.distance) <= rounding);
  RC_ASSERT((p - e.centre() - found.arm).norm() <= rounding);
}

// geometry/closest_point.hpp (4)
RC_GTEST_PROP(ClosestPointProperty, GoesWithARotationAndATranslation, ()) {
  const auto [e, p] = *body_and_point();
  const Quaterniond turn = (*testing::orientation()).normalized();
  const Vec3 shift = 10 * *testing::direction(), q = turn * p + shift;
  const Ellipsoid there(turn * e.centre() + shift, e.semi_axes(), turn * e.orientation());
  const ClosestPoint before = closest_point(e, p), after = closest_point(there, q);
  // Products of quaternions and with vectors are within 8 u, sums within u.
  const double rounding =
      16 * kU * (size_of(e, p) + e.centre().norm() + p.norm() + 2 * shift.norm());
  RC_ASSERT(std::abs(after.distance - before.distance) <= rounding);
  const double turned = rounding * sensitivity(e, before.distance);
  RC_CLASSIFY(turned < kComparable, "normal compared");
  if (turned >= kComparable) return;
  RC_ASSERT((after.normal - turn * before.normal).norm() <= turned);
  RC_ASSERT((after.arm - turn * before.arm).norm() <=
            2 * rounding + turned * std::abs(before.distance));
}

// geometry/closest_point.hpp (5)
RC_GTEST_PROP(ClosestPointProperty, ScalesWithTheUnit, ()) {
  const auto [e, p] = *body_and_point();
  const double s = *testing::log_uniform(1e-100, 1e100);
  const Ellipsoid there(s * e.centre(), s * e.semi_axes(), e.orientation());
  const ClosestPoint before = closest_point(e, p), after = closest_point(there, s * p);
  const double rounding = 8 * kU * (size_of(e, p) + e.centre().norm() + p.norm());
  RC_ASSERT(std::abs(after.distance / s - before.distance) <= rounding);
  const double turned = rounding * sensitivity(e, before.distance);
  if (turned >= kComparable) return;
  RC_ASSERT((after.normal - before.normal).norm() <= turned);
  RC_ASSERT((after.arm / s - before.arm).norm() <=
            2 * rounding + turned * std::abs(before.distance));
}

// geometry/closest_point.hpp (3)
RC_GTEST_PROP(ClosestPointProperty, PointIsCentrePlusArmPlusDistanceAlongTheNormal, ()) {
  const auto [e, p] = *body_and_point();
  const ClosestPoint found = closest_point(e, p);
  const Vec3 rest = p - e.centre() - found.arm - found.distance * found.normal;
  RC_ASSERT(rest.norm() <= 8 * kU * size_of(e, p));
  RC_ASSERT(std::abs(found.normal.norm() - 1) <= 4 * kU);
}

// geometry/closest_point.hpp (2)
RC_GTEST_PROP(ClosestPointProperty, DistanceChangesNoFasterThanThePoint, ()) {
  const auto [e, p] = *body_and_point();
  const Vec3 q = p + *testing::log_uniform(1e-9, 1) * e.largest_semi_axis() * *testing::direction();
  const double change = closest_point(e, q).distance - closest_point(e, p).distance;
  RC_ASSERT(std::abs(change) <= (q - p).norm() + 8 * kU * (size_of(e, p) + size_of(e, q)));
}

RC_GTEST_PROP(ClosestPointProperty, NoSurfacePointIsCloser, ()) {
  const auto [e, p] = *body_and_point();
  const double least = std::abs(closest_point(e, p).distance);
  for (int i = 0; i < 20; ++i) {
    const Vec3 other = e.centre() + e.support_point(*testing::direction());
    RC_ASSERT((p - other).norm() >= least - 16 * kU * (size_of(e, p) + e.centre().norm()));
  }
}

RC_GTEST_PROP(ClosestPointProperty, AgreesWithTheOracleToRounding, ()) {
  const auto [e, p] = *body_and_point();
  const auto raw = verify::to_raw(e);
  const auto truth = verify::nearest(raw, verify::from_centre(raw, {p[0], p[1], p[2]}));
  const auto error = static_cast<double>(abs(closest_point(e, p).distance - truth.distance));
  RC_ASSERT(error <=
            2 * kU * std::abs(static_cast<double>(truth.distance)) + 0x1p-80 * size_of(e, p));
}

TEST(NearestOracle, SatisfiesTheConditionsThatProveItClosest) {
  // p = x + t diag(1/a^2) x with t > -a_min^2, and x on the surface: oracles/primitives.hpp, (1).
  const verify::RawEllipsoid body{{0, 0, 0}, {3, 1e-4, 2}, {1, 0, 0, 0}};
  for (const auto& p : {std::array<double, 3>{1, 2, 3}, {0.5, 1e-5, 0.2}, {-1e6, 1, 0}}) {
    const auto truth = verify::nearest(body, verify::exact(p));
    verify::Digits120 level = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const verify::Digits120 a = body.semi_axes[i], x = truth.point[i];
      level += x * x / (a * a);
      EXPECT_LT(abs(x + truth.multiplier * x / (a * a) - p[i]), 1e-80);
      EXPECT_GE(truth.multiplier, -a * a);
    }
    EXPECT_LT(abs(level - 1), 1e-80);
  }
}

}  // namespace
}  // namespace tangency
