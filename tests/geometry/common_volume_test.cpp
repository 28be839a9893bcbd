// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/numbers/arc_tangent.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using testing::EnvironmentGuard;
using testing::Pair;

const double kPi = std::acos(-1.0);
const Vec3 kOrigin = Vec3::Zero();

double volume_of(const Ellipsoid& e) {
  const Vec3& a = e.semi_axes();
  return 4.0 / 3.0 * kPi * a[0] * a[1] * a[2];
}

/// Two balls of radii r and s whose centres are r + s - depth apart, depth exact: their lens by the
/// heights of its two caps, and the area of the disc between these.
struct Lens {
  double volume, disc;

  Lens(double r, double s, double depth) {
    const double d = r + s - depth;
    const double of_r = depth * (2 * s - depth) / (2 * d), of_s = depth * (2 * r - depth) / (2 * d);
    volume = kPi / 3 * (of_r * of_r * (3 * r - of_r) + of_s * of_s * (3 * s - of_s));
    disc = kPi * of_r * (2 * r - of_r);
  }
};

void expect_same(const CommonVolume& found, const CommonVolume& expected, double sign = 1.0) {
  EXPECT_EQ(found.volume, expected.volume);
  EXPECT_EQ(found.volume_error, expected.volume_error);
  EXPECT_EQ(found.gradient, sign * expected.gradient);
  EXPECT_EQ(found.gradient_error, expected.gradient_error);
  EXPECT_EQ(found.status, expected.status);
}

TEST(CommonVolume, OfTwoBallsIsThatOfTheLensBetweenThem) {
  for (const double r : {1.0, 0.5, 1.75}) {
    for (const double depth : {0x1p-40, 0x1p-20, 0x1p-3, 0.375}) {
      const Ellipsoid a(kOrigin, {r, r, r}, {1, 2, 3, 4}), b({1 + r - depth, 0, 0}, {1, 1, 1});
      const Lens lens(r, 1, depth);
      const CommonVolume found = common_volume(a, b);
      ASSERT_EQ(found.status, CommonVolumeStatus::ok);
      EXPECT_LE(std::abs(found.volume - lens.volume), found.volume_error + 8e-16 * lens.volume);
      EXPECT_LE((found.gradient + Vec3(lens.disc, 0, 0)).norm(), found.gradient_error);
      EXPECT_LE(found.volume_error, 1e-12 * lens.volume) << depth;
      EXPECT_LE(found.gradient_error, 1e-12 * kPi) << depth;
    }
  }
}

// A stretch makes balls of these and carries volumes and, inverted, their gradients with it.
TEST(CommonVolume, OfAlikeEllipsoidsIsThatOfTheBallsTheyAreStretchedFrom) {
  const Vec3 axes(0.25, 3, 40), to_ball = Vec3(0.5, 0.5, 0.25);
  const Quaternion q(3, 1, -1, 2);
  const Ellipsoid a(kOrigin, axes, q);
  const Vec3 d = a.rotation() * axes.cwiseProduct(to_ball);
  const double away = to_ball.norm();
  const Lens lens(1, 1, 2 - away);
  const CommonVolume found = common_volume(a, Ellipsoid(d, axes, q));
  const Vec3 along = -lens.disc * to_ball / away;
  const Vec3 gradient = a.rotation() * axes.prod() * along.cwiseQuotient(axes);
  EXPECT_LE(std::abs(found.volume - axes.prod() * lens.volume), found.volume_error + 1e-13);
  EXPECT_LE((found.gradient - gradient).norm(), found.gradient_error + 1e-12);
  EXPECT_LE(found.volume_error, 1e-12 * volume_of(a));
}

