// SPDX-License-Identifier: GPL-3.0-or-later
// Points, walls, rays and motions of bodies by matrices, and by a separation in place of centres;
// walls without thickness. tests/verify/question_agreement.cpp holds their numbers against oracles.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/ray.hpp>
#include <tangency/geometry/time_of_contact.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

constexpr double kU = kUnitRoundoff;

/// x^2/9 + y^2/4 + z^2 <= 1 about (1, 2, 3), whose shape matrix is exact.
const Ellipsoid& by_axes() {
  static const Ellipsoid body({1, 2, 3}, {3, 2, 1});
  return body;
}
MatrixEllipsoid by_matrix() {
  return MatrixEllipsoid::from_shape({1, 2, 3}, Vec3(9, 4, 1).asDiagonal());
}

TEST(ClosestPointOfAMatrix, IsThatOfItsNearestBodyWithAWiderError) {
  const Vec3 p(1, 2, 7);
  const ClosestPoint matrix = closest_point(by_matrix(), p), axes = closest_point(by_axes(), p);
  EXPECT_EQ(matrix.distance, 3);
  EXPECT_GE(matrix.distance_error, axes.distance_error);
  EXPECT_LE(matrix.distance_error, 1e-14);
  EXPECT_EQ(axes.status, GapStatus::ok);
  EXPECT_GE(axes.distance_error, 6 * kU);
  EXPECT_LE(axes.distance_error, 6.001 * kU);
}

TEST(ClosestPoint, ErrorHoldsForSemiAxesThatAreTakenForThicker) {
  const Ellipsoid needle({0, 0, 0}, {1, 1, 1e-100});
  const ClosestPoint found = closest_point(needle, {0, 0, 0});
  EXPECT_LE(std::abs(found.distance - -1e-100), found.distance_error);
}

// geometry/primitives.hpp (5)
RC_GTEST_PROP(SheetProperty, IsTheWallOnTheOtherSideOfTheCentre, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e4);
  const Vec3 n = *testing::log_uniform(1e-3, 1e3) * *testing::direction();
  const double offset = n.norm() * *testing::uniform(-5, 5);
  const bool below = n.dot(e.centre()) < offset;
  RC_PRE(std::abs(n.dot(e.centre()) - offset) >
         1e-12 * (n.norm() * e.centre().norm() + std::abs(offset)));
  const Plane wall = below ? Plane{-n, -offset} : Plane{n, offset};
  const WallGap found = signed_gap(e, Sheet{n, offset}), expected = signed_gap(e, wall);
  RC_ASSERT(found.gap == expected.gap);
  RC_ASSERT(found.normal == expected.normal);
  RC_ASSERT(found.arm_body == expected.arm_body);
  RC_ASSERT(found.arm_wall == expected.arm_wall);
  RC_ASSERT(found.gap_error == expected.gap_error);
  RC_ASSERT(relation(e, Sheet{n, offset}).relation == relation(e, wall).relation);
}

TEST(WallRelation, IsExactAtATouchOfATurnedBody) {
  // A disc of radius 5 whatever way it is turned about its axis: its plane normals are whole
  // numbers.
  const Ellipsoid e({0, 0, 0}, {5, 5, 1}, Quaternion(2, 0, 0, 1));
  const MatrixEllipsoid body(e);
  EXPECT_EQ(relation(body, Plane{{1, 0, 0}, -5}).relation, Relation::external_touch);
  EXPECT_EQ(relation(body, Plane{{3, 4, 0}, -25}).relation, Relation::external_touch);
  EXPECT_EQ(relation(body, Plane{{3, 4, 0}, std::nextafter(-25.0, 0.0)}).relation,
            Relation::overlap);
  EXPECT_EQ(relation(body, Plane{{3, 4, 0}, std::nextafter(-25.0, -30.0)}).relation,
            Relation::separate);
  const RelationAnswer inside = relation(body, Plane{{3, 4, 0}, 25});
  EXPECT_EQ(inside.relation, Relation::internal_touch);
  EXPECT_EQ(inside.inner, Inner::a);
  EXPECT_EQ(inside.tier, Tier::exact);
  EXPECT_EQ(relation(body, Plane{{3, 4, 0}, 26}).tier, Tier::filter);
  EXPECT_EQ(relation(body, Sheet{{3, 4, 0}, 25}).relation, Relation::external_touch);
  EXPECT_EQ(signed_gap(body, Plane{{3, 4, 0}, -25}).gap, 0);
  EXPECT_EQ(signed_gap(body, Plane{{3, 4, 0}, -25}).gap_error, 0);
  EXPECT_LT(signed_gap(body, Plane{{3, 4, 0}, std::nextafter(-25.0, 0.0)}).gap, 0);
}

