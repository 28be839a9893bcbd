// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cfenv>
#include <cmath>
#include <string>

#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/plane/ellipse_meeting.hpp>
#include <tangency/tests/support/ellipse_generators.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using testing::EllipsePair;

struct Expected {
  Relation relation;
  Inner inner;
  int crossings;  ///< -1: none is given
};

void expect(const Ellipse& a, const Ellipse& b, const Expected& expected) {
  const EllipseRelation found = relation(a, b);
  EXPECT_EQ(to_string(found.relation), to_string(expected.relation));
  EXPECT_EQ(found.inner, expected.inner);
  EXPECT_EQ(found.crossings.value_or(-1), expected.crossings);
}

const Vec2 kOrigin = Vec2::Zero();
const Ellipse kWide(kOrigin, {2, 1});

TEST(EllipseRelation, TellsApartAndNested) {
  expect(kWide, Ellipse({3.5, 0}, {1, 1}), {Relation::separate, Inner::none, 0});
  expect(kWide, Ellipse({0.25, 0}, {0.5, 0.5}), {Relation::b_in_a, Inner::none, 0});
  expect(kWide, Ellipse({0.25, 0}, {3, 2}), {Relation::a_in_b, Inner::none, 0});
}

TEST(EllipseRelation, CountsSimpleCrossings) {
  expect(kWide, Ellipse({2, 0}, {1, 1}), {Relation::overlap, Inner::none, 2});
  expect(kWide, Ellipse(kOrigin, {2, 1}, {0, 1}), {Relation::overlap, Inner::none, 4});
}

TEST(EllipseRelation, CountsATouchOnceWhateverItsOrder) {
  expect(kWide, Ellipse({3, 0}, {1, 1}), {Relation::external_touch, Inner::none, 1});
  // Vertex to vertex inside: double; where the curvatures agree, fourfold.
  expect(kWide, Ellipse({1.75, 0}, {0.25, 0.25}), {Relation::internal_touch, Inner::b, 1});
  expect(kWide, Ellipse({1.5, 0}, {0.5, 0.5}), {Relation::internal_touch, Inner::b, 1});
  expect(Ellipse({1.5, 0}, {0.5, 0.5}), kWide, {Relation::internal_touch, Inner::a, 1});
}

TEST(EllipseRelation, CountsATouchBesideTwoCrossings) {
  expect(kWide, Ellipse({1, 0}, {1, 2}), {Relation::overlap, Inner::none, 3});
  expect(kWide, Ellipse({0, 0.5}, {1.5, 1.5}), {Relation::overlap, Inner::none, 3});
}

TEST(EllipseRelation, CountsTwoTouches) {
  expect(kWide, Ellipse(kOrigin, {1, 1}), {Relation::internal_touch, Inner::b, 2});
  expect(Ellipse(kOrigin, {1, 1}), kWide, {Relation::internal_touch, Inner::a, 2});
}

// The circle of curvature where (cos, sin) = (3, 4) / 5.
TEST(EllipseRelation, CountsAnOsculationAsACrossing) {
  expect(Ellipse(kOrigin, {45, 80}), Ellipse({-21, 28}, {60, 60}),
         {Relation::overlap, Inner::none, 2});
}

TEST(EllipseRelation, EqualEllipsesHaveNoCount) {
  expect(kWide, Ellipse(kOrigin, {1, 2}, {0, -3}), {Relation::equal, Inner::none, -1});
  expect(Ellipse({1, 1}, {2, 2}, {1, 0}), Ellipse({1, 1}, {2, 2}, {1, 3}),
         {Relation::equal, Inner::none, -1});
}

TEST(EllipseRelation, KnowsTheNextDoubleFromATouch) {
  const Ellipse unit(kOrigin, {1, 1}, {3, 4});
  EXPECT_EQ(relation(unit, Ellipse({std::nextafter(2, 3), 0}, {1, 1})).relation,
            Relation::separate);
  EXPECT_EQ(relation(unit, Ellipse({2, 0}, {1, 1})).relation, Relation::external_touch);
  EXPECT_EQ(relation(unit, Ellipse({std::nextafter(2, 1), 0}, {1, 1})).relation, Relation::overlap);
}

