// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <tangency/geometry/ellipse_closest_point.hpp>
#include <tangency/geometry/ellipse_containment.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/tests/support/ellipse_generators.hpp>
#include <tangency/tests/support/generators.hpp>
#include <tangency/verify/oracles/containment.hpp>

namespace tangency {
namespace {

using testing::EllipsePair;

constexpr double kU = kUnitRoundoff;

Ellipse scaled(const Ellipse& e, double by) {
  return Ellipse(e.centre(), by * e.semi_axes(), e.direction());
}

double size_of(const Ellipse& a, const Ellipse& b) {
  return (b.centre() - a.centre()).norm() + a.largest_semi_axis() + b.largest_semi_axis();
}

/// Of a in b: 1 in its interior, 0 touching from inside or equal, else -1.
int side_of(const EllipseRelation& found) {
  if (found.relation == Relation::a_in_b) return 1;
  const bool touches = found.relation == Relation::internal_touch && found.inner == Inner::a;
  return touches || found.relation == Relation::equal ? 0 : -1;
}
int sign_of(double x) { return (x > 0) - (x < 0); }

verify::RawEllipse raw(const Ellipse& e) {
  return {{e.centre()[0], e.centre()[1]},
          {e.semi_axes()[0], e.semi_axes()[1]},
          {e.direction()[0], e.direction()[1]}};
}

/// a in b, up to rounding: as large as it may be, times a factor, and a little more at times.
EllipsePair nested(double aspect) {
  const Ellipse outer = *testing::ellipse(aspect), shape = *testing::ellipse(aspect);
  const double off = *rc::gen::element(0.0, 0.3, 0.9, 0.999);
  const Ellipse inner =
      shape.moved_to(Vec2(outer.centre() + off * outer.support_point(*testing::plane_direction())));
  const double most = containment_margin(inner, outer).margin;
  const double share = *rc::gen::element(0.2, 0.7, 0.99, 1 - 1e-9, 1.0, 1.2);
  return most > 1e-6 ? EllipsePair{scaled(inner, share * most), outer} : EllipsePair{inner, outer};
}

TEST(EllipseContainment, OfTwoParallelEllipsesIsWhatThePaperSays) {
  const Ellipse inner({0, 0}, {3, 1}), outer({0, 0}, {5, 2.5});
  const PlaneClearance c = clearance(inner, outer);
  // The least of sqrt(6.25 + 18.75 x) - sqrt(1 + 8 x) for x in [0, 1], in 50 digits.
  EXPECT_NEAR(c.clearance, 1.4965237496723309, 4e-16);
  EXPECT_LE(c.clearance_error, 1e-15);
  EXPECT_EQ(c.status, GapStatus::ok);
  EXPECT_GT(std::abs(c.normal[0]), 0.17);  // on no axis
  EXPECT_NEAR(containment_margin(inner, outer).margin, 5.0 / 3, 2.3e-16);
  EXPECT_NEAR(signed_gap(inner, outer).gap, -3.5, 1e-15);
}

// geometry/ellipse_containment.hpp (1) (2)
RC_GTEST_PROP(EllipseContainment, SignsAreThoseOfTheExactRelation, ()) {
  const bool whole = *rc::gen::element(0, 1) == 0;
  const EllipsePair p =
      whole ? EllipsePair{*testing::whole_ellipse(), *testing::whole_ellipse()} : nested(1e4);
  const int side = side_of(relation(p.a, p.b));
  RC_TAG(side);
  const PlaneClearance c = clearance(p.a, p.b);
  RC_ASSERT(sign_of(c.clearance) == side);
  RC_ASSERT(sign_of(containment_margin(p.a, p.b).margin - 1) == side);
  RC_ASSERT(c.status == GapStatus::ok);
  RC_ASSERT(c.clearance_error <= 16 * kU * size_of(p.a, p.b));
}

// geometry/ellipse_containment.hpp (3)
RC_GTEST_PROP(EllipseContainment, TheMarginBoundsTheClearance, ()) {
  const EllipsePair p = nested(1e4);
  const PlaneClearance c = clearance(p.a, p.b);
  const ContainmentMargin m = containment_margin(p.a, p.b);
  const double axis = m.margin > 1 ? p.a.smallest_semi_axis() : p.a.largest_semi_axis();
  RC_ASSERT(c.clearance + c.clearance_error >=
            (m.margin - 1 - m.margin_error) * axis - 8 * kU * size_of(p.a, p.b));
}

// geometry/ellipse_containment.hpp (4)
RC_GTEST_PROP(EllipseContainment, GrowsByItsMarginUntilItTouches, ()) {
  const EllipsePair p = nested(1e4);
  const ContainmentMargin m = containment_margin(p.a, p.b);
  RC_PRE(m.margin > 1e-3);
  RC_ASSERT(std::abs(containment_margin(scaled(p.a, m.margin), p.b).margin - 1) <= 8 * kU);
  const PlaneClearance c = clearance(p.a, p.b);
  const auto unit = [](const Ellipse& e) {
    return Ellipse(0x1p-300 * e.centre(), 0x1p-300 * e.semi_axes(), e.direction());
  };
  RC_ASSERT(containment_margin(unit(p.a), unit(p.b)).margin == m.margin);
  RC_ASSERT(std::abs(0x1p300 * clearance(unit(p.a), unit(p.b)).clearance - c.clearance) <=
            2 * c.clearance_error);
}

// geometry/ellipse_containment.hpp (5)
RC_GTEST_PROP(EllipseContainment, ChangesNoFasterThanTheBodiesMove, ()) {
  const EllipsePair p = nested(1e4);
  const Vec2 d = p.b.centre() - p.a.centre();
  const Vec2 there = d + *testing::log_uniform(1e-12, 1) * *testing::plane_direction();
  const PlaneClearance here = clearance(p.a, p.b, d), after = clearance(p.a, p.b, there);
  RC_ASSERT(std::abs(after.clearance - here.clearance) <=
            (there - d).norm() * (1 + 4 * kU) + here.clearance_error + after.clearance_error);
}

// geometry/ellipse_containment.hpp (6)
RC_GTEST_PROP(EllipseContainment, IsCarriedAlongByARotation, ()) {
  const EllipsePair p = nested(1e4);
  const auto turned = [](const Ellipse& e) {  // by a quarter, exactly
    const Vec2 &c = e.centre(), &u = e.direction();
    return Ellipse({-c[1], c[0]}, e.semi_axes(), {-u[1], u[0]});
  };
  const PlaneClearance c = clearance(p.a, p.b), t = clearance(turned(p.a), turned(p.b));
  RC_ASSERT(std::abs(c.clearance - t.clearance) <= c.clearance_error + t.clearance_error);
  RC_ASSERT(containment_margin(p.a, p.b).margin ==
            containment_margin(turned(p.a), turned(p.b)).margin);
}

// geometry/ellipse_containment.hpp (6)
TEST(EllipseContainment, MarginsAreThoseOfTheEllipsesAfterAnAffineMap) {
  const auto body = [](const Vec2& centre, const MatrixEllipse::Symmetric2& m) {
    return MatrixEllipse::from_shape(centre, m);
  };
  // T = [1 2; 0 1]: T M T' of [9 2; 2 3] and of [40 5; 5 20].
  const ContainmentMargin m =
      containment_margin(body({1, -1}, {9, 3, 2}), body({0, 0}, {40, 20, 5}));
  const ContainmentMargin mapped =
      containment_margin(body({-1, -1}, {29, 3, 8}), body({0, 0}, {140, 20, 45}));
  EXPECT_GT(m.margin, 1);
  EXPECT_EQ(m.margin, mapped.margin);
}

RC_GTEST_PROP(EllipseContainment, NoOtherNormalIsBetterAndTheBranchIsThatOfTheOracle, ()) {
  const EllipsePair p = nested(1e6);
  const PlaneClearance c = clearance(p.a, p.b);
  const verify::Real near = verify::clearance_near(raw(p.a), raw(p.b), {c.normal[0], c.normal[1]});
  const verify::Real digits("1e-40");  // of the oracle
  RC_ASSERT(abs(near - c.clearance) <= c.clearance_error + digits);
  const Vec2 n = *testing::plane_direction();
  RC_ASSERT(verify::clearance_at(raw(p.a), raw(p.b), {n[0], n[1]}) >=
            verify::Real(c.clearance) - c.clearance_error - digits);
  const Vec2 between = (p.b.centre() - p.a.centre()) + c.arm_outer - c.arm_inner;
  RC_ASSERT(std::abs(between.dot(c.normal) - c.clearance) <=
            32 * kU * size_of(p.a, p.b) + c.clearance_error);
}

RC_GTEST_PROP(EllipseContainment, MarginsAreThoseOfTheEigenvalues, ()) {
  const EllipsePair p = nested(1e8);
  const ContainmentMargin m = containment_margin(p.a, p.b);
  const verify::MarginTruth truth = verify::margin_truth(raw(p.a), raw(p.b));
  RC_ASSERT(abs(truth.low - m.margin) <= m.margin_error + verify::Real("1e-60"));
  RC_ASSERT(m.margin_error <= 2 * kU * m.margin);
}

TEST(EllipseContainment, OfACircleIsItsCentresDistanceFromTheBoundary) {
  const Ellipse outer({0, 0}, {5, 3}, {3, 4});
  for (const Vec2& at : {Vec2(0, 0), Vec2(1, 0.5), Vec2(0, 1), Vec2(9, 0)}) {
    const PlaneClearance c = clearance(Ellipse(at, {0.25, 0.25}), outer);
    EXPECT_NEAR(c.clearance, -closest_point(outer, at).distance - 0.25, 4e-15);
  }
}

TEST(EllipseContainment, OfEllipsesThatAreNearlyTheSameKeepsItsDigits) {
  const Ellipse outer({0, 0}, {5, 3}, {3, 4});
  for (const double close : {1e-4, 1e-8, 1e-12, 1e-15}) {
    const Ellipse inner(close * Vec2(0.1, -0.2), {5 - close, 3 - 2 * close}, {3, 4});
    const PlaneClearance c = clearance(inner, outer);
    EXPECT_EQ(c.status, GapStatus::ok) << close;
    EXPECT_LE(c.clearance_error, 1e-15) << close;
    EXPECT_GT(c.clearance, 0) << close;
    EXPECT_LT(c.clearance, close) << close;
  }
  EXPECT_EQ(clearance(outer, outer).clearance, 0);
  EXPECT_EQ(clearance(outer, outer).clearance_error, 0);
}

TEST(EllipseContainment, HasTheSameBitsInEveryEnvironment) {
  const Ellipse outer({0, 0}, {5, 3}, {3, 4}), inner({0.5, 0.25}, {2, 1.5}, {1, 7});
  const PlaneClearance c = clearance(inner, outer);
  const ContainmentMargin m = containment_margin(inner, outer);
  const Vec2 d = outer.centre() - inner.centre();
  for (const testing::FloatingPointEnvironment& environment : testing::all_environments()) {
    const testing::EnvironmentGuard guard(environment);
    const PlaneClearance there = clearance(inner, outer, d);
    const ContainmentMargin margin = containment_margin(inner, outer, d);
    const bool same = there.clearance == c.clearance && there.normal == c.normal &&
                      there.clearance_error == c.clearance_error && margin.margin == m.margin &&
                      margin.margin_error == m.margin_error;
    EXPECT_TRUE(same) << environment.name;
  }
}

TEST(EllipseContainment, OfEllipsesByMatricesIsThatOfTheEllipsesAsGiven) {
  const MatrixEllipse::Symmetric2 shape{9, 3, 2};
  const auto a = MatrixEllipse::from_shape({1, -1}, shape);
  const auto b = MatrixEllipse::from_shape({0, 0}, {40, 20, 5});
  const PlaneClearance c = clearance(a, b), rounded = clearance(a.ellipse(), b.ellipse());
  EXPECT_GT(c.clearance, 0);
  EXPECT_EQ(c.normal, rounded.normal);
  EXPECT_GE(c.clearance_error, rounded.clearance_error + a.rounding() + b.rounding());
  EXPECT_EQ(containment_margin(a, a).margin, 1);
  const auto larger = MatrixEllipse::from_shape({1, -1}, shape, std::nextafter(1.0, 2.0));
  EXPECT_GT(clearance(a, larger).clearance, 0);
  EXPECT_LT(clearance(larger, a).clearance, 0);
  EXPECT_GT(containment_margin(a, larger).margin, 1);
  EXPECT_LT(containment_margin(larger, a).margin, 1);
}

}  // namespace
}  // namespace tangency
