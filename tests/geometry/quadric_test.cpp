// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include <tangency/geometry/bodies/ellipsoid_form.hpp>
#include <tangency/geometry/classify.hpp>
#include <tangency/geometry/quadric.hpp>
#include <tangency/tests/geometry/quadric_generators.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

constexpr double kU = kUnitRoundoff;

rc::Gen<Vec3> point() {
  const auto c = testing::uniform(-4, 4);
  return rc::gen::construct<Vec3>(c, c, c);
}

Quadric any_quadric() {
  Quadric::Coefficients c;
  for (double& value : c) value = *testing::uniform(-1, 1);
  return Quadric(c);
}

/// Sum of the magnitudes of the terms of evaluate(): the size of its rounding.
double magnitude(const Quadric& q, const Vec3& x) {
  const Eigen::Vector4d h(std::abs(x[0]), std::abs(x[1]), std::abs(x[2]), 1);
  return h.dot(q.discriminant().cwiseAbs() * h);
}

// geometry/quadric.hpp (1)
RC_GTEST_PROP(QuadricProperty, EvaluateIsTheFormOfTheDiscriminantMatrix, ()) {
  const Quadric q = any_quadric();
  const Vec3 x = *point();
  const double expected = x.homogeneous().dot(q.discriminant() * x.homogeneous());
  RC_ASSERT(std::abs(q.evaluate(x) - expected) <= 16 * kU * magnitude(q, x));
}

// geometry/quadric.hpp (2)
RC_GTEST_PROP(QuadricProperty, TheGradientIsTheDerivative, ()) {
  const Quadric q = any_quadric();
  const Vec3 x = *point(), step = *point();
  // A quadratic polynomial's central difference is its derivative without a remainder.
  const double difference = (q.evaluate(x + step) - q.evaluate(x - step)) / 2;
  const double size = magnitude(q, x.cwiseAbs() + step.cwiseAbs());
  RC_ASSERT(std::abs(q.gradient(x).dot(step) - difference) <= 64 * kU * size);
}

// geometry/quadric.hpp (2)
RC_GTEST_PROP(QuadricProperty, TheGradientIsZeroAtTheCentre, ()) {
  // Ellipsoids, hyperboloids, cones and their imaginary relatives about a centre.
  Quadric::Coefficients c{};
  for (const std::size_t i : {0u, 1u, 2u, 9u}) c[i] = *testing::uniform(-1, 1);
  const Vec3 centre = *point();
  const Quadric q = Quadric(c).moved(*testing::orientation(), centre);
  const Vec3 x = centre.cwiseAbs();
  const Eigen::Vector3d terms = (q.discriminant().cwiseAbs() * x.homogeneous()).head<3>();
  RC_ASSERT(q.gradient(centre).norm() <= 64 * kU * (terms.norm() + q.sub_discriminant().norm()));
}

// geometry/quadric.hpp (3)
RC_GTEST_PROP(QuadricProperty, MovingTheSurfaceMovesItsValues, ()) {
  const Quadric q = any_quadric();
  const Eigen::Quaterniond turn = *testing::orientation();
  const Vec3 shift = *point(), x = *point();
  const Quadric moved = q.moved(turn, shift);
  const Vec3 y = rotation_of(turn) * x + shift;
  const double size = magnitude(q, x) + magnitude(moved, y) + magnitude(moved, shift);
  RC_ASSERT(std::abs(moved.evaluate(y) - q.evaluate(x)) <= 256 * kU * size);
}

// geometry/quadric.hpp (4)
RC_GTEST_PROP(QuadricProperty, ScalingTheSurfaceScalesItsValues, ()) {
  const Quadric q = any_quadric();
  const double s = *testing::log_uniform(1e-3, 1e3);
  const Vec3 x = *point();
  const double expected = s * q.evaluate(x);
  RC_ASSERT(std::abs(q.scaled(s).evaluate(s * x) - expected) <= 32 * kU * s * magnitude(q, x));
}

RC_GTEST_PROP(QuadricProperty, ScalingByAPowerOfTwoIsExact, ()) {
  const Quadric q = any_quadric();
  const double s = std::ldexp(1.0, *rc::gen::inRange(-300, 301));
  RC_ASSERT(q.scaled(s).scaled(1 / s).coefficients() == q.coefficients());
  RC_ASSERT(classify(q.scaled(s)).type == classify(q).type);
}

// geometry/quadric.hpp (5)
RC_GTEST_PROP(QuadricProperty, AnEllipsoidIsNegativeInsideAndPositiveOutside, ()) {
  const Ellipsoid e = *testing::ellipsoid(30);
  const Quadric q = Quadric::from_ellipsoid(e);
  const Vec3 n = *testing::direction();
  const Vec3 surface = e.support_point(n);
  const double fraction = *testing::uniform(0, 2);
  RC_PRE(std::abs(fraction - 1) > 1e-6);
  RC_ASSERT((q.evaluate(e.centre() + fraction * surface) > 0) == (fraction > 1));
  // The gradient on the surface is the outward normal n.
  const Vec3 gradient = q.gradient(e.centre() + surface).normalized();
  RC_ASSERT((gradient - n.normalized()).norm() <= 1e-9);
}

/// The exact quadric scaled as from_ellipsoid() scales, and how far the doubles are from it, in
/// units of the promised bounds' w, w |c| and w |c|^2 + ...
struct CoefficientErrors {
  double block, column, constant;
};

