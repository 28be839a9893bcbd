// SPDX-License-Identifier: MIT
/// @file
/// The point of an ellipsoid's surface closest to a given point, in the frame of its axes and in
/// double-double.
#pragma once

#include <tangency/geometry/bodies/double_double_body.hpp>

namespace tangency::detail {

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

}  // namespace tangency::detail
