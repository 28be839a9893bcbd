// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <tangency/geometry/ellipse_closest_point.hpp>
#include <tangency/tests/support/ellipse_generators.hpp>
#include <tangency/tests/support/generators.hpp>
#include <tangency/verify/oracles/primitives.hpp>

namespace tangency {
namespace {

constexpr double kU = kUnitRoundoff;

double size_of(const Ellipse& e, const Vec2& p) {
  return (p - e.centre()).norm() + e.largest_semi_axis();
}

verify::Digits120 true_distance(const Ellipse& e, const Vec2& p) {
  return verify::plane_distance({{e.centre()[0], e.centre()[1]},
                                 {e.semi_axes()[0], e.semi_axes()[1]},
                                 {e.direction()[0], e.direction()[1]}},
                                {p[0], p[1]});
}

TEST(EllipseClosestPoint, OnAnAxisOutsideIsTheTip) {
  const Ellipse e({1, 2}, {5, 3}, {3, 4});
  const PlaneClosestPoint found = closest_point(e, {1 + 6, 2 + 8});
  EXPECT_EQ(found.distance, 5);
  EXPECT_EQ(found.arm, Vec2(3, 4));
  EXPECT_EQ(found.normal, Vec2(0.6, 0.8));
  EXPECT_EQ(found.status, GapStatus::ok);
}

TEST(EllipseClosestPoint, TiesToThePositiveSideOfTheShorterAxis) {
  for (const Vec2& axes : {Vec2(5, 3), Vec2(3, 5)}) {
    const bool first_is_shorter = axes[0] < axes[1];
    const Ellipse e({0, 0}, axes);
    const Vec2 along = first_is_shorter ? Vec2(0, 1) : Vec2(1, 0);
    const Vec2 across = first_is_shorter ? Vec2(1, 0) : Vec2(0, 1);
    // The centre of curvature of the longer axis' end is 5 - 9/5 from the centre.
    for (const double at : {-3.1, 0.0, 1.0, 3.1}) {
      const PlaneClosestPoint found = closest_point(e, at * along);
      EXPECT_GT(found.arm.dot(across), 0);
      EXPECT_NEAR(found.arm.dot(along), at * 25 / 16, 1e-14);
    }
    EXPECT_EQ(closest_point(e, 3.3 * along).arm, Vec2(5 * along));
  }
}

TEST(EllipseClosestPoint, OfACirclesCentreIsTheEndOfItsFirstAxis) {
  const PlaneClosestPoint found = closest_point(Ellipse({1, 1}, {2, 2}, {0, 3}), {1, 1});
  EXPECT_EQ(found.distance, -2);
  EXPECT_EQ(found.arm, Vec2(0, 2));
}

TEST(EllipseClosestPoint, IsInfinitelyFarBeyondTheRangeOfDoubles) {
  const double huge = std::numeric_limits<double>::max();
  const PlaneClosestPoint found = closest_point(Ellipse({huge, 0}, {1, 1}), {-huge, 0});
  EXPECT_EQ(found.distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(found.normal, Vec2(-1, 0));
}

TEST(EllipseClosestPoint, ErrorIsTwoRoundingsInEveryUnit) {
  for (const double unit : {0x1p-400, 1.0, 0x1p400}) {
    const PlaneClosestPoint found =
        closest_point(Ellipse({0, 0}, {2 * unit, unit}), Vec2(5 * unit, 0));
    EXPECT_EQ(found.distance, 3 * unit);
    EXPECT_GE(found.distance_error, 6 * kU * unit);
    EXPECT_LE(found.distance_error, 6.001 * kU * unit);
  }
}

TEST(EllipseClosestPoint, OfAMatrixHasItsRoundingInTheError) {
  // Exactly the ellipse x^2/2 + y^2/3 <= 1: its tip is at sqrt 2.
  const MatrixEllipse body = MatrixEllipse::from_shape({0, 0}, {2, 3, 0});
  const PlaneClosestPoint found = closest_point(body, {4, 0});
  const verify::Digits120 truth = 4 - sqrt(verify::Digits120(2));
  EXPECT_LE(abs(found.distance - truth), found.distance_error);
  EXPECT_GE(found.distance_error, body.rounding());
  EXPECT_LE(found.distance_error, 1e-14);
}

/// A point anywhere about an ellipse: at its centre, on its boundary or axes, inside, far away.
rc::Gen<std::pair<Ellipse, Vec2>> body_and_point() {
  return rc::gen::map(
      rc::gen::tuple(testing::ellipse(1e8), testing::plane_direction(),
                     rc::gen::weightedOneOf<double>({{1, rc::gen::just(0.0)},
                                                     {1, rc::gen::just(1.0)},
                                                     {4, testing::uniform(0, 2)},
                                                     {2, testing::log_uniform(1, 1e6)}})),
      [](const std::tuple<Ellipse, Vec2, double>& t) {
        const auto& [e, n, f] = t;
        return std::pair<Ellipse, Vec2>(e, e.centre() + f * e.support_point(n));
      });
}

/// How far a closest point's normal moves where point and body move by 1 each.
double sensitivity(const Ellipse& e, double distance) {
  const double radius = e.least_radius() + distance;
  return radius > 0 ? 2 / radius : std::numeric_limits<double>::infinity();
}

constexpr double kComparable = 1e-3;  // rad; chosen: normals that rounding may turn by more tie

// geometry/ellipse_closest_point.hpp (1)
RC_GTEST_PROP(EllipseClosestPointProperty, OfABoundaryPointIsItself, ()) {
  const Ellipse e = *testing::ellipse(1e8);
  const Vec2 p = e.centre() + e.support_point(*testing::plane_direction());
  const PlaneClosestPoint found = closest_point(e, p);
  const double rounding = 16 * kU * e.largest_semi_axis() + 2 * kU * e.centre().norm();
  RC_ASSERT(std::abs(found.distance) <= rounding);
  RC_ASSERT((p - e.centre() - found.arm).norm() <= rounding);
}

// geometry/ellipse_closest_point.hpp (2)
RC_GTEST_PROP(EllipseClosestPointProperty, DistanceChangesNoFasterThanThePoint, ()) {
  const auto [e, p] = *body_and_point();
  const double step = *testing::log_uniform(1e-9, 1) * e.largest_semi_axis();
  const Vec2 q = p + step * *testing::plane_direction();
  const PlaneClosestPoint before = closest_point(e, p), after = closest_point(e, q);
  RC_ASSERT(std::abs(after.distance - before.distance) <=
            (q - p).norm() * (1 + 4 * kU) + before.distance_error + after.distance_error);
}

// geometry/ellipse_closest_point.hpp (3)
RC_GTEST_PROP(EllipseClosestPointProperty, PointIsCentrePlusArmPlusDistanceAlongTheNormal, ()) {
  const auto [e, p] = *body_and_point();
  const PlaneClosestPoint found = closest_point(e, p);
  const Vec2 rest = p - e.centre() - found.arm - found.distance * found.normal;
  RC_ASSERT(rest.norm() <= 8 * kU * size_of(e, p));
  RC_ASSERT(std::abs(found.normal.norm() - 1) <= 4 * kU);
}

// geometry/ellipse_closest_point.hpp (4)
RC_GTEST_PROP(EllipseClosestPointProperty, GoesWithARotationAndATranslation, ()) {
  const auto [e, p] = *body_and_point();
  const Vec2 axis = *testing::plane_direction(), shift = 10 * *testing::plane_direction();
  const auto turn = [&](const Vec2& v) { return turned(axis, v); };
  const Vec2 q = turn(p) + shift;
  const Ellipse there(turn(e.centre()) + shift, e.semi_axes(), turn(e.axis()));
  const PlaneClosestPoint before = closest_point(e, p), after = closest_point(there, q);
  const double rounding =
      16 * kU * (size_of(e, p) + e.centre().norm() + p.norm() + 2 * shift.norm());
  RC_ASSERT(std::abs(after.distance - before.distance) <= rounding);
  const double turned_by = rounding * sensitivity(e, before.distance);
  if (turned_by >= kComparable) return;
  RC_ASSERT((after.normal - turn(before.normal)).norm() <= turned_by + 16 * kU);
  RC_ASSERT((after.arm - turn(before.arm)).norm() <=
            2 * rounding + turned_by * std::abs(before.distance));
}

// geometry/ellipse_closest_point.hpp (5)
RC_GTEST_PROP(EllipseClosestPointProperty, ScalesWithTheUnit, ()) {
  const auto [e, p] = *body_and_point();
  const double s = std::ldexp(1.0, *rc::gen::inRange(-300, 300));
  const Ellipse there(s * e.centre(), s * e.semi_axes(), e.direction());
  const PlaneClosestPoint before = closest_point(e, p), after = closest_point(there, s * p);
  RC_ASSERT(after.distance == s * before.distance);
  RC_ASSERT(after.arm == Vec2(s * before.arm));
  RC_ASSERT(after.normal == before.normal);
}

RC_GTEST_PROP(EllipseClosestPointProperty, AgreesWithTheOracleWithinItsError, ()) {
  const auto [e, p] = *body_and_point();
  const PlaneClosestPoint found = closest_point(e, p);
  RC_ASSERT(abs(found.distance - true_distance(e, p)) <= found.distance_error);
  RC_ASSERT(found.distance_error <=
            2.001 * kU * std::abs(found.distance) + 0x1p-79 * size_of(e, p));
}

RC_GTEST_PROP(EllipseClosestPointProperty, FromTheCentreIsThatOfAnImage, ()) {
  const auto [e, p] = *body_and_point();
  const Vec2 d = p - e.centre();
  const PlaneClosestPoint found = closest_point_from_centre(e, d);
  const PlaneClosestPoint there = closest_point(e.moved_to(Vec2::Zero()), d);
  RC_ASSERT(found.distance == there.distance);
  RC_ASSERT(found.arm == there.arm);
  RC_ASSERT(std::abs(found.distance - closest_point(e, p).distance) <=
            4 * kU * (size_of(e, p) + p.norm()));
}

// The ellipse is the section of an ellipsoid whose third axis is the longer one; a quaternion of
// whole numbers (w, 0, 0, z) turns its first axis into (w^2 - z^2, 2 w z).
RC_GTEST_PROP(PlaneDistanceOracle, IsThatOfTheEllipsoidInSpace, ()) {
  const double a = *testing::log_uniform(1e-4, 1), b = *testing::log_uniform(1e-4, 1);
  const double w = *rc::gen::inRange(1, 50), z = *rc::gen::inRange(-50, 50);
  const double x = *testing::uniform(-2, 2), y = *testing::uniform(-2, 2);
  const verify::RawEllipsoid body{{0, 0, 0}, {a, b, std::max(a, b)}, {w, 0, 0, z}};
  const auto in_space = verify::nearest(body, verify::from_centre(body, {x, y, 0})).distance;
  const auto in_plane =
      verify::plane_distance({{0, 0}, {a, b}, {w * w - z * z, 2 * w * z}}, {x, y});
  RC_ASSERT(abs(in_space - in_plane) <= 1e-50);
}

}  // namespace
}  // namespace tangency
