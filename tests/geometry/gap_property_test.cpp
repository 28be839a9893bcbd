// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/normals/factored.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using testing::Pair;

constexpr double kU = kUnitRoundoff;

/// A bound on the error of a reported gap: kOrdinaryGapErrorBound, and the doubles of moved and
/// turned bodies are off by as much again.
double rounding(const Pair& p) {
  const double size = (p.b.centre() - p.a.centre()).norm() + p.a.largest_semi_axis() +
                      p.b.largest_semi_axis() + p.a.centre().norm() + p.b.centre().norm();
  return 32 * kU * size;
}

/// Least and largest radius of curvature of a body's surface.
double least_radius(const Ellipsoid& e) {
  return e.smallest_semi_axis() * (e.smallest_semi_axis() / e.largest_semi_axis());
}
double largest_radius(const Ellipsoid& e) {
  return e.largest_semi_axis() * (e.largest_semi_axis() / e.smallest_semi_axis());
}

/// rad; chosen: normals that rounding may turn by more are too close to a tie to be compared.
constexpr double kComparable = 1e-3;

RC_GTEST_PROP(GapProperty, ConvergesForEveryPairAndPointsAreOnTheCommonNormal, ()) {
  const Pair p = *testing::pair(100);
  const Gap g = signed_gap(p.a, p.b);
  RC_ASSERT(std::isfinite(g.gap_error));
  // Deeper than a ball of both least radii the search over all normals may leave doubt.
  RC_ASSERT(g.status == GapStatus::ok || g.gap < 0.99 * -(least_radius(p.a) + least_radius(p.b)));
  RC_ASSERT(std::abs(g.normal.norm() - 1) <= 4 * kU);
  const Vec3 d = p.b.centre() - p.a.centre();
  // p_B - p_A = g n: the part along n is the gap itself; the part across is the slope, at most
  // sqrt(2 curvature loss), where the loss is rounding and the curvature that of A + (-B).
  const Vec3 between = d + g.arm_b - g.arm_a;
  RC_ASSERT(std::abs(between.dot(g.normal) - g.gap) <= rounding(p));
  const double curvature = largest_radius(p.a) + largest_radius(p.b) + std::abs(g.gap);
  RC_ASSERT((between - g.gap * g.normal).norm() <= std::sqrt(2 * curvature * rounding(p)));
  RC_ASSERT(std::abs(g.normal.dot(g.arm_a) - p.a.support(g.normal)) <= rounding(p));
  RC_ASSERT(std::abs(g.normal.dot(g.arm_b) + p.b.support(g.normal)) <= rounding(p));
}

/// How far two normals may lie apart that are both stationary up to rounding: where the gap exceeds
/// -rho by `margin` the value falls off by at least margin / 2 times the squared angle.
double normal_tolerance(const Pair& p, double margin) {
  return std::sqrt(4 * rounding(p) / margin) + 16 * kU;
}

// geometry/gap.hpp (1)
RC_GTEST_PROP(GapProperty, ExchangeReversesTheNormalAndExchangesThePoints, ()) {
  const Pair p = *testing::pair(100);
  const Gap ab = signed_gap(p.a, p.b), ba = signed_gap(p.b, p.a);
  if (ab.status == GapStatus::ok) {
    RC_ASSERT(ba.status == GapStatus::ok);
    RC_ASSERT(std::abs(ab.gap - ba.gap) <= rounding(p));
    const double margin = ab.gap + least_radius(p.a) + least_radius(p.b);
    const double turn = normal_tolerance(p, margin);
    if (turn < kComparable) {
      RC_ASSERT((ab.normal + ba.normal).norm() <= turn);
      // A support point moves at most a_max^2 / a_min times as far as the normal turns.
      RC_ASSERT((ab.arm_a - ba.arm_b).norm() <= 2 * turn * largest_radius(p.a) + rounding(p));
      RC_ASSERT((ab.arm_b - ba.arm_a).norm() <= 2 * turn * largest_radius(p.b) + rounding(p));
      RC_TAG("normal compared");
    }
  }
  RC_CLASSIFY(ab.status == GapStatus::ok, "ok");
}

