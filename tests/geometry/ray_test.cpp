// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <ios>
#include <limits>
#include <ostream>
#include <tuple>
#include <utility>

#include <tangency/geometry/ray.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {

/// What a property prints of a counterexample; found by argument-dependent lookup.
inline void showValue(const Ray& ray, std::ostream& os) {
  os << std::hexfloat << "{o " << ray.origin.transpose() << " d " << ray.direction.transpose()
     << '}';
}

namespace {

constexpr double kU = kUnitRoundoff;
constexpr double kEver = std::numeric_limits<double>::infinity();

double size_of(const Ellipsoid& e, const Ray& ray) {
  return (ray.origin - e.centre()).norm() + e.largest_semi_axis();
}

TEST(Ray, HitsTheNearSideFirst) {
  const Ellipsoid e({0, 0, 0}, {3, 2, 1});
  const RayHit hit = intersect(e, {{-10, 0, 0}, {1, 0, 0}});
  ASSERT_EQ(hit.status, RayStatus::hit);
  ASSERT_EQ(hit.count, 2);
  EXPECT_EQ(hit.points[0].t, 7);
  EXPECT_EQ(hit.points[0].arm, Vec3(-3, 0, 0));
  EXPECT_EQ(hit.points[0].normal, Vec3(-1, 0, 0));
  EXPECT_EQ(hit.points[1].t, 13);
  EXPECT_EQ(hit.points[1].normal, Vec3(1, 0, 0));
}

TEST(Ray, FromInsideHitsWhereItLeaves) {
  const Ellipsoid e({1, 1, 1}, {3, 2, 1});
  const RayHit hit = intersect(e, {{1, 1, 1}, {0, 0, -2}});
  ASSERT_EQ(hit.count, 1);
  EXPECT_EQ(hit.points[0].t, 0.5);
  EXPECT_EQ(hit.points[0].arm, Vec3(0, 0, -1));
  EXPECT_EQ(hit.points[0].normal, Vec3(0, 0, -1));
}

TEST(Ray, AwayFromTheBodyMisses) {
  const Ellipsoid e({0, 0, 0}, {3, 2, 1});
  EXPECT_EQ(intersect(e, {{10, 0, 0}, {1, 0, 0}}).status, RayStatus::miss);
  EXPECT_EQ(intersect(e, {{10, 0, 0}, {1, 0, 0}}, -kEver, kEver).count, 2);
}

TEST(Ray, FromTheSurfaceHitsAtZero) {
  const Ellipsoid e({0, 0, 0}, {3, 2, 1});
  const RayHit inwards = intersect(e, {{-3, 0, 0}, {1, 0, 0}});
  ASSERT_EQ(inwards.count, 2);
  EXPECT_EQ(inwards.points[0].t, 0);
  EXPECT_EQ(inwards.points[1].t, 6);
  const RayHit outwards = intersect(e, {{-3, 0, 0}, {-1, 0, 0}});
  ASSERT_EQ(outwards.count, 1);
  EXPECT_EQ(outwards.points[0].t, 0);
}

// geometry/ray.hpp (5)
TEST(Ray, OriginExactlyOnATurnedSurfaceIsAHitAtZero) {
  // Lost once: double-double put the hit at -1e-32.
  const Ellipsoid e({0, 0, 0}, {2.5, 5, 10}, Eigen::Quaterniond(1, 2, 0, 0));
  for (const double turn : {1.0, -1.0}) {
    const RayHit hit = intersect(e, {{0, -3, 4}, {0, turn * 3, turn * -4}});
    ASSERT_EQ(hit.status, RayStatus::hit);
    ASSERT_EQ(hit.count, turn > 0 ? 2 : 1);
    EXPECT_EQ(hit.points[0].t, 0);
    EXPECT_EQ(hit.points[0].arm, Vec3(0, -3, 4));
    if (turn > 0) {
      EXPECT_EQ(hit.points[1].t, 2);
    }
  }
  const Ellipsoid other({0, 0, 0}, {13, 26, 52}, Eigen::Quaterniond(1, 5, 0, 0));
  const RayHit outwards = intersect(other, {{0, -24, 10}, {0, -24, 10}});
  ASSERT_EQ(outwards.count, 1);
  EXPECT_EQ(outwards.points[0].t, 0);
}

// geometry/ray.hpp (5)
TEST(Ray, EndsOfAnIntervalThatAreHitsAreInItAndTheirNeighboursTell) {
  const Ellipsoid e({1, 2, 3}, {2.5, 5, 10}, Eigen::Quaterniond(1, 2, 0, 0));
  // On the surface at t = 5 and t = 7 exactly.
  const Ray ray{Vec3(1, 2, 3) + 6.0 * Vec3(0, -3, 4), {0, 3, -4}};
  const auto count = [&](double begin, double end) { return intersect(e, ray, begin, end).count; };
  const auto before = [](double t) { return std::nextafter(t, -kEver); };
  const auto after = [](double t) { return std::nextafter(t, kEver); };
  EXPECT_EQ(count(5, 7), 2);
  EXPECT_EQ(count(after(5), 7), 1);
  EXPECT_EQ(count(5, before(7)), 1);
  EXPECT_EQ(count(after(5), before(7)), 0);
  EXPECT_EQ(count(5, 5), 1);
  EXPECT_EQ(count(7, 7), 1);
  EXPECT_EQ(count(-kEver, before(5)), 0);
  EXPECT_EQ(count(after(7), kEver), 0);
  EXPECT_EQ(intersect(e, ray, 5, 6).points[0].t, 5);
  EXPECT_EQ(intersect(e, ray, 6, 7).points[0].t, 7);
}

// geometry/ray.hpp (5)
TEST(Ray, HitBesideAnEndByLessThanRoundingIsOnItsTrueSide) {
  // It was taken by its rounded t. At t = 2^(1/2), which is below the double next to it.
  const Ellipsoid ball({0, 0, 0}, {1, 1, 1});
  const Ray ray{{0, 0, 0}, {0.5, 0.5, 0}};
  const double above = std::sqrt(2.0), below = std::nextafter(above, 0.0);
  EXPECT_EQ(intersect(ball, ray, above).status, RayStatus::miss);
  EXPECT_EQ(intersect(ball, ray, below).count, 1);
  EXPECT_EQ(intersect(ball, ray, 0, above).count, 1);
  EXPECT_EQ(intersect(ball, ray, 0, below).status, RayStatus::miss);
  const RayHit hit = intersect(ball, ray, below, above);
  ASSERT_EQ(hit.count, 1);
  EXPECT_EQ(hit.points[0].t, above);
}

// geometry/ray.hpp (5)
TEST(Ray, TangentOfATurnedSurfaceTouchesAtItsOrigin) {
  // The gradient at (0, -3, 4) is along (0, -3, 4) by symmetry: it is the end of an axis.
  const Ellipsoid e({0, 0, 0}, {2.5, 5, 10}, Eigen::Quaterniond(1, 2, 0, 0));
  for (const Vec3& along : {Vec3(0, 4, 3), Vec3(1, 8, 6), Vec3(-3, 0, 0)}) {
    const RayHit hit = intersect(e, {{0, -3, 4}, along});
    ASSERT_EQ(hit.status, RayStatus::grazing);
    ASSERT_EQ(hit.count, 1);
    EXPECT_EQ(hit.points[0].t, 0);
    EXPECT_EQ(hit.points[0].arm, Vec3(0, -3, 4));
    EXPECT_LE((hit.points[0].normal - Vec3(0, -0.6, 0.8)).norm(), 2 * kU);
    EXPECT_EQ(intersect(e, {{0, -3, 4}, along}, 0x1p-1074).status, RayStatus::miss);
  }
}

TEST(Ray, HitPointsOfTheThinnestBodiesAreOnTheLine) {
  // 2.05 times 8 u L off once, and 1e15 times at aspect 1e50.
  for (const double thin : {0x1.3a90a51fac45bp-60, 0x1p-100, 0x1p-180, 0x1p-500, 0x1p-1022}) {
    const Ellipsoid e({0, 0, 0}, {thin, 1, 0x1.83f43f9baacadp-36},
                      Eigen::Quaterniond(-0x1.30ce24ea08644p-1, 0x1.a81c48c475901p-3,
                                         -0x1.37b7d96815c4cp-4, -0x1.a88521baffb96p-5));
    const Ray ray{{-0x1.593ce14a280bfp-1, -0x1.0832d27a028d3p-1, 0x1.a94eeb0dbbbfap-2},
                  {0x1.8b0758de66ddep-1, 0x1.809751604f8a6p-3, -0x1.54afd4b24f0b3p-3}};
    const RayHit hit = intersect(e, ray);
    ASSERT_EQ(hit.count, 2) << thin;
    const double tilt = 4 * kU + 0x1p36 * thin;  // of the normal, from the thin axis
    for (const SurfacePoint& p : hit.points) {
      const Vec3 off = (p.arm - ray.origin).cross(ray.direction) / ray.direction.norm();
      EXPECT_LE(off.norm(), 2 * kU * size_of(e, ray)) << thin;
      // On the disc's plane, and its normal the axis.
      const Vec3 axis = e.rotation().col(0);
      EXPECT_LE(std::abs(axis.dot(p.arm)), 4 * kU) << thin;
      EXPECT_LE(p.normal.cross(axis).norm(), tilt) << thin;
    }
    EXPECT_LE((hit.points[0].normal + hit.points[1].normal).norm(), 2 * tilt) << thin;
  }
}

TEST(Ray, LineInThePlaneOfAThinDiscIsToldFromAMiss) {
  // Called grazing once, with a point off the surface: the plane is thinner than double-double.
  const Ellipsoid disc({0, 0, 0}, {5, 5, 1e-50}, Eigen::Quaterniond(1, 0, 2, 0));
  // Its axis is (4, 0, -3) / 5; in its plane are y and (3, 0, 4).
  const Vec3 across(3, 0, 4);
  for (const double y : {4.9, 5.0, 5.1}) {
    const RayHit hit = intersect(disc, {Vec3(0, y, 0) - 2 * across, across});
    EXPECT_EQ(hit.status, y < 5 ? RayStatus::hit : y > 5 ? RayStatus::miss : RayStatus::grazing);
    for (int i = 0; i < hit.count; ++i) {
      EXPECT_NEAR(hit.points[i].arm.norm(), 5, 8 * kU * 15);
      EXPECT_LE((hit.points[i].normal - hit.points[i].arm / 5).norm(), 8 * kU);
    }
  }
}

TEST(Ray, SegmentHitsOnlyBetweenItsEnds) {
  const Ellipsoid e({0, 0, 0}, {3, 2, 1});
  const Ray ray{{-10, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(intersect(e, ray, 0, 6.999).count, 0);
  EXPECT_EQ(intersect(e, ray, 0, 6.999).status, RayStatus::miss);
  EXPECT_EQ(intersect(e, ray, 0, 7).count, 1);
  EXPECT_EQ(intersect(e, ray, 8, 12).count, 0);
  EXPECT_EQ(intersect(e, ray, 8, 13).points[0].t, 13);
}

TEST(Ray, TangentIsCalledGrazingAndTouchesOnce) {
  const Ellipsoid e({0, 0, 0}, {3, 2, 1});
  const RayHit hit = intersect(e, {{-10, 2, 0}, {2, 0, 0}});
  ASSERT_EQ(hit.status, RayStatus::grazing);
  ASSERT_EQ(hit.count, 1);
  EXPECT_EQ(hit.points[0].t, 5);
  EXPECT_LE((hit.points[0].arm - Vec3(0, 2, 0)).norm(), 0x1p-90);
  EXPECT_LE((hit.points[0].normal - Vec3(0, 1, 0)).norm(), 0x1p-90);
}

TEST(Ray, NextToATangentIsTold) {
  const Ellipsoid e({0, 0, 0}, {3, 2, 1});
  const double above = std::nextafter(2.0, 3.0), below = std::nextafter(2.0, 1.0);
  EXPECT_EQ(intersect(e, {{-10, above, 0}, {1, 0, 0}}).status, RayStatus::miss);
  const RayHit hit = intersect(e, {{-10, below, 0}, {1, 0, 0}});
  ASSERT_EQ(hit.status, RayStatus::hit);
  ASSERT_EQ(hit.count, 2);
  // x = -+3 sqrt(1 - (1 - u)^2), u = 2^-53
  const double half = 3 * std::sqrt(2 * kU);
  EXPECT_NEAR(hit.points[0].t, 10 - half, 16 * kU);
  EXPECT_NEAR(hit.points[1].t, 10 + half, 16 * kU);
}

TEST(Ray, TellsTangentsFromAFarOrigin) {
  const Ellipsoid e({0, 0, 0}, {3, 2, 1});
  const double above = std::nextafter(2.0, 3.0), below = std::nextafter(2.0, 1.0);
  EXPECT_EQ(intersect(e, {{-1e12, above, 0}, {1, 0, 0}}).status, RayStatus::miss);
  EXPECT_EQ(intersect(e, {{-1e12, below, 0}, {1, 0, 0}}).count, 2);
}

TEST(Ray, HitsANeedleFromFarAway) {
  const Ellipsoid needle({0, 0, 0}, {1, 1e-8, 1e-8});
  EXPECT_EQ(intersect(needle, {{0, 0, -1e12}, {0, 0, 1}}).count, 2);
  EXPECT_EQ(intersect(needle, {{-1e12, 0.999e-8, 0}, {1, 0, 0}}).count, 2);
  EXPECT_EQ(intersect(needle, {{-1e12, 1.001e-8, 0}, {1, 0, 0}}).count, 0);
}

#ifndef NDEBUG
TEST(RayDeathTest, ZeroDirectionIsRefused) {
  const Ellipsoid e({0, 0, 0}, {3, 2, 1});
  EXPECT_DEATH(intersect(e, {{0, 0, 0}, {0, 0, 0}}), "direction");
}
#endif

rc::Gen<std::pair<Ellipsoid, Ray>> body_and_ray() {
  return rc::gen::map(
      rc::gen::tuple(testing::ellipsoid(1e4), testing::direction(), testing::direction(),
                     testing::uniform(0, 1), testing::log_uniform(1e-3, 1e6)),
      [](const std::tuple<Ellipsoid, Vec3, Vec3, double, double>& t) {
        const auto& [e, n, along, depth, back] = t;
        const Vec3 through = e.centre() + depth * e.support_point(n);
        return std::pair<Ellipsoid, Ray>(e, {through - back * along, along});
      });
}

// geometry/ray.hpp (1)
RC_GTEST_PROP(RayProperty, EveryPointIsOnTheRayAndItsNormalIsTheSurfaces, ()) {
  const auto [e, ray] = *body_and_ray();
  const RayHit hit = intersect(e, ray, -kEver, kEver);
  RC_ASSERT(hit.count > 0);
  for (int i = 0; i < hit.count; ++i) {
    const SurfacePoint& p = hit.points[i];
    const Vec3 there = ray.origin - e.centre() + p.t * ray.direction;
    RC_ASSERT((there - p.arm).norm() <= 8 * kU * (size_of(e, ray) + e.centre().norm()));
    // The support point of the normal is the point, to the rounding of R over a needle.
    RC_ASSERT(std::abs(p.normal.dot(p.arm) - e.support(p.normal)) <= 64 * kU * size_of(e, ray));
  }
}

// geometry/ray.hpp (2)
RC_GTEST_PROP(RayProperty, ReversedDirectionNegatesAndExchanges, ()) {
  const auto [e, ray] = *body_and_ray();
  const RayHit there = intersect(e, ray, -kEver, kEver);
  const RayHit back = intersect(e, {ray.origin, -ray.direction}, -kEver, kEver);
  RC_ASSERT(there.count == back.count);
  for (int i = 0; i < there.count; ++i) {
    const SurfacePoint &p = there.points[i], &q = back.points[there.count - 1 - i];
    RC_ASSERT(p.t == -q.t);
    RC_ASSERT(p.arm == q.arm);
    RC_ASSERT(p.normal == q.normal);
  }
}

/// Are the hits of `other` those of `one`, where the line of `other` is off by `moved` and its t
/// becomes t_of(t) of one's? A hit moves by that over the cosine k of incidence; both are there as
/// long as the chord's depth, k^2 / 2 of the least radius of curvature, is more.
template <class TimeOf>
void assert_same_hits(const Ellipsoid& e, const Vec3& direction, const RayHit& one,
                      const RayHit& other, double moved, const TimeOf& t_of) {
  for (int i = 0; i < one.count; ++i) {
    const SurfacePoint& p = one.points[i];
    const double k = std::abs(p.normal.dot(direction));
    if (k < 1e-6 || k * k * e.least_radius() < 4 * moved) RC_SUCCEED("grazing");
  }
  RC_ASSERT(one.status == other.status && one.count == other.count);
  for (int i = 0; i < one.count; ++i) {
    const SurfacePoint &p = one.points[i], &q = other.points[i];
    const double slid = 2 * moved / std::abs(p.normal.dot(direction));
    RC_ASSERT(std::abs(t_of(q.t) - p.t) <= slid);
    RC_ASSERT((q.arm - p.arm).norm() <= slid);
  }
}

// geometry/ray.hpp (3)
RC_GTEST_PROP(RayProperty, LengthOfTheDirectionScalesTimeOnly, ()) {
  const auto [e, ray] = *body_and_ray();
  const double s = *testing::log_uniform(1e-100, 1e100);
  const Ray longer{ray.origin, s * ray.direction};
  const RayHit one = intersect(e, ray, -kEver, kEver), other = intersect(e, longer, -kEver, kEver);
  // s * direction is rounded: the direction turns by u.
  assert_same_hits(e, ray.direction, one, other, 8 * kU * size_of(e, ray),
                   [&](double t) { return s * t; });
}

// geometry/ray.hpp (4)
RC_GTEST_PROP(RayProperty, OriginMovedAlongTheLineShiftsTime, ()) {
  const auto [e, ray] = *body_and_ray();
  const double shift = *testing::uniform(-2, 2) * size_of(e, ray);
  const Ray further{ray.origin + shift * ray.direction, ray.direction};
  const RayHit one = intersect(e, ray, -kEver, kEver), other = intersect(e, further, -kEver, kEver);
  const double size = size_of(e, ray) + e.centre().norm() + std::abs(shift);
  assert_same_hits(e, ray.direction, one, other, 8 * kU * size,
                   [&](double t) { return t + shift; });
}

RC_GTEST_PROP(RayProperty, OriginInsideHasOneHitAhead, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e4);
  const Vec3 inside =
      e.centre() + *testing::uniform(0, 0.99) * e.support_point(*testing::direction());
  RC_PRE(e.level(inside) < 0.999);
  const RayHit hit = intersect(e, {inside, *testing::direction()});
  RC_ASSERT(hit.count == 1);
  RC_ASSERT(hit.points[0].t > 0);
}

}  // namespace
}  // namespace tangency