TEST(EllipseRelation, TellsWhichTierKnew) {
  EXPECT_EQ(relation(kWide, Ellipse({2, 0}, {1, 1})).tier, Tier::filter);
  EXPECT_EQ(relation(kWide, Ellipse({3, 0}, {1, 1})).tier, Tier::exact);
}

TEST(EllipseRelation, HoldsAtEveryScale) {
  for (const double s : {1e-300, 1e-150, 1e150, 1e300}) {
    const Ellipse a(kOrigin, {2 * s, s}), b({3 * s, 0}, {s, s});
    // 3 s and 2 s are rounded: either side, but never a guess that exchange would change.
    EXPECT_EQ(to_string(relation(a, b).relation), to_string(relation(b, a).relation)) << s;
  }
  const double s = 0x1p-1070;
  expect(Ellipse(kOrigin, {2 * s, s}), Ellipse({3 * s, 0}, {s, s}),
         {Relation::external_touch, Inner::none, 1});
}

TEST(EllipseRelation, FilterAnswersInOtherRoundingModesToo) {
  const Ellipse other({2, 0}, {1, 1});
  std::fesetround(FE_UPWARD);
  const EllipseRelation found = relation(kWide, other);
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(found.tier, Tier::filter);
  EXPECT_EQ(found.crossings, 2);
}

EllipseRelation exchanged(EllipseRelation r) {
  if (r.relation == Relation::a_in_b) {
    r.relation = Relation::b_in_a;
  } else if (r.relation == Relation::b_in_a) {
    r.relation = Relation::a_in_b;
  }
  if (r.inner != Inner::none) r.inner = r.inner == Inner::a ? Inner::b : Inner::a;
  return r;
}

bool same(const EllipseRelation& x, const EllipseRelation& y) {
  return x.relation == y.relation && x.inner == y.inner && x.crossings == y.crossings;
}

// geometry/ellipse_relation.hpp (1)
RC_GTEST_PROP(EllipseRelationProperty, ExchangingTheBodiesExchangesTheAnswer, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  RC_ASSERT(same(relation(p.b, p.a), exchanged(relation(p.a, p.b))));
}

/// B, moved so that pairs are known to overlap or not by how they were made.
struct Placed {
  Ellipse a, b;
  Vec2 n, m;  ///< unit

  Placed()
      : a(*testing::ellipse(1000)),
        b(*testing::ellipse(1000)),
        n(*testing::plane_direction()),
        m(*testing::plane_direction()) {}
  Vec2 to_edge_of_a() const { return a.support_point(n); }
};

constexpr double kRounded = 1e-9;  // chosen: far above what support points lose at this aspect

// geometry/ellipse_relation.hpp (2)
RC_GTEST_PROP(EllipseRelationProperty, OverlapsWhereAPointLiesInsideBoth, ()) {
  const Placed p;
  const double in_a = *testing::uniform(0, 1 - kRounded), in_b = *testing::uniform(0, 1 - kRounded);
  const Vec2 inside = p.a.centre() + in_a * p.to_edge_of_a();
  const Ellipse b = p.b.moved_to(inside + in_b * p.b.support_point(p.m));
  RC_ASSERT(overlaps(p.a, b));
  RC_ASSERT(overlaps(b, p.a));
  const Relation found = relation(p.a, b).relation;
  RC_ASSERT(found != Relation::separate && found != Relation::external_touch);
}

// geometry/ellipse_relation.hpp (2)
RC_GTEST_PROP(EllipseRelationProperty, DoesNotOverlapWhereALineSeparates, ()) {
  const Placed p;
  // Anywhere along the line, which is across n.
  const Vec2 along = *testing::uniform(-3, 3) * Vec2(-p.n[1], p.n[0]);
  const double apart = 1 + *testing::log_uniform(kRounded, 2);
  const Ellipse b =
      p.b.moved_to(p.a.centre() + apart * (p.to_edge_of_a() + p.b.support_point(p.n)) + along);
  RC_ASSERT(!overlaps(p.a, b));
  RC_ASSERT(!overlaps(b, p.a));
  RC_ASSERT(relation(p.a, b).relation == Relation::separate);
}

