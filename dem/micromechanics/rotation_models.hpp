// SPDX-License-Identifier: MIT
/// @file
/// How much of the anisotropy of contact normals comes from that of the bodies' axes, if where a
/// body is touched does not depend on how it lies [Ouadfel1998, sections 7.3 and 7.4].
///
/// gamma is the angle of the contact normal to the axis of symmetry u (in the plane: to the long
/// axis), beta that of the contact vector; means are over contact sides. Then, in the plane and in
/// space (the addition theorem of harmonics; U = <uu>, ' the deviator, S4 the part of order 4),
///
///   plane   <nn>' = <cos 2 gamma> U'
///   space   <nn>' = <P2(cos gamma)> U',    S4 <nnnn> = <P4(cos gamma)> S4 <uuuu>
///
/// so that a^r_rot = factor a^E, as tensors: for long bodies the factor is negative, to -1 for
/// needles in the plane and -1/2 in space; for flat disks in space it is up to 1. The published
/// plane relation counts a^r across the long axes as positive: minus this factor.
/// Closed forms, to 1e-12 for aspect ratios from 1e-4 to 1e4, at the sphere too. Functions keep no
/// state: any number of threads may call. Errors are those of spheroid.hpp.
#pragma once

#include <tangency/dem/micromechanics/spheroid.hpp>

namespace tangency::inline v0::micromechanics {

/// Plane: a^r_rot/a^E = c1 + a_l c2, with signs as published, of contact vectors that have the
/// density (1/2 pi)(1 + a_l cos 2 beta) (eq. 7.46-7.47). `along` is the long semi-axis.
struct PlaneRotation {
  double c1 = 0.0, c2 = 0.0;  ///< coefficients of the model

  /// At an anisotropy a_l of the long axes.
  double factor(double a_l) const { return c1 + a_l * c2; }
};
/// (1) equals its integrals; c1 = (k-1)/(k+1), c2 = -2k/(k+1)^2, k = (along/across)^2
PlaneRotation plane_rotation(const Spheroid& ellipse);

/// Contacts equally dense on the ellipse's arc: their density over beta (eq. 7.51), and its a_l.
double arc_law_density(const Spheroid& ellipse, double beta);
/// (2) equals quadrature of 2 times the integral of arc_law_density cos 2 beta
double arc_law_anisotropy(const Spheroid& ellipse);
/// The published ways to the same number, on `points` angles (i + 1/2) 2 pi/points: as an integral
/// (eq. 7.52), and by least squares (eq. 7.53).
/// @param ellipse  its semi-axes
/// @param points  at least 3, else std::invalid_argument
///
/// (3) the two are one number but for rounding
double arc_law_anisotropy_by_integral(const Spheroid& ellipse, int points);
/// By least squares over `points` angles.
double arc_law_anisotropy_by_least_squares(const Spheroid& ellipse, int points);

/// What tensors of order 2 and 4 of axes are multiplied by.
struct RotationFactors {
  double second = 0.0;  ///< <P2(cos gamma)>
  double fourth = 0.0;  ///< <P4(cos gamma)>
};

/// Space, of contact vectors with the density (1/4 pi)(1 + a1 P2(cos beta)): <P2> = c1 + a1 c2,
/// <P4> = d1 + a1 d2.
struct SpaceRotation {
  double c1 = 0.0, c2 = 0.2;  ///< coefficients of the factor of second order
  double d1 = 0.0, d2 = 0.0;  ///< coefficients of the factor of fourth order

  /// Both factors at an anisotropy a1.
  RotationFactors factors(double a1) const { return {c1 + a1 * c2, d1 + a1 * d2}; }
};
/// (4) equals its integrals; of a sphere the factors are a1/5 and 0, of needles -1/2 and 3/8, of
///     disks 1 and 1
SpaceRotation space_rotation(const Spheroid& s);

/// Of contacts equally dense on the surface. Their density over beta has all orders: this is not
/// quite space_rotation with area_law_a1.
///
/// (5) equals quadrature over the surface
RotationFactors rotation_by_area(const Spheroid& s);

}  // namespace tangency::inline v0::micromechanics
