// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tangency/geometry/curvature.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

constexpr double kU = kUnitRoundoff;
constexpr double kAspect = 1e8;      // chosen
constexpr double kComparable = 0.1;  // rad; chosen: beyond it a direction is as good as any

double beta(const Ellipsoid& e, const Vec3& n) { return e.largest_semi_axis() / e.support(n); }

/// What curvature.hpp promises of a curvature, of itself.
double relative_error(double beta) { return 128 * kU * beta; }

/// What it promises of the directions, rad.
double direction_error(const PrincipalCurvatures& c, double beta) {
  const double split = c.curvature[0] - c.curvature[1], sum = c.curvature[0] + c.curvature[1];
  return split > 0 ? 64 * kU * beta * sum / split : std::numeric_limits<double>::infinity();
}

/// Both curvatures the same to within `error` of themselves, both directions but for their signs to
/// within `turn`.
void assert_same(const PrincipalCurvatures& x, const PrincipalCurvatures& y, double error,
                 double turn) {
  for (int i = 0; i < 2; ++i) {
    RC_ASSERT(std::abs(x.curvature[i] - y.curvature[i]) <= error * x.curvature[i]);
    if (turn < kComparable) RC_ASSERT(x.direction[i].cross(y.direction[i]).norm() <= turn);
  }
  RC_CLASSIFY(turn < kComparable, "directions compared");
}

// geometry/curvature.hpp (1)
RC_GTEST_PROP(CurvatureProperty, ProductIsThatOfTheSupportAndTheSemiAxes, ()) {
  const Ellipsoid e = *testing::ellipsoid(kAspect);
  const Vec3 n = *testing::direction();
  const PrincipalCurvatures c = surface_curvature(e, n);
  const double h = e.support(n);
  const double expected =
      std::pow(h / e.semi_axes()[0] * (h / e.semi_axes()[1]) / e.semi_axes()[2], 2);
  // Two curvatures, and four times h, which errs by 8 u a_max: R and n by 4 u of 1.
  const double error = 2 * relative_error(beta(e, n)) + 4 * 8 * kU * beta(e, n) + 16 * kU;
  RC_ASSERT(std::abs(c.curvature[0] * c.curvature[1] - expected) <= error * expected);
}

// geometry/curvature.hpp (2)
RC_GTEST_PROP(CurvatureProperty, IsThatOfTheOppositePoint, ()) {
  const Ellipsoid e = *testing::ellipsoid(kAspect);
  const Vec3 n = *testing::direction();
  const PrincipalCurvatures c = surface_curvature(e, n);
  assert_same(c, surface_curvature(e, -n), 2 * relative_error(beta(e, n)),
              2 * direction_error(c, beta(e, n)));
}

// geometry/curvature.hpp (3)
RC_GTEST_PROP(CurvatureProperty, TurnsWithARotationAndDividesByAScale, ()) {
  const Ellipsoid e = *testing::ellipsoid(kAspect);
  const Vec3 n = *testing::direction();
  const Eigen::Quaterniond turn = (*testing::orientation()).normalized();
  const double s = *testing::log_uniform(1e-100, 1e100);
  const Ellipsoid moved(Vec3::Zero(), s * e.semi_axes(), turn * e.orientation().normalized());
  const PrincipalCurvatures before = surface_curvature(e, n);
  PrincipalCurvatures after = surface_curvature(moved, (turn * n).normalized());
  for (double& k : after.curvature) k *= s;
  for (Vec3& t : after.direction) t = turn.conjugate() * t;
  // The turned body and the turned normal are rounded, which counts as their rounding does in the
  // promise: once more each way. The scaled semi-axes are within u, a curvature has six of them.
  assert_same(before, after, 4 * relative_error(beta(e, n)),
              4 * direction_error(before, beta(e, n)) + 16 * kU);
}

struct Contact {
  Ellipsoid a, b;
  Vec3 normal;
  double beta;
  ContactCurvature curvature;
};

Contact any_contact() {
  const testing::Pair p = *testing::pair_at(kAspect, testing::uniform(0, 2));
  const Vec3 n = *testing::direction();
  return {p.a, p.b, n, std::max(beta(p.a, n), beta(p.b, n)), contact_curvature(p.a, p.b, n)};
}

// geometry/curvature.hpp (4)
RC_GTEST_PROP(ContactCurvatureProperty, ExchangeLeavesTheRelativeCurvatures, ()) {
  const Contact c = any_contact();
  const ContactCurvature back = contact_curvature(c.b, c.a, -c.normal);
  const auto compare = [&](const PrincipalCurvatures& x, const PrincipalCurvatures& y,
                           double error) {
    assert_same(x, y, 2 * error, 2 * direction_error(x, c.beta));
  };
  compare(c.curvature.a, back.b, relative_error(c.beta));
  compare(c.curvature.b, back.a, relative_error(c.beta));
  compare(c.curvature.relative, back.relative, 4 * relative_error(c.beta));
}

// geometry/curvature.hpp (5)
RC_GTEST_PROP(ContactCurvatureProperty, RelativeCurvaturesAddUpToTheFourOfTheBodies, ()) {
  const Contact c = any_contact();
  const auto sum = [](const PrincipalCurvatures& x) { return x.curvature[0] + x.curvature[1]; };
  const double bodies = sum(c.curvature.a) + sum(c.curvature.b);
  RC_ASSERT(std::abs(sum(c.curvature.relative) - bodies) <=
            (2 * relative_error(c.beta) + 8 * kU) * bodies);
}

}  // namespace
}  // namespace tangency
