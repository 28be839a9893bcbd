// SPDX-License-Identifier: MIT
/// @file
/// The gap at a bounded cost, for callers who cannot wait: gap.hpp without its search and without
/// the exact relation. Conventions are those there.
///
/// Every pair takes a fixed number of steps at most. A pair that is apart, or no deeper than the
/// least radii of curvature, is mostly answered as by signed_gap() (bodies of aspect to 5: always,
/// measured), but for its sign within gap_error of a touch. Of a deep pair the answer is the best
/// maximum that those steps find, with a proof of how much shallower the true depth may be
/// (docs/derivations/bounded-gap.md); where that is nothing but rounding, the answer is the global
/// one and says so.
///
/// (1) gap - gap_error <= true gap <= gap + above.
/// (2) `ok` where both are at most 100 u L (gap.hpp), so that the answer is the global one; else
///     `local`.
/// (3) Exchanging the bodies, or a common motion or scaling, leaves enclosures of one true gap,
///     which therefore meet.
///
/// The sign is proven where gap > gap_error or gap < -above. Nothing here tells a touch from a near
/// miss: relation() does, and overlaps_by_filter() in bounded time where doubles tell.
#pragma once

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>

namespace tangency::inline v0 {

/// As a Gap; but gap_error bounds how much less than `gap` the true gap may be, for `local` too.
struct BoundedGap : Gap {
  double above;  ///< how much more the true gap may be; gap_error where `ok`
};

/// Allocates nothing and searches nothing; measured by bench_bounded. Pairs whose semi-axes differ
/// by more than some 1e7 may have an `above` as large as the bodies.
BoundedGap bounded_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept;
/// The same with the separation d = c_B - c_A given, in place of the centres: for periodic images.
/// @param a,b  the bodies, in this order
/// @param separation  finite: else the process ends with one line on standard error
BoundedGap bounded_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept;
/// Of bodies given by matrices: the answer of MatrixEllipsoid::ellipsoid() of each, with their
/// roundings in gap_error and above, which are both at most 100 u L + these where it is `ok`.
BoundedGap bounded_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b) noexcept;
/// @overload
BoundedGap bounded_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                       const Vec3& separation) noexcept;

}  // namespace tangency::inline v0
