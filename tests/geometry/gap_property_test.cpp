// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/geometry/gap.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include <tangency/geometry/methods/gap_factored.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using testing::Pair;

constexpr double kU = 0x1p-53;

/// A bound on the error of a reported gap: gap.hpp promises 8 u L, and the doubles of moved and
/// turned bodies are off by as much again.
double rounding(const Pair& p) {
  const double size = (p.b.centre() - p.a.centre()).norm() + p.a.largest_semi_axis() +
                      p.b.largest_semi_axis() + p.a.centre().norm() + p.b.centre().norm();
  return 32 * kU * size;
}

RC_GTEST_PROP(GapProperty, ConvergesForEveryPairAndPointsAreOnTheCommonNormal, ()) {
  const Pair p = *testing::pair(100);
  const Gap g = signed_gap(p.a, p.b);
  RC_ASSERT(g.status != GapStatus::not_converged);
  RC_ASSERT(std::abs(g.normal.norm() - 1) <= 4 * kU);
  const Vec3 d = p.b.centre() - p.a.centre();
  // p_B - p_A = g n: the part along n is the gap itself. The part across vanishes as fast as the
  // slope of the support functions lets it, which a normal good to sqrt(u) leaves at sqrt(u).
  const Vec3 between = d + g.arm_b - g.arm_a;
  RC_ASSERT(std::abs(between.dot(g.normal) - g.gap) <= rounding(p));
  RC_ASSERT((between - g.gap * g.normal).norm() <= 1e-6 * std::sqrt(rounding(p) / kU));
  RC_ASSERT(std::abs(g.normal.dot(g.arm_a) - p.a.support(g.normal)) <= rounding(p));
  RC_ASSERT(std::abs(g.normal.dot(g.arm_b) + p.b.support(g.normal)) <= rounding(p));
}

RC_GTEST_PROP(GapProperty, ExchangeReversesTheNormal, ()) {
  const Pair p = *testing::pair(100);
  const Gap ab = signed_gap(p.a, p.b), ba = signed_gap(p.b, p.a);
  if (ab.status == GapStatus::ok) {
    RC_ASSERT(ba.status == GapStatus::ok);
    RC_ASSERT(std::abs(ab.gap - ba.gap) <= rounding(p));
  }
  RC_CLASSIFY(ab.status == GapStatus::ok, "ok");
}

RC_GTEST_PROP(GapProperty, MovingBByTheReportedDepthLeavesAJustTouchingPair, ()) {
  const Pair p = *testing::pair_at(100, testing::uniform(0, 1));
  const Gap before = signed_gap(p.a, p.b);
  RC_PRE(before.gap < 0);
  const Ellipsoid moved = p.b.moved_to(p.b.centre() - before.gap * before.normal);
  const Gap after = signed_gap(p.a, moved);
  RC_ASSERT(after.status == GapStatus::ok);
  RC_ASSERT(std::abs(after.gap) <= rounding(p) + rounding({p.a, moved}));
}

RC_GTEST_PROP(GapProperty, NoDirectionTriedReachesFurtherThanAnOkAnswer, ()) {
  const Pair p = *testing::pair(100);
  const Gap g = signed_gap(p.a, p.b);
  RC_PRE(g.status == GapStatus::ok);
  const Vec3 d = p.b.centre() - p.a.centre();
  for (int i = 0; i < 64; ++i) {
    const Vec3 n = *testing::direction();
    RC_ASSERT(methods::gap_at(p.a, p.b, d, n).gap <= g.gap + rounding(p));
  }
}

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
}

RC_GTEST_PROP(GapProperty, FollowingFromTheOwnNormalStaysThere, ()) {
  const Pair p = *testing::pair(100);
  const Gap g = signed_gap(p.a, p.b);
  const Gap again = follow_gap(p.a, p.b, p.b.centre() - p.a.centre(), g.normal);
  RC_ASSERT(again.status == g.status);
  RC_ASSERT(std::abs(again.gap - g.gap) <= rounding(p));
}

/// One body moving along a smooth path past another, turning as it goes.
struct Motion {
  explicit Motion(std::uint64_t seed) : random(seed) {
    for (Vec3* v : {&centre, &swing, &phase, &spin}) {
      for (double& c : *v) c = draw(-1, 1);
    }
    a = shape();
    b = shape();
    start = Eigen::Quaterniond(draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(-1, 1)).normalized();
  }
  double draw(double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  }
  Vec3 shape() { return {std::exp(draw(-1, 1)), std::exp(draw(-1, 1)), std::exp(draw(-1, 1))}; }

  Ellipsoid at(double time) const {
    const Vec3 c = centre + 3 * swing.cwiseProduct((4 * phase + Vec3::Constant(time)).array().sin().matrix());
    const double angle = spin.norm() * time;
    return {c, b, Eigen::Quaterniond(Eigen::AngleAxisd(angle, spin.normalized())) * start};
  }

  std::mt19937_64 random;
  Vec3 centre, swing, phase, spin, a, b;
  Eigen::Quaterniond start;
};

TEST(GapAlongMotions, NeverChangesFasterThanTheMotion) {
  constexpr int kMotions = 1000, kSteps = 200;
  constexpr double kStep = 2 * M_PI / kSteps;
  double fastest = 0;
  int overlapping = 0, deep = 0;
  for (int m = 0; m < kMotions; ++m) {
    const Motion motion(static_cast<std::uint64_t>(m));
    const Ellipsoid a(Vec3::Zero(), motion.a);
    Ellipsoid before = motion.at(0);
    double gap = signed_gap(a, before).gap;
    for (int k = 1; k <= kSteps; ++k) {
      const Ellipsoid now = motion.at(k * kStep);
      const Gap next = signed_gap(a, now);
      // A turn by w moves no point of B by more than w times its largest semi-axis.
      const double moved = (now.centre() - before.centre()).norm() +
                           motion.spin.norm() * kStep * now.largest_semi_axis();
      ASSERT_LE(std::abs(next.gap - gap), moved + rounding({a, now})) << "motion " << m << " step " << k;
      fastest = std::max(fastest, std::abs(next.gap - gap) / moved);
      overlapping += next.gap < 0;
      deep += next.status == GapStatus::local;
      gap = next.gap;
      before = now;
    }
  }
  std::printf("%d motions of %d steps, %d overlapping, %d deep: at most %.4f of the motion\n", kMotions,
              kSteps, overlapping, deep, fastest);
  EXPECT_GT(overlapping, kMotions * kSteps / 10);
  EXPECT_GT(deep, 1000);
}

}  // namespace
}  // namespace tangency
