// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/bodies/wall_form.hpp>
#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/ellipse_containment.hpp>
#include <tangency/geometry/gap/chart_bound.hpp>
#include <tangency/geometry/gap/search.hpp>
#include <tangency/geometry/normals/factored.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/relation/exact_margin.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/tests/support/generators.hpp>
#include <tangency/verify/oracles/containment.hpp>

namespace tangency {
namespace {

using testing::Pair;

constexpr double kU = kUnitRoundoff;

Ellipsoid scaled(const Ellipsoid& e, double by) {
  return Ellipsoid(e.centre(), by * e.semi_axes(), e.orientation());
}

double size_of(const Ellipsoid& a, const Ellipsoid& b) {
  return (b.centre() - a.centre()).norm() + a.largest_semi_axis() + b.largest_semi_axis();
}

/// Of a in b: 1 in its interior, 0 touching from inside or equal, else -1.
int side_of(const RelationAnswer& found) {
  if (found.relation == Relation::a_in_b) return 1;
  const bool touches = found.relation == Relation::internal_touch && found.inner == Inner::a;
  return touches || found.relation == Relation::equal ? 0 : -1;
}
int sign_of(double x) { return (x > 0) - (x < 0); }

verify::RawEllipsoid raw(const Ellipsoid& e) {
  const Quaternion q = e.orientation();
  return {{e.centre()[0], e.centre()[1], e.centre()[2]},
          {e.semi_axes()[0], e.semi_axes()[1], e.semi_axes()[2]},
          {q.w(), q.x(), q.y(), q.z()}};
}

/// a in b, up to rounding: as large as it may be, times a factor, and a little more at times.
Pair nested(double aspect) {
  const Ellipsoid outer = *testing::ellipsoid(aspect), shape = *testing::ellipsoid(aspect);
  const double off = *rc::gen::element(0.0, 0.3, 0.9, 0.999);
  const Vec3 at = outer.centre() + off * outer.support_point(*testing::direction());
  const Ellipsoid inner = shape.moved_to(at);
  const double most = containment_margin(inner, outer).margin;
  const double share = *rc::gen::element(0.2, 0.7, 0.99, 1 - 1e-9, 1.0, 1.2);
  return most > 1e-6 ? Pair{scaled(inner, share * most), outer} : Pair{inner, outer};
}

// geometry/containment.hpp (1) (2)
RC_GTEST_PROP(Containment, SignsAreThoseOfTheExactRelation, ()) {
  const Pair p = *rc::gen::element(0, 1) == 0 ? nested(100) : *testing::whole_pair();
  const int side = side_of(relation(p.a, p.b));
  const Clearance c = clearance(p.a, p.b);
  RC_TAG(side);
  RC_ASSERT(sign_of(c.clearance) == side);
  RC_ASSERT(sign_of(containment_margin(p.a, p.b).margin - 1) == side);
  RC_ASSERT(c.status == GapStatus::ok);
  RC_ASSERT(c.clearance_error <= 100 * kU * size_of(p.a, p.b));
}

// geometry/containment.hpp (3)
RC_GTEST_PROP(Containment, TheMarginBoundsTheClearance, ()) {
  const Pair p = nested(1000);
  const Clearance c = clearance(p.a, p.b);
  const ContainmentMargin m = containment_margin(p.a, p.b);
  const double axis = m.margin > 1 ? p.a.smallest_semi_axis() : p.a.largest_semi_axis();
  RC_ASSERT(c.clearance + c.clearance_error >=
            (m.margin - 1 - m.margin_error) * axis - 8 * kU * size_of(p.a, p.b));
}

// geometry/containment.hpp (4)
RC_GTEST_PROP(Containment, GrowsByItsMarginUntilItTouches, ()) {
  const Pair p = nested(1000);
  const ContainmentMargin m = containment_margin(p.a, p.b);
  RC_PRE(m.margin > 1e-3);
  // The semi-axes of the grown body are rounded.
  const ContainmentMargin grown = containment_margin(scaled(p.a, m.margin), p.b);
  RC_ASSERT(std::abs(grown.margin - 1) <= 8 * kU);
  const Clearance c = clearance(p.a, p.b);
  const auto unit = [](const Ellipsoid& e) {
    return Ellipsoid(0x1p-300 * e.centre(), 0x1p-300 * e.semi_axes(), e.orientation());
  };
  RC_ASSERT(containment_margin(unit(p.a), unit(p.b)).margin == m.margin);
  RC_ASSERT(std::abs(0x1p300 * clearance(unit(p.a), unit(p.b)).clearance - c.clearance) <=
            2 * c.clearance_error);
}

// geometry/containment.hpp (5)
RC_GTEST_PROP(Containment, ChangesNoFasterThanTheBodiesMove, ()) {
  const Pair p = nested(100);
  const Vec3 move = *testing::log_uniform(1e-12, 1) * *testing::direction();
  const Vec3 d = p.b.centre() - p.a.centre(), there = d + move;
  const Clearance here = clearance(p.a, p.b, d), after = clearance(p.a, p.b, there);
  RC_ASSERT(std::abs(after.clearance - here.clearance) <=
            (there - d).norm() * (1 + 4 * kU) + here.clearance_error + after.clearance_error);
}

// geometry/containment.hpp (6)
RC_GTEST_PROP(Containment, IsCarriedAlongByARotation, ()) {
  const Pair p = nested(100);
  // A third of a turn about the diagonal exchanges coordinates, exactly.
  const auto turned = [](const Ellipsoid& e) {
    const Vec3& c = e.centre();
    return Ellipsoid({c[2], c[0], c[1]}, e.semi_axes(), Quaternion(1, 1, 1, 1) * e.orientation());
  };
  const Clearance c = clearance(p.a, p.b), t = clearance(turned(p.a), turned(p.b));
  // The product of the quaternions is rounded.
  const double off = 32 * kU * size_of(p.a, p.b);
  RC_ASSERT(std::abs(c.clearance - t.clearance) <= c.clearance_error + t.clearance_error + off);
}

// geometry/containment.hpp (6)
TEST(Containment, MarginsAreThoseOfTheBodiesAfterAnAffineMap) {
  Mat3 outer, inner, map;
  outer << 50, 3, -4, 3, 40, 7, -4, 7, 30;
  inner << 4, 1, 0, 1, 5, -1, 0, -1, 3;
  map << 1, 2, 0, 0, 1, 3, -1, 0, 1;
  const Vec3 at(1, -2, 1), shift(100, 7, 1);
  const auto body = [](const Vec3& centre, const Mat3& shape) {
    return MatrixEllipsoid::from_shape(centre, shape);
  };
  const ContainmentMargin m = containment_margin(body(at, inner), body(Vec3::Zero(), outer));
  const ContainmentMargin mapped =
      containment_margin(body(map * at + shift, map * inner * map.transpose()),
                         body(shift, map * outer * map.transpose()));
  EXPECT_GT(m.margin, 1);
  EXPECT_EQ(m.margin, mapped.margin);
  EXPECT_EQ(m.margin_error, mapped.margin_error);
}

RC_GTEST_PROP(Containment, NormalAndPointsAreThoseOfTheClearance, ()) {
  const Pair p = nested(100);
  const Clearance c = clearance(p.a, p.b);
  const double rounding = 32 * kU * size_of(p.a, p.b) + c.clearance_error;
  RC_ASSERT(std::abs(c.normal.norm() - 1) <= 4 * kU);
  RC_ASSERT(std::abs(c.normal.dot(c.arm_inner) - p.a.support(c.normal)) <= rounding);
  RC_ASSERT(std::abs(c.normal.dot(c.arm_outer) - p.b.support(c.normal)) <= rounding);
  const Vec3 between = (p.b.centre() - p.a.centre()) + c.arm_outer - c.arm_inner;
  RC_ASSERT(std::abs(between.dot(c.normal) - c.clearance) <= rounding);
}

RC_GTEST_PROP(Containment, NoOtherNormalIsBetterAndTheBranchIsThatOfTheOracle, ()) {
  const Pair p = nested(1000);
  const Clearance c = clearance(p.a, p.b);
  const verify::Real near =
      verify::clearance_near(raw(p.a), raw(p.b), {c.normal[0], c.normal[1], c.normal[2]});
  const verify::Real digits("1e-40");  // of the oracle
  RC_ASSERT(abs(near - c.clearance) <= c.clearance_error + digits);
  const Vec3 n = *testing::direction();
  RC_ASSERT(verify::clearance_at(raw(p.a), raw(p.b), {n[0], n[1], n[2]}) >=
            verify::Real(c.clearance) - c.clearance_error - digits);
}

/// The least of phi(n) over a net of normals, some 0.01 rad apart.
double least_on_a_net(const Ellipsoid& inner, const Ellipsoid& outer) {
  constexpr int kRows = 300;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kRows; ++i) {
    const double z = -1.0 + 2.0 * i / kRows, r = std::sqrt(std::fmax(0.0, 1.0 - z * z));
    for (int k = 0; k < 2 * kRows; ++k) {
      const double turn = std::numbers::pi * k / kRows;
      const Vec3 n(r * std::cos(turn), r * std::sin(turn), z);
      const Vec3 d = inner.centre() - outer.centre();
      least = std::min(least, outer.support(n) - inner.support(n) - n.dot(d));
    }
  }
  return least;
}

// One of 3 pairs among 200,000 whose minimum no ascent from d or from an axis comes to.
TEST(Containment, IsTheLeastWhereNoAscentFindsIt) {
  const Ellipsoid outer(Vec3::Zero(), {3.855472, 8.730415, 0.368066},
                        {0.078677, 0.227053, -0.287924, 0.390949});
  const Ellipsoid inner({-0.043813, -0.068542, -0.029722}, {1.076939, 4.718496, 1.213537},
                        {-0.066811, -0.481635, -0.834636, 0.464153});
  const detail::Pair pair({outer, inner}, detail::Sought::clearance);
  const detail::FactoredPair factored(pair.a, pair.b, pair.d, true);
  const auto by_ascents = detail::search_sphere(pair, factored, pair.d.stableNormalized(), 0);
  ASSERT_TRUE(by_ascents);
  const Clearance c = clearance(inner, outer);
  EXPECT_EQ(c.status, GapStatus::ok);
  EXPECT_LT(c.clearance, -by_ascents->gap - 0.01);
  EXPECT_LE(c.clearance, least_on_a_net(inner, outer) + c.clearance_error);
}

RC_GTEST_PROP(Containment, MarginsAreThoseOfTheEigenvalues, ()) {
  const Pair p = nested(1e6);
  const ContainmentMargin m = containment_margin(p.a, p.b);
  const verify::MarginTruth truth = verify::margin_truth(raw(p.a), raw(p.b));
  RC_ASSERT(abs(truth.low - m.margin) <= m.margin_error + verify::Real("1e-60"));
  RC_ASSERT(m.margin_error <= 2 * kU * m.margin);
}

// geometry/relation/exact_margin.hpp (1)
RC_GTEST_PROP(Containment, BoundsOfTheMarginAreRationalsAroundIt, ()) {
  const Pair p = nested(1e6);
  const exact::MarginEnclosure found =
      exact::margin(exact::rational_solid(p.a), exact::rational_solid(p.b));
  const verify::MarginTruth truth = verify::margin_truth(raw(p.a), raw(p.b));
  const auto real = [](const mpq_class& q) {
    return verify::Real(verify::Real(q.get_num().get_str()) / verify::Real(q.get_den().get_str()));
  };
  const verify::Real digits("1e-60");
  RC_ASSERT(real(found.low) <= truth.high + digits);
  RC_ASSERT(real(found.high) >= truth.low - digits);
  RC_ASSERT(((found.high - found.low) << 56) <= found.low);
}

// geometry/relation/exact_margin.hpp (2) (3)
TEST(Containment, MarginsAreNoneFromTheBoundaryOutwardsAndRoundedToTheirSide) {
  const auto margin = [](double x) {
    return exact::margin(exact::rational_solid(Ellipsoid({x, 0, 0}, {1, 2, 1})),
                         exact::rational_solid(Ellipsoid({0, 0, 0}, {3, 2, 1})));
  };
  EXPECT_EQ(margin(3).high, 0);
  EXPECT_EQ(margin(std::nextafter(3, 4)).high, 0);
  EXPECT_GT(margin(std::nextafter(3, 0)).low, 0);
  const mpq_class little(1, mpz_class(1) << 70);
  const exact::MarginEnclosure around{1 - little, 1 + little};
  EXPECT_TRUE(around.leaves_one_open());
  EXPECT_EQ(exact::rounded(around, 0).value, 1);
  EXPECT_EQ(exact::rounded(around, 1).value, 1 + 2 * kU);
  EXPECT_EQ(exact::rounded(around, -1).value, 1 - kU);
  EXPECT_GE(exact::rounded(around, 1).error, 2 * kU);
  EXPECT_GE(exact::rounded(around, -1).error, kU);
}

// geometry/gap/chart_bound.hpp (1)
RC_GTEST_PROP(Containment, NoNormalOfATriangleExceedsItsBound, ()) {
  const Pair p = nested(100);
  const Vec3 d = p.a.centre() - p.b.centre(), c = *testing::direction();
  const detail::FactoredPair factored(p.b, p.a, d, true);
  const double reach = *testing::log_uniform(1e-4, 0.3);
  std::array<Vec3, 3> corner;
  for (Vec3& v : corner) v = c + reach * *testing::direction();
  const Vec3 centre = (corner[0] + corner[1] + corner[2]).normalized();
  const double value = factored.value(*testing::direction());
  const detail::Chart<double, 3> chart(
      d, centre, corner, [&](const Vec3& v) -> Vec3 { return factored.factor_a().transpose() * v; },
      [&](const Vec3& v) -> Vec3 { return factored.factor_b().transpose() * v; });
  const double excess = chart.excess(value, 0x1p-44 * size_of(p.a, p.b));
  for (int i = 0; i <= 6; ++i) {
    for (int j = 0; i + j <= 6; ++j) {
      const Vec3 n = (i * corner[0] + j * corner[1] + (6 - i - j) * corner[2]).normalized();
      RC_ASSERT(factored.value(n) <= value + excess);
    }
  }
}

TEST(Containment, OfSpheresIsThatOfTheirRadii) {
  const Ellipsoid outer({1, 2, 3}, {10, 10, 10}), inner({1, 2, 6}, {2, 2, 2});
  const Clearance c = clearance(inner, outer);
  EXPECT_EQ(c.clearance, 5);
  EXPECT_EQ(c.normal, Vec3(0, 0, 1));
  EXPECT_EQ(c.arm_inner, Vec3(0, 0, 2));
  EXPECT_EQ(c.arm_outer, Vec3(0, 0, 10));
  EXPECT_EQ(containment_margin(inner, outer).margin, 3.5);
  EXPECT_EQ(clearance(outer, inner).clearance, -11);
}

TEST(Containment, OfABallIsItsCentresDistanceFromTheSurface) {
  const Ellipsoid outer({0, 0, 0}, {5, 3, 2}, Quaternion(1, 2, 3, 4));
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1, 0.5, -0.5), Vec3(0, 1, 0), Vec3(9, 0, 0)}) {
    const Clearance c = clearance(Ellipsoid(at, {0.25, 0.25, 0.25}), outer);
    EXPECT_NEAR(c.clearance, -closest_point(outer, at).distance - 0.25, 2e-15);
    EXPECT_EQ(c.status, GapStatus::ok);
  }
}

