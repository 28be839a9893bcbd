// SPDX-License-Identifier: MIT
/// @file
/// The gap of two solid ellipsoids by definitions other than the common normal's: what other codes
/// call the overlap of ellipsoids, so that a difference of definition can be told from an error.
///
/// Both start from the Perram-Wertheim function [PerramWertheim1985]. With M the shape matrices
/// and d = c_B - c_A,
///     F = max over 0 < s < 1 of s (1-s) d' ((1-s) M_A + s M_B)^-1 d,
/// and at the best s: v = ((1-s) M_A + s M_B)^-1 d, the normal n = v/|v| from A to B, and the point
/// x = c_A + (1-s) M_A v = c_B - s M_B v, where both level functions (x - c)' M^-1 (x - c) are F
/// and their gradients oppose each other along n. F > 1 <=> the solids are apart, and F is the
/// square of the factor by which both must shrink or grow to touch: they then touch at x.
///
/// (1) Exchanging the bodies leaves the gap, reverses the normal and exchanges the points.
/// (2) A common motion carries normal and points along; a common scaling scales gap and points.
/// (3) The gap is > 0 where F > 1, and < 0 where F < 1: its sign is that of the signed gap, but for
///     an error of u L / 64: a touch need not be 0.
/// (4) For two spheres it is the signed gap; in general it differs from it by O(gap^2 / radius of
///     curvature).
///
/// (5) F > 1, = 1 and < 1, known to its error, where the solids are apart, touch and overlap.
/// (6) F is that of the scaled bodies after a common scaling, and F(b, a) is F(a, b).
///
/// Every number of an `ok` is within u of itself + u L / 64, u = 2^-53, L = |d| + both largest
/// semi-axes (the normal within 8 u), at any aspect ratio: a bound is computed beside the numbers,
/// in double-double and, where that does not suffice, in 512 bits; where that does not either the
/// status says so (docs/derivations/other-gaps.md; tests/verify/flat_contact_agreement.cpp prints
/// the largest errors). Any scale. In any floating-point environment. Nothing here allocates.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>

namespace tangency::inline v0 {

/// Whether a gap by another definition exists and is known.
enum class OtherGapStatus {
  ok,
  not_applicable,  ///< the definition says nothing about this pair
  not_converged,   ///< not known well enough: aspect ratios far beyond 1e20, or a line that touches
};

/// The Perram-Wertheim contact function and what it says of sizes. The numbers are 0 unless `ok`.
struct PerramWertheimFactor {
  double factor;          ///< F >= 0, without a unit; infinite beyond the range of doubles
  double scale;           ///< mu = sqrt F: both bodies, scaled by mu about their centres, touch
  double factor_error;    ///< proven: |factor - F| is at most this
  double scale_error;     ///< proven: |scale - mu| is at most this
  OtherGapStatus status;  ///< the numbers are answers where it is `ok`
};

/// Both numbers to 1.02 u of themselves + 2^-1073; 0 without error where the centres coincide.
/// `not_converged` far beyond aspect ratios of 1e20, else `ok`.
PerramWertheimFactor perram_wertheim_factor(const Ellipsoid& a, const Ellipsoid& b) noexcept;
/// The same with the separation d = c_B - c_A given, in place of the centres.
/// @param a,b  the bodies, in this order
/// @param separation  finite, here and below: else the process ends with one line on standard error
PerramWertheimFactor perram_wertheim_factor(const Ellipsoid& a, const Ellipsoid& b,
                                            const Vec3& separation) noexcept;
/// Of bodies given by matrices: of MatrixEllipsoid::ellipsoid() of each, with their roundings in
/// both errors.
PerramWertheimFactor perram_wertheim_factor(const MatrixEllipsoid& a,
                                            const MatrixEllipsoid& b) noexcept;

/// As Gap, by another definition. The numbers are 0 unless `ok`.
struct OtherGap {
  double gap;   ///< in the unit of length of the bodies; infinite beyond the range of doubles
  Vec3 normal;  ///< unit, from A to B
  Vec3 arm_a;   ///< A's witness point relative to its centre
  Vec3 arm_b;   ///< B's
  OtherGapStatus status;  ///< the numbers are answers where it is `ok`
  /// Proven: |gap - the true gap by this definition| is at most this, which is at most 1.01 (u
  /// |gap|
  /// + u L / 64) + 2^-1072 and mostly little above u |gap|.
  double gap_error;
};

/// gap = (1 - 1/sqrt F) n.d = n.d - h_A(n) - h_B(n), h the support functions: how far apart are the
/// two tangent planes with the normal n.
///
/// Never above the signed gap, which is the greatest of n.d - h_A - h_B. The witness points are the
/// support points, where those planes touch the bodies: (p_B - p_A).n = gap, but p_B - p_A is in
/// general not along n. `not_applicable` where the centres coincide: F has no maximum.
OtherGap perram_wertheim_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept;
/// The same with the separation d = c_B - c_A given, in place of the centres.
OtherGap perram_wertheim_gap(const Ellipsoid& a, const Ellipsoid& b,
                             const Vec3& separation) noexcept;

/// Along the line x + t n: from the last point of the line in A to the first in B, t increasing
/// from A to B, gap = t_B - t_A. Those are the witness points, p_B - p_A = gap n, for overlapping
/// solids and for solids that are apart. This is the overlap of the discrete element codes that
/// seek the point of equal potentials [Podlozhnyuk2017].
///
/// `not_applicable` where the centres coincide, and where the line misses a body: solids that are
/// far apart for their curvature. That it misses is proven. `not_converged` where it touches a
/// body, or so nearly that 512 bits do not tell.
OtherGap midpoint_potential_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept;
/// The same with the separation d = c_B - c_A given, in place of the centres.
OtherGap midpoint_potential_gap(const Ellipsoid& a, const Ellipsoid& b,
                                const Vec3& separation) noexcept;

}  // namespace tangency::inline v0
