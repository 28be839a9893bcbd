// SPDX-License-Identifier: MIT
/// @file
/// Two moving ellipsoids, and how long a direction that separates them now is sure to go on doing
/// so: docs/derivations/time-of-contact.md.
#pragma once

#include <tangency/geometry/motion.hpp>

namespace tangency::detail {

/// A pair at one moment: the bodies about their own centres and d = c_B - c_A.
struct PairAt {
  double t;
  Ellipsoid a, b;
  Vec3 d;
  Vec3 pivot_arm_a, pivot_arm_b;  ///< turned with the bodies
};

/// Lengths within [2^-400, 2^400].
class MovingPair {
 public:
  MovingPair(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b, const Motion& motion_b,
             const Vec3& separation) noexcept;

  PairAt at(double t) const noexcept;

  /// A bound of the error, against the true motion at time t, of n.d - h_A - h_B at a unit normal,
  /// and of the gap that signed_gap() calls `ok`.
  double rounding(double t) const noexcept;

  /// The longest step found, at most `longest`, such that the true solids are apart throughout
  /// [now.t, now.t + step]; 0 where they are not proven apart now.
  /// @param normal  unit, from A to B; the closer to the normal of the gap, the longer the step
  double safe_step(const PairAt& now, const Vec3& normal, double longest) const noexcept;

 private:
  double safe_step(const PairAt& now, const Vec3& normal, const Vec3& turning,
                   double longest) const noexcept;
  double safe_step_of_spheres(const PairAt& now, double longest) const noexcept;

  Ellipsoid a_, b_;
  Motion motion_a_, motion_b_;
  Vec3 separation_;
  double rounding_at_start_, rounding_per_time_;
  double greatest_speed_;         ///< a bound of |d'|
  double greatest_acceleration_;  ///< a bound of |d''|
};

}  // namespace tangency::detail
