// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using Eigen::Quaterniond;
constexpr double kU = kUnitRoundoff;
const double kInf = std::numeric_limits<double>::infinity();
const double kNan = std::numeric_limits<double>::quiet_NaN();

std::string fault_field(const Vec3& c, const Vec3& r, const Quaterniond& q) {
  const auto fault = Ellipsoid::find_fault(c, r, q);
  return fault ? fault->field : "";
}

TEST(Ellipsoid, RejectsEveryBadFieldByItsName) {
  const Vec3 c(1, 2, 3), r(1, 2, 3);
  const Quaterniond q = Quaterniond::Identity();
  EXPECT_EQ(fault_field(c, r, q), "");
  for (const double bad : {kNan, kInf, -kInf}) {
    EXPECT_EQ(fault_field({bad, 2, 3}, r, q), "x");
    EXPECT_EQ(fault_field({1, bad, 3}, r, q), "y");
    EXPECT_EQ(fault_field({1, 2, bad}, r, q), "z");
    EXPECT_EQ(fault_field(c, r, {bad, 0, 0, 1}), "qw");
    EXPECT_EQ(fault_field(c, r, {1, bad, 0, 0}), "qx");
    EXPECT_EQ(fault_field(c, r, {1, 0, bad, 0}), "qy");
    EXPECT_EQ(fault_field(c, r, {1, 0, 0, bad}), "qz");
  }
  for (const double bad : {kNan, kInf, -kInf, 0.0, -0.0, -1.0}) {
    EXPECT_EQ(fault_field(c, {bad, 2, 3}, q), "r1");
    EXPECT_EQ(fault_field(c, {1, bad, 3}, q), "r2");
    EXPECT_EQ(fault_field(c, {1, 2, bad}, q), "r3");
  }
  EXPECT_EQ(fault_field(c, r, {0, 0, -0.0, 0}), "qw");
}

TEST(Ellipsoid, ConstructorThrowsWithFieldValueAndRule) {
  try {
    Ellipsoid(Vec3::Zero(), {1, -1, 1});
    FAIL() << "no exception";
  } catch (const InvalidEllipsoid& e) {
    EXPECT_STREQ(e.what(), "r2 = -1: a semi-axis must be finite and > 0");
    EXPECT_STREQ(e.fault().field, "r2");
  }
}

TEST(Ellipsoid, AcceptsTheSmallestAndLargestDoubles) {
  for (const double r :
       {std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()}) {
    EXPECT_EQ(fault_field({-r, r, 0}, {r, r, r}, {r, r, r, r}), "");
    EXPECT_TRUE(rotation_of({r, r, r, r}).allFinite());
  }
}

TEST(Ellipsoid, OrientationMeansTheRotationOfTheNormalisedQuaternion) {
  const Mat3 expected =
      Eigen::AngleAxisd(2 * M_PI / 3, Vec3(1, 1, 1).normalized()).toRotationMatrix();
  for (const double length : {1.0, 0.5, 3.0, 1e-300, 1e300}) {
    const Mat3 r = rotation_of({length, length, length, length});
    EXPECT_LE((r - expected).cwiseAbs().maxCoeff(), 12 * kU) << length;
  }
}

TEST(Ellipsoid, SphereHasItsRadiusAsSupport) {
  const Ellipsoid e({1, 2, 3}, {2, 2, 2}, {0.3, -0.2, 0.9, 0.1});
  EXPECT_NEAR(e.support({0, 3, 4}), 10, 20 * kU);
  EXPECT_LE((e.support_point({0, 3, 4}) - Vec3(0, 1.2, 1.6)).norm(), 16 * kU);
}

TEST(Ellipsoid, IsClosed) {
  const Ellipsoid e({1, 2, 3}, {4, 2, 8});
  EXPECT_TRUE(e.contains({5, 2, 3}));
  EXPECT_TRUE(e.contains({1, 2, -5}));
  EXPECT_FALSE(e.contains({1, std::nextafter(4, 5), 3}));
}

// geometry/ellipsoid.hpp (1)
RC_GTEST_PROP(EllipsoidProperty, ContainsItsCentre, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e6);
  RC_ASSERT(e.contains(e.centre()));
}