TEST(WallRelation, OfAMatrixIsThatOfItsEntriesAsGiven) {
  // n' M n = 2 for n = (1, 1, 0); no double is the square root of 2.
  Mat3 m;
  m << 1, 0, 0, 0, 1, 0, 0, 0, 1;
  const MatrixEllipsoid body = MatrixEllipsoid::from_shape({0, 0, 0}, 2 * m);
  EXPECT_EQ(relation(body, Plane{{1, 1, 0}, -2}).relation, Relation::external_touch);
  EXPECT_EQ(signed_gap(body, Plane{{1, 1, 0}, -2}).gap, 0);
  EXPECT_EQ(relation(body, Plane{{1, 1, 0}, std::nextafter(-2.0, -3.0)}).relation,
            Relation::separate);
  EXPECT_GT(signed_gap(body, Plane{{1, 1, 0}, std::nextafter(-2.0, -3.0)}).gap, 0);
}

TEST(WallGap, ErrorIsTwoRoundingsAndGrowsWithTheDistanceOfTheOrigin) {
  const WallGap near = signed_gap(Ellipsoid({0, 0, 5}, {1, 2, 3}), Plane{{0, 0, 1}, 0});
  EXPECT_EQ(near.gap, 2);
  EXPECT_EQ(near.status, GapStatus::ok);
  EXPECT_GE(near.gap_error, 4 * kU);
  EXPECT_LE(near.gap_error, 4.001 * kU);
  const WallGap far = signed_gap(Ellipsoid({0x1p90, 0, 5}, {1, 2, 3}), Plane{{0, 0, 1}, 0});
  EXPECT_GE(far.gap_error, 0x1p-8);
}

// geometry/primitives.hpp (6)
RC_GTEST_PROP(SeparationProperty, IsThatOfBodiesWhoseCentresAreThatFarApart, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e4), o = *testing::ellipsoid(1e4);
  const Vec3 d = 3 * *testing::direction();
  const Sphere s{o.centre(), *testing::log_uniform(0.1, 10)};
  const Ellipsoid here = e.moved_to(Vec3::Zero());
  const Sphere there{d, s.radius};
  RC_ASSERT(signed_gap(e, s, d).gap == signed_gap(here, there).gap);
  RC_ASSERT(signed_gap(s, e, d).gap ==
            signed_gap(Sphere{Vec3::Zero(), s.radius}, e.moved_to(d)).gap);
  RC_ASSERT(signed_gap(s, Sphere{o.centre(), 1}, d).gap ==
            signed_gap(Sphere{Vec3::Zero(), s.radius}, Sphere{d, 1}).gap);
  RC_ASSERT(closest_point_from_centre(e, d).distance == closest_point(here, d).distance);
  const Vec3 n = *testing::direction();
  RC_ASSERT(signed_gap(e, Plane{n, 7}, d).gap == signed_gap(e.moved_to(-d), Plane{n, 0}).gap);
  RC_ASSERT(signed_gap(e, Sheet{n, 7}, d).gap == signed_gap(e.moved_to(-d), Sheet{n, 0}).gap);
  const RayHit by_separation = intersect_from_centre(e, d, n),
               by_origin = intersect(here, Ray{d, n});
  RC_ASSERT(by_separation.count == by_origin.count);
  RC_ASSERT(by_separation.points[0].t == by_origin.points[0].t);
  const Motion way{-d, n, Vec3::Zero()};
  RC_ASSERT(time_of_contact(e, Motion{}, o, way, d, 2, 1e-6).time ==
            time_of_contact(here, Motion{}, o.moved_to(d), way, 2, 1e-6).time);
}

