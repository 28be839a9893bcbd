// SPDX-License-Identifier: MIT
/// @file
/// How far one solid ellipse lies inside another: the plane's counterpart of containment.hpp, by
/// the same definitions and with the same identities:
///
/// (1) The sign of the clearance is that of the exact relation: > 0 where the inner body is in the
///     other's interior, 0 where it is in it and touches its boundary, or both are equal, else < 0.
/// (2) margin > 1, = 1 or < 1 as the clearance is > 0, = 0 or < 0.
/// (3) Where the margin is above 1, clearance >= (margin - 1) times the inner body's smaller
///     semi-axis; where it is below 1, clearance >= (margin - 1) times its larger one.
/// (4) The inner body scaled by its margin has the margin 1, and scaling both bodies scales the
///     clearance and leaves the margin.
/// (5) The clearance changes no faster than the bodies move.
/// (6) A common rotation leaves both; margins are invariant under every common affine map.
#pragma once

#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/matrix_ellipse.hpp>

namespace tangency::inline v0 {

/// The least distance from the boundary of an inner ellipse to that of an outer one.
struct PlaneClearance {
  double clearance;  ///< signed, in the unit of length of the bodies
  Vec2 normal;       ///< unit, outwards
  Vec2 arm_inner;    ///< witness point of the inner body, relative to its centre
  Vec2 arm_outer;    ///< outer's witness point relative to its centre
  /// Proven, whatever the status: |clearance - true clearance| is at most this.
  /// docs/derivations/containment.md
  double clearance_error;
  GapStatus status;  ///< ok: the error is at most 100 u L; local: it is wider
  GapTier tier;      ///< how the answer was found
};

/// The global minimum over all normals: any pose, any semi-axes. Where several normals tie the
/// answer is one of them. In any floating-point environment. Allocates. Takes 10 us to 50 ms.
PlaneClearance clearance(const Ellipse& inner, const Ellipse& outer) noexcept;

/// The same with the separation d = c_outer - c_inner given, in place of the centres.
/// @param inner  the body inside
/// @param outer  the body around it
/// @param separation  finite, here and below: else the process ends with one line on standard error
PlaneClearance clearance(const Ellipse& inner, const Ellipse& outer,
                         const Vec2& separation) noexcept;

/// Of ellipses given by matrices: the answer of MatrixEllipse::ellipse() of each, with the sign of
/// the true bodies' relation, and their roundings in the error, which `ok` bounds no longer.
PlaneClearance clearance(const MatrixEllipse& inner, const MatrixEllipse& outer) noexcept;

/// From exact integers, as in space.
ContainmentMargin containment_margin(const Ellipse& inner, const Ellipse& outer) noexcept;
/// @overload
ContainmentMargin containment_margin(const Ellipse& inner, const Ellipse& outer,
                                     const Vec2& separation) noexcept;
/// Of ellipses given by matrices: exactly the bodies as they were given.
ContainmentMargin containment_margin(const MatrixEllipse& inner,
                                     const MatrixEllipse& outer) noexcept;

}  // namespace tangency::inline v0