// geometry/ellipsoid.hpp (2) (3)
RC_GTEST_PROP(EllipsoidProperty, SupportIsHomogeneousAndReachedAtTheSupportPoint, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e3);
  const Vec3 n = *testing::direction();
  const double s = *testing::uniform(-4, 4);
  const double bound = 16 * kU * e.largest_semi_axis();
  RC_ASSERT(std::abs(e.support(s * n) - std::abs(s) * e.support(n)) <= 4 * bound);
  RC_ASSERT(std::abs(n.dot(e.support_point(n)) - e.support(n)) <= bound);
}

RC_GTEST_PROP(EllipsoidProperty, SupportPointIsOnTheSurfaceAndNoPointOfTheSolidReachesFurther, ()) {
  const Ellipsoid e = *testing::ellipsoid(100);
  const Vec3 n = *testing::direction(), m = *testing::direction();
  const double bound = 32 * kU * e.largest_semi_axis();
  // The rounding of a point moves the level by its size over the smallest semi-axis.
  const double level = e.level(e.centre() + e.support_point(n));
  const double slack = (bound + kU * e.centre().norm()) / e.smallest_semi_axis();
  RC_ASSERT(std::abs(level - 1) <= 4 * slack);
  RC_ASSERT(n.dot(e.support_point(m)) <= e.support(n) + bound);
}

// geometry/ellipsoid.hpp (4)
RC_GTEST_PROP(EllipsoidProperty, SolidDependsOnNeitherSignNorLengthOfTheQuaternionNorOrderOfAxes,
              ()) {
  const Ellipsoid e = *testing::ellipsoid(100);
  const Vec3 n = *testing::direction();
  const Quaterniond q = e.orientation();
  const Vec3& r = e.semi_axes();
  const double bound = 32 * kU * e.largest_semi_axis();
  const Ellipsoid negated(e.centre(), r, Quaterniond(-q.coeffs()));
  const Ellipsoid longer(e.centre(), r, Quaterniond(64 * q.coeffs()));
  RC_ASSERT(negated.support(n) == e.support(n));
  RC_ASSERT(longer.support(n) == e.support(n));
  // A turn by a third about the body's diagonal takes axes 1, 2, 3 to 2, 3, 1.
  const Ellipsoid cycled(e.centre(), {r[1], r[2], r[0]}, q * Quaterniond(1, 1, 1, 1));
  RC_ASSERT(std::abs(cycled.support(n) - e.support(n)) <= bound);
  const Ellipsoid half_turned(e.centre(), r, q * Quaterniond(0, 0, 1, 0));
  RC_ASSERT(std::abs(half_turned.support(n) - e.support(n)) <= bound);
}

/// The square of the half width along axis i, in units of 2^exponent, as a fraction: M_ii with
/// R = R~ / |q|^2.
struct Fraction {
  mpz_class numerator, denominator;
};

Fraction squared_half_width(const Ellipsoid& e, int i, int exponent) {
  const Quaterniond q = e.orientation();
  const std::array<double, 4> stored{q.w(), q.x(), q.y(), q.z()};
  const int unit = exact::common_exponent(stored);
  std::array<mpz_class, 4> z;
  for (std::size_t k = 0; k < 4; ++k) z[k] = exact::to_integer(stored[k], unit);
  const mpz_class &w = z[0], &x = z[1], &y = z[2], &v = z[3];
  const std::array<std::array<mpz_class, 3>, 3> r{
      {{w * w + x * x - y * y - v * v, 2 * (x * y - w * v), 2 * (x * v + w * y)},
       {2 * (x * y + w * v), w * w - x * x + y * y - v * v, 2 * (y * v - w * x)},
       {2 * (x * v - w * y), 2 * (y * v + w * x), w * w - x * x - y * y + v * v}}};
  mpz_class sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpz_class term = r[static_cast<std::size_t>(i)][k] *
                           exact::to_integer(e.semi_axes()[static_cast<int>(k)], exponent);
    sum += term * term;
  }
  const mpz_class norm = w * w + x * x + y * y + v * v;
  return {sum, norm * norm};
}

