// SPDX-License-Identifier: MIT
/// @file
/// The point of an ellipsoid's surface that is closest to a given point, and the signed distance:
///
///     s(p) = max over unit n of [ n . (p - c) - h(n) ],
///
/// which is the distance from the solid for a point outside and minus the distance from the surface
/// for a point inside: the gap of gap.hpp with a body that is a single point.
///
/// (1) The closest point of a surface point is itself, at distance 0.
/// (2) |s(p) - s(q)| <= |p - q|.
/// (3) point = centre + arm + distance * normal.
/// (4) A common rotation or translation leaves the distance; normal and arm go with it.
/// (5) A common scaling scales distance and arm and leaves the normal.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0 {

/// The point of a body's surface that is nearest to a given point.
struct ClosestPoint {
  double distance;        ///< signed, < 0 inside, in the unit of length of the body
  Vec3 normal;            ///< unit, the outer normal of the surface at the closest point
  Vec3 arm;               ///< closest point - centre
  double distance_error;  ///< proven: |distance - true distance| is at most this
  GapStatus status;       ///< ok: the least distance is always found
};

/// Any finite point: at the centre, on an axis, on the surface, far away. With L = |p - c| +
/// largest semi-axis and u = 2^-53, semi-axes at least 2^-200 L:
///
/// - distance is within 2 u |distance| + 2^-80 L of the true one, so its sign is right but for
///   points within 2^-80 L of the surface (docs/derivations/primitives.md, section 3). This, with
///   what is below 2^-1073, is distance_error, which holds for thinner semi-axes too;
/// - arm is within 2 u |arm| + 2^-80 L of a point of the surface that is closest to a point within
///   2^-80 L of p. Outside, that is as near to the true closest point; inside, near the focal set
///   where closest points jump, it is one whose distance from p is the least within the same bound.
///
/// On the focal set several points tie: in the symmetry plane across the smallest semi-axis, nearer
/// to the centre than the focal curve, it is the one on the positive side of that body axis. (Of
/// equal smallest semi-axes the first.) Points turned out of that plane by rounding are not on it.
///
/// The distance is infinite where the true one is beyond the range of doubles.
ClosestPoint closest_point(const Ellipsoid& body, const Vec3& point) noexcept;

/// Of a body given by a matrix: the answer of MatrixEllipsoid::ellipsoid(), with its rounding in
/// distance_error.
ClosestPoint closest_point(const MatrixEllipsoid& body, const Vec3& point) noexcept;

/// With the separation d = p - c given, in place of point and centre: for periodic images. A name
/// of its own, as intersect_from_centre() has: a point and a separation are both three numbers.
/// @param body  the body
/// @param separation  finite
ClosestPoint closest_point_from_centre(const Ellipsoid& body, const Vec3& separation) noexcept;
/// @overload
ClosestPoint closest_point_from_centre(const MatrixEllipsoid& body,
                                       const Vec3& separation) noexcept;

}  // namespace tangency::inline v0
