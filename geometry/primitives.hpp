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
#pragma once

#include <tangency/geometry/gap.hpp>

namespace tangency {

struct Sphere {
  Vec3 centre;    ///< finite
  double radius;  ///< finite, >= 0: a point is a sphere
};

/// A wall: the solid half-space { x : normal . x <= offset }. The normal points out of the wall.
struct Plane {
  Vec3 normal;    ///< finite, of any length but 0
  double offset;  ///< finite, in units of normal . x: the distance from the origin times |normal|
};

/// Two spheres: |d| - r_A - r_B, n along d; n = (1, 0, 0) where the centres coincide. `ok`.
Gap signed_gap(const Sphere& a, const Sphere& b) noexcept;

/// A sphere and an ellipsoid: the signed distance of the sphere's centre from the ellipsoid, less
/// the radius. The global answer however deep the overlap, so `ok`; ties as in closest_point.hpp.
Gap signed_gap(const Sphere& a, const Ellipsoid& b) noexcept;
Gap signed_gap(const Ellipsoid& a, const Sphere& b) noexcept;

/// An ellipsoid and a wall. Both arms are relative to the ellipsoid's centre, the wall having none.
struct WallGap {
  double gap;   ///< (normal . c - offset) / |normal| - h: < 0 where the body reaches into the wall
  Vec3 normal;  ///< unit, from the body to the wall: against the plane's normal
  Vec3 arm_body;  ///< the point of the body that reaches furthest towards the wall
  Vec3 arm_wall;  ///< the point of the plane opposite to it: arm_body + gap * normal
};
/// The gap's bound gains 2^-98 (|centre| + |offset| / |normal|), for walls far from the origin.
WallGap signed_gap(const Ellipsoid& body, const Plane& wall) noexcept;

}  // namespace tangency