/// Is the side, at a distance (side - centre) sign from the centre, no nearer than the solid
/// reaches?
bool encloses(const Ellipsoid& e, int i, double side, int sign) {
  if (!std::isfinite(side)) return side == sign * kInf;
  const Vec3 &c = e.centre(), &r = e.semi_axes();
  const std::array<double, 5> lengths{c[i], side, r[0], r[1], r[2]};
  const int unit = exact::common_exponent(lengths);
  const mpz_class distance = sign * (exact::to_integer(side, unit) - exact::to_integer(c[i], unit));
  const Fraction h2 = squared_half_width(e, i, unit);
  return distance > 0 && distance * distance * h2.denominator >= h2.numerator;
}

// Against exact arithmetic: ordinary bodies far and near, needles and discs, and every number over
// the whole range of exponents.
TEST(Ellipsoid, BoundingBoxEnclosesOnEachOfAHundredThousandSides) {
  std::mt19937_64 random(20261122);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const auto any = [&](double range) { return std::exp2(uniform(-range, range)); };
  const auto centre = [&](double range) { return (random() & 1) != 0 ? any(range) : -any(range); };
  int inside = 0;
  for (int n = 0; n < 16700; ++n) {
    const double range = n % 8 == 0 ? 1022 : n % 8 == 1 ? 300 : n % 2 == 0 ? 30 : 3;
    const double turn = n % 16 == 0 ? 1000 : 3;
    const Ellipsoid e({centre(range), centre(range), n % 3 == 0 ? 0.0 : centre(range)},
                      {any(range), any(range), any(range)},
                      {centre(turn), centre(turn), centre(turn), centre(turn)});
    const auto box = e.bounding_box();
    for (int i = 0; i < 3; ++i) {
      inside += !encloses(e, i, box.max()[i], 1) + !encloses(e, i, box.min()[i], -1);
    }
  }
  EXPECT_EQ(inside, 0);
}

TEST(Ellipsoid, BoundingBoxEnclosesInEveryRoundingModeAndAmongSubnormals) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  std::vector<Ellipsoid> bodies{
      Ellipsoid({0, tiny, -tiny}, {tiny, 3 * tiny, 0x1p-1040}, {1, 2, 3, 4}),
      Ellipsoid({1, 1e300, -1e-300}, {tiny, 1e-300, 5}, {1, 2, 3, 4}),
      // Half widths of a few units of the least number, where rounding is a large part of them.
      Ellipsoid({0, 0, 0}, {5 * tiny, 9 * tiny, 3 * tiny}, {1, 2, 3, 4}),
      Ellipsoid({0, 0, 0}, {40 * tiny, 7 * tiny, 23 * tiny}, {4, -1, 2, 1}),
      Ellipsoid({0, 0, 0}, {11 * tiny, 13 * tiny, 2 * tiny}, {1, 1, -3, 2}),
      Ellipsoid({0.1, 0.7, -3}, {0.1, 0.3, 0.7}, {0.1, 0.2, 0.3, 0.4})};
  for (const auto& environment : testing::all_environments()) {
    for (const Ellipsoid& built : bodies) {
      std::array<double, 6> sides;
      {
        const testing::EnvironmentGuard guard(environment);
        const Ellipsoid e(built.centre(), built.semi_axes(), built.orientation());
        const auto box = e.bounding_box();
        for (std::size_t i = 0; i < 3; ++i) {
          sides[i] = box.max()[static_cast<int>(i)];
          sides[i + 3] = box.min()[static_cast<int>(i)];
        }
      }
      for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(encloses(built, i, sides[static_cast<std::size_t>(i)], 1)) << environment.name;
        EXPECT_TRUE(encloses(built, i, sides[static_cast<std::size_t>(i) + 3], -1))
            << environment.name;
      }
    }
  }
}

RC_GTEST_PROP(EllipsoidProperty, BoundingBoxTouchesTheSolidOnAllSixSides, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e3);
  const auto box = e.bounding_box();
  for (int i = 0; i < 3; ++i) {
    // 40 u are promised, 8 u are for support().
    const double bound = kU * (40 * (e.support(Vec3::Unit(i)) + std::abs(e.centre()[i])) +
                               8 * e.largest_semi_axis());
    const Vec3 unit = Vec3::Unit(i);
    RC_ASSERT(std::abs(box.max()[i] - (e.centre()[i] + e.support(unit))) <= bound);
    RC_ASSERT(std::abs(box.min()[i] - (e.centre()[i] - e.support(unit))) <= bound);
  }
}

}  // namespace
}  // namespace tangency
