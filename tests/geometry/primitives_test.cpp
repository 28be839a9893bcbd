// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <tangency/geometry/primitives.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using Eigen::Quaterniond;

constexpr double kU = kUnitRoundoff;

TEST(SphereGap, IsDistanceOfCentresLessRadii) {
  const Gap gap = signed_gap(Sphere{{1, 2, 3}, 2}, Sphere{{1, 2 + 12, 3 + 5}, 4});
  EXPECT_EQ(gap.gap, 7);
  EXPECT_LE((gap.normal - Vec3(0, 12, 5) / 13).norm(), 2 * kU);
  EXPECT_LE((gap.arm_a - 2 * Vec3(0, 12, 5) / 13).norm(), 4 * kU);
  EXPECT_LE((gap.arm_b + 4 * Vec3(0, 12, 5) / 13).norm(), 8 * kU);
  EXPECT_EQ(gap.status, GapStatus::ok);
}

TEST(SphereGap, OfConcentricSpheresIsMinusTheSumOfRadiiAlongX) {
  const Gap gap = signed_gap(Sphere{{4, 4, 4}, 2}, Sphere{{4, 4, 4}, 3});
  EXPECT_EQ(gap.gap, -5);
  EXPECT_EQ(gap.normal, Vec3(1, 0, 0));
}

TEST(SphereGap, ErrorIsTwoRoundingsOfTheGapInEveryUnit) {
  for (const double unit : {0x1p-400, 1.0, 0x1p400}) {
    const Gap gap = signed_gap(Sphere{{0, 0, 0}, unit}, Sphere{{4 * unit, 0, 0}, 2 * unit});
    EXPECT_EQ(gap.gap, unit);
    EXPECT_GE(gap.gap_error, 2 * kU * unit);
    EXPECT_LE(gap.gap_error, 2.001 * kU * unit);
  }
}

TEST(SphereGap, HasADirectionHoweverCloseTheCentres) {
  const Gap gap = signed_gap(Sphere{{0, 0, 0}, 1}, Sphere{{3e-310, 4e-310, 0}, 1});
  EXPECT_EQ(gap.gap, -2);
  EXPECT_NEAR(gap.normal.x(), 0.6, 1e-10);
  EXPECT_NEAR(gap.normal.y(), 0.8, 1e-10);
}

TEST(SphereGap, OfTouchingSpheresIsZero) {
  EXPECT_EQ(signed_gap(Sphere{{0, 0, 0}, 1}, Sphere{{0, 0, 3}, 2}).gap, 0);
  EXPECT_LT(signed_gap(Sphere{{0, 0, 0}, 1}, Sphere{{0, 0, std::nextafter(3, 2)}, 2}).gap, 0);
}

TEST(SphereEllipsoidGap, OnAnAxisIsFromTheTip) {
  const Gap gap = signed_gap(Sphere{{0, 0, 9}, 2}, Ellipsoid({0, 0, 0}, {1, 2, 3}));
  EXPECT_EQ(gap.gap, 4);
  EXPECT_EQ(gap.normal, Vec3(0, 0, -1));
  EXPECT_EQ(gap.arm_a, Vec3(0, 0, -2));
  EXPECT_EQ(gap.arm_b, Vec3(0, 0, 3));
}

TEST(SphereEllipsoidGap, SphereDeepInsideLeavesAcrossTheSmallestAxis) {
  const Gap gap = signed_gap(Sphere{{0, 0, 0}, 0.5}, Ellipsoid({0, 0, 0}, {1, 2, 3}));
  EXPECT_EQ(gap.gap, -1.5);
  EXPECT_EQ(gap.status, GapStatus::ok);
  EXPECT_EQ(gap.normal, Vec3(-1, 0, 0));
}

TEST(SphereEllipsoidGap, RadiusMayDwarfTheBody) {
  const Gap gap = signed_gap(Sphere{{0, 0, 2}, 1e300}, Ellipsoid({0, 0, 0}, {1e-20, 1e-20, 1e-20}));
  EXPECT_EQ(gap.gap, -1e300);
}

TEST(WallGap, OfAnAxisAlignedBodyIsItsHeightAboveTheWall) {
  const WallGap gap = signed_gap(Ellipsoid({7, 8, 10}, {1, 2, 3}), Plane{{0, 0, 1}, 4});
  EXPECT_EQ(gap.gap, 3);
  EXPECT_EQ(gap.normal, Vec3(0, 0, -1));
  EXPECT_EQ(gap.arm_body, Vec3(0, 0, -3));
  EXPECT_EQ(gap.arm_wall, Vec3(0, 0, -6));
}

