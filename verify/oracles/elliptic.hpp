// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Elliptic integrals and functions through GSL, in double. The parameter is m = k^2 throughout;
/// what is complementary to it, 1 - m, is formed here, exactly for m >= 1/2.
///
///  (1) E(m) K(1-m) + E(1-m) K(m) - K(m) K(1-m) = pi/2 (Legendre).
///  (2) K - E = m D.
///  (3) sn^2 + cn^2 = 1 and dn^2 + m sn^2 = 1; sn, cn have the period 4 K, dn has 2 K.
///  (4) sn(F(phi)) = sin phi; F and E to pi/2 are K and E.
///  (5) A perimeter and a surface do not depend on the order of the semi-axes, and grow as length
///      and as length squared.
#pragma once

#include <array>

namespace tangency::inline v0::verify {

/// From 0 to pi/2, of (1 - m sin^2)^(-1/2), of (1 - m sin^2)^(1/2) and of sin^2 (1 - m
/// sin^2)^(-1/2), each to 1e-15 of itself (D too where m is small, where (K - E) / m is not). Throw
/// std::invalid_argument unless m < 1; E has m = 1 too.
double complete_elliptic_k(double m);
double complete_elliptic_e(double m);
double complete_elliptic_d(double m);

/// The first two from 0 to phi. Throw std::invalid_argument unless |phi| <= pi/2 and m < 1.
double incomplete_elliptic_f(double phi, double m);
double incomplete_elliptic_e(double phi, double m);

struct JacobiElliptic {
  double sn, cn, dn;
};

/// Each to 2e-15 max(1, |u|). Throws std::invalid_argument unless 0 <= m <= 1.
JacobiElliptic jacobi_elliptic(double u, double m);

/// Throw std::invalid_argument unless all semi-axes are finite and > 0.
double ellipse_perimeter(const std::array<double, 2>& semi_axes);
double ellipsoid_surface(const std::array<double, 3>& semi_axes);

}  // namespace tangency::inline v0::verify
