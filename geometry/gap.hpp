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
/// (1) gap(b, a) is gap(a, b); where the best normal is unique it is reversed and the points are
///     exchanged. Deeper than -rho (see signed_gap()) the search may prove in one order, ok, what
///     it leaves open in the other, local.
/// (2) A common rotation or translation leaves the gap; a unique normal and its points go with it.
/// (3) A common scaling scales gap and points and leaves the normal.
/// (4) Moving B by -gap n leaves the pair just touching, to within the errors of the two gaps and
///     |gap| times that of n (contact_bounds()), which a move along it is off by sideways.
/// (5) The gap changes no faster than the bodies move: |g(d + e) - g(d)| <= |e|.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0 {

/// Gap, normal and witness points of an ordered pair (A, B).
struct Gap {
  double gap;   ///< signed gap, in the unit of length of the bodies
  Vec3 normal;  ///< unit, from A to B
  Vec3 arm_a;   ///< p_A - c_A: A's witness point relative to its centre
  Vec3 arm_b;   ///< p_B - c_B: B's witness point relative to its centre
  /// Proven: |gap - true gap| is at most this where `ok`. Where `local` it bounds the distance to
  /// the value of the branch (as wide as |d| where even that is not proven), and the true gap is at
  /// least gap - gap_error. docs/derivations/gap-certificate.md
  double gap_error;
  GapStatus status;  ///< what is proven
  GapTier tier;      ///< how the answer was found
};

/// The global gap: for overlapping solids the shortest separating translation.
///
/// Any pose, any semi-axes; coinciding centres and nested solids included. Where several normals
/// tie (concentric pairs, symmetric deep overlaps) the answer is the first of them in the order of
/// the search: the Perram-Wertheim direction, then the axes of A, then those of B, each pointing
/// with d (or along its positive body axis where d is normal to it). Coaxial bodies of revolution:
/// along their axis, then across it along the first equal axis of A (of B, if A is a sphere). Two
/// concentric spheres: along A's first axis.
///
/// `ok` wherever the gap is above -rho, rho = a_min^2/a_max of A plus that of B, and gap_error at
/// most 100 u L; deeper pairs are searched, and `ok` where the search over all normals finished
/// within its budget. Where one body is a sphere: `ok` at any depth.
///
/// The sign of gap is that of the exact relation: > 0 separate, 0 external_touch, < 0 where the
/// interiors meet. In any floating-point environment. Allocates only in tier `exact`.
///
/// @return infinite where the true gap is beyond the range of doubles
Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept;

/// The same with the separation d = c_B - c_A given, in place of the centres: for periodic images.
/// @param a,b  the bodies, in this order
/// @param separation  finite, here and below: else the process ends with one line on standard error
Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept;

/// Of bodies given by matrices: the answer of MatrixEllipsoid::ellipsoid() of each, with the sign
/// of the true bodies' relation, and their roundings in gap_error, which `ok` bounds no longer.
Gap signed_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b) noexcept;
/// @overload
Gap signed_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const Vec3& separation) noexcept;

/// The answer of the branch that a moving contact is on: starts from the normal of a moment ago
/// and stays with the stationary answer it leads to. `ok` where that is known to be global, and
/// then the same as signed_gap; `local` where not: a shorter way out may exist. Never < 0 for
/// solids that are apart. Allocates only in tier `exact` and where a `local` answer has to be held
/// against the exact relation.
/// @param a,b  the bodies, in this order
/// @param separation  c_B - c_A, finite
/// @param previous_normal  from A to B; not zero, of moderate length
Gap follow_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
               const Vec3& previous_normal) noexcept;

/// How far the normal and the witness points of an answer may be from those of the true maximum
/// that they are on: the global one, where that leads every other by more than gap_error.
struct ContactBounds {
  double normal;  ///< of |normal - true normal|
  double arm_a;   ///< of |arm_a - true arm_a|, in the unit of length
  double arm_b;   ///< of |arm_b - true arm_b|, in the unit of length
};

/// @param a,b  the bodies, in this order
/// @param gap  the answer of signed_gap() or follow_gap() for this pair. Where nothing can be
///             proven (ties, a status other than ok) the bounds are 2 and the largest diameters.
ContactBounds contact_bounds(const Ellipsoid& a, const Ellipsoid& b, const Gap& gap) noexcept;
/// @overload
ContactBounds contact_bounds(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
                             const Gap& gap) noexcept;

}  // namespace tangency::inline v0
