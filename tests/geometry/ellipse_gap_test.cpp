// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/plane/plane_gap.hpp>
#include <tangency/tests/support/ellipse_generators.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using testing::EllipsePair;

const Vec2 kOrigin = Vec2::Zero();

double size(const EllipsePair& p) {
  return (p.b.centre() - p.a.centre()).norm() + p.a.largest_semi_axis() + p.b.largest_semi_axis();
}

/// The value that the gap maximises.
double reach(const EllipsePair& p, const Vec2& n) {
  return n.dot(p.b.centre() - p.a.centre()) - p.a.support(n) - p.b.support(n);
}

TEST(PlaneGap, OfCirclesIsTheDistanceLessTheRadii) {
  const PlaneGap gap = signed_gap(Ellipse(kOrigin, {1, 1}), Ellipse({3, 4}, {2, 2}));
  EXPECT_DOUBLE_EQ(gap.gap, 2);
  EXPECT_NEAR(gap.normal[0], 0.6, 1e-15);
  EXPECT_NEAR((gap.arm_a - Vec2(0.6, 0.8)).norm(), 0, 1e-15);
  EXPECT_NEAR((gap.arm_b - Vec2(-1.2, -1.6)).norm(), 0, 1e-15);
  EXPECT_EQ(gap.status, GapStatus::ok);
  EXPECT_EQ(gap.tier, GapTier::fast);
}

TEST(PlaneGap, IsZeroAtATouchAndHasTheSignOfTheRelationNextToIt) {
  const Ellipse a(kOrigin, {2, 1}, {3, 4});
  const auto gap_at = [&](double x) { return signed_gap(a, Ellipse({x, 4}, {3, 1}, {3, 4})); };
  EXPECT_EQ(gap_at(3).gap, 0);
  EXPECT_EQ(gap_at(3).gap_error, 0);
  EXPECT_EQ(gap_at(3).tier, GapTier::exact);
  EXPECT_GT(gap_at(std::nextafter(3, 4)).gap, 0);
  EXPECT_LT(gap_at(std::nextafter(3, 2)).gap, 0);
}

TEST(PlaneGap, OfConcentricPairsIsTheShortestWayOutAlongTheFirstAxisThatTies) {
  const PlaneGap circles = signed_gap(Ellipse(kOrigin, {1, 1}, {0, 1}), Ellipse(kOrigin, {2, 2}));
  EXPECT_EQ(circles.gap, -3);
  EXPECT_EQ(circles.normal, Vec2(0, 1));
  const PlaneGap crossed = signed_gap(Ellipse(kOrigin, {2, 1}), Ellipse(kOrigin, {1, 2}));
  EXPECT_EQ(crossed.gap, -3);
  EXPECT_EQ(crossed.status, GapStatus::ok);
}

TEST(PlaneGap, IsProvenForThinDeepPairs) {
  const Ellipse needle(kOrigin, {1, 1e-8}, {1, 2});
  for (const double x : {0.0, 1e-9, 0.3, 0.9}) {
    const PlaneGap gap = signed_gap(needle, Ellipse({x, 0.1}, {1e-7, 2}, {3, 1}));
    EXPECT_EQ(gap.status, GapStatus::ok) << x;
    EXPECT_LE(gap.gap_error, 16 * 0x1p-53 * 4) << x;
  }
}

TEST(PlaneGap, OfASearchThatSpentItsBudgetIsNotGlobal) {
  const EllipsePair p{Ellipse(kOrigin, {1, 1e-8}, {1, 2}), Ellipse({0.3, 0.1}, {1e-7, 2}, {3, 1})};
  const detail::PlanePair pair({p.a, p.b});
  EXPECT_TRUE(detail::search_plane_gap(pair, Vec2(1, 0)).global);
  EXPECT_FALSE(detail::search_plane_gap(pair, Vec2(1, 0), 3).global);
}

TEST(PlaneGap, HoldsAtEveryScaleAndFarFromTheOrigin) {
  for (const double s : {0x1p-500, 0x1p-60, 0x1p60, 0x1p500}) {
    const PlaneGap gap = signed_gap(Ellipse({s, -s}, {2 * s, s}), Ellipse({4.5 * s, -s}, {s, s}));
    EXPECT_EQ(gap.gap, 0.5 * s);
    EXPECT_EQ(gap.status, GapStatus::ok);
    EXPECT_LE(gap.gap_error, 16 * 0x1p-53 * 6.5 * s);
    EXPECT_EQ(gap.normal, Vec2(1, 0));
    EXPECT_EQ(gap.arm_a, Vec2(2 * s, 0));
    EXPECT_EQ(gap.arm_b, Vec2(-s, 0));
  }
  const Vec2 far(0x1p40, -0x1p41);
  EXPECT_EQ(signed_gap(Ellipse(far, {2, 1}), Ellipse(far + Vec2(3.5, 0), {1, 1})).gap, 0.5);
}

