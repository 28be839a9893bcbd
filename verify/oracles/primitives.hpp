// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: ellipsoids against points, lines and planes, in 120 decimal digits (MPFR) for the stored
/// doubles. Vectors are in space and relative to the body's centre unless said otherwise.
///
/// (1) `nearest`: x is the point of the surface with grad(x) parallel to p - x and the multiplier t
///     above -a_min^2, which makes it the closest of all surface points, inside as outside:
///     p = x + t diag(1/a^2) x, and for any surface point z
///     |p - z|^2 - |p - x|^2 = (x - z)'(I + t diag(1/a^2))(x - z) >= 0.
/// (2) `line`: the roots of the quadratic |diag(1/a) R'(o + t e)|^2 = 1.
/// (3) `wall`: the support function.
/// (4) `plane_distance`: of the quarter of the ellipse on the point's side of both axes, where the
///     only foot of a normal through the point that can be closest lies, by bisection of its angle.
#pragma once

#include <boost/multiprecision/mpfr.hpp>

#include <array>

#include <tangency/verify/oracles/ellipse.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

using Digits120 = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<120>,
                                                boost::multiprecision::et_off>;
using Vector120 = std::array<Digits120, 3>;

Digits120 dot(const Vector120& a, const Vector120& b);
Digits120 length(const Vector120& v);
Vector120 minus(const Vector120& a, const Vector120& b);
Vector120 exact(const std::array<double, 3>& v);
Vector120 from_centre(const RawEllipsoid& body, const std::array<double, 3>& point);

struct NearestTruth {
  Digits120 distance;  ///< signed, < 0 inside
  Vector120 point, normal;
  Digits120 multiplier;  ///< t of (1)
};
NearestTruth nearest(const RawEllipsoid& body, const Vector120& point);

struct LineTruth {
  Digits120 discriminant;  ///< relative to |diag(1/a) R'e|^2: 1 - (least level along the line)
  Digits120 t[2];          ///< where it is >= 0, by increasing t
};
LineTruth line(const RawEllipsoid& body, const Vector120& origin, const Vector120& direction);

struct WallTruth {
  Digits120 gap, centre_distance;
  Vector120 point;  ///< the body's
};
/// The half-space normal . x <= offset, in space.
WallTruth wall(const RawEllipsoid& body, const std::array<double, 3>& normal, double offset);

/// The signed distance of a point from an ellipse in the plane, < 0 inside.
Digits120 plane_distance(const RawEllipse& body, const std::array<double, 2>& point);

}  // namespace tangency::inline v0::verify