// geometry/common_volume.hpp (2)
TEST(CommonVolume, IsExactWhereTheRelationTellsIt) {
  const Ellipsoid ball(kOrigin, {1, 1, 1}), small({0.25, 0, 0}, {0.5, 0.25, 0.75});
  const Ellipsoid touching_inside({0.5, 0, 0}, {0.5, 0.25, 0.25});
  const Ellipsoid touching({3, 0, 0}, {2, 1, 1}), apart({3.5, 0, 0}, {2, 1, 1});
  for (const Ellipsoid& b : {touching, apart}) {
    expect_same(common_volume(ball, b), {0, 0, kOrigin, 0, CommonVolumeStatus::ok});
  }
  for (const Ellipsoid& b : {small, touching_inside, ball}) {
    for (const CommonVolume& found : {common_volume(ball, b), common_volume(b, ball)}) {
      EXPECT_EQ(found.status, CommonVolumeStatus::ok);
      EXPECT_NEAR(found.volume, volume_of(b), 4e-16 * volume_of(b));
      EXPECT_LE(found.volume_error, 1e-15 * volume_of(b));
      EXPECT_EQ(found.gradient, kOrigin);
      EXPECT_EQ(found.gradient_error, 0);
    }
  }
  // The next double on, and the bodies overlap: by a gradient that is not 0.
  const Ellipsoid nudged({std::nextafter(0.5, 1.0), 0, 0}, {0.5, 0.25, 0.25});
  ASSERT_EQ(relation(ball, nudged).relation, Relation::overlap);
  EXPECT_GT(common_volume(ball, nudged).gradient_error, 0);
}

// geometry/common_volume.hpp (1)
RC_GTEST_PROP(CommonVolume, DoesNotDependOnTheOrderOfTheBodies, ()) {
  const Pair pair = *testing::pair(50);
  const CommonVolume found = common_volume(pair.a, pair.b);
  const CommonVolume exchanged = common_volume(pair.b, pair.a);
  RC_ASSERT(found.volume == exchanged.volume);
  RC_ASSERT(found.volume_error == exchanged.volume_error);
  RC_ASSERT(found.gradient == Vec3(-exchanged.gradient));
  RC_ASSERT(found.gradient_error == exchanged.gradient_error);
}

// geometry/common_volume.hpp (3)
RC_GTEST_PROP(CommonVolume, IsAtMostTheSmallerVolume, ()) {
  const Pair pair = *testing::any_pair();
  const CommonVolume found = common_volume(pair.a, pair.b);
  RC_ASSERT(found.volume >= 0);
  RC_ASSERT(found.volume <= (1 + 1e-15) * std::min(volume_of(pair.a), volume_of(pair.b)));
}

// geometry/common_volume.hpp (4)
TEST(CommonVolume, ScalesWithTheBodiesToTheLastBit) {
  const Ellipsoid a({1, 2, 3}, {0.3, 1.2, 0.7}, {1, 2, -1, 3}), b({1.5, 2.25, 3}, {1, 0.4, 0.6});
  const CommonVolume found = common_volume(a, b);
  ASSERT_GT(found.volume, 0);
  for (const int power : {-300, -1, 40, 300}) {
    const auto scaled = [&](const Ellipsoid& e) {
      return Ellipsoid(std::ldexp(1, power) * e.centre(), std::ldexp(1, power) * e.semi_axes(),
                       e.orientation());
    };
    const CommonVolume there = common_volume(scaled(a), scaled(b));
    EXPECT_EQ(there.volume, std::ldexp(found.volume, 3 * power));
    EXPECT_EQ(there.gradient, std::ldexp(1, 2 * power) * found.gradient);
    EXPECT_EQ(there.status, CommonVolumeStatus::ok);
  }
}

// geometry/common_volume.hpp (5)
RC_GTEST_PROP(CommonVolume, DoesNotShrinkWhereABodyGrows, ()) {
  const Pair pair = *testing::pair(20);
  const Vec3 by(*testing::uniform(1, 1.1), *testing::uniform(1, 1.0001), 1);
  const Ellipsoid grown(pair.a.centre(), pair.a.semi_axes().cwiseProduct(by), pair.a.orientation());
  const CommonVolume before = common_volume(pair.a, pair.b), after = common_volume(grown, pair.b);
  RC_ASSERT(after.volume + after.volume_error >= before.volume - before.volume_error);
}

