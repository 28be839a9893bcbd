// SPDX-License-Identifier: MIT
/// @file
/// The gap by Newton's method on the sphere of normals, without a tangent basis: the fast path.
#pragma once

#include <tangency/geometry/gap.hpp>

namespace tangency::methods {

/// Where a search stopped, and whether it may be believed.
struct Stationary {
  Vec3 normal;  ///< unit
  bool
      accepted;  ///< a strict local maximum of n.d - h_A - h_B, reached through concave ground only
};

/// Newton's method from a unit normal. Accepted where the tangent Hessian was negative definite at
/// *every* step and the last step's gain fell below rounding; "the last step was small" alone lets
/// wrong answers through on extreme shapes. Requires moderate() bodies.
Stationary newton_from(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                       const Vec3& normal) noexcept;

/// The same from the Perram-Wertheim normal. Requires moderate() bodies and d != 0.
Stationary newton(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept;

}  // namespace tangency::methods
