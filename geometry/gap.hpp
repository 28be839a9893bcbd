// SPDX-License-Identifier: MIT
/// @file
/// The signed gap of two solid ellipsoids, and where they touch.
///
///     g(A,B) = max over unit n of [ n . d - h_A(n) - h_B(n) ],   d = c_B - c_A,
///
/// h the support functions. g > 0 is the distance; g < 0 is minus the penetration depth, the length
/// of the shortest translation that separates the solids; g = 0 is a touch. The normal n points
/// from A to B. At the best n the witness points p_A = c_A + x_A(n) and p_B = c_B - x_B(n) satisfy
/// p_B - p_A = g n: the *common normal*. Their midpoint is the contact point.
///
/// (1) gap(b, a) is gap(a, b) with the normal reversed and the points exchanged.
/// (2) A common rotation or translation turns and moves normal and points and leaves the gap.
/// (3) A common scaling scales gap and points and leaves the normal.
/// (4) Moving B by -gap n leaves the pair just touching.
/// (5) The gap changes no faster than the bodies move: |g(d + e) - g(d)| <= |e|.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency {

enum class GapStatus {
  ok,             ///< the global answer
  local,          ///< a stationary answer; that no shorter penetration exists is not proven
  not_converged,  ///< no stationary direction was found: the numbers are not an answer
};

/// Gap, normal and witness points of an ordered pair (A, B).
struct Gap {
  double gap;        ///< signed gap, in the unit of length of the bodies
  Vec3 normal;       ///< unit, from A to B
  Vec3 arm_a;        ///< p_A - c_A: A's witness point relative to its centre
  Vec3 arm_b;        ///< p_B - c_B: B's witness point relative to its centre
  GapStatus status;
};

/// The global gap: for overlapping solids the shortest separating translation.
///
/// Any pose, any semi-axes; coinciding centres and nested solids included. Where several normals
/// tie (concentric pairs, symmetric deep overlaps) the answer is the first of them in the order of
/// the search: the Perram-Wertheim direction, then the axes of A, then those of B, each pointing
/// with d (or along its positive body axis where d is normal to it).
///
/// `ok` where the answer is proven to be the global one, which every pair with gap > -rho is,
/// rho = a_min^2/a_max of A plus that of B; deeper pairs are searched from several starts and the
/// best is returned as `local`.
///
/// @return gap within 8 u L of the true one for aspect ratios to 100, u = 2^-53,
///         L = |d| + largest semi-axis of A + that of B.
Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept;

/// The same with the separation d = c_B - c_A given, in place of the centres: for periodic images.
Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept;

/// The answer of the branch that a moving contact is on: starts from the normal of a moment ago
/// and stays with the stationary answer it leads to. `ok` where that is proven to be global,
/// `local` where not; for pairs that touch lightly (gap > -rho) the same as signed_gap.
/// @param previous_normal  not zero; from A to B
Gap follow_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
               const Vec3& previous_normal) noexcept;

}  // namespace tangency