TEST(Containment, InABallIsWhatTheFarthestPointLeaves) {
  const Ellipsoid ball({0, 0, 0}, {10, 10, 10}), body({0, 0, 0}, {3, 1, 2}, Quaternion(3, 0, 4, 0));
  const Clearance c = clearance(body, ball);
  EXPECT_NEAR(c.clearance, 7, c.clearance_error);
  EXPECT_LE(c.clearance_error, 1e-14);
  EXPECT_NEAR(containment_margin(body, ball).margin, 10.0 / 3, 1e-15);
}

// Minima all along a circle.
TEST(Containment, OfCoaxialBodiesIsThatOfTheirProfiles) {
  for (const double shift : {0.0, 0.75}) {
    for (const Vec2& b : {Vec2(3, 1), Vec2(1, 2), Vec2(4.2, 2.25), Vec2(4.2, 2.4999999)}) {
      const PlaneClearance plane = clearance(Ellipse({shift, 0}, b), Ellipse({0, 0}, {5, 2.5}));
      const Clearance space = clearance(Ellipsoid({shift, 0, 0}, {b[0], b[1], b[1]}),
                                        Ellipsoid({0, 0, 0}, {5, 2.5, 2.5}));
      EXPECT_EQ(space.status, GapStatus::ok);
      EXPECT_NEAR(space.clearance, plane.clearance, space.clearance_error + plane.clearance_error);
      EXPECT_LE(space.clearance_error, 100 * kU * 10);
    }
  }
}

