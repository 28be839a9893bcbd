// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/plane/lens.hpp>
#include <tangency/tests/support/ellipse_generators.hpp>

namespace tangency {
namespace {

using testing::EllipsePair;

const Vec2 kOrigin = Vec2::Zero();
const Ellipse kWide(kOrigin, {2, 1});

void expect_point(const Crossing& found, const Vec2& place, int multiplicity) {
  EXPECT_NEAR((found.arm_a - place).norm(), 0, 1e-15);
  EXPECT_EQ(found.multiplicity, multiplicity);
}

TEST(Crossings, OfCrossedEllipsesAreFour) {
  const Crossings found = crossings(kWide, Ellipse(kOrigin, {2, 1}, {0, 1}));
  ASSERT_EQ(found.count, 4);
  const double s = 2 / std::sqrt(5);
  expect_point(found.at[0], {-s, -s}, 1);
  expect_point(found.at[1], {-s, s}, 1);
  expect_point(found.at[2], {s, -s}, 1);
  expect_point(found.at[3], {s, s}, 1);
}

TEST(Crossings, KnowTheirMultiplicity) {
  const Crossings beside = crossings(kWide, Ellipse({1, 0}, {1, 2}));
  ASSERT_EQ(beside.count, 3);
  expect_point(beside.at[2], {2, 0}, 2);
  const Crossings twice = crossings(kWide, Ellipse(kOrigin, {1, 1}));
  ASSERT_EQ(twice.count, 2);
  expect_point(twice.at[0], {0, -1}, 2);
  expect_point(twice.at[1], {0, 1}, 2);
  const Crossings fourfold = crossings(kWide, Ellipse({1.5, 0}, {0.5, 0.5}));
  ASSERT_EQ(fourfold.count, 1);
  expect_point(fourfold.at[0], {2, 0}, 4);
  const Crossings osculating = crossings(Ellipse(kOrigin, {45, 80}), Ellipse({-21, 28}, {60, 60}));
  ASSERT_EQ(osculating.count, 2);
  const bool first = osculating.at[0].multiplicity == 3;
  EXPECT_NEAR((osculating.at[first ? 0 : 1].arm_a - Vec2(27, 64)).norm(), 0, 1e-13);
  EXPECT_EQ(osculating.at[first ? 1 : 0].multiplicity, 1);
}

TEST(Crossings, ThatAreNoneHaveNoMultiplicity) {
  for (const Vec2& centre : {Vec2(9, 0), Vec2(3, 0), Vec2(2.5, 0)}) {
    const Crossings found = crossings(kWide, Ellipse(centre, {1, 1}));
    for (int i = found.count; i < 4; ++i) {
      EXPECT_EQ(found.at[static_cast<std::size_t>(i)].multiplicity, 0) << centre.x();
    }
  }
}

TEST(Crossings, OfEqualEllipsesAreNotPoints) {
  const Crossings found = crossings(kWide, Ellipse(kOrigin, {1, 2}, {0, 1}));
  EXPECT_TRUE(found.equal);
  EXPECT_EQ(found.count, 0);
}

TEST(CommonArea, IsThatOfTheLensOfTwoCircles) {
  const double lens = 2 * M_PI / 3 - std::sqrt(3) / 2;
  EXPECT_NEAR(common_area(Ellipse(kOrigin, {1, 1}), Ellipse({1, 0}, {1, 1})), lens, 1e-15);
}

// pi a b - 4 (the corners cut off): for semi-axes a > b crossed at right angles it is
// 4 a b atan(b / a).
TEST(CommonArea, IsThatOfCrossedEllipses) {
  for (const double a : {1.001, 2.0, 1e3, 1e6}) {
    const double area = common_area(Ellipse(kOrigin, {a, 1}), Ellipse(kOrigin, {a, 1}, {0, 1}));
    const double expected = 4 * a * std::atan(1 / a);
    EXPECT_NEAR(area, expected, 1e-13 * expected) << a;
  }
}

TEST(CommonArea, IsTheInnerOneOfANestedPairAndNothingOfOneApart) {
  EXPECT_EQ(common_area(kWide, Ellipse({0.25, 0}, {0.5, 0.25})), M_PI / 8);
  EXPECT_EQ(common_area(kWide, Ellipse({1.75, 0}, {0.25, 0.25})), M_PI / 16);
  EXPECT_EQ(common_area(kWide, kWide), 2 * M_PI);
  EXPECT_EQ(common_area(kWide, Ellipse({3, 0}, {1, 1})), 0);
  EXPECT_EQ(common_area(kWide, Ellipse({5, 0}, {1, 1})), 0);
}

// Two circles of radius 1 overlapping by t: 4/3 t^(3/2) (1 - 3 t / 40 + ...).
TEST(CommonArea, OfThinLensesKeepsItsDigits) {
  for (const double t : {0x1p-20, 0x1p-30, 0x1p-40, 0x1p-50}) {
    const double area = common_area(Ellipse(kOrigin, {1, 1}), Ellipse({2 - t, 0}, {1, 1}));
    const double half = t / 2;  // each segment's height
    const double segment = 4.0 / 3 * half * std::sqrt(2 * half) * (1 - 3 * half / 20);
    EXPECT_NEAR(area / (2 * segment), 1, 1e-13 + t * t) << t;
  }
}

TEST(CommonArea, ScalesByPowersOfTwo) {
  const Ellipse b({1, 0.5}, {1, 1.5}, {1, 3});
  const double area = common_area(kWide, b);
  for (const double s : {0x1p-500, 0x1p500}) {
    const auto scaled = [&](const Ellipse& e) {
      return Ellipse(s * e.centre(), s * e.semi_axes(), e.direction());
    };
    EXPECT_EQ(common_area(scaled(kWide), scaled(b)), area * s * s);
  }
}

TEST(ChordContact, OfTwoCirclesIsAlongTheCentres) {
  const ChordContact chord = chord_contact(Ellipse(kOrigin, {1, 1}), Ellipse({1.5, 0}, {1, 1}));
  ASSERT_EQ(chord.status, ChordStatus::ok);
  EXPECT_NEAR(chord.depth, 0.5, 1e-15);
  EXPECT_NEAR((chord.normal - Vec2(1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((chord.arm_a - Vec2(1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((chord.arm_b - Vec2(-1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((chord.point - Vec2(0.75, 0)).norm(), 0, 1e-15);
}

TEST(ChordContact, NeedsExactlyTwoCrossings) {
  for (const Ellipse& b :
       {Ellipse({5, 0}, {1, 1}), Ellipse({3, 0}, {1, 1}), Ellipse({1, 0}, {1, 2}),
        Ellipse(kOrigin, {2, 1}, {0, 1}), Ellipse(kOrigin, {1, 1}), Ellipse(kOrigin, {2, 1})}) {
    EXPECT_EQ(chord_contact(kWide, b).status, ChordStatus::not_applicable);
  }
}

// (x + 3) (x + 3 + e) (x + 1) (x - 2): told to have two simple roots only, rounding made the pair.
TEST(RealQuartic, OfMoreChangesOfSignThanRootsLosesTheClosestPair) {
  const double e = 0x1p-30;
  const std::array<detail::DoubleDouble, 5> c{-18 - 6 * e, -21 - 5 * e, 1 + 2 * e, 5 + e, 1.0};
  const auto expect_roots = [&](exact::Meeting meeting, const std::vector<double>& expected) {
    const detail::MultipleRoots roots = detail::real_quartic_roots(c, meeting);
    ASSERT_EQ(roots.count, static_cast<int>(expected.size()));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(roots.root[i].at.high, expected[i], 1e-15) << i;
      EXPECT_EQ(roots.root[i].multiplicity, 1);
    }
  };
  expect_roots(exact::Meeting::four_simple, {-3 - e, -3, -1, 2});
  expect_roots(exact::Meeting::two_simple, {-1, 2});
}

// geometry/ellipse_crossings.hpp (2)
RC_GTEST_PROP(CrossingsProperty, LieOnBothBoundariesAsManyAsTheRelationCounts, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const Crossings found = crossings(p.a, p.b);
  RC_ASSERT(found.count == relation(p.a, p.b).crossings.value_or(0));
  int multiplicities = 0;
  for (int i = 0; i < found.count; ++i) {
    const Crossing& c = found.at[static_cast<std::size_t>(i)];
    multiplicities += c.multiplicity;
    // The level of a rounded point errs by u a / (smallest semi-axis), and the centre's addition.
    const auto off = [](const Ellipse& e, const Vec2& arm) {
      return std::abs(e.moved_to(kOrigin).level(arm) - 1) * e.smallest_semi_axis() /
             e.largest_semi_axis();
    };
    RC_ASSERT(off(p.a, c.arm_a) <= 1e-14 && off(p.b, c.arm_b) <= 1e-14);
  }
  RC_ASSERT(multiplicities <= 4);
}

// geometry/ellipse_crossings.hpp (1)
RC_GTEST_PROP(CrossingsProperty, ExchangingTheBodiesChangesNothingButTheArms, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const Crossings c = crossings(p.a, p.b), d = crossings(p.b, p.a);
  RC_ASSERT(c.count == d.count && c.equal == d.equal);
  for (const Crossing& x : c.at) {
    RC_ASSERT(std::ranges::any_of(d.at, [&](const Crossing& y) {
      return y.arm_a == x.arm_b && y.arm_b == x.arm_a && y.multiplicity == x.multiplicity;
    }));
  }
  RC_ASSERT(common_area(p.a, p.b) == common_area(p.b, p.a));
  const ChordContact chord = chord_contact(p.a, p.b), back = chord_contact(p.b, p.a);
  RC_ASSERT(chord.status == back.status && chord.depth == back.depth);
  RC_ASSERT(chord.normal == -back.normal);
  RC_ASSERT(chord.arm_a == back.arm_b && chord.arm_b == back.arm_a);
}

// geometry/ellipse_crossings.hpp (3)
RC_GTEST_PROP(CrossingsProperty, AreaIsBetweenNothingAndTheSmallerOneWhichItIsOfANestedPair, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const double area = common_area(p.a, p.b), smaller = std::min(p.a.area(), p.b.area());
  const Relation known = relation(p.a, p.b).relation;
  RC_ASSERT(area >= 0 && area <= smaller);
  RC_ASSERT((area > 0) == overlaps(p.a, p.b));
  const bool nested = known == Relation::a_in_b || known == Relation::b_in_a ||
                      known == Relation::internal_touch || known == Relation::equal;
  if (nested) RC_ASSERT(area == smaller);
  RC_CLASSIFY(nested, "nested");
}

RC_GTEST_PROP(CrossingsProperty, AreaGoesWithARotationAndATranslation, ()) {
  const EllipsePair p = *testing::ellipse_pair(5);
  const double gap = signed_gap(p.a, p.b).gap;
  RC_PRE(gap < -1e-3);
  const Vec2 turn = *testing::plane_direction(), shift(3, -7);
  const auto moved = [&](const Ellipse& e) {
    return Ellipse(turned(turn, e.centre()) + shift, e.semi_axes(), turned(turn, e.direction()));
  };
  const double area = common_area(p.a, p.b);
  RC_ASSERT(std::abs(common_area(moved(p.a), moved(p.b)) - area) <= 1e-11 * area);
}

// geometry/ellipse_crossings.hpp (4)
RC_GTEST_PROP(ChordContactProperty, ItsLineLeavesBothBodiesAtTheArms, ()) {
  const EllipsePair p = *testing::ellipse_pair(100);
  const ChordContact chord = chord_contact(p.a, p.b);
  if (chord.status != ChordStatus::ok) return;
  RC_ASSERT(chord.depth > 0);
  RC_ASSERT(std::abs(p.a.moved_to(kOrigin).level(chord.arm_a) - 1) <= 1e-11);
  RC_ASSERT(std::abs(p.b.moved_to(kOrigin).level(chord.arm_b) - 1) <= 1e-11);
  const Vec2 d = p.b.centre() - p.a.centre();
  const Vec2 across = chord.arm_a - (d + chord.arm_b);
  const double rounding = 1e-14 * (d.norm() + p.a.largest_semi_axis());
  RC_ASSERT((across - chord.depth * chord.normal).norm() <= rounding);
}

}  // namespace
}  // namespace tangency
