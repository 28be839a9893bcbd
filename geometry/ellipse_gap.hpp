// SPDX-License-Identifier: MIT
/// @file
/// The signed gap of two solid ellipses, and where they touch: the plane's counterpart of gap.hpp,
/// by the same definition,
///
///     g(A,B) = max over unit n of [ n . d - h_A(n) - h_B(n) ],   d = c_B - c_A,
///
/// with the same identities:
///
/// (1) gap(b, a) is gap(a, b); where the best normal is unique it is reversed and the points are
///     exchanged.
/// (2) A common rotation or translation leaves the gap; a unique normal and its points go with it.
/// (3) A common scaling scales gap and points and leaves the normal.
/// (4) Moving B by -gap n leaves the pair just touching.
/// (5) The gap changes no faster than the bodies move: |g(d + e) - g(d)| <= |e|.
#pragma once

#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/matrix_ellipse.hpp>

namespace tangency::inline v0 {

/// Gap, normal and witness points of an ordered pair (A, B); statuses as for Gap.
struct PlaneGap {
  double gap;   ///< signed gap, in the unit of length of the bodies
  Vec2 normal;  ///< unit, from A to B
  Vec2 arm_a;   ///< p_A - c_A: A's witness point relative to its centre
  Vec2 arm_b;   ///< p_B - c_B: B's witness point relative to its centre
  /// Proven: |gap - true gap| is at most this where `ok`. Where `local` it bounds the distance to
  /// the value of the branch (as wide as |d| where even that is not proven), and the true gap is at
  /// least gap - gap_error. docs/derivations/ellipses.md
  double gap_error;
  GapStatus status;  ///< what is proven
  GapTier tier;      ///< fast, factored (double-double), search or exact
};

/// The global gap: for overlapping solids the shortest separating translation. Any pose, any
/// semi-axes; coinciding centres and nested solids included. Where several normals tie the answer
/// is the first of them in the order of the search: the direction from the Perram-Wertheim form
/// (the first axis of A where the centres coincide), then the axes of A, then those of B, each
/// pointing with d.
///
/// `ok` for aspect ratios to 1e8 at every depth: the circle of normals is searched to the end.
/// The sign of gap is that of the exact relation: > 0 separate, 0 external_touch, < 0 where the
/// interiors meet. In any floating-point environment. Allocates only in tier `exact`.
///
/// @return infinite where the true gap is beyond the range of doubles
PlaneGap signed_gap(const Ellipse& a, const Ellipse& b) noexcept;

/// Of ellipses given by matrices: the answer of MatrixEllipse::ellipse() of each, with the sign of
/// the true bodies' relation, and their roundings in gap_error.
PlaneGap signed_gap(const MatrixEllipse& a, const MatrixEllipse& b) noexcept;

/// The same with the separation d = c_B - c_A given, in place of the centres: for periodic images.
PlaneGap signed_gap(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept;

/// The answer of the branch that a moving contact is on: starts from the normal of a moment ago
/// and stays with the stationary answer it leads to. `ok` where that is known to be global, `local`
/// where not: a shorter way out may exist. Never < 0 for solids that are apart.
/// @param a,b  the bodies, in this order
/// @param separation  c_B - c_A, finite
/// @param previous_normal  from A to B; not zero, of moderate length
PlaneGap follow_gap(const Ellipse& a, const Ellipse& b, const Vec2& separation,
                    const Vec2& previous_normal) noexcept;

}  // namespace tangency::inline v0
