// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <tangency/geometry/bodies/ellipsoid_form.hpp>
#include <tangency/geometry/bodies/exact_quadric_type.hpp>
#include <tangency/geometry/bodies/pencil_form.hpp>
#include <tangency/geometry/pencil.hpp>
#include <tangency/tests/geometry/quadric_generators.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using enum QuadricType;
using Members = std::vector<PencilMember>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Ellipsoid sphere(double x, double radius) { return {{x, 0, 0}, {radius, radius, radius}}; }

/// Small integers, so that touching and degenerate pairs are common and forms stay short.
Ellipsoid integer_ellipsoid() {
  const auto length = [] { return static_cast<double>(*rc::gen::inRange(1, 5)); };
  const auto coordinate = [] { return static_cast<double>(*rc::gen::inRange(-4, 5)); };
  const Vec3 centre(coordinate(), coordinate(), coordinate());
  const Vec3 semi_axes(length(), length(), length());
  const Eigen::Quaterniond q(length(), coordinate(), coordinate(), coordinate());
  return {centre, semi_axes, q};
}

/// Roots of the invariants that the published scan sorts: T1-3 and D2-4.
long published_roots(const Members& members) {
  return std::count_if(members.begin(), members.end(), [](const PencilMember& m) {
    return m.is_root && (m.sign(Invariant::t1) == 0 || m.sign(Invariant::t2) == 0 ||
                         m.sign(Invariant::t3) == 0 || m.sign(Invariant::d2) == 0 ||
                         m.sign(Invariant::d3) == 0 || m.sign(Invariant::d4) == 0);
  });
}

const PencilMember& root_at(const Members& members, double f) {
  const auto found = std::find_if(members.begin(), members.end(), [f](const PencilMember& m) {
    return m.is_root && m.low == f && m.high == f;
  });
  if (found == members.end()) throw std::runtime_error("no root there");
  return *found;
}

// x^2 + y^2 + z^2 +- 2^-700: only the last coefficient tells which.
TEST(Pencil, EveryCoefficientCountsHoweverSmall) {
  const Quadric unit({1, 1, 1, 0, 0, 0, 0, 0, 0, -1});
  for (const double tiny : {-0x1p-700, 0x1p-700}) {
    const Members members = pencil_members(Quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, tiny}), unit);
    EXPECT_EQ(root_at(members, -1).classification.type, no_points);
    const auto at_zero = std::find_if(members.begin(), members.end(), [](const PencilMember& m) {
      return m.low <= 0 && m.high >= 0;
    });
    ASSERT_NE(at_zero, members.end());
    EXPECT_EQ(at_zero->classification.type, tiny < 0 ? real_ellipsoid : imaginary_ellipsoid);
  }
}

// Erratum 1.
TEST(PencilErrata, AllMembersCountSurfacesSoNestedSolidsReadAsApart) {
  const Quadric inner({1, 1, 1, 0, 0, 0, 0, 0, 0, -1});
  const Quadric outer({1, 1, 1, 0, 0, 0, 0, 0, 0, -4});
  const Members members = pencil_members(inner, outer);
  EXPECT_FALSE(published_scan_finds_overlap(members));
  EXPECT_EQ(scan_solids(members), PencilVerdict::overlap);

  for (const PencilMember& m : members) {
    const bool expected = m.low >= -1 && m.high <= -0.25 && !(m.is_root && m.f == -0.25);
    EXPECT_EQ(is_empty(m.classification.type), expected) << m.f;
  }
}

// Erratum 2.
TEST(PencilErrata, FifteenDistinctRootsOccur) {
  const Ellipsoid a({0, 0, 0}, {1, 2, 3});
  const Ellipsoid b({7, 1, 2}, {2, 1, 1.5}, Eigen::Quaterniond(1, 2, 3, 4));
  const Members members = pencil_members(a, b);
  EXPECT_EQ(published_roots(members), 15);
  EXPECT_EQ(members.size(), 33u);  // with the root of D1
}

TEST(PencilErrata, TheDegreesAddUpToFifteenAndD1MakesSixteen) {
  const auto form = [](double x, const Vec3& axes) {
    return exact::ellipsoid_form(Ellipsoid({x, 1, 2}, axes, Eigen::Quaterniond(1, 2, 3, 4))).form;
  };
  const auto invariants = exact::pencil_invariants(form(3, {1, 2, 3}), form(-5, {3, 1, 1}));
  int sum = 0;
  for (const auto& p : invariants) sum += p.degree();
  EXPECT_EQ(sum, 15 + 1);
}

