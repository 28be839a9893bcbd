// SPDX-License-Identifier: MIT
/// @file
/// Where a ray, a segment or a line meets the surface of an ellipsoid.
///
/// (1) origin + t direction = centre + arm at every point returned.
/// (2) Reversing the direction negates t and exchanges the points.
/// (3) A direction s times as long divides t by s and changes nothing else.
/// (4) Moving the origin along the line shifts t.
/// (5) Whether a point is in the interval is exact: t_begin and t_end are those of the stored
///     doubles, and an end that is exactly a hit's t is returned as that.
/// (6) A body given by axes and the same given by its shape matrix have the same hits, where the
///     matrix is exact.
#pragma once

#include <limits>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>

namespace tangency::inline v0 {

/// A line with a direction, which need not be a unit vector.
struct Ray {
  Vec3 origin;     ///< finite
  Vec3 direction;  ///< finite, of any length but 0 (asserted)
};

/// How a ray and a body lie.
enum class RayStatus {
  miss,     ///< no point of the surface in the interval
  hit,      ///< one or two points
  grazing,  ///< the line touches the surface in one point, exactly, which is in the interval
};

/// A point where a ray meets a surface.
struct SurfacePoint {
  double t;     ///< origin + t direction, in the direction's own length
  Vec3 arm;     ///< the point relative to the ellipsoid's centre
  Vec3 normal;  ///< unit, outwards
};

/// The points of the surface on the ray, by increasing t.
struct RayHit {
  RayStatus status;        ///< exact
  int count;               ///< how many of the points there are: 0, 1 or 2
  SurfacePoint points[2];  ///< the first is the first hit; those beyond count are zero
};

/// Intersects the surface with origin + t direction, t_begin <= t <= t_end: a ray without further
/// arguments, a segment or, from -infinity, a line. An origin inside has one hit, where the ray
/// leaves; one exactly on the surface is a hit at t = 0, and may have another ahead.
///
/// With L = |origin - c| + largest semi-axis, u = 2^-53, e = direction / |direction|, for any
/// semi-axes, in any floating-point environment (docs/derivations/primitives.md, section 4):
///
/// - hit, miss or touch, and what lies in the interval, is exact for the stored doubles: decided in
///   double-double with a bound of its error, and in exact integers where that does not do, which
///   allocates.
/// - arm is within 8 u L of the surface and of the line; t |direction| is within 2 u |t direction|
///   + 2^-80 L / k of the true one where k = |n . e| > 2^-30, and the arm as near to the true hit.
///   Nearer to tangency t loses accuracy as the problem does: a change of the body by x moves the
///   hit by x / k.
///
/// t is infinite where the true one is beyond the range of doubles.
/// @param body  the body
/// @param ray  origin and direction
/// @param t_begin, t_end  t_begin <= t_end; infinities allowed, NaN not (asserted)
RayHit intersect(const Ellipsoid& body, const Ray& ray, double t_begin = 0.0,
                 double t_end = std::numeric_limits<double>::infinity()) noexcept;

/// Of a body given by a matrix: status, interval and t are those of its numbers as they were given,
/// decided in exact integers; arms are relative to the centre of MatrixEllipsoid::ellipsoid().
RayHit intersect(const MatrixEllipsoid& body, const Ray& ray, double t_begin = 0.0,
                 double t_end = std::numeric_limits<double>::infinity()) noexcept;

/// With the separation d = origin - c given, in place of origin and centre: for periodic images.
/// @param body  the body
/// @param direction  not zero, of any length
/// @param t_begin  where the interval of the line begins
/// @param t_end  where the interval of the line ends
/// @param separation  finite
RayHit intersect_from_centre(const Ellipsoid& body, const Vec3& separation, const Vec3& direction,
                             double t_begin = 0.0,
                             double t_end = std::numeric_limits<double>::infinity()) noexcept;

}  // namespace tangency::inline v0
