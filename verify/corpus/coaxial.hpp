// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: the signed gap of two spheroids about one common axis, and all normals that reach it.
///
/// About the axis u, towards B, with n.u = x, p polar and e equatorial semi-axes, D = |d|:
///
///     f(x) = D x - sqrt(e_A^2 + k_A x^2) - sqrt(e_B^2 + k_B x^2),   k = p^2 - e^2.
///
///  (1) f(x) - f(-x) = 2 D x, so x >= 0 has a maximum.
///  (2) f'' = -k_A e_A^2/h_A^3 - k_B e_B^2/h_B^3 is zero for all x, or at no more than one x > 0,
///      where h_A^2/h_B^2 = (-k_A e_A^2 / (k_B e_B^2))^(2/3).
///  (3) So on either side of that x f is concave, and has one maximum, or convex, and has it at an
///      end: the greatest of at most four values, each found by bisection of f' in 150 digits.
#pragma once

#include <optional>
#include <vector>

#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

struct CoaxialGap {
  Real gap;
  Real3 axis;                 ///< unit, from A to B; either way round where the centres coincide
  std::vector<Real> cosines;  ///< n.axis of every maximiser, descending
  bool every_normal;          ///< concentric spheres: no normal is better than another
};

/// Nothing unless both bodies turn into themselves about one common axis. Requires a and b as
/// separation() does; not two spheres apart from each other, which signed_gap() answers as well.
std::optional<CoaxialGap> coaxial_gap(const RealEllipsoid& a, const RealEllipsoid& b);

}  // namespace tangency::inline v0::verify