// Erratum 3.
TEST(PencilErrata, D2AndD3ChangeUnderTranslationWhereTAndD4DoNot) {
  const auto invariants = [](double x) {
    const auto form = exact::ellipsoid_form(sphere(x, 1)).form;
    return exact::pencil_invariants(form, exact::IntegerForm<4>{});
  };
  const auto value = [&](double x, Invariant i) {
    return invariants(x)[static_cast<std::size_t>(i)].coefficients()[0];
  };
  EXPECT_EQ(value(0, Invariant::d3), -2);
  EXPECT_EQ(value(1, Invariant::d3), -1);
  EXPECT_EQ(value(3, Invariant::d3), 7);
  for (const double x : {1.0, 3.0}) {
    for (const Invariant i : {Invariant::t1, Invariant::t2, Invariant::t3, Invariant::d4}) {
      EXPECT_EQ(value(x, i), value(0, i));
    }
    EXPECT_NE(value(x, Invariant::d2), value(0, Invariant::d2));
    EXPECT_EQ(classify(Quadric::from_ellipsoid(sphere(x, 1))).type, real_ellipsoid);
  }
}

// Erratum 3, its last part: T1-3 and D2-4 all vanish in both, D1 does not.
TEST(PencilErrata, D1IsNeededToTellNoPointsFromAllSpace) {
  const PencilMember nothing = root_at(pencil_members(Quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, -1}),
                                                      Quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, -4})),
                                       -1);
  const PencilMember everything = root_at(pencil_members(sphere(0, 1), sphere(0, 1)), -1);
  EXPECT_EQ(nothing.signs, (std::array<int, 7>{0, 0, 0, 1, 0, 0, 0}));
  EXPECT_EQ(everything.signs, (std::array<int, 7>{0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(nothing.classification.type, no_points);
  EXPECT_EQ(everything.classification.type, all_space);
}

// Erratum 4.
RC_GTEST_PROP(PencilErrata, BetweenRootsTheOnlyEmptyTypeIsTheImaginaryEllipsoid, ()) {
  const Members members = pencil_members(integer_ellipsoid(), integer_ellipsoid());
  bool some = false;
  for (const PencilMember& m : members) {
    const QuadricType type = m.classification.type;
    if (!m.is_root) RC_ASSERT(!is_empty(type) || type == imaginary_ellipsoid);
    if (type == imaginary_elliptic_cylinder || type == imaginary_parallel_planes) {
      RC_ASSERT(m.sign(Invariant::d4) == 0);
    }
    some = some || type == imaginary_ellipsoid;
  }
  RC_CLASSIFY(some, "has an empty member");
}

// Erratum 5.
TEST(PencilErrata, EqualAndConcentricPairsLeaveTheSeventeenTypesAtMinusOne) {
  const auto type_at_minus_one = [](const Ellipsoid& a, const Ellipsoid& b) {
    return root_at(pencil_members(a, b), -1).classification.type;
  };
  EXPECT_EQ(type_at_minus_one(sphere(0, 1), sphere(0, 1)), all_space);
  EXPECT_EQ(type_at_minus_one(sphere(0, 1), sphere(2, 1)), plane);
  const Quadric small({1, 1, 1, 0, 0, 0, 0, 0, 0, -1}), large({1, 1, 1, 0, 0, 0, 0, 0, 0, -4});
  EXPECT_EQ(root_at(pencil_members(small, large), -1).classification.type, no_points);
}

// Erratum 6.
TEST(PencilErrata, AnExactTouchCountsAsOverlapWhenPublished) {
  const Members touching = pencil_members(sphere(0, 1), sphere(2, 1));
  EXPECT_TRUE(published_scan_finds_overlap(touching));
  EXPECT_EQ(scan_solids(touching), PencilVerdict::touch);
  EXPECT_EQ(root_at(touching, 1).classification.type, imaginary_elliptic_cone);

  const Members apart = pencil_members(sphere(0, 1), sphere(std::nextafter(2, 3), 1));
  EXPECT_FALSE(published_scan_finds_overlap(apart));
  EXPECT_EQ(scan_solids(apart), PencilVerdict::separate);

  const Members meeting = pencil_members(sphere(0, 1), sphere(std::nextafter(2, 1), 1));
  EXPECT_TRUE(published_scan_finds_overlap(meeting));
  EXPECT_EQ(scan_solids(meeting), PencilVerdict::overlap);
}

/// Two solids of one shape and orientation, sizes r and s, whose distance in units of the shape is
/// sqrt(steps . steps): with |q|^2 as a factor of all lengths everything is an integer.
struct SimilarPair {
  Ellipsoid a, b;
  int distance2, r, s;
};

SimilarPair similar_pair() {
  const auto small = [] { return *rc::gen::inRange(-2, 3); };
  const int q[] = {*rc::gen::inRange(1, 3), small(), small(), small()};
  const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
  const double length2 = turn.squaredNorm();
  Vec3 shape;
  for (double& axis : shape) axis = *rc::gen::inRange(1, 4);
  const int r = *rc::gen::inRange(1, 6), s = *rc::gen::inRange(1, 6);
  const int reach = *rc::gen::element(r + s, r - s, *rc::gen::inRange(-9, 10));
  const int aside = *rc::gen::element(0, 1) * *rc::gen::inRange(-6, 7);
  const int steps[] = {aside, reach, 0};
  const Vec3 along = shape.cwiseProduct(Vec3(steps[0], steps[1], steps[2]));
  // |q|^2 R along, from |q|^2 R v = (w^2 - u.u) v + 2 (u.v) u + 2 w u x v.
  const Vec3 u = turn.vec();
  const double w = turn.w();
  const Vec3 offset =
      (w * w - u.squaredNorm()) * along + 2 * u.dot(along) * u + 2 * w * u.cross(along);
  const Vec3 centre(small(), small(), small());
  return {Ellipsoid(centre, r * length2 * shape, turn),
          Ellipsoid(centre + offset, s * length2 * shape, turn),
          steps[0] * steps[0] + steps[1] * steps[1] + steps[2] * steps[2], r, s};
}

RC_GTEST_PROP(PencilProperty, TheCorrectedScanIsRightForSolidsThePublishedOneForSurfaces, ()) {
  const SimilarPair p = similar_pair();
  const Members members = pencil_members(p.a, p.b);
  const int sum2 = (p.r + p.s) * (p.r + p.s), difference2 = (p.r - p.s) * (p.r - p.s);
  const PencilVerdict expected = p.distance2 > sum2    ? PencilVerdict::separate
                                 : p.distance2 == sum2 ? PencilVerdict::touch
                                                       : PencilVerdict::overlap;
  RC_ASSERT(scan_solids(members) == expected);
  const bool surfaces_meet = p.distance2 <= sum2 && p.distance2 >= difference2;
  RC_ASSERT(published_scan_finds_overlap(members) == surfaces_meet);
  RC_CLASSIFY(expected == PencilVerdict::touch, "touch");
  RC_CLASSIFY(p.distance2 < difference2, "nested");
  RC_CLASSIFY(p.distance2 == difference2, "internal touch or equal");
  RC_CLASSIFY(expected == PencilVerdict::separate, "separate");
}

// geometry/pencil.hpp (1)
RC_GTEST_PROP(PencilProperty, MembersAlternateAndAscendFromMinusToPlusInfinity, ()) {
  const Members members = pencil_members(integer_ellipsoid(), integer_ellipsoid());
  RC_ASSERT(members.front().low == -kInfinity);
  RC_ASSERT(members.back().high == kInfinity);
  RC_ASSERT(members.size() % 2 == 1);
  RC_ASSERT(members.size() <= 33u);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const PencilMember& m = members[i];
    RC_ASSERT(m.is_root == (i % 2 == 1));
    RC_ASSERT(m.low <= m.f);
    RC_ASSERT(m.f <= m.high);
    if (m.is_root) RC_ASSERT(std::nextafter(m.low, kInfinity) >= m.high);
    if (i > 0) RC_ASSERT(members[i - 1].f < m.f);
    const bool vanishes = std::find(m.signs.begin(), m.signs.end(), 0) != m.signs.end();
    RC_ASSERT(vanishes == m.is_root);
  }
}

RC_GTEST_PROP(PencilProperty, TheTypeAtADoubleIsThatOfTheCombinedForm, ()) {
  const auto& first = testing::kNormalForms[*rc::gen::inRange<std::size_t>(0, 20)];
  const auto& second = testing::kNormalForms[*rc::gen::inRange<std::size_t>(0, 20)];
  const Quadric a =
      testing::to_quadric(testing::pulled_back(first.quadric, *testing::integer_map()));
  const Quadric b =
      testing::to_quadric(testing::pulled_back(second.quadric, *testing::integer_map()));
  const auto form_a = exact::quadric_form(a.coefficients(), 0);
  const auto form_b = exact::quadric_form(b.coefficients(), 0);
  for (const PencilMember& m : pencil_members(a, b)) {
    if (m.is_root && m.low != m.high) continue;
    const mpq_class f = exact::to_rational(m.f);
    const Classification c =
        exact::classify_form(exact::combine(f.get_den(), form_a, f.get_num(), form_b));
    RC_ASSERT(to_string(c.type) == to_string(m.classification.type));
    RC_ASSERT(c.rank4 == m.classification.rank4);
    RC_ASSERT(c.rank3 == m.classification.rank3);
  }
}

Quadric any_normal_form() {
  const auto& form = testing::kNormalForms[*rc::gen::inRange<std::size_t>(0, 20)];
  return testing::to_quadric(testing::pulled_back(form.quadric, *testing::integer_map()));
}

// geometry/pencil.hpp (2)
RC_GTEST_PROP(PencilProperty, SignsGiveTheTypeByDescartesRule, ()) {
  const bool solids = *rc::gen::arbitrary<bool>();
  const Members members = solids ? pencil_members(integer_ellipsoid(), integer_ellipsoid())
                                 : pencil_members(any_normal_form(), any_normal_form());
  for (const PencilMember& m : members) {
    const auto inertia_of = [&](const std::vector<Invariant>& invariants) {
      std::vector<int> signs{1};
      for (const Invariant i : invariants) signs.push_back(m.sign(i));
      return exact::inertia_from_signs(signs);
    };
    const exact::Inertia form =
        inertia_of({Invariant::d1, Invariant::d2, Invariant::d3, Invariant::d4});
    const exact::Inertia sub_form = inertia_of({Invariant::t1, Invariant::t2, Invariant::t3});
    RC_ASSERT(m.classification.type == exact::type_of(form, sub_form));
    RC_ASSERT(m.classification.rank4 == form.rank());
    RC_ASSERT(m.classification.rank3 == sub_form.rank());
  }
}

// geometry/pencil.hpp (3)
RC_GTEST_PROP(PencilProperty, ExchangingThePairReversesThePositiveMembers, ()) {
  const Ellipsoid a = integer_ellipsoid(), b = integer_ellipsoid();
  const auto positive = [](const Members& members) {
    std::vector<std::pair<QuadricType, std::array<int, 7>>> seen;
    for (const PencilMember& m : members) {
      if (m.is_positive()) seen.emplace_back(m.classification.type, m.signs);
    }
    return seen;
  };
  auto forward = positive(pencil_members(a, b));
  std::reverse(forward.begin(), forward.end());
  RC_ASSERT(forward == positive(pencil_members(b, a)));
}

TEST(Pencil, ThePairOfEllipsoidsIsNormalisedToMinusOneAtTheCentres) {
  const Members solids = pencil_members(sphere(0, 1), sphere(3, 2));
  // |x|^2 - 1 and |x - c|^2 / 4 - 1, c = (3, 0, 0).
  const Members quadrics = pencil_members(Quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, -1}),
                                          Quadric({.25, .25, .25, 0, 0, 0, -.75, 0, 0, 1.25}));
  ASSERT_EQ(solids.size(), quadrics.size());
  for (std::size_t i = 0; i < solids.size(); ++i) {
    EXPECT_EQ(solids[i].low, quadrics[i].low);
    EXPECT_EQ(solids[i].high, quadrics[i].high);
    EXPECT_EQ(solids[i].signs, quadrics[i].signs);
  }
}

TEST(Pencil, APairOfEmptyQuadricsHasOneMemberEverywhere) {
  const Quadric zero({0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  const Members members = pencil_members(zero, zero);
  ASSERT_EQ(members.size(), 1u);
  EXPECT_EQ(members[0].classification.type, all_space);
  EXPECT_EQ(members[0].low, -kInfinity);
  EXPECT_EQ(members[0].high, kInfinity);
}

TEST(Pencil, ExtremeSizesAndShapesAreDecided) {
  const Ellipsoid huge({0, 0, 0}, {1e150, 1e142, 1e146}, Eigen::Quaterniond(1, 2, 3, 4));
  const Ellipsoid tiny({1e155, 0, 0}, {1e-150, 1e-145, 1e-142}, Eigen::Quaterniond(4, -1, 0.1, 2));
  EXPECT_EQ(scan_solids(pencil_members(huge, tiny)), PencilVerdict::separate);
  EXPECT_EQ(scan_solids(pencil_members(huge, tiny.moved_to({0, 0, 0}))), PencilVerdict::overlap);
  EXPECT_FALSE(published_scan_finds_overlap(pencil_members(huge, tiny.moved_to({0, 0, 0}))));
}

}  // namespace
}  // namespace tangency
