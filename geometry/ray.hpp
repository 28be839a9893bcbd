// SPDX-License-Identifier: MIT
/// @file
/// Where a ray, a segment or a line meets the surface of an ellipsoid.
///
/// (1) origin + t direction = centre + arm at every point returned.
/// (2) Reversing the direction negates t and exchanges the points.
/// (3) A direction s times as long divides t by s and changes nothing else.
/// (4) Moving the origin along the line shifts t.
#pragma once

#include <limits>

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency {

struct Ray {
  Vec3 origin;     ///< finite
  Vec3 direction;  ///< finite, of any length but 0 (asserted)
};

enum class RayStatus {
  miss,     ///< no point of the surface in the interval
  hit,      ///< one or two points
  grazing,  ///< the whole line touches the surface, or misses or cuts it by less than can be told
};

struct SurfacePoint {
  double t;     ///< origin + t direction, in the direction's own length
  Vec3 arm;     ///< the point relative to the ellipsoid's centre
  Vec3 normal;  ///< unit, outwards
};

/// The points of the surface on the ray, by increasing t.
struct RayHit {
  RayStatus status;
  int count;               ///< how many of the points there are: 0, 1 or 2
  SurfacePoint points[2];  ///< the first is the first hit; those beyond count are zero
};

/// Intersects the surface with origin + t direction, t_begin <= t <= t_end: a ray without further
/// arguments, a segment or, from -infinity, a line. An origin inside has one hit, where the ray
/// leaves; one on the surface counts as a hit at t = 0 where the exact t rounds to 0.
///
/// With L = |origin - c| + largest semi-axis, u = 2^-53, e = direction / |direction|, semi-axes of
/// at least 2^-200 L, in any floating-point environment (docs/derivations/primitives.md,
/// section 4):
///
/// - hit or miss is decided in double-double with a bound of its error and is never wrong.
/// `grazing`
///   is what it cannot decide: on such a line the least of the level |diag(1/a) R'(x - c)|^2 is
///   within 2^-90 L / smallest semi-axis of 1. One point is returned for it, that of the least
///   level, if it is in the interval.
/// - arm is within 8 u L of the surface and of the line; t |direction| is within 2 u |t direction|
///   + 2^-80 L / k of the true one where k = |n . e| > 2^-30, and the arm as near to the true hit.
///   Nearer to tangency t loses accuracy as the problem does: a change of the body by x moves the
///   hit by x / k.
///
/// t is infinite where the true one is beyond the range of doubles.
/// @param t_begin, t_end  t_begin <= t_end; infinities allowed, NaN not (asserted)
RayHit intersect(const Ellipsoid& body, const Ray& ray, double t_begin = 0.0,
                 double t_end = std::numeric_limits<double>::infinity()) noexcept;

}  // namespace tangency
