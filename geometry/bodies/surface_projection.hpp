// SPDX-License-Identifier: MIT
/// @file
/// A point seen from an ellipsoid's centre, and the point of the surface closest to it, in
/// double-double: for answers each of whose numbers is rounded once.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/double_double.hpp>

namespace tangency::inline v0::detail {

/// A body and a point seen from its centre, in units of 2^exponent: the largest of the semi-axes
/// and of the separation's components in [1, 4). A semi-axis below kThinnestAxisSeen of that is
/// taken for it.
struct SeenFromCentre {
  Vec3 semi_axes;
  DoubleDoubleVector separation;  ///< point - centre, exactly
  int exponent;
};

/// @param separation  point - centre, in units of 2^shift times that of the body
SeenFromCentre seen_from_centre(const Ellipsoid& body, const DoubleDoubleVector& separation,
                                int shift = 0) noexcept;
SeenFromCentre seen_from_centre(const Ellipsoid& body, const Vec3& point) noexcept;

/// In the frame of the axes.
struct SurfaceProjection {
  DoubleDouble distance;      ///< signed, < 0 inside
  DoubleDoubleVector normal;  ///< unit, outwards
  DoubleDoubleVector point;   ///< on the surface
};

/// @param semi_axes  in [2^-200, 4)
/// @param from       in the frame of the axes, components below 8; below 2^-300 they are taken for
/// 0
///
/// With y = from and k the smallest axis, w_i = (x_i / a_i) solves |w| = 1 for
///     w_i = r_i y_i / (t + f_i),  r_i = a_i / a_k,  f_i = (a_i - a_k) (r_i + 1) >= 0,  t >= 0,
/// which is Eberly's equation [Eberly2013] with its pole at the smallest axis moved to t = 0: no
/// difference is formed of numbers that are not stored, inside or outside. 1/|w| is concave and
/// grows with t, so that Newton's method on it climbs to the root from below [MoreSorensen1983].
SurfaceProjection project_on_surface(const Vec3& semi_axes,
                                     const DoubleDoubleVector& from) noexcept;

/// The same in space.
struct ClosestOnSurface {
  DoubleDouble distance;  ///< signed, < 0 inside, in units of 2^exponent
  Vec3 normal;            ///< unit, outwards
  Vec3 arm;               ///< of the point from the centre, in the unit of the body
};

/// @param seen  the point, as seen_from_centre() of this body has it
ClosestOnSurface closest_on_surface(const Ellipsoid& body, const SeenFromCentre& seen) noexcept;

/// L of the headers: |p - c| + largest semi-axis, in units of 2^exponent.
double size_of(const SeenFromCentre& seen) noexcept;

/// What the headers promise of a distance, 2 u |distance| + 2^-80 L, in the unit of the body.
/// @param distance, size  rounded once; L; in units of 2^exponent
double error_of_distance(double distance, double size, int exponent) noexcept;

}  // namespace tangency::inline v0::detail