// geometry/gap.hpp (4)
RC_GTEST_PROP(GapProperty, MovingBByTheReportedDepthLeavesAJustTouchingPair, ()) {
  const Pair p = *testing::pair_at(100, testing::uniform(0, 1));
  const Gap before = signed_gap(p.a, p.b);
  RC_PRE(before.gap < 0);
  const Ellipsoid moved = p.b.moved_to(p.b.centre() - before.gap * before.normal);
  const Gap after = signed_gap(p.a, moved);
  RC_ASSERT(after.status == GapStatus::ok);
  RC_ASSERT(std::abs(after.gap) <= rounding(p) + rounding({p.a, moved}));
}

RC_GTEST_PROP(GapProperty, NoAscentReachesFurtherThanAnOkAnswer, ()) {
  const Pair p = *testing::pair(100);
  const Gap g = signed_gap(p.a, p.b);
  RC_PRE(g.status == GapStatus::ok);
  const Vec3 d = p.b.centre() - p.a.centre();
  const detail::FactoredPair climber(p.a, p.b, d);
  for (int i = 0; i < 16; ++i) {
    const Vec3 n = climber.climb(*testing::direction()).normal;
    RC_ASSERT(climber.value(n) <= g.gap + rounding(p));
  }
}

// geometry/gap.hpp (2)
RC_GTEST_PROP(GapProperty, TurningAndMovingBothBodiesLeavesTheGap, ()) {
  const Pair p = *testing::pair(20);
  const Eigen::Quaterniond turn = (*testing::orientation()).normalized();
  const Vec3 shift = 10 * *testing::direction();
  const auto moved = [&](const Ellipsoid& e) {
    return Ellipsoid(shift + turn * e.centre(), e.semi_axes(), turn * e.orientation());
  };
  const Pair q{moved(p.a), moved(p.b)};
  const Gap before = signed_gap(p.a, p.b), after = signed_gap(q.a, q.b);
  RC_PRE(before.status == GapStatus::ok && after.status == GapStatus::ok);
  RC_ASSERT(std::abs(before.gap - after.gap) <= rounding(p) + rounding(q));
  const double margin = before.gap + least_radius(p.a) + least_radius(p.b);
  const double tolerance = normal_tolerance(p, margin) + normal_tolerance(q, margin);
  if (tolerance < kComparable) RC_ASSERT((turn * before.normal - after.normal).norm() <= tolerance);
}

// geometry/gap.hpp (3)
RC_GTEST_PROP(GapProperty, ScalingBothBodiesScalesGapAndPointsAndLeavesTheNormal, ()) {
  const Pair p = *testing::pair(100);
  const double s = *testing::log_uniform(1e-150, 1e150);
  const auto scaled = [&](const Ellipsoid& e) {
    return Ellipsoid(s * e.centre(), s * e.semi_axes(), e.orientation());
  };
  const Gap before = signed_gap(p.a, p.b), after = signed_gap(scaled(p.a), scaled(p.b));
  RC_PRE(before.status == GapStatus::ok && after.status == GapStatus::ok);
  RC_ASSERT(std::abs(after.gap / s - before.gap) <= 2 * rounding(p));
  const double margin = before.gap + least_radius(p.a) + least_radius(p.b);
  const double turn = 2 * normal_tolerance(p, margin);
  RC_CLASSIFY(turn < kComparable, "normal compared");
  if (!(turn < kComparable)) return;
  RC_ASSERT((after.normal - before.normal).norm() <= turn);
  RC_ASSERT((after.arm_a / s - before.arm_a).norm() <=
            2 * turn * largest_radius(p.a) + rounding(p));
  RC_ASSERT((after.arm_b / s - before.arm_b).norm() <=
            2 * turn * largest_radius(p.b) + rounding(p));
}