// geometry/relation.hpp (7)
RC_GTEST_PROP(SeparationProperty, LeavesTheRelationOfBodiesThatFarApart, ()) {
  const Ellipsoid a = *testing::ellipsoid(1e4), b = *testing::ellipsoid(1e4);
  const Vec3 d = *testing::uniform(0, 3) * *testing::direction();
  const Ellipsoid here = a.moved_to(Vec3::Zero()), there = b.moved_to(d);
  const RelationAnswer found = relation(a, b, d), expected = relation(here, there);
  RC_ASSERT(found.relation == expected.relation);
  RC_ASSERT(found.inner == expected.inner);
  RC_ASSERT(found.tier == expected.tier);
  RC_ASSERT(overlaps(a, b, d) == overlaps(here, there));
  RC_ASSERT(overlap_answer(a, b, d).tier == overlap_answer(here, there).tier);
  RC_ASSERT(overlaps_by_filter(a, b, d) == overlaps_by_filter(here, there));
}

TEST(RelationAtASeparation, IsExactForItWhereTheCentresRoundIt) {
  const Ellipsoid a({1e17, 0, 0}, {1, 1, 1}), b({1e17 + 16, 0, 0}, {1, 1, 1});
  EXPECT_EQ(relation(a, b).relation, Relation::separate);
  EXPECT_EQ(relation(a, b, Vec3(2, 0, 0)).relation, Relation::external_touch);
  EXPECT_EQ(relation(a, b, Vec3(std::nextafter(2.0, 3.0), 0, 0)).relation, Relation::separate);
  EXPECT_EQ(relation(a, b, Vec3(std::nextafter(2.0, 1.0), 0, 0)).relation, Relation::overlap);
  EXPECT_FALSE(overlaps(a, b, Vec3(2, 0, 0)));
  EXPECT_EQ(overlap_answer(a, b, Vec3(2, 0, 0)).tier, Tier::exact);
  EXPECT_TRUE(overlaps(a, b, Vec3(std::nextafter(2.0, 1.0), 0, 0)));
  EXPECT_EQ(overlaps_by_filter(a, b, Vec3(2, 0, 0)), std::nullopt);
  EXPECT_EQ(overlaps_by_filter(a, b, Vec3(1, 0, 0)), true);
}

TEST(RelationAtASeparation, OfMatricesIsThatOfTheirEntriesAsGiven) {
  // Balls whose radii are the square root of 2, and half of |d| = sqrt(8).
  const Mat3 two = 2 * Mat3::Identity();
  const MatrixEllipsoid a = MatrixEllipsoid::from_shape({5, 6, 7}, two);
  const MatrixEllipsoid by_quadric =
      MatrixEllipsoid::from_quadric(Quadric({3, 3, 3, 0, 0, 0, -1, 0, 0, -17.0 / 3}));
  const Vec3 d(2, 2, 0), out(std::nextafter(2.0, 3.0), 2, 0), in(std::nextafter(2.0, 1.0), 2, 0);
  const MatrixEllipsoid c = MatrixEllipsoid::from_shape({-1e9, 0, 0}, two);
  EXPECT_EQ(relation(a, c, d).relation, Relation::external_touch);
  EXPECT_EQ(relation(a, c, out).relation, Relation::separate);
  EXPECT_EQ(relation(a, c, in).relation, Relation::overlap);
  EXPECT_EQ(relation(a, c, Vec3(0, 0, 0)).relation, Relation::equal);
  EXPECT_EQ(signed_gap(a, c, d).gap, 0);
  EXPECT_GT(signed_gap(a, c, out).gap, 0);
  EXPECT_LT(signed_gap(a, c, in).gap, 0);
  EXPECT_GE(signed_gap(a, c, d).gap_error, 0);
  // Its centre, (1/3, 0, 0), is no double, and plays no part; its shape, by 17/3 rounded, is a
  // little off the others'.
  EXPECT_EQ(relation(a, by_quadric, 1e-300 * d).relation,
            relation(c, by_quadric, 1e-300 * d).relation);
  EXPECT_EQ(relation(by_quadric, by_quadric, Vec3(0, 0, 0)).relation, Relation::equal);
  EXPECT_EQ(relation(by_quadric, by_quadric, Vec3(0, 0, 0x1p-1074)).relation, Relation::overlap);
}