// geometry/common_volume.hpp (6)
TEST(CommonVolume, ChangesByTheIntegralOfItsGradient) {
  const Ellipsoid a(kOrigin, {0.8, 1.2, 0.7}, {1, 2, -1, 3});
  for (const double far : {0.05, 0.5, 1.0, 1.4}) {
    for (const Vec3& way : {Vec3(1e-3, 0, 0), Vec3(0, 1e-3, 0), Vec3(0, 0, 1e-3)}) {
      const Ellipsoid b(kOrigin, {1.1, 0.6, 0.9}, {2, 1, 0, -1});
      const Vec3 d = far * Vec3(0.6, -0.64, 0.48);
      const CommonVolume before = common_volume(a, b, Vec3(d - way)), at = common_volume(a, b, d);
      const CommonVolume after = common_volume(a, b, Vec3(d + way));
      ASSERT_GT(after.volume, 0);
      // Simpson's rule.
      const Vec3 mean = (before.gradient + 4 * at.gradient + after.gradient) / 6;
      EXPECT_NEAR(after.volume - before.volume, 2 * way.dot(mean), 2e-12) << far;
    }
  }
}

// Brunn and Minkowski: the cube root of the volume is a concave function of d.
RC_GTEST_PROP(CommonVolume, HasAGradientThatBoundsItsCubeRootEverywhere, ()) {
  const Pair pair = *testing::pair(20);
  const Vec3 d = pair.b.centre() - pair.a.centre();
  const double size = pair.a.smallest_semi_axis();
  const Vec3 step = *testing::log_uniform(1e-5, 1) * size * *testing::direction();
  const CommonVolume here = common_volume(pair.a, pair.b, d);
  const CommonVolume there = common_volume(pair.a, pair.b, Vec3(d + step));
  RC_PRE(here.volume > 1e-6 * volume_of(pair.a));
  const double root = std::cbrt(here.volume);
  const double slope = here.gradient.dot(step) / (3 * root * root);
  RC_ASSERT(std::cbrt(there.volume) <= root + slope + 1e-9 * (root + std::abs(slope)));
}

TEST(CommonVolume, IsTheSameInEveryEnvironment) {
  const Ellipsoid a(kOrigin, {0.3, 1.2, 0.7}, {1, 2, -1, 3}), b({0.5, 0.2, 0}, {1, 0.4, 0.6});
  const Ellipsoid plate({0.1, 0.2, 0}, {1e-8, 2, 1}, {1, 0.5, 0, 0});
  const CommonVolume found = common_volume(a, b), of_plate = common_volume(a, plate);
  for (const auto& environment : testing::all_environments()) {
    CommonVolume there, with_plate;
    {
      const EnvironmentGuard guard(environment);
      there = common_volume(a, b), with_plate = common_volume(a, plate);
    }
    SCOPED_TRACE(environment.name);
    expect_same(there, found);
    expect_same(with_plate, of_plate);
  }
}

TEST(CommonVolume, TakesASeparationForTheCentres) {
  const Ellipsoid a({9, 9, 9}, {0.3, 1.2, 0.7}, {1, 2, -1, 3}), b({7, 7, 7}, {1, 0.4, 0.6});
  const Vec3 d(0.5, 0.25, 0.125);
  expect_same(common_volume(a, b, d), common_volume(a.moved_to(kOrigin), b.moved_to(d)));
}

TEST(CommonVolume, SaysWhereItsToleranceIsNotReached) {
  const Ellipsoid a(kOrigin, {0.3, 1.2, 0.7}, {1, 2, -1, 3}), b({0.5, 0.2, 0}, {1, 0.4, 0.6});
  const CommonVolume rough = common_volume(a, b, 1e-4), fine = common_volume(a, b, 1e-13);
  EXPECT_EQ(rough.status, CommonVolumeStatus::ok);
  EXPECT_EQ(fine.status, CommonVolumeStatus::ok);
  EXPECT_LE(fine.volume_error, 1e-13 * volume_of(a));
  EXPECT_GT(rough.volume_error, fine.volume_error);
  EXPECT_LE(std::abs(rough.volume - fine.volume), rough.volume_error + fine.volume_error);
  EXPECT_EQ(common_volume(a, b, 1e-17).status, CommonVolumeStatus::tolerance_not_reached);
}

