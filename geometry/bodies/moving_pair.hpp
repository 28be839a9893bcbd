// SPDX-License-Identifier: MIT
/// @file
/// Two moving ellipsoids, and how long a direction that separates them now is sure to go on doing
/// so: docs/derivations/time-of-contact.md.
#pragma once

#include <tangency/geometry/motion.hpp>

namespace tangency::inline v0::detail {

/// Of the tolerance in time: steps shorter than that look for the overlap. Chosen.
inline constexpr double kNearContact = 0.5;

/// The greatest double that is no more than from + by, both >= 0; infinite where that overflows.
double at_most_after(double from, double by) noexcept;

/// What bounds of a motion read of a shape.
struct ShapeReach {
  double largest;  ///< semi-axis a_max
  double spread;   ///< a_max^2 - a_min^2 or more
};

/// A pair at one moment as bounds read it: each body by its factor R diag(a), within the rounding
/// of section 3 of the derivation, and d = c_B - c_A.
struct PairMoment {
  double t;
  Mat3 factor_a, factor_b;
  Vec3 d;
  Vec3 pivot_arm_a, pivot_arm_b;  ///< turned with the bodies
};

/// How fast a pair of given motions may close. Lengths within [2^-400, 2^400].
class MotionBounds {
 public:
  MotionBounds() = default;
  MotionBounds(const ShapeReach& a, const Motion& motion_a, const ShapeReach& b,
               const Motion& motion_b, const Vec3& separation) noexcept;

  const Motion& motion_a() const noexcept { return motion_a_; }
  const Motion& motion_b() const noexcept { return motion_b_; }

  /// The pair at time t, of the factors at t = 0. Speeds of turning are 0 or within
  /// [2^-400, 2^400].
  PairMoment at(double t, const Mat3& factor_a, const Mat3& factor_b) const noexcept;
  /// Separation and arms alone: factors are left as they are.
  void place(PairMoment& moment) const noexcept;

  /// A bound of the error, against the true motion at time t, of n.d - h_A - h_B at a unit normal,
  /// and of the gap that signed_gap() calls `ok`.
  double rounding(double t) const noexcept;

  /// Are balls of the largest semi-axes proven to be apart throughout [0, span]?
  bool balls_apart_throughout(double span) const noexcept;

  /// The longest step found, at most `longest`, such that the true solids are apart throughout
  /// [now.t, now.t + step]; 0 where they are not proven apart now.
  /// @param normal  unit, from A to B; the closer to the normal of the gap, the longer the step
  double safe_step(const PairMoment& now, const Vec3& normal, double longest) const noexcept;

 private:
  struct Bound;
  struct Looking;
  Vec3 velocity(const Vec3& pivot_arm_a, const Vec3& pivot_arm_b) const noexcept;

  ShapeReach a_, b_;
  Motion motion_a_, motion_b_;
  Vec3 separation_;
  double rounding_at_start_, rounding_per_time_;
  double greatest_speed_;         ///< a bound of |d'|
  double greatest_acceleration_;  ///< a bound of |d''|
};

/// A pair at one moment: the bodies about their own centres and d = c_B - c_A.
struct PairAt {
  double t;
  Ellipsoid a, b;
  Vec3 d;
  Vec3 pivot_arm_a, pivot_arm_b;  ///< turned with the bodies
};

/// The same of whole ellipsoids.
class MovingPair {
 public:
  MovingPair(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b, const Motion& motion_b,
             const Vec3& separation) noexcept;

  PairAt at(double t) const noexcept;
  double rounding(double t) const noexcept { return bounds_.rounding(t); }
  /// MotionBounds::safe_step().
  double safe_step(const PairAt& now, const Vec3& normal, double longest) const noexcept;

 private:
  Ellipsoid a_, b_;
  MotionBounds bounds_;
};

}  // namespace tangency::inline v0::detail
