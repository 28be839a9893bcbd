// SPDX-License-Identifier: MIT
/// @file
/// Two ellipsoids in a frame in which parallel planes cut both of them in circles. Internal.
///
/// The first body becomes the unit ball, whose sections are circles in any direction; the second
/// stays an ellipsoid, which has circular sections normal to a direction in the plane of its
/// longest and shortest axes. With z along that direction a section at height z is
///
///     of the ball      the circle of radius^2  1 - z^2                about 0,
///     of the second    the circle of radius^2  beta - mu (z - z0)^2   about (x0 + tau (z - z0),
///     y0),
///
/// in the unit of the first body's semi-axes: docs/derivations/common-volume.md, section 2.
///
/// T is the arithmetic: DoubleDouble, or WideFloat where needles and plates meet whose sections are
/// larger than the ball by more than double-double can tell.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/vector3.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::detail {

template <class T>
struct CircularSections {
  T beta, mu, z0;
  T half_height;  ///< of the second body: sqrt(beta / mu)
  T x0, tau, y0;
  Mat3 frame;  ///< unit vectors along x, y and z in its columns, in the ball's body axes

  // How far the two solids of these very numbers may be from the true ones: each true body lies
  // between its own, larger and smaller about its centre by `distortion`, with the second body's
  // centre off by `shift`. Proven, section 3.
  double distortion;
  double shift;
  double centre_distance;  ///< of the second body's centre from the ball's
  double steepness;        ///< one over the second body's shortest semi-axis

  /// How much these may change the volume, over the surface of the common region.
  double layer() const noexcept;
  /// How much they may change q1 = D + r_1^2 - r_2^2 on the surface of the ball.
  double level_error() const noexcept;
};

/// Requires bodies in one unit, both thick_enough(). Numbers are not finite where something
/// overflows on the way.
/// @param d  from the centre of the first to that of the second
template <class T>
CircularSections<T> circular_sections(const Ellipsoid& first, const Ellipsoid& second,
                                      const Vector3<T>& d) noexcept;

}  // namespace tangency::inline v0::detail
