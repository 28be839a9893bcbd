// SPDX-License-Identifier: GPL-3.0-or-later
// The gap along smooth motions: what a simulator sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap/cap.hpp>

namespace tangency {
namespace {

constexpr double kU = kUnitRoundoff;

double size_of(const Ellipsoid& a, const Ellipsoid& b) {
  return (b.centre() - a.centre()).norm() + a.largest_semi_axis() + b.largest_semi_axis();
}

/// The errors of two gaps, and of the doubles of turned bodies.
double rounding(const Ellipsoid& a, const Ellipsoid& b) { return 32 * kU * size_of(a, b); }

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
    const Vec3 c =
        centre + 3 * swing.cwiseProduct((4 * phase + Vec3::Constant(time)).array().sin().matrix());
    const double angle = spin.norm() * time;
    return {c, b, Eigen::Quaterniond(Eigen::AngleAxisd(angle, spin.normalized())) * start};
  }

  std::mt19937_64 random;
  Vec3 centre, swing, phase, spin, a, b;
  Eigen::Quaterniond start;
};

TEST(GapAlongMotions, FollowedAnswerIsTheGlobalOneWhereItSaysSoAndNeverOverlapsBodiesApart) {
  constexpr int kMotions = 300, kSteps = 400;
  constexpr double kStep = 2 * M_PI / kSteps;
  int local = 0, jumps = 0;
  for (int m = 0; m < kMotions; ++m) {
    const Motion motion(static_cast<std::uint64_t>(m));
    const Ellipsoid a(Vec3::Zero(), motion.a);
    Gap followed = signed_gap(a, motion.at(0));
    for (int k = 1; k <= kSteps; ++k) {
      const Ellipsoid b = motion.at(k * kStep);
      followed = follow_gap(a, b, b.centre(), followed.normal);
      ASSERT_TRUE(std::isfinite(followed.gap_error));
      const Gap global = signed_gap(a, b);
      const double slack = rounding(a, b);
      if (followed.status == GapStatus::ok) {
        ASSERT_LE(std::abs(followed.gap - global.gap), slack) << "motion " << m << " step " << k;
      } else {
        ++local;
        ASSERT_LE(followed.gap, global.gap + slack);
        jumps += followed.gap < global.gap - slack;
      }
      ASSERT_EQ(followed.gap < -slack, global.gap < -slack) << "motion " << m << " step " << k;
    }
  }
  std::printf("%d local answers, %d of them on another branch than the global one\n", local, jumps);
  EXPECT_GT(jumps, 0);
}

// geometry/gap.hpp (5)
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
      ASSERT_LE(std::abs(next.gap - gap), moved + rounding(a, now))
          << "motion " << m << " step " << k;
      fastest = std::max(fastest, std::abs(next.gap - gap) / moved);
      overlapping += next.gap < 0;
      deep += next.tier == GapTier::search;
      gap = next.gap;
      before = now;
    }
  }
  std::printf("%d motions of %d steps, %d overlapping, %d deep: at most %.4f of the motion\n",
              kMotions, kSteps, overlapping, deep, fastest);
  EXPECT_GT(overlapping, kMotions * kSteps / 10);
  EXPECT_GT(deep, 1000);
}

/// Halves [from, to] towards a jump of the normal until it is 2^-40 of a step wide; normal_at(time,
/// previous normal) gives the normal. Returns false where the jump dissolves.
struct Jump {
  double before, after;
  Vec3 normal_before, normal_after;
};

constexpr double kJump = 0.3;         // rad; chosen: smooth turns of a step are mostly shorter
constexpr double kContinuous = 1e-3;  // rad; chosen: no smooth turn is as long in 2^-40 of a step
// Of bodies of size 1; chosen: sharpness goes with the root of the time that is left, 1e-7 here.
constexpr double kBlunt = 1e-3;
constexpr double kTie =
    1e-9;  // of bodies of size 1; chosen: far above what 2^-40 of a step changes

template <class NormalAt>
bool close_in(Jump& jump, const NormalAt& normal_at) {
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (jump.before + jump.after);
    const Vec3 normal = normal_at(middle, jump.normal_before);
    if ((normal - jump.normal_before).norm() > (jump.normal_after - normal).norm()) {
      jump.after = middle, jump.normal_after = normal;
    } else {
      jump.before = middle, jump.normal_before = normal;
    }
  }
  return (jump.normal_after - jump.normal_before).norm() > kContinuous;
}