TEST(Containment, OfEqualBodiesIsNothingAndOne) {
  const Ellipsoid e({1, 2, 3}, {5, 3, 2}, Quaternion(1, 2, 3, 4));
  const Clearance c = clearance(e, e);
  EXPECT_EQ(c.clearance, 0);
  EXPECT_EQ(c.clearance_error, 0);
  EXPECT_EQ(c.status, GapStatus::ok);
  const ContainmentMargin m = containment_margin(e, e);
  EXPECT_EQ(m.margin, 1);
  EXPECT_EQ(m.margin_error, 0);
}

TEST(Containment, OfBodiesThatAreNearlyTheSameKeepsItsDigits) {
  const Ellipsoid outer({0, 0, 0}, {5, 3, 2}, Quaternion(1, 2, 3, 4));
  for (const double close : {1e-4, 1e-8, 1e-12, 1e-15}) {
    const Ellipsoid inner(close * Vec3(0.1, -0.2, 0.1), {5 - close, 3 - 2 * close, 2 - close},
                          Quaternion(1, 2, 3, 4));
    const Clearance c = clearance(inner, outer);
    EXPECT_EQ(c.status, GapStatus::ok) << close;
    EXPECT_LE(c.clearance_error, 1e-14) << close;
    EXPECT_GT(c.clearance, 0) << close;
    EXPECT_LT(c.clearance, close) << close;
  }
}

