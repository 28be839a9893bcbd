// SPDX-License-Identifier: MIT
/// @file
/// How a rigid body moves.
///
/// A moving body turns at a constant angular velocity w about an axis in space that itself moves at
/// a constant velocity v. With E(t) = exp(t [w]x), r = centre - pivot at t = 0:
///
///     c(t) = c(0) + t v + (E(t) - 1) r,      R(t) = E(t) R(0).
///
/// r = 0 is a body that flies straight and spins about its centre; v along w is a screw motion.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::inline v0 {

/// The motion of a rigid body: it turns about a pivot, which moves in a straight line.
struct Motion {
  Vec3 velocity = Vec3::Zero();          ///< of the pivot, length per time
  Vec3 angular_velocity = Vec3::Zero();  ///< in space, radians per time
  Vec3 pivot_arm = Vec3::Zero();         ///< r: the body's centre at t = 0 less the pivot
};

}  // namespace tangency::inline v0
