// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/geometry/ellipse.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <tangency/geometry/exact/cosine_sine.hpp>
#include <tangency/tests/support/ellipse_generators.hpp>

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

RC_GTEST_PROP(EllipseProperty, ContainsItsCentre, ()) {
  const Ellipse e = *testing::ellipse(1000);
  RC_ASSERT(e.contains(e.centre()));
}

RC_GTEST_PROP(EllipseProperty, SupportScalesWithTheVectorsLength, ()) {
  const Ellipse e = *testing::ellipse(1000);
  const Vec2 n = *testing::plane_direction();
  RC_ASSERT(std::abs(e.support(-4 * n) - 4 * e.support(n)) <= 1e-15 * e.support(n));
}

RC_GTEST_PROP(EllipseProperty, SupportIsReachedAtTheSupportPointOnTheBoundary, ()) {
  const Ellipse e = *testing::ellipse(100);
  const Vec2 n = *testing::plane_direction(), p = e.support_point(n);
  RC_ASSERT(std::abs(n.dot(p) - e.support(n)) <= 1e-15 * e.largest_semi_axis());
  RC_ASSERT(std::abs(e.level(e.centre() + p) - 1) <= 1e-12);
}

RC_GTEST_PROP(EllipseProperty, QuarterTurnWithExchangedAxesLeavesTheSolid, ()) {
  const Ellipse e = *testing::ellipse(100);
  const Vec2 &a = e.semi_axes(), &u = e.direction();
  const Ellipse same(e.centre(), {a[1], a[0]}, 0.25 * Vec2(-u[1], u[0]));
  const Vec2 n = *testing::plane_direction();
  RC_ASSERT(std::abs(same.support(n) - e.support(n)) <= 1e-15 * e.largest_semi_axis());
}

// Hard cases of rounding [Muller2016]: the first is the double nearest to a multiple of pi/2.
TEST(CosineSine, AreTheNearestDoubles) {
  const double hardest = std::ldexp(6381956970095103.0, 797);
  EXPECT_EQ(exact::rounded_cosine_sine(hardest).cosine, -4.6871659242546277e-19);
  EXPECT_EQ(exact::rounded_cosine_sine(hardest).sine, 1.0);
  EXPECT_EQ(exact::rounded_cosine_sine(1e22).sine, -0.85220084976718880);
  EXPECT_EQ(exact::rounded_cosine_sine(M_PI / 2).cosine, 6.123233995736766e-17);
  EXPECT_EQ(exact::rounded_cosine_sine(0.0).cosine, 1.0);
  EXPECT_EQ(exact::rounded_cosine_sine(-0x1p-1074).sine, -0x1p-1074);
}

RC_GTEST_PROP(CosineSineProperty, DoubleDoubleAndIntegersAgree, ()) {
  const double angle = *testing::uniform(-100, 100) * *testing::log_uniform(1e-9, 1e6);
  const auto fast = exact::rounded_cosine_sine(angle);
  const auto exactly = exact::rounded_cosine_sine_in_integers(angle);
  RC_ASSERT(fast.cosine == exactly.cosine && fast.sine == exactly.sine);
  const auto reflected = exact::rounded_cosine_sine(-angle);
  RC_ASSERT(reflected.cosine == fast.cosine && reflected.sine == -fast.sine);
  // The C library's are within 2 u of themselves.
  RC_ASSERT(std::abs(fast.cosine - std::cos(angle)) <= 0x1p-52 * std::abs(fast.cosine));
}

}  // namespace
}  // namespace tangency