// The least is in the plane of the longest and the shortest axis.
TEST(Containment, OfNeedlesIsThatOfTheirSections) {
  for (const double length : {1e2, 1e4, 1e6, 1e8}) {
    const Ellipsoid outer({0, 0, 0}, {length, 1, 2e-3}, Quaternion(1, 2, 3, 4));
    const Ellipsoid inner({0, 0, 0}, {0.75 * length, 0.5, 1e-3}, Quaternion(1, 2, 3, 4));
    const Clearance c = clearance(inner, outer);
    const PlaneClearance section =
        clearance(Ellipse({0, 0}, {0.75 * length, 1e-3}), Ellipse({0, 0}, {length, 2e-3}));
    EXPECT_NEAR(c.clearance, section.clearance, c.clearance_error + section.clearance_error);
    EXPECT_GT(c.clearance, 0);
    if (length < 1e5) {
      EXPECT_EQ(c.status, GapStatus::ok);
    }
    const ContainmentMargin m = containment_margin(inner, outer);
    EXPECT_NEAR(m.margin, 4.0 / 3, 4 * kU);
  }
}

TEST(Containment, IsNothingWhereTheCentreIsNotInside) {
  const Ellipsoid outer({0, 0, 0}, {3, 2, 1}), small({3, 0, 0}, {1e-9, 1e-9, 1e-9});
  EXPECT_EQ(containment_margin(small, outer).margin, 0);
  EXPECT_EQ(containment_margin(small, outer).margin_error, 0);
  const Ellipsoid barely({std::nextafter(3, 0), 0, 0}, {1, 1, 1});
  const ContainmentMargin m = containment_margin(barely, outer);
  EXPECT_GT(m.margin, 0);
  EXPECT_LT(m.margin, 1e-15);
  EXPECT_LE(m.margin_error, 2 * kU * m.margin);
}

