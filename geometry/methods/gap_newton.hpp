// SPDX-License-Identifier: MIT
/// @file
/// The gap by Newton's method on the sphere of normals, without a tangent basis: the fast path.
#pragma once

#include <tangency/geometry/gap.hpp>

namespace tangency::methods {

/// Where a search stopped, and whether it may be believed.
struct Stationary {
  Vec3 normal;    ///< unit
  bool accepted;  ///< a strict local maximum of n.d - h_A - h_B
};

/// When Newton's method stops: where its last step gained less than this, of the size of the pair.
enum class Finish {
  /// 2^-26: the step squares what is left of the way, which then is rounding for shapes whose
  /// curvature varies moderately.
  early,
  /// 2^-54, below the rounding of the lengths that are added.
  late,
};

/// Newton's method from a unit normal. Accepted where the tangent Hessian was negative definite at
/// *every* step and the last step's gain is as small as `finish` asks; "the last step was small"
/// alone lets wrong answers through on extreme shapes. What it returns is still to be proven:
/// gap_proof.hpp. Requires moderate() bodies.
Stationary newton_from(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& normal,
                       Finish finish) noexcept;

/// The same from the Perram-Wertheim normal. Requires moderate() bodies and d != 0.
Stationary newton(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, Finish finish) noexcept;

}  // namespace tangency::methods
