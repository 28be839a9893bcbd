// SPDX-License-Identifier: MIT
/// @file
/// How far one solid ellipsoid lies inside another: the clearance between their boundaries, a
/// length, and the margin, a factor.
///
///     c = min over unit n of [ h_outer(n) - h_inner(n) - n . (c_inner - c_outer) ]
///
/// h the support functions, is the largest t for which the inner body and a ball of radius t around
/// each of its points lie in the outer one: the least distance between the boundaries. c < 0 is
/// minus the length by which the inner body sticks out: the distance of its farthest point from the
/// outer body. The normal n is the outer normal of both bodies at the witness points, for which
/// p_outer - p_inner = c n.
///
///     s = the largest factor for which  c_inner + s (inner - c_inner)  lies in the outer body
///
/// is the margin; s = 0 where the inner body's centre is not in the interior of the outer one.
/// Which body is taken for the inner one is the caller's to say: any pair has an answer.
///
/// (1) The sign of the clearance is that of the exact relation: > 0 where the inner body is in the
///     other's interior, 0 where it is in it and touches its boundary, or both are equal, else < 0.
/// (2) margin > 1, = 1 or < 1 as the clearance is > 0, = 0 or < 0.
/// (3) Where the margin is above 1, clearance >= (margin - 1) times the inner body's smallest
///     semi-axis; where it is below 1, clearance >= (margin - 1) times its largest one.
/// (4) The inner body scaled by its margin has the margin 1, and scaling both bodies scales the
///     clearance and leaves the margin.
/// (5) The clearance changes no faster than the bodies move.
/// (6) A common rotation leaves both; margins are invariant under every common affine map.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0 {

/// The least distance from the surface of an inner body to that of an outer one.
struct Clearance {
  double clearance;  ///< signed, in the unit of length of the bodies
  Vec3 normal;       ///< unit, outwards
  Vec3 arm_inner;    ///< witness point of the inner body, relative to its centre
  Vec3 arm_outer;    ///< outer's witness point relative to its centre
  /// Proven, whatever the status: |clearance - true clearance| is at most this.
  /// docs/derivations/containment.md
  double clearance_error;
  GapStatus status;  ///< ok: the error is at most 100 u L; local: it is wider
  GapTier tier;      ///< how the answer was found
};

/// The global minimum over all normals: any pose, any semi-axes. Where several normals tie the
/// answer is one of them.
///
/// `ok`, L = |d| + the largest semi-axes, by a branch and bound over the sphere of normals, where
/// that finishes within its budget: nearly always to aspect ratios of 1e6. `local` are some thinner
/// bodies, and concentric ones that are spheres but for 1e-13 to 1e-6 of themselves; then (3)
/// bounds the error. A sphere inside, and two bodies of revolution about one axis, are `ok`.
///
/// In any floating-point environment. Allocates. Takes 0.1 to 1 ms, and 50 ms where the search does
/// not finish.
Clearance clearance(const Ellipsoid& inner, const Ellipsoid& outer) noexcept;

/// The same with the separation d = c_outer - c_inner given, in place of the centres: for periodic
/// images.
/// @param inner  the body inside
/// @param outer  the body around it
/// @param separation  finite, here and below: else the process ends with one line on standard error
Clearance clearance(const Ellipsoid& inner, const Ellipsoid& outer,
                    const Vec3& separation) noexcept;

/// Of bodies given by matrices: the answer of MatrixEllipsoid::ellipsoid() of each, with the sign
/// of the true bodies' relation, and their roundings in the error, which `ok` bounds no longer.
Clearance clearance(const MatrixEllipsoid& inner, const MatrixEllipsoid& outer) noexcept;

/// The largest factor by which an inner body can be scaled about its centre and stay inside.
struct ContainmentMargin {
  double margin;        ///< >= 0; infinite where it is beyond the range of doubles
  double margin_error;  ///< proven: |margin - true margin| is at most this, some u margin
};

/// From exact integers: rounded once, but where that would break identity (2). Any pose, any
/// semi-axes, in any floating-point environment. Allocates. Takes about 1 ms.
ContainmentMargin containment_margin(const Ellipsoid& inner, const Ellipsoid& outer) noexcept;
/// @overload
ContainmentMargin containment_margin(const Ellipsoid& inner, const Ellipsoid& outer,
                                     const Vec3& separation) noexcept;
/// Of bodies given by matrices: exactly the bodies as they were given.
ContainmentMargin containment_margin(const MatrixEllipsoid& inner,
                                     const MatrixEllipsoid& outer) noexcept;

}  // namespace tangency::inline v0