// Beyond what any arithmetic here resolves the bounds are those of the smaller body.
TEST(CommonVolume, OfAPlateThatIsTooThinIsBetweenNothingAndThePlate) {
  const Ellipsoid plate(kOrigin, {1e-120, 1, 1}, {1, 0.1, 0.2, 0.3}), ball({1, 0, 0}, {1, 1, 1});
  const CommonVolume found = common_volume(plate, ball);
  EXPECT_EQ(found.status, CommonVolumeStatus::tolerance_not_reached);
  EXPECT_LE(found.volume - found.volume_error, 0);
  EXPECT_GE(found.volume + found.volume_error, volume_of(plate));
  EXPECT_LE(found.volume_error, 0.51 * volume_of(plate));
  EXPECT_GE(found.gradient_error, kPi);
}

TEST(CommonVolume, OfVeryLargeBodiesIsInfinite) {
  const Ellipsoid a(kOrigin, {1e110, 1e110, 1e110}), b({1e110, 0, 0}, {1e110, 1e110, 2e110});
  EXPECT_EQ(common_volume(a, b).volume, std::numeric_limits<double>::infinity());
}

TEST(CommonVolume, OfMatricesHasTheirRoundingInItsError) {
  Mat3 m;
  m << 2, 1, 0, 1, 2, 0, 0, 0, 1;
  const MatrixEllipsoid a = MatrixEllipsoid::from_shape(kOrigin, m);
  const CommonVolume same = common_volume(a, a);
  const double whole = 4.0 / 3.0 * kPi * std::sqrt(3.0);
  EXPECT_LE(std::abs(same.volume - whole), same.volume_error + 4e-16);
  EXPECT_LE(same.volume_error, 1e-14);
  EXPECT_EQ(same.gradient_error, 0);

  const MatrixEllipsoid b = MatrixEllipsoid::from_shape({1, 0.5, 0.25}, m);
  const CommonVolume found = common_volume(a, b);
  const CommonVolume of_doubles = common_volume(a.ellipsoid(), b.ellipsoid());
  EXPECT_EQ(found.status, CommonVolumeStatus::ok);
  EXPECT_GT(found.volume_error, of_doubles.volume_error);
  // A stretch of balls: (B - A)' M^-1 (B - A) = 0.5625.
  const Lens lens(1, 1, 2 - 0.75);
  EXPECT_LE(std::abs(found.volume - std::sqrt(3.0) * lens.volume), found.volume_error + 1e-15);

  // B touches A: their numbers say so, and those of the nearest bodies by doubles need not.
  const MatrixEllipsoid touching = MatrixEllipsoid::from_shape({0, 0, 2}, m);
  expect_same(common_volume(a, touching), {0, 0, kOrigin, 0, CommonVolumeStatus::ok});
}

// geometry/numbers/arc_tangent.hpp (1)
RC_GTEST_PROP(AngleOf, IsWithinItsBound, ()) {
  const double angle = *rc::gen::element(
      *testing::uniform(0, 3.1415926535), *testing::log_uniform(1e-300, 1), 0.0, 1.5707963267948966,
      0.78539816339744828, 3.1415926535897931 - *testing::log_uniform(1e-15, 1));
  const double size = *testing::log_uniform(1e-5, 1e5);
  const double sine = size * std::sin(angle), cosine = size * std::cos(angle);
  const long double truth =
      std::atan2(static_cast<long double>(sine), static_cast<long double>(cosine));
  const long double off = std::abs(detail::angle_of(sine, cosine) - truth);
  RC_ASSERT(off <= detail::kAngleError * kUnitRoundoff * truth);
}

}  // namespace
}  // namespace tangency