TEST(Containment, HasTheSameBitsInEveryEnvironment) {
  const Ellipsoid outer({0, 0, 0}, {5, 3, 2}, Quaternion(1, 2, 3, 4));
  const Ellipsoid inner({0.5, 0.25, 0.1}, {2, 1.5, 0.5}, Quaternion(4, -1, 2, 3));
  const Clearance c = clearance(inner, outer);
  const ContainmentMargin m = containment_margin(inner, outer);
  const Vec3 d = outer.centre() - inner.centre();
  for (const testing::FloatingPointEnvironment& environment : testing::all_environments()) {
    const testing::EnvironmentGuard guard(environment);
    const Clearance there = clearance(inner, outer, d);
    const ContainmentMargin margin = containment_margin(inner, outer, d);
    const bool same = there.clearance == c.clearance && there.normal == c.normal &&
                      there.clearance_error == c.clearance_error && margin.margin == m.margin &&
                      margin.margin_error == m.margin_error;
    EXPECT_TRUE(same) << environment.name;
  }
}

TEST(Containment, OfBodiesByMatricesIsThatOfTheBodiesAsGiven) {
  Mat3 outer, inner;
  outer << 50, 3, -4, 3, 40, 7, -4, 7, 30;
  inner << 4, 1, 0, 1, 5, -1, 0, -1, 3;
  const auto a = MatrixEllipsoid::from_shape({1, -2, 1}, inner);
  const auto b = MatrixEllipsoid::from_shape({0, 0, 0}, outer);
  const Clearance c = clearance(a, b), rounded = clearance(a.ellipsoid(), b.ellipsoid());
  EXPECT_EQ(c.normal, rounded.normal);
  EXPECT_GT(c.clearance, 0);
  EXPECT_GE(c.clearance_error, rounded.clearance_error + a.rounding() + b.rounding());
  // The nearest bodies by axes are about u of themselves off.
  const double near = containment_margin(a.ellipsoid(), b.ellipsoid()).margin;
  EXPECT_NEAR(containment_margin(a, b).margin, near, 64 * kU * near);
  // A body is equal to itself, and one in the last place larger is not.
  EXPECT_EQ(clearance(a, a).clearance, 0);
  EXPECT_EQ(containment_margin(a, a).margin, 1);
  const auto larger = MatrixEllipsoid::from_shape({1, -2, 1}, inner, std::nextafter(1.0, 2.0));
  EXPECT_GT(clearance(a, larger).clearance, 0);
  EXPECT_LT(clearance(larger, a).clearance, 0);
  EXPECT_GT(containment_margin(a, larger).margin, 1);
  EXPECT_LT(containment_margin(larger, a).margin, 1);
}

// A flat body that sticks out by 2^-40 along its middle axis, which the search does not settle.
TEST(Containment, OfBodiesByMatricesKeepsBothBoundsWhereItIsLocal) {
  const Mat3 turn = Quaternion(1, 2, 3, 4).normalized().toRotationMatrix();
  const Vec3 axes(1, 0.1, 1e-9);
  const Mat3 inner = turn * ((1 + 0x1p-40) * axes).asDiagonal();
  const Mat3 outer = turn * axes.cwiseProduct(Vec3(1.25, 1, 1.125)).asDiagonal();
  const auto a = MatrixEllipsoid::from_axes(Vec3::Zero(), inner);
  const auto b = MatrixEllipsoid::from_axes(Vec3::Zero(), outer);
  const Clearance c = clearance(a, b), rounded = clearance(a.ellipsoid(), b.ellipsoid());
  ASSERT_EQ(c.status, GapStatus::local);
  EXPECT_LT(c.clearance, 0);
  // Identity (3) of the bodies by axes.
  EXPECT_LT(rounded.clearance_error, 0x1p-40);
  EXPECT_LE(c.clearance_error, 2 * (rounded.clearance_error + a.rounding() + b.rounding()));
}

}  // namespace
}  // namespace tangency
