// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/numbers/cosine_sine.hpp>
#include <tangency/tests/support/ellipse_generators.hpp>
#include <tangency/tests/support/generators.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string refusal(const Vec2& centre, const Vec2& semi_axes, const Vec2& direction) {
  try {
    const Ellipse made(centre, semi_axes, direction);
  } catch (const InvalidEllipse& invalid) {
    return invalid.what();
  }
  return "";
}

TEST(Ellipse, RefusesByFieldValueAndRule) {
  const Vec2 zero = Vec2::Zero(), one(1, 1);
  EXPECT_EQ(refusal({0, kInfinity}, one, one), "y = inf: a centre must be finite");
  EXPECT_EQ(refusal(zero, {1, -1}, one), "r2 = -1: a semi-axis must be finite and > 0");
  EXPECT_EQ(refusal(zero, {0, 1}, one), "r1 = 0: a semi-axis must be finite and > 0");
  EXPECT_EQ(refusal(zero, one, zero), "ux = 0: a direction must be finite and not both 0");
  EXPECT_EQ(refusal(zero, one, {1, kInfinity}),
            "uy = inf: a direction must be finite and not both 0");
  EXPECT_EQ(refusal(zero, {1, 1e-320}, {0, 1e-320}), "");
  EXPECT_THROW(Ellipse::at_angle(zero, one, kInfinity), InvalidEllipse);
}

TEST(Ellipse, AxisIsTheNormalisedDirectionWhateverItsLength) {
  for (const double scale : {1.0, 0x1p-1060, 0x1p1000}) {
    const Ellipse e(Vec2::Zero(), {2, 1}, scale * Vec2(3, 4));
    EXPECT_NEAR(e.axis()[0], 0.6, 0x1p-54) << scale;
    EXPECT_NEAR(e.axis()[1], 0.8, 0x1p-53) << scale;
  }
}

// geometry/ellipse.hpp (1)
RC_GTEST_PROP(EllipseProperty, ContainsItsCentre, ()) {
  const Ellipse e = *testing::ellipse(1000);
  RC_ASSERT(e.contains(e.centre()));
}

// geometry/ellipse.hpp (2)
RC_GTEST_PROP(EllipseProperty, SupportScalesWithTheVectorsLength, ()) {
  const Ellipse e = *testing::ellipse(1000);
  const Vec2 n = *testing::plane_direction();
  const double s = *testing::uniform(-4, 4) * *testing::log_uniform(1e-9, 1e9);
  // s n is rounded, within u of itself, and each support within 8 u of the largest there is.
  RC_ASSERT(std::abs(e.support(s * n) - std::abs(s) * e.support(n)) <=
            16 * 0x1p-53 * std::abs(s) * e.largest_semi_axis());
}

// geometry/ellipse.hpp (3)
RC_GTEST_PROP(EllipseProperty, SupportIsReachedAtTheSupportPointOnTheBoundary, ()) {
  const Ellipse e = *testing::ellipse(100);
  const Vec2 n = *testing::plane_direction(), p = e.support_point(n);
  RC_ASSERT(std::abs(n.dot(p) - e.support(n)) <= 1e-15 * e.largest_semi_axis());
  RC_ASSERT(std::abs(e.level(e.centre() + p) - 1) <= 1e-12);
}

// geometry/ellipse.hpp (4)
RC_GTEST_PROP(EllipseProperty, HalfAndQuarterTurnsAndLengthsOfTheDirectionLeaveTheSolid, ()) {
  const Ellipse e = *testing::ellipse(1e6);
  const Vec2 &a = e.semi_axes(), &u = e.direction();
  const double length = std::exp2(*rc::gen::inRange(-900, 900));
  const Ellipse quarter(e.centre(), {a[1], a[0]}, length * Vec2(-u[1], u[0]));
  const Ellipse half(e.centre(), a, -u), longer(e.centre(), a, length * u);
  const Vec2 n = *testing::plane_direction();
  RC_ASSERT(half.support(n) == e.support(n));
  RC_ASSERT(longer.support(n) == e.support(n));
  RC_ASSERT(std::abs(quarter.support(n) - e.support(n)) <= 1e-15 * e.largest_semi_axis());
}

// Hard cases of rounding [Muller2016]: the first is the double nearest to a multiple of pi/2.
// geometry/numbers/cosine_sine.hpp (1)
TEST(CosineSine, AreTheNearestDoubles) {
  const double hardest = std::ldexp(6381956970095103.0, 797);
  EXPECT_EQ(detail::rounded_cosine_sine(hardest).cosine, -4.6871659242546277e-19);
  EXPECT_EQ(detail::rounded_cosine_sine(hardest).sine, 1.0);
  EXPECT_EQ(detail::rounded_cosine_sine(1e22).sine, -0.85220084976718880);
  EXPECT_EQ(detail::rounded_cosine_sine(M_PI / 2).cosine, 6.123233995736766e-17);
  EXPECT_EQ(detail::rounded_cosine_sine(0.0).cosine, 1.0);
  EXPECT_EQ(detail::rounded_cosine_sine(-0x1p-1074).sine, -0x1p-1074);
}

// geometry/numbers/cosine_sine.hpp (1) (2)
RC_GTEST_PROP(CosineSineProperty, DoubleDoubleAndIntegersAgree, ()) {
  const double angle =
      *testing::uniform(-1, 1) *
      *rc::gen::oneOf(testing::log_uniform(1e-9, 1e9), testing::log_uniform(1e-300, 1e300));
  const auto fast = detail::rounded_cosine_sine(angle);
  const auto exactly = detail::rounded_cosine_sine_in_integers(angle);
  RC_ASSERT(fast.cosine == exactly.cosine && fast.sine == exactly.sine);
  const auto reflected = detail::rounded_cosine_sine(-angle);
  RC_ASSERT(reflected.cosine == fast.cosine && reflected.sine == -fast.sine);
  // MPFR rounds to 150 digits, whatever the angle; no double's cosine is nearer to a tie than
  // 1e-40.
  const verify::Real exact = angle;
  RC_ASSERT(fast.cosine == static_cast<double>(cos(exact)));
  RC_ASSERT(fast.sine == static_cast<double>(sin(exact)));
}

}  // namespace
}  // namespace tangency
