// SPDX-License-Identifier: MIT
/// @file
/// A plane against an ellipsoid in exact rational numbers. Internal (GMP).
///
/// With the height s = n . c - w of the centre c above the plane n . x = w, and the shape matrix M,
/// the body's points are from s - r to s + r above it, r^2 = n' M n. So the sign of s and that of
/// s^2 - n' M n tell how they lie: both are rational in the stored doubles.
#pragma once

#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::exact {

/// The solid itself: the quaternion means R(q/|q|), whose square roots cancel in the shape matrix.
RationalSolid<3> rational_solid(const Ellipsoid& body);

struct WallSigns {
  int centre;   ///< of s: 1 where the centre is on the side that n points to
  int outside;  ///< of s^2 - n' M n: 1 apart from the plane, 0 touching it, -1 across it
};

/// @param normal, offset  finite, normal not 0
WallSigns wall_signs(const RationalSolid<3>& body, const Vec3& normal, double offset);

}  // namespace tangency::inline v0::exact
