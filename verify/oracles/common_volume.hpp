// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: the volume that two ellipsoids have in common, and its derivative by d = c_B - c_A, for
/// the stored doubles.
///
///  (1) `common_volume`: the larger body is made a ball (the kernel makes the smaller one so), and
///      planes cut both in circles. The heights are divided where circles touch, where the
///      discriminant of their crossing turns, and where their centres are nearest; between these
///      the area is integrated by the tanh-sinh rule in 80 digits.
///  (2) `common_volume_by_rays`: from a point inside both, a third of the integral of the cube of
///      the distance to the nearer boundary over all directions. Shares nothing with (1).
#pragma once

#include <array>

#include <tangency/verify/oracles/plain_bodies.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

struct CommonVolumeTruth {
  Real volume;
  Real3 gradient;  ///< in space
};

/// To 1e-20 of the smaller volume, and of the area of a section of it for the gradient; of thin
/// lenses to 1e-12 of their own. Throws std::invalid_argument unless both are ellipsoids.
CommonVolumeTruth common_volume(const RawEllipsoid& a, const RawEllipsoid& b);

/// In double, by so many midpoints along half a great circle, and twice as many around, of bodies
/// whose interiors meet: to some 10 / steps^2 of itself for moderate shapes.
double common_volume_by_rays(const RawEllipsoid& a, const RawEllipsoid& b, int steps);

}  // namespace tangency::inline v0::verify