TEST(RelationAtASeparation, ThatIsNotFiniteEndsTheProcessWithALine) {
  const Ellipsoid e({0, 0, 0}, {1, 1, 1});
  const Vec3 bad(0, std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_DEATH((void)relation(e, e, bad), "tangency: relation: separation = ");
  EXPECT_DEATH((void)overlaps(e, e, bad), "tangency: overlap_answer: separation = ");
  EXPECT_DEATH((void)overlaps_by_filter(e, e, bad), "tangency: overlaps_by_filter: separation = ");
}

TEST(ClosestPointOfAMatrix, AtASeparationIsThatOfTheNearestBodyWithAWiderError) {
  const MatrixEllipsoid body = MatrixEllipsoid::from_shape({1, 2, 3}, 2 * Mat3::Identity());
  const ClosestPoint found = closest_point_from_centre(body, Vec3(0, 0, 4));
  EXPECT_LE(std::abs(found.distance - (4 - std::sqrt(2.0L))), found.distance_error);
  const ClosestPoint rounded = closest_point_from_centre(body.ellipsoid(), Vec3(0, 0, 4));
  ASSERT_GT(body.rounding(), 0);
  EXPECT_GE(found.distance_error, rounded.distance_error + body.rounding());
}

TEST(EllipseRelationAtASeparation, IsExactForItWhereTheCentresRoundIt) {
  const Ellipse a({1e17, 0}, {1, 2}, {1, 0}), b({0, 1e17}, {1, 1}, {1, 0});
  EXPECT_EQ(relation(a, b, Vec2(2, 0)).relation, Relation::external_touch);
  EXPECT_EQ(relation(a, b, Vec2(2, 0)).crossings, 1);
  EXPECT_FALSE(overlaps(a, b, Vec2(2, 0)));
  EXPECT_TRUE(overlaps(a, b, Vec2(std::nextafter(2.0, 1.0), 0)));
  EXPECT_EQ(relation(a, b, Vec2(std::nextafter(2.0, 3.0), 0)).relation, Relation::separate);
}

// geometry/ray.hpp (6)
RC_GTEST_PROP(RayProperty, OfAShapeMatrixIsThatOfTheAxes, ()) {
  const auto whole = [](int low, int high) { return double(*rc::gen::inRange(low, high)); };
  const Vec3 axes(whole(1, 9), whole(1, 9), whole(1, 9)),
      centre(whole(-5, 6), whole(-5, 6), whole(-5, 6));
  const Ray ray{{whole(-9, 10), whole(-9, 10), whole(-9, 10)},
                {whole(-4, 5), whole(-4, 5), whole(1, 5)}};
  const Mat3 shape = axes.cwiseProduct(axes).asDiagonal();
  const RayHit expected = intersect(Ellipsoid(centre, axes), ray);
  const RayHit found = intersect(MatrixEllipsoid::from_shape(centre, shape), ray);
  RC_ASSERT(found.status == expected.status);
  RC_ASSERT(found.count == expected.count);
  const double reach = (ray.origin - centre).norm() + axes.maxCoeff();
  for (int k = 0; k < found.count; ++k) {
    RC_ASSERT(std::abs(found.points[k].t - expected.points[k].t) <= 4 * kU * reach);
    RC_ASSERT((found.points[k].arm - expected.points[k].arm).norm() <= 16 * kU * reach * 8);
  }
}

TEST(RayOfAMatrix, EndsExactlyAtAHitThatNoAxisHas) {
  // x' x <= 2: the point (1, 1, 0) is on it.
  const MatrixEllipsoid body = MatrixEllipsoid::from_shape({0, 0, 0}, 2 * Mat3::Identity());
  const Ray ray{{1, 1, 0}, {1, 0, 0}};
  ASSERT_EQ(intersect(body, ray).count, 1);
  EXPECT_EQ(intersect(body, ray).points[0].t, 0);
  EXPECT_EQ(intersect(body, {{1, 1, 0}, {1, -1, 0}}).status, RayStatus::grazing);
  EXPECT_EQ(intersect(body, {{1, std::nextafter(1.0, 2.0), 0}, {1, 0, 0}}).status, RayStatus::miss);
  EXPECT_EQ(intersect(body, ray, -2, -2).count, 1);
  EXPECT_EQ(intersect(body, ray, std::nextafter(-2.0, 0.0), std::nextafter(0.0, -1.0)).count, 0);
}

TEST(TimeOfContactOfMatrices, HoldsForTheBodiesAsGiven) {
  // Balls of radius sqrt 2, 8 apart, at unit speed: they meet at 8 - 2 sqrt 2.
  const MatrixEllipsoid a = MatrixEllipsoid::from_shape({0, 0, 0}, 2 * Mat3::Identity());
  const MatrixEllipsoid b = MatrixEllipsoid::from_shape({8, 0, 0}, 2 * Mat3::Identity());
  const Motion way{{-1, 0, 0}, Vec3::Zero(), Vec3::Zero()};
  const TimeOfContact found = time_of_contact(a, Motion{}, b, way, 10, 1e-9);
  ASSERT_EQ(found.status, ContactTimeStatus::contact);
  EXPECT_LE(found.time, 8 - 2 * std::sqrt(2.0));
  EXPECT_GE(found.latest, 8 - 2 * std::sqrt(2.0));
  EXPECT_LE(found.latest - found.time, 1.1e-9);
}

// A needle of aspect 2^24 that both forms have exactly, and a ball that flies at its tip at speed
// 5, 49 away. Nearest semi-axes and quaternion may be off by 2^-29 of the needle's length.
TEST(TimeOfContactOfMatrices, HoldsWhereTheRoundingOfTheAxesShiftsTheContact) {
  const double k = 0x1p48;
  Mat3 shape;
  shape << 9 * k + 16, 12 * k - 12, 0, 12 * k - 12, 16 * k + 9, 0, 0, 0, 25;
  const MatrixEllipsoid needle = MatrixEllipsoid::from_shape({0, 0, 0}, shape);
  ASSERT_GT(needle.relative_rounding(), 0x1p-40);
  const Ellipsoid ball(Vec3(3, 4, 0) * (0x1p24 + 10), {1, 1, 1});
  const Motion way{{-3, -4, 0}, Vec3::Zero(), Vec3::Zero()};
  const TimeOfContact found = time_of_contact(needle, Motion{}, ball, way, 20, 1e-6);
  ASSERT_EQ(found.status, ContactTimeStatus::contact);
  EXPECT_LE(found.time, 9.8 - 1e-5);
  EXPECT_GE(found.latest, 9.8 + 1e-5);
  EXPECT_LE(found.latest - found.time, 1);
}

TEST(TimeOfContactOfMatrices, KnowsATouchAtTheStartFromANearMiss) {
  const auto ball = [](const Vec3& centre) {
    return MatrixEllipsoid::from_shape(centre, 2 * Mat3::Identity());
  };
  const Motion away{{1, 1, 0}, Vec3::Zero(), Vec3::Zero()};
  const auto status = [&](const Vec3& d) {
    return time_of_contact(ball({0, 0, 0}), Motion{}, ball(d), away, 1, 1e-9).status;
  };
  EXPECT_EQ(status({2, 2, 0}), ContactTimeStatus::touching_at_start);
  EXPECT_EQ(status({2, std::nextafter(2.0, 3.0), 0}), ContactTimeStatus::grazing);
  EXPECT_EQ(status({2, 2.001, 0}), ContactTimeStatus::none);
}

}  // namespace
}  // namespace tangency