TEST(PlaneGap, FollowingStaysOnItsBranch) {
  const Ellipse a(kOrigin, {3, 1}), b(kOrigin, {3, 1});
  const Vec2 d(0.2, 0.1);
  const PlaneGap down = follow_gap(a, b, d, Vec2(0.1, -1)), best = signed_gap(a, b, d);
  EXPECT_LT(down.gap, best.gap - 0.1);
  EXPECT_EQ(down.status, GapStatus::local);
  EXPECT_LT(down.normal[1], -0.9);
  EXPECT_GT(best.normal[1], 0.9);
}

RC_GTEST_PROP(PlaneGapProperty, NoNormalReachesFurther, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const PlaneGap gap = signed_gap(p.a, p.b);
  RC_ASSERT(gap.status == GapStatus::ok);
  const double rounding = 16 * 0x1p-53 * size(p);
  const Vec2 n = *testing::plane_direction();
  RC_ASSERT(reach(p, n) <= gap.gap + gap.gap_error + rounding);
  RC_ASSERT(std::abs(reach(p, gap.normal) - gap.gap) <= gap.gap_error + rounding);
}

/// How far the witness points where an ascent ends are from facing each other, over u L.
double unfacing(const EllipsePair& p, const Vec2& start) {
  const Vec2 d = p.b.centre() - p.a.centre();
  const detail::PlaneProof top = detail::climb_plane_gap(detail::PlanePair({p.a, p.b, &d}), start);
  return (d + top.arm_b - top.arm_a - top.gap * top.normal).norm() / (0x1p-53 * size(p));
}

RC_GTEST_PROP(PlaneGapProperty, AnAscentEndsWhereTheWitnessPointsFaceEachOther, ()) {
  const EllipsePair p = *testing::ellipse_pair(100);
  RC_ASSERT(unfacing(p, *testing::plane_direction()) <= 8);
}

// Slopes that a double holds are no zeros.
TEST(PlaneGap, AnAscentFromAnAxisPassesSlopesWithoutRounding) {
  for (int i = 1; i < 32; ++i) {
    for (int j = 1; j < 32; ++j) {
      const EllipsePair p{Ellipse(kOrigin, {2, 1}), Ellipse({i / 8.0, j / 8.0}, {1, 1})};
      EXPECT_LE(unfacing(p, Vec2(1, 0)), 8) << i << ' ' << j;
      EXPECT_LE(unfacing(p, Vec2(0, 1)), 8) << i << ' ' << j;
    }
  }
}

/// How far apart the normals of two answers may be that each are best but for `loss`: where the gap
/// exceeds -rho by `margin` the value falls off by at least margin / 2 times the squared angle.
double turn_for(double loss, double margin) {
  return margin > 0 ? 2 * std::sqrt(2 * loss / margin) + 16 * 0x1p-53
                    : std::numeric_limits<double>::infinity();
}

/// Answers about one pair, `there` brought back, whose values may differ by `loss`: the gap, and
/// where no tie is near the normal and the arms.
void assert_same(const EllipsePair& p, const PlaneGap& here, const PlaneGap& there, double loss) {
  constexpr double kComparable = 1e-3;  // rad; chosen
  RC_ASSERT(std::abs(here.gap - there.gap) <= loss);
  const double turn = turn_for(loss, here.gap + p.a.least_radius() + p.b.least_radius());
  RC_CLASSIFY(turn < kComparable, "normals compared");
  if (turn >= kComparable) return;
  RC_ASSERT((here.normal - there.normal).norm() <= turn);
  // A support point moves at most a_max^2 / a_min times as far as the normal turns.
  const auto moves = [&](const Ellipse& e) {
    return 2 * turn * e.largest_semi_axis() * (e.largest_semi_axis() / e.smallest_semi_axis());
  };
  RC_ASSERT((here.arm_a - there.arm_a).norm() <= loss + moves(p.a));
  RC_ASSERT((here.arm_b - there.arm_b).norm() <= loss + moves(p.b));
}