TEST(GapAlongMotions, NormalAndPointsJumpOnlyWhereTheGlobalAnswerChanges) {
  constexpr int kMotions = 1000, kSteps = 100;
  constexpr double kStep = 2 * M_PI / kSteps;
  int changes = 0, steep = 0;
  for (int m = 0; m < kMotions; ++m) {
    const Motion motion(static_cast<std::uint64_t>(m));
    const Ellipsoid a(Vec3::Zero(), motion.a);
    const auto normal_at = [&](double time, const Vec3&) {
      return signed_gap(a, motion.at(time)).normal;
    };
    Vec3 last = normal_at(0, {});
    for (int k = 1; k <= kSteps; ++k) {
      const Vec3 now = normal_at(k * kStep, last);
      if ((now - last).norm() > kJump) {
        Jump jump{(k - 1) * kStep, k * kStep, last, now};
        if (!close_in(jump, normal_at)) {
          ++steep;
        } else {
          // The old answer's branch goes on, and is as good: a tie.
          const Ellipsoid b = motion.at(jump.after);
          const Gap global = signed_gap(a, b);
          const Gap old = follow_gap(a, b, b.centre(), jump.normal_before);
          ASSERT_LE(std::abs(old.gap - global.gap), kTie) << "motion " << m << " step " << k;
          ++changes;
        }
      }
      last = now;
    }
  }
  std::printf("%d changes of the global answer, %d steep turns\n", changes, steep);
  EXPECT_GT(changes, 100);
}

TEST(GapAlongMotions, FollowedAnswerJumpsOnlyWhereItsBranchEndsOrTheBodiesPart) {
  constexpr int kMotions = 1000, kSteps = 400;
  constexpr double kStep = 2 * M_PI / kSteps;
  int ends = 0, parted = 0, lost = 0, steep = 0;
  for (int m = 0; m < kMotions; ++m) {
    const Motion motion(static_cast<std::uint64_t>(m));
    const Ellipsoid a(Vec3::Zero(), motion.a);
    const auto normal_at = [&](double time, const Vec3& previous) {
      const Ellipsoid b = motion.at(time);
      return follow_gap(a, b, b.centre(), previous).normal;
    };
    Vec3 last = signed_gap(a, motion.at(0)).normal;
    for (int k = 1; k <= kSteps; ++k) {
      const Vec3 now = normal_at(k * kStep, last);
      if ((now - last).norm() > kJump) {
        Jump jump{(k - 1) * kStep, k * kStep, last, now};
        if (!close_in(jump, normal_at)) {
          ++steep;
        } else {
          const Ellipsoid b = motion.at(jump.before), after = motion.at(jump.after);
          const Gap next = follow_gap(a, after, after.centre(), jump.normal_before);
          if ((next.normal - jump.normal_before).norm() < kContinuous) {
            // The branch goes on: it turned too fast for one of the longer steps.
            ++lost;
          } else if (next.gap > 0) {
            // The wrong way out all along: no branch of bodies that are apart has a gap < 0.
            ++parted;
          } else {
            // A maximum that meets a saddle and vanishes: its sharpness goes to 0 with the root of
            // the time that is left.
            const Vec3& n = jump.normal_before;
            const double h_a = a.support(n), h_b = b.support(n);
            const detail::DoubleDoubleSide side_a(a, detail::exactly(n)),
                side_b(b, detail::exactly(n));
            const detail::Hessian hessian =
                detail::hessian_at({side_a, a.support_point(n)}, {side_b, b.support_point(n)}, n);
            const double value = n.dot(b.centre()) - h_a - h_b;
            const double sharpness = std::min(hessian.curvature[0], hessian.curvature[1]) + value;
            ASSERT_LE(sharpness, kBlunt) << "motion " << m << " step " << k;
            ++ends;
          }
        }
      }
      last = now;
    }
  }
  std::printf("%d branches ended, %d bodies parted, %d branches lost in a step, %d steep turns\n",
              ends, parted, lost, steep);
  EXPECT_LE(lost, kMotions / 100);
  EXPECT_GT(ends, 10);
}

}  // namespace
}  // namespace tangency