CoefficientErrors errors_of(const Ellipsoid& e) {
  const exact::EllipsoidForm truth = exact::ellipsoid_form(e);
  const auto c = Quadric::from_ellipsoid(e).coefficients();
  const double least = e.smallest_semi_axis();
  const double s = std::ldexp(1.0, std::ilogb(least));
  const double w = s / least / least * kU, distance = e.centre().norm();
  const auto error = [&](std::size_t index, std::size_t i, std::size_t j) {
    mpq_class value(truth.form[i][j], truth.denominator);
    value.canonicalize();
    return std::abs(
        mpq_class(value * exact::to_rational(s) - exact::to_rational(c[index])).get_d());
  };
  const double block = std::max({error(0, 0, 0), error(1, 1, 1), error(2, 2, 2), error(3, 0, 1),
                                 error(4, 1, 2), error(5, 2, 0)});
  const double column = std::max({error(6, 0, 3), error(7, 1, 3), error(8, 2, 3)});
  const double constant = error(9, 3, 3) / (150 * w * distance * distance + 2 * kU * s);
  return {block / (40 * w), distance > 0 ? column / (80 * w * distance) : column, constant};
}

TEST(Quadric, FromEllipsoidRoundsEachCoefficientWithinItsBound) {
  CoefficientErrors worst{0, 0, 0};
  rc::check("bounds of from_ellipsoid", [&worst] {
    const CoefficientErrors errors = errors_of(*testing::ellipsoid(1e4, 1e6));
    worst = {std::max(worst.block, errors.block), std::max(worst.column, errors.column),
             std::max(worst.constant, errors.constant)};
  });
  std::cout << "largest error / bound: block " << worst.block << ", column " << worst.column
            << ", constant " << worst.constant << '\n';
  EXPECT_LE(worst.block, 1);
  EXPECT_LE(worst.column, 1);
  EXPECT_LE(worst.constant, 1);
  EXPECT_GT(worst.block, 0.02) << "the bound is loose";
}

// geometry/quadric.hpp (5)
RC_GTEST_PROP(QuadricProperty, TheRoundTripGivesTheEllipsoidBack, ()) {
  const double aspect = *rc::gen::element(1.5, 10.0, 100.0);
  const Ellipsoid e = *testing::ellipsoid(aspect);
  const auto back = Quadric::from_ellipsoid(e).to_ellipsoid();
  RC_ASSERT(back.has_value());
  const double least = e.smallest_semi_axis(), largest = e.largest_semi_axis();
  const double condition =
      largest / least * (largest / least) * (1 + e.centre().squaredNorm() / (least * least));
  const double tolerance = 1000 * kU * condition;
  RC_PRE(tolerance < 0.1);
  Vec3 sorted = e.semi_axes();
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < 3; ++i) {
    RC_ASSERT(std::abs(back->semi_axes()[i] / sorted[i] - 1) <= tolerance);
  }
  RC_ASSERT((back->centre() - e.centre()).norm() <= tolerance * largest);
  // Axes of equal length have no orientation of their own: compare the solids by their supports.
  const Vec3 n = *testing::direction();
  RC_ASSERT(std::abs(back->support(n) / e.support(n) - 1) <= 4 * tolerance);
}

TEST(Quadric, TheRoundTripWorksForNegativeFormsAndFarScales) {
  for (const double size : {1e-200, 1e-3, 1.0, 1e200}) {
    const Ellipsoid e({2 * size, 0, -size}, {3 * size, size, 2 * size});
    for (const Quadric& q : {Quadric::from_ellipsoid(e), Quadric::from_ellipsoid(e).negated()}) {
      const auto back = q.to_ellipsoid();
      ASSERT_TRUE(back.has_value()) << size;
      EXPECT_NEAR(back->semi_axes()[0] / size, 1, 1e-13);
      EXPECT_NEAR(back->semi_axes()[2] / size, 3, 1e-13);
      EXPECT_NEAR(back->centre()[0] / size, 2, 1e-13);
      EXPECT_NEAR(back->centre()[2] / size, -1, 1e-13);
    }
  }
}

TEST(Quadric, OnlyARealEllipsoidHasSemiAxes) {
  for (const auto& form : testing::kNormalForms) {
    EXPECT_EQ(testing::to_quadric(form.quadric).to_ellipsoid().has_value(),
              form.type == QuadricType::real_ellipsoid)
        << to_string(form.type);
  }
}

TEST(Quadric, AUnitSphereHasItsTextbookCoefficients) {
  const auto c = Quadric::from_ellipsoid(Ellipsoid({3, 0, 0}, {1, 1, 1})).coefficients();
  EXPECT_EQ(c, (Quadric::Coefficients{1, 1, 1, 0, 0, 0, -3, 0, 0, 8}));
}

TEST(Quadric, AFaultNamesTheCoefficientItsValueAndTheRule) {
  Quadric::Coefficients c{1, 1, 1, 0, 0, 0, 0, 0, 0, -1};
  EXPECT_FALSE(Quadric::find_fault(c));
  c[8] = std::numeric_limits<double>::infinity();
  ASSERT_TRUE(Quadric::find_fault(c));
  EXPECT_STREQ(Quadric::find_fault(c)->field, "J");
  try {
    const Quadric q(c);
    FAIL() << "accepted " << q.coefficients()[8];
  } catch (const InvalidQuadric& fault) {
    EXPECT_STREQ(fault.what(), "J = inf: a coefficient must be finite");
  }
  c[8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Quadric{c}, InvalidQuadric);
}

TEST(Quadric, AnOverflowingCoefficientIsRefused) {
  EXPECT_THROW(Quadric::from_ellipsoid(Ellipsoid({1e200, 0, 0}, {1, 1, 1})), InvalidQuadric);
  EXPECT_NO_THROW(Quadric::from_ellipsoid(Ellipsoid({1e200, 0, 0}, {1e150, 1e150, 1e150})));
  EXPECT_THROW(Quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, 1e300}).scaled(1e10), InvalidQuadric);
}

}  // namespace
}  // namespace tangency