// geometry/ellipse_gap.hpp (1)
RC_GTEST_PROP(PlaneGapProperty, ExchangeReversesTheNormalAndExchangesThePoints, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const PlaneGap here = signed_gap(p.a, p.b);
  PlaneGap back = signed_gap(p.b, p.a);
  back.normal = -back.normal;
  std::swap(back.arm_a, back.arm_b);
  assert_same(p, here, back, here.gap_error + back.gap_error + 8 * 0x1p-53 * size(p));
}

// geometry/ellipse_gap.hpp (2)
RC_GTEST_PROP(PlaneGapProperty, GoesWithARotationAndATranslation, ()) {
  const EllipsePair p = *testing::ellipse_pair(1e6);
  const Vec2 turn = *testing::plane_direction(), shift(3, -7);
  const auto moved = [&](const Ellipse& e) {
    return Ellipse(turned(turn, e.centre()) + shift, e.semi_axes(), turned(turn, e.direction()));
  };
  const PlaneGap here = signed_gap(p.a, p.b);
  PlaneGap there = signed_gap(moved(p.a), moved(p.b));
  const Vec2 back(turn[0], -turn[1]);
  for (Vec2* v : {&there.normal, &there.arm_a, &there.arm_b}) *v = turned(back, *v);
  // The moved numbers are rounded: centres by a few u of 10, directions by 2 u.
  assert_same(p, here, there, here.gap_error + there.gap_error + 16 * 0x1p-53 * (10 + size(p)));
}

// geometry/ellipse_gap.hpp (3)
RC_GTEST_PROP(PlaneGapProperty, ScalesWithTheUnit, ()) {
  const EllipsePair p = *testing::ellipse_pair(1e6);
  const double s = *testing::log_uniform(1e-150, 1e150);
  const auto scaled = [&](const Ellipse& e) {
    return Ellipse(s * e.centre(), s * e.semi_axes(), e.direction());
  };
  const PlaneGap here = signed_gap(p.a, p.b);
  PlaneGap there = signed_gap(scaled(p.a), scaled(p.b));
  there.gap /= s;
  for (Vec2* v : {&there.arm_a, &there.arm_b}) *v /= s;
  const double centres = p.a.centre().norm() + p.b.centre().norm();
  assert_same(p, here, there,
              here.gap_error + there.gap_error / s + 8 * 0x1p-53 * (size(p) + centres));
}

// geometry/ellipse_gap.hpp (4)
RC_GTEST_PROP(PlaneGapProperty, MovingByTheDepthLeavesATouch, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const PlaneGap gap = signed_gap(p.a, p.b);
  const Ellipse moved = p.b.moved_to(p.b.centre() - gap.gap * gap.normal);
  const PlaneGap after = signed_gap(p.a, moved);
  RC_ASSERT(std::abs(after.gap) <= gap.gap_error + after.gap_error + 64 * 0x1p-53 * size(p));
}

// geometry/ellipse_gap.hpp (5)
RC_GTEST_PROP(PlaneGapProperty, ChangesNoFasterThanTheBodiesMove, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const Vec2 d = p.b.centre() - p.a.centre();
  const Vec2 e = *testing::log_uniform(1e-9, 1) * *testing::plane_direction();
  const PlaneGap before = signed_gap(p.a, p.b, d), after = signed_gap(p.a, p.b, Vec2(d + e));
  RC_ASSERT(std::abs(after.gap - before.gap) <=
            e.norm() + before.gap_error + after.gap_error + 8 * 0x1p-53 * size(p));
}

RC_GTEST_PROP(PlaneGapProperty, HasTheSignOfTheExactRelation, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const double gap = signed_gap(p.a, p.b).gap;
  const Relation r = relation(p.a, p.b).relation;
  RC_ASSERT((gap > 0) == (r == Relation::separate));
  RC_ASSERT((gap == 0) == (r == Relation::external_touch));
}

RC_GTEST_PROP(PlaneGapProperty, FollowingFindsTheGlobalAnswerNextToIt, ()) {
  const EllipsePair p = *testing::any_ellipse_pair();
  const Vec2 d = p.b.centre() - p.a.centre();
  const PlaneGap gap = signed_gap(p.a, p.b, d);
  const PlaneGap followed = follow_gap(p.a, p.b, d, gap.normal);
  RC_ASSERT(std::abs(followed.gap - gap.gap) <= followed.gap_error + gap.gap_error);
}

}  // namespace
}  // namespace tangency