// geometry/gap.hpp (5)
RC_GTEST_PROP(GapProperty, ChangesNoFasterThanTheBodiesMove, ()) {
  const Pair p = *testing::pair(1000);
  const Vec3 d = p.b.centre() - p.a.centre();
  const double size = d.norm() + p.a.largest_semi_axis() + p.b.largest_semi_axis();
  const Vec3 to = d + *testing::log_uniform(1e-15, 10) * size * *testing::direction();
  const Gap before = signed_gap(p.a, p.b, d), after = signed_gap(p.a, p.b, to);
  RC_PRE(before.status == GapStatus::ok && after.status == GapStatus::ok);
  const double moved = (to - d).norm() * (1 + 8 * kU);
  RC_ASSERT(std::abs(after.gap - before.gap) <= moved + before.gap_error + after.gap_error);
}

/// Aspect and size ratios to 1e8, nearer than which the pairs above are.
Pair extreme_pair() {
  const auto body = testing::ellipsoid(1e8, 1e8);
  const Ellipsoid a = *body, b = *body;
  const double fraction = *rc::gen::oneOf(testing::uniform(0, 3), testing::uniform(0.999, 1.001));
  const Vec3 n = *testing::direction();
  return {a, b.moved_to(a.centre() + fraction * (a.support_point(n) + b.support_point(n)))};
}

// geometry/gap.hpp (1) (3) (4)
RC_GTEST_PROP(GapProperty, OfExtremeShapesIsTheSameExchangedAndScaledAndLeavesATouch, ()) {
  const Pair p = extreme_pair();
  const int power = *rc::gen::inRange(-300, 301);
  const auto scaled = [&](const Ellipsoid& e) {
    return Ellipsoid(std::exp2(power) * e.centre(), std::exp2(power) * e.semi_axes(),
                     e.orientation());
  };
  const Gap gap = signed_gap(p.a, p.b), back = signed_gap(p.b, p.a);
  RC_CLASSIFY(gap.status == GapStatus::ok, "ok");
  if (gap.status != GapStatus::ok) return;
  if (back.status == GapStatus::ok) {
    RC_ASSERT(std::abs(back.gap - gap.gap) <= gap.gap_error + back.gap_error);
  } else {  // the search may prove in one order what it leaves open in the other
    RC_ASSERT(gap.gap < 0.99 * -(least_radius(p.a) + least_radius(p.b)));
    RC_ASSERT(back.gap - back.gap_error <= gap.gap + gap.gap_error);
  }
  const Gap there = signed_gap(scaled(p.a), scaled(p.b));
  RC_ASSERT(there.status == GapStatus::ok);
  RC_ASSERT(std::abs(std::ldexp(there.gap, -power) - gap.gap) <=
            gap.gap_error + std::ldexp(there.gap_error, -power));
  const Vec3 d = p.b.centre() - p.a.centre();
  const Gap touch = signed_gap(p.a, p.b, d - gap.gap * gap.normal);
  RC_ASSERT(touch.status == GapStatus::ok);
  // A normal that is off by `turn` moves B aside by |gap| times that. d and what moves it are
  // rounded, each to u of itself.
  const double turn = contact_bounds(p.a, p.b, gap).normal;
  RC_CLASSIFY(turn < kComparable, "touch compared");
  RC_ASSERT(std::abs(touch.gap) <= gap.gap_error + touch.gap_error + std::abs(gap.gap) * turn +
                                       8 * kU * (d.norm() + std::abs(gap.gap)));
}

RC_GTEST_PROP(GapProperty, FollowingFromTheOwnNormalStaysThere, ()) {
  const Pair p = *testing::pair(100);
  const Gap g = signed_gap(p.a, p.b);
  const Gap again = follow_gap(p.a, p.b, p.b.centre() - p.a.centre(), g.normal);
  // What only the search over all normals proves, following does not.
  if (g.tier != GapTier::search) RC_ASSERT(again.status == g.status);
  RC_ASSERT(std::isfinite(again.gap_error));
  RC_ASSERT(std::abs(again.gap - g.gap) <= rounding(p));
}

}  // namespace
}  // namespace tangency
