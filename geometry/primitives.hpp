// SPDX-License-Identifier: MIT
/// @file
/// Gaps of ellipsoids, spheres and walls: the neighbours of signed_gap() that have closed forms.
///
/// Each number of an answer is rounded once from double-double arithmetic, in any
/// floating-point environment and for semi-axes of at least 2^-200 L, u = 2^-53:
/// gaps are within 2 u |gap| + 2^-80 L of the true ones, arms within 2 u |arm| + 2^-80 L, unit
/// normals within 2 u + 2^-80 L / (least radius of curvature + gap) (docs/derivations/
/// primitives.md). L is the distance of the centres + radius + largest semi-axis; for a wall
/// the centre's distance from its plane + largest semi-axis.
///
/// (1) signed_gap(b, a) is signed_gap(a, b) with the normal reversed and the points exchanged.
/// (2) A sphere and an Ellipsoid of three equal semi-axes have the same gap to any third body.
/// (3) Moving either body along the normal until the gap is 0 leaves a touch.
/// (4) A common rotation or translation leaves the gap, and a common scaling scales it.
/// (5) The relation of a body and a Sheet is that of the body and the Plane on the other side of
/// its
///     centre, with internal_touch and a_in_b impossible.
/// (6) A separation d in place of the centres leaves the answer to bodies whose centres are d
/// apart.
#pragma once

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0 {

/// A solid ball.
struct Sphere {
  Vec3 centre;    ///< finite
  double radius;  ///< finite, >= 0: a point is a sphere
};

/// A wall: the solid half-space { x : normal . x <= offset }. The normal points out of the wall.
struct Plane {
  Vec3 normal;    ///< finite, of any length but 0
  double offset;  ///< finite, in units of normal . x: the distance from the origin times |normal|
};

/// A wall without thickness: the plane { x : normal . x = offset }, both of whose sides are free.
struct Sheet {
  Vec3 normal;    ///< finite, of any length but 0
  double offset;  ///< finite, as a Plane's
};

/// Two spheres: |d| - r_A - r_B, n along d; n = (1, 0, 0) where the centres coincide. `ok`.
Gap signed_gap(const Sphere& a, const Sphere& b) noexcept;

/// A sphere and an ellipsoid: the signed distance of the sphere's centre from the ellipsoid, less
/// the radius. The global answer however deep the overlap, so `ok`; ties as in closest_point.hpp.
Gap signed_gap(const Sphere& a, const Ellipsoid& b) noexcept;
/// @overload
Gap signed_gap(const Ellipsoid& a, const Sphere& b) noexcept;

/// Of a body given in any form: the answer of MatrixEllipsoid::ellipsoid() with its rounding in
/// gap_error, which bounds how far the sign is known.
Gap signed_gap(const MatrixEllipsoid& a, const Sphere& b) noexcept;

/// The same with the separation d = c_B - c_A given, in place of the centres: for periodic images.
/// @param a,b  the bodies, in this order
/// @param separation  finite
Gap signed_gap(const Sphere& a, const Sphere& b, const Vec3& separation) noexcept;
/// @overload
Gap signed_gap(const Sphere& a, const Ellipsoid& b, const Vec3& separation) noexcept;
/// @overload
Gap signed_gap(const Ellipsoid& a, const Sphere& b, const Vec3& separation) noexcept;

/// An ellipsoid and a wall. Both arms are relative to the ellipsoid's centre, the wall having none.
struct WallGap {
  double gap;   ///< (normal . c - offset) / |normal| - h: < 0 where the body reaches into the wall
  Vec3 normal;  ///< unit, from the body to the wall: against the plane's normal
  Vec3 arm_body;  ///< the point of the body that reaches furthest towards the wall
  Vec3 arm_wall;  ///< the point of the plane opposite to it: arm_body + gap * normal
  /// Proven: |gap - true gap| is at most this, the bound above and, for walls far from the origin,
  /// 2^-98 (|centre| + |offset| / |normal|).
  double gap_error;
  GapStatus status;  ///< ok: the global answer
};
/// @overload
WallGap signed_gap(const Ellipsoid& body, const Plane& wall) noexcept;

/// An ellipsoid and a wall without thickness: as of the solid wall that has the body's centre on
/// its free side, so that a gap < 0 is minus the length of the shortest translation that brings the
/// whole body to one side, its nearer one. The normal points from the centre to the plane; against
/// the sheet's normal where the centre lies in the plane, up to rounding.
WallGap signed_gap(const Ellipsoid& body, const Sheet& sheet) noexcept;

/// The same with the separation d = p - c given from the body's centre to a point of the plane, in
/// place of centre and offset: for periodic images.
/// @param body  the body
/// @param wall  the wall
/// @param separation  finite
WallGap signed_gap(const Ellipsoid& body, const Plane& wall, const Vec3& separation) noexcept;
/// @overload
WallGap signed_gap(const Ellipsoid& body, const Sheet& sheet, const Vec3& separation) noexcept;

/// Of a body given in any form: the answer of MatrixEllipsoid::ellipsoid() with its rounding in
/// gap_error, and the sign of the exact relation. Allocates where that is decided exactly.
WallGap signed_gap(const MatrixEllipsoid& body, const Plane& wall) noexcept;
/// @overload
WallGap signed_gap(const MatrixEllipsoid& body, const Sheet& sheet) noexcept;

/// How a body lies to a solid wall, as point sets, exact for the stored doubles: separate,
/// external_touch, overlap, internal_touch (inner is then a) or a_in_b. Allocates where the double-
/// double numbers of signed_gap() leave a doubt, and then takes some 10 us.
RelationAnswer relation(const MatrixEllipsoid& body, const Plane& wall) noexcept;
/// To a wall without thickness: separate, external_touch, or overlap where it cuts the interior.
RelationAnswer relation(const MatrixEllipsoid& body, const Sheet& sheet) noexcept;

}  // namespace tangency::inline v0