TEST(WallGap, IsNegativeOnTheSolidSide) {
  const WallGap gap = signed_gap(Ellipsoid({0, 0, -5}, {1, 2, 3}), Plane{{0, 0, 1}, 0});
  EXPECT_EQ(gap.gap, -8);
  EXPECT_EQ(signed_gap(Ellipsoid({0, 0, -5}, {1, 2, 3}), Plane{{0, 0, -1}, 0}).gap, 2);
}

TEST(WallGap, DoesNotDependOnTheLengthOfTheNormal) {
  const Ellipsoid e({1, 2, 3}, {1, 2e-3, 0.5}, Quaterniond(0.3, -0.5, 0.1, 0.8));
  const Vec3 n(0.3, 0.4, -1.2);
  const WallGap one = signed_gap(e, Plane{n, -5});
  for (const double s : {0x1p-900, 0x1p900}) {
    const WallGap other = signed_gap(e, Plane{s * n, s * -5});
    EXPECT_EQ(one.gap, other.gap);
    EXPECT_EQ(one.normal, other.normal);
    EXPECT_EQ(one.arm_wall, other.arm_wall);
  }
}

TEST(WallGap, KeepsItsAccuracyFarFromTheOrigin) {
  // 1e12 from the origin: n.c and the offset agree in their first 12 digits.
  const Ellipsoid e({1e12, 1e12, 0}, {1, 1, 1});
  EXPECT_NEAR(signed_gap(e, Plane{{1, -1, 0}, -3 * std::sqrt(2.0)}).gap, 2, 8 * kU);
}

// geometry/primitives.hpp (2)
RC_GTEST_PROP(PrimitivesProperty, SphereIsAnEllipsoidOfEqualSemiAxes, ()) {
  const Ellipsoid e = *testing::ellipsoid(100);
  const double r = *testing::log_uniform(0.1, 10);
  const Vec3 c = e.centre() + *testing::uniform(0.8, 3) *
                                  (e.support_point(*testing::direction()) + Vec3(r, 0, 0));
  const Gap gap = signed_gap(Sphere{c, r}, e), same = signed_gap(Ellipsoid(c, {r, r, r}), e);
  const double size = (c - e.centre()).norm() + r + e.largest_semi_axis();
  RC_PRE(same.status == GapStatus::ok);
  RC_ASSERT(std::abs(gap.gap - same.gap) <= 10 * kU * size);
}

// Each order by what makes a contact: the points are those of the bodies furthest along the normal
// from a to b, and differ by the gap along it.
// geometry/primitives.hpp (1)
RC_GTEST_PROP(PrimitivesProperty, OfASphereAndABodyInEitherOrderIsAContactFromAToB, ()) {
  const Ellipsoid e = *testing::ellipsoid(100);
  const Sphere s{Vec3(3 * *testing::direction()), *testing::log_uniform(0.1, 10)};
  const double size = (s.centre - e.centre()).norm() + s.radius + e.largest_semi_axis();
  // What a support point does of the normal's rounding, at this aspect.
  const auto near = [&](const Vec3& x, const Vec3& y) { return (x - y).norm() <= 1e-10 * size; };
  const Gap from_sphere = signed_gap(s, e), to_sphere = signed_gap(e, s);
  RC_ASSERT(near(from_sphere.arm_a, s.radius * from_sphere.normal));
  RC_ASSERT(near(from_sphere.arm_b, e.support_point(-from_sphere.normal)));
  RC_ASSERT(near(s.centre + from_sphere.arm_a + from_sphere.gap * from_sphere.normal,
                 e.centre() + from_sphere.arm_b));
  RC_ASSERT(near(to_sphere.arm_a, e.support_point(to_sphere.normal)));
  RC_ASSERT(near(to_sphere.arm_b, -s.radius * to_sphere.normal));
  RC_ASSERT(near(e.centre() + to_sphere.arm_a + to_sphere.gap * to_sphere.normal,
                 s.centre + to_sphere.arm_b));
  RC_ASSERT(from_sphere.gap == to_sphere.gap);
}