// Circles at the whole distance 5 k of a 3-4-5 triangle, scaled along both axes: they overlap where
// the radii add up to more.
// geometry/ellipse_relation.hpp (2)
TEST(EllipseRelation, OverlapsBeyondAnExactTouchAndNotAtIt) {
  for (const Vec2& scale : {Vec2(1, 1), Vec2(3, 1), Vec2(0x1p-30, 7)}) {
    for (int k = 1; k <= 6; ++k) {
      for (int radius = 1; radius < 5 * k - 1; ++radius) {
        for (const int more : {-1, 0, 1}) {
          const Ellipse a(kOrigin, radius * scale);
          const Ellipse b(k * Vec2(3, 4).cwiseProduct(scale), (5 * k - radius + more) * scale);
          EXPECT_EQ(overlaps(a, b), more > 0) << k << ' ' << radius << ' ' << more;
          EXPECT_EQ(overlaps(b, a), more > 0) << k << ' ' << radius << ' ' << more;
          EXPECT_EQ(relation(a, b).relation == Relation::external_touch, more == 0);
        }
      }
    }
  }
}

// geometry/ellipse_relation.hpp (3)
RC_GTEST_PROP(EllipseRelationProperty, ScalingBothByAPowerOfTwoLeavesIt, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const double s = std::ldexp(1.0, *rc::gen::inRange(-900, 900));
  const auto scaled = [&](const Ellipse& e) {
    return Ellipse(s * e.centre(), s * e.semi_axes(), e.direction());
  };
  RC_ASSERT(same(relation(scaled(p.a), scaled(p.b)), relation(p.a, p.b)));
}

// geometry/ellipse_relation.hpp (3)
RC_GTEST_PROP(EllipseRelationProperty, ReflectingAndExchangingCoordinatesLeavesIt, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const auto moved = [](const Ellipse& e) {
    const Vec2 &c = e.centre(), &u = e.direction();
    return Ellipse({c[1], -c[0]}, e.semi_axes(), {-2 * u[1], 2 * u[0]});
  };
  RC_ASSERT(same(relation(moved(p.a), moved(p.b)), relation(p.a, p.b)));
}

// geometry/ellipse_relation.hpp (3)
RC_GTEST_PROP(EllipseRelationProperty, TurnsAndLengthsThatLeaveTheSolidsLeaveIt, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const double length = std::ldexp(1.0, *rc::gen::inRange(-900, 900));
  const Vec2 &r = p.b.semi_axes(), &u = p.b.direction();
  const Ellipse half(p.b.centre(), r, -length * u);
  const Ellipse quarter(p.b.centre(), {r[1], r[0]}, length * Vec2(-u[1], u[0]));
  RC_ASSERT(same(relation(p.a, half), relation(p.a, p.b)));
  RC_ASSERT(same(relation(p.a, quarter), relation(p.a, p.b)));
}

// geometry/ellipse_relation.hpp (4)
RC_GTEST_PROP(EllipseRelationProperty, CountsFitTheRelation, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const EllipseRelation r = relation(p.a, p.b);
  const int n = r.crossings.value_or(-1);
  switch (r.relation) {
    case Relation::separate:
    case Relation::a_in_b:
    case Relation::b_in_a:
      RC_ASSERT(n == 0);
      break;
    case Relation::external_touch:
      RC_ASSERT(n == 1);
      break;
    case Relation::internal_touch:
      RC_ASSERT(n == 1 || n == 2);
      break;
    case Relation::overlap:
      RC_ASSERT(n >= 2 && n <= 4);
      break;
    case Relation::equal:
      RC_ASSERT(n == -1);
  }
  RC_TAG(std::string(to_string(r.relation)));
}

RC_GTEST_PROP(EllipseRelationProperty, FilterNeverContradictsIntegers, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const auto filtered = detail::filter_meeting(p.a, p.b);
  if (!filtered) return;
  const exact::ConicAnswer exactly = exact::conic_relation(p.a, p.b);
  RC_ASSERT(filtered->relation == exactly.relation && filtered->meeting == exactly.meeting);
}

}  // namespace
}  // namespace tangency
