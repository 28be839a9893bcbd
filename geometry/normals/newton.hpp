// SPDX-License-Identifier: MIT
/// @file
/// The gap by Newton's method on the sphere of normals, without a tangent basis: the fast path.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::inline v0::detail {

/// Where a search stopped, and whether it may be believed.
struct Stationary {
  Vec3 normal;    ///< unit
  bool accepted;  ///< a strict local maximum of n.d - h_A - h_B
};

/// When Newton's method stops.
enum class Finish {
  /// Where what is left of the way, as the lengths of the steps so far tell, is below 2^-39 rad:
  /// for
  /// shapes whose curvature varies moderately.
  early,
  /// Where the last step gained less than 2^-54 of the size of the pair, below the rounding of the
  /// lengths that are added.
  late,
};

/// Newton's method from a unit normal. Accepted where the tangent Hessian was negative definite at
/// *every* step and the end is as near as `finish` asks; "the last step was small"
/// alone lets wrong answers through on extreme shapes. What it returns is still to be proven:
/// gap/proof.hpp. Requires moderate() bodies.
Stationary newton_from(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& normal,
                       Finish finish) noexcept;

/// The same from the Perram-Wertheim normal. Requires moderate() bodies and d != 0.
Stationary newton(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, Finish finish) noexcept;

}  // namespace tangency::inline v0::detail