// geometry/primitives.hpp (1)
RC_GTEST_PROP(PrimitivesProperty, ExchangedSpheresHaveTheOppositeNormalAndExchangedPoints, ()) {
  const Ellipsoid p = *testing::ellipsoid(1), q = *testing::ellipsoid(1, 1e8);
  const Sphere a{p.centre(), p.largest_semi_axis()}, b{q.centre(), q.largest_semi_axis()};
  if (a.centre == b.centre) RC_SUCCEED("concentric: every normal ties");
  const Gap one = signed_gap(a, b), other = signed_gap(b, a);
  RC_ASSERT(one.gap == other.gap);
  RC_ASSERT(one.normal == Vec3(-other.normal));
  RC_ASSERT(one.arm_a == other.arm_b && one.arm_b == other.arm_a);
}

/// A common motion and scaling of a body, a sphere and a wall.
struct Similarity {
  Quaterniond turn;
  Vec3 shift;
  double scale;

  Vec3 at(const Vec3& x) const { return scale * (turn * x + shift); }
  Ellipsoid operator()(const Ellipsoid& e) const {
    return {at(e.centre()), scale * e.semi_axes(), turn * e.orientation()};
  }
  Sphere operator()(const Sphere& s) const { return {at(s.centre), scale * s.radius}; }
  Plane operator()(const Plane& p) const {
    const Vec3 normal = turn * p.normal;
    return {normal, scale * (p.offset + normal.dot(shift))};
  }
};

Similarity any_similarity() {
  return {(*testing::orientation()).normalized(), 10 * *testing::direction(),
          *testing::log_uniform(1e-100, 1e100)};
}

// geometry/primitives.hpp (4)
RC_GTEST_PROP(PrimitivesProperty, CommonMotionLeavesTheGapAndACommonScalingScalesIt, ()) {
  const Similarity to = any_similarity();
  const Ellipsoid e = *testing::ellipsoid(1e6);
  const Sphere s{Vec3(3 * *testing::direction()), *testing::log_uniform(1e-6, 1e6)};
  const Sphere other{e.centre(), e.largest_semi_axis()};
  const Plane wall{*testing::direction(), *testing::uniform(-5, 5)};
  // Centres, the offset and the turned body are rounded, each within 8 u of the lengths in them.
  const double size = 2 * (e.centre().norm() + s.centre.norm() + std::abs(wall.offset) +
                           to.shift.norm() + s.radius + e.largest_semi_axis());
  const auto same = [&](double before, double after) {
    return std::abs(after / to.scale - before) <= 16 * kU * size;
  };
  RC_ASSERT(same(signed_gap(e, s).gap, signed_gap(to(e), to(s)).gap));
  RC_ASSERT(same(signed_gap(other, s).gap, signed_gap(to(other), to(s)).gap));
  RC_ASSERT(same(signed_gap(e, wall).gap, signed_gap(to(e), to(wall)).gap));
}

// geometry/primitives.hpp (3)
RC_GTEST_PROP(PrimitivesProperty, MovingTheSphereByTheGapLeavesATouch, ()) {
  const Ellipsoid e = *testing::ellipsoid(100);
  const Sphere s{Vec3(3 * *testing::direction()), *testing::log_uniform(0.1, 10)};
  const Gap gap = signed_gap(e, s);
  const Sphere moved{s.centre - gap.gap * gap.normal, s.radius};
  const double size = (s.centre - e.centre()).norm() + s.radius + e.largest_semi_axis() + 4;
  RC_ASSERT(std::abs(signed_gap(e, moved).gap) <= 8 * kU * size);
}

// geometry/primitives.hpp (3)
RC_GTEST_PROP(PrimitivesProperty, MovingTheBodyByTheGapTouchesTheWall, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e4);
  const Plane wall{Vec3(*testing::log_uniform(1e-3, 1e3) * *testing::direction()),
                   *testing::uniform(-5, 5)};
  const WallGap gap = signed_gap(e, wall);
  const WallGap touch = signed_gap(e.moved_to(e.centre() + gap.gap * gap.normal), wall);
  const double size =
      e.centre().norm() + std::abs(wall.offset) / wall.normal.norm() + e.largest_semi_axis();
  RC_ASSERT(std::abs(touch.gap) <= 8 * kU * size);
  RC_ASSERT((gap.arm_body + gap.gap * gap.normal - gap.arm_wall).norm() <= 8 * kU * size);
  // No point of the body reaches further.
  RC_ASSERT(std::abs(gap.normal.dot(gap.arm_body) - e.support(gap.normal)) <= 32 * kU * size);
}

}  // namespace
}  // namespace tangency
