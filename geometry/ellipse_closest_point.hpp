// SPDX-License-Identifier: MIT
/// @file
/// The point of an ellipse's boundary that is closest to a given point, and the signed distance:
/// the plane's counterpart of closest_point.hpp, by the same definition,
///
///     s(p) = max over unit n of [ n . (p - c) - h(n) ],
///
/// with the same identities:
///
/// (1) The closest point of a boundary point is itself, at distance 0.
/// (2) |s(p) - s(q)| <= |p - q|.
/// (3) point = centre + arm + distance * normal.
/// (4) A common rotation or translation leaves the distance; normal and arm go with it.
/// (5) A common scaling scales distance and arm and leaves the normal.
#pragma once

#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/matrix_ellipse.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0 {

/// The point of an ellipse that is nearest to a given point.
struct PlaneClosestPoint {
  double distance;        ///< signed, < 0 inside, in the unit of length of the ellipse
  Vec2 normal;            ///< unit, the outer normal of the boundary at the closest point
  Vec2 arm;               ///< closest point - centre
  double distance_error;  ///< proven: |distance - true distance| is at most this
  GapStatus status;       ///< ok: the least distance is always found
};

/// Any finite point and any semi-axes. With L = |p - c| + larger semi-axis and u = 2^-53 the
/// numbers are as near to the true ones as those of closest_point.hpp: distance_error is 2 u
/// |distance| + 2^-80 L (docs/derivations/primitives.md, section 3), the arm within 2 u |arm| +
/// 2^-80 L of a point of the boundary that is closest to a point within 2^-80 L of p.
///
/// On the longer axis, nearer to the centre than the centres of curvature of its ends, two points
/// tie: it is the one on the positive side of the shorter axis. At the centre of a circle all
/// tie: it is the end of the first axis. Points turned off that axis by rounding are not on it.
///
/// The distance is infinite where the true one is beyond the range of doubles.
PlaneClosestPoint closest_point(const Ellipse& body, const Vec2& point) noexcept;

/// Of an ellipse given by a matrix: the answer of MatrixEllipse::ellipse(), with its rounding in
/// distance_error.
PlaneClosestPoint closest_point(const MatrixEllipse& body, const Vec2& point) noexcept;

/// With the separation d = p - c given, in place of point and centre: for periodic images.
/// @param body  the body
/// @param separation  finite
PlaneClosestPoint closest_point_from_centre(const Ellipse& body, const Vec2& separation) noexcept;

}  // namespace tangency::inline v0
