// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/elliptic.hpp>

#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace tangency::inline v0::verify {
namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;

// Carlson's symmetric integrals. GSL's own K and E take k and lose 1 - k^2 where it is small.
double rf(double x, double y, double z) { return gsl_sf_ellint_RF(x, y, z, GSL_PREC_DOUBLE); }
double rd(double x, double y, double z) { return gsl_sf_ellint_RD(x, y, z, GSL_PREC_DOUBLE); }

void require(bool allowed, const char* rule) {
  if (!allowed) throw std::invalid_argument(rule);
}

void require_semi_axes(std::span<const double> semi_axes) {
  require(std::ranges::all_of(semi_axes, [](double r) { return std::isfinite(r) && r > 0; }),
          "a semi-axis must be finite and > 0");
}

struct Amplitude {
  double s, c2, delta2;  // sin phi, cos^2 phi, 1 - m sin^2 phi
};

Amplitude amplitude(double phi, double m) {
  require(std::abs(phi) <= kPi / 2 && m < 1, "an incomplete integral needs |phi| <= pi/2, m < 1");
  const double s = std::sin(phi), c = std::cos(phi);
  return {s, c * c, c * c + (1 - m) * s * s};
}

}  // namespace

double complete_elliptic_k(double m) {
  require(m < 1, "K(m) needs m < 1");
  return rf(0, 1 - m, 1);
}

double complete_elliptic_e(double m) {
  require(m <= 1, "E(m) needs m <= 1");
  if (m == 1) return 1;
  // A sum of positive terms, unlike K - m D.
  return (1 - m) / 3 * (rd(0, 1 - m, 1) + rd(0, 1, 1 - m));
}

double complete_elliptic_d(double m) {
  require(m < 1, "D(m) needs m < 1");
  return rd(0, 1 - m, 1) / 3;
}

double incomplete_elliptic_f(double phi, double m) {
  const Amplitude at = amplitude(phi, m);
  return at.s * rf(at.c2, at.delta2, 1);
}

double incomplete_elliptic_e(double phi, double m) {
  const Amplitude at = amplitude(phi, m);
  return at.s * (rf(at.c2, at.delta2, 1) - m / 3 * at.s * at.s * rd(at.c2, at.delta2, 1));
}

JacobiElliptic jacobi_elliptic(double u, double m) {
  require(m >= 0 && m <= 1 && std::isfinite(u), "sn(u, m) needs 0 <= m <= 1 and a finite u");
  JacobiElliptic value{};
  gsl_sf_elljac_e(u, m, &value.sn, &value.cn, &value.dn);
  return value;
}

double ellipse_perimeter(const std::array<double, 2>& semi_axes) {
  require_semi_axes(semi_axes);
  const auto [b, a] = std::minmax(semi_axes[0], semi_axes[1]);
  return 4 * a * complete_elliptic_e((a - b) / a * ((a + b) / a));
}

double ellipsoid_surface(const std::array<double, 3>& semi_axes) {
  require_semi_axes(semi_axes);
  std::array<double, 3> r = semi_axes;
  std::ranges::sort(r);
  // 4 pi R_G of the squared products of two axes, in units of the largest, where
  // 2 R_G(x,y,z) = z R_F - (x-z)(y-z) R_D / 3 + sqrt(xy/z); with the middle one as z all terms are
  // positive.
  const double c = r[0] / r[2], b = r[1] / r[2];
  const double x = b * b * c * c, y = b * b, z = c * c;
  const double g = z * rf(x, y, z) + (z - x) * (y - z) / 3 * rd(x, y, z) + b * b;
  return 2 * kPi * g * r[2] * r[2];
}

}  // namespace tangency::inline v0::verify
