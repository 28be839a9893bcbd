// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/rotation_models.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <tangency/dem/micromechanics/harmonics.hpp>

#include "spheroid_integrals.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

using std::numbers::pi;

/// Means over all beta of cos^2 gamma and cos^4 gamma, and of each times cos^2 beta.
struct Moments {
  double square = 0.0, square_weighted = 0.0, fourth = 0.0, fourth_weighted = 0.0;
};

/// With x = cos beta: cos^2 gamma = (x/k)^2/(1 - m x^2), m = 1 - 1/k^2.
Moments moments_near_sphere(double k, double m) {
  // The integral of x^(2 p) (1 - m x^2)^(-order), order 1 or 2.
  const auto integral = [m](int p, int order) {
    double power = 1.0;
    return series([&, power](int n) mutable {
      const double term = power * (order == 2 ? n + 1 : 1) / (2 * p + 2 * n + 1);
      power *= m;
      return term;
    });
  };
  const double k2 = k * k;
  return {integral(1, 1) / k2, integral(2, 1) / k2, integral(2, 2) / (k2 * k2),
          integral(3, 2) / (k2 * k2)};
}

Moments moments_of(const Spheroid& s) {
  const double k = s.along / s.across * (s.along / s.across);
  const double q = kappa_of(s.across / s.along) * k * (k + 1.0);  // k^2 - 1
  const double m = q / (k * k);
  if (std::abs(m) < kSeries) return moments_near_sphere(k, m);
  // The integral of 1/(1 - m x^2), and what partial fractions make of it.
  const double base = k * (q > 0.0 ? std::acosh(k) : std::acos(k)) / std::sqrt(std::abs(q));
  Moments found;
  found.square = (base - 1.0) / q;
  found.square_weighted = (k * k * found.square - 1.0 / 3.0) / q;
  found.fourth = (0.5 * (k * k - base) / q - found.square) / q;
  found.fourth_weighted = (k * k * found.fourth - found.square_weighted) / q;
  return found;
}

}  // namespace

PlaneRotation plane_rotation(const Spheroid& ellipse) {
  require_sound(ellipse);
  const double ratio = ellipse.across / ellipse.along, w = ratio * ratio;  // 1/k
  if (w > 1.0) {
    const PlaneRotation turned = plane_rotation({ellipse.across, ellipse.along});
    return {-turned.c1, turned.c2};
  }
  return {kappa_of(ratio) / (1.0 + w), -2.0 * w / ((1.0 + w) * (1.0 + w))};
}

double arc_law_density(const Spheroid& ellipse, double beta) {
  const double length = contact_length(ellipse, beta);
  const double a = ellipse.along, b = ellipse.across, longest = std::fmax(a, b);
  const double modulus = std::sqrt(kappa_of(std::fmin(a, b) / longest));
  const double circumference = 4.0 * longest * std::comp_ellint_2(modulus);
  return std::hypot(std::cos(beta) / (a * a), std::sin(beta) / (b * b)) * length * length * length /
         circumference;
}

double arc_law_anisotropy(const Spheroid& ellipse) {
  require_sound(ellipse);
  if (ellipse.across > ellipse.along) return -arc_law_anisotropy({ellipse.across, ellipse.along});
  const double ratio = ellipse.across / ellipse.along, w = ratio * ratio;
  const double m = kappa_of(ratio), modulus = std::sqrt(m);
  const double second = std::comp_ellint_2(modulus);
  if (m >= kSeries) {
    const double first = std::comp_ellint_1(modulus);
    const double third = std::comp_ellint_3(modulus, -m / w);
    return 2.0 / m * ((2.0 - m) - 2.0 * ((2.0 - m) * third - w * first) / second);
  }
  // In sigma = sin^2 t, t the eccentric angle: the mean of (1 - (1 + w) sigma)/(1 - m sigma)
  // sqrt(1 + (m/w) sigma), a power series times the means of powers of sigma.
  double coefficient = 0.0, root = 1.0, mean = 1.0;
  const double sum = series([&](int n) {
    if (n > 0) {
      root *= (1.5 - n) / n * (m / w);
      mean *= (2.0 * n - 1.0) / (2.0 * n);
    }
    coefficient = m * coefficient + root;
    return coefficient * mean * (m * (2 * n + 1) - 2 * n) / (2 * n + 2);
  });
  return pi * std::sqrt(w) * sum / second;
}

namespace {

template <typename Visit>
void for_angles(int points, Visit visit) {
  if (points < 3)
    throw std::invalid_argument("points = " + std::to_string(points) + ": must be at least 3");
  for (int i = 0; i < points; ++i) visit(2.0 * pi * (i + 0.5) / points);
}

}  // namespace

double arc_law_anisotropy_by_integral(const Spheroid& ellipse, int points) {
  double sum = 0.0;
  for_angles(points,
             [&](double beta) { sum += arc_law_density(ellipse, beta) * std::cos(2.0 * beta); });
  return 2.0 * sum * (2.0 * pi / points);
}

double arc_law_anisotropy_by_least_squares(const Spheroid& ellipse, int points) {
  double product = 0.0, square = 0.0;
  for_angles(points, [&](double beta) {
    const double c = std::cos(2.0 * beta);
    product += c * (1.0 - 2.0 * pi * arc_law_density(ellipse, beta));
    square += c * c;
  });
  return -product / square;
}

SpaceRotation space_rotation(const Spheroid& s) {
  require_sound(s);
  const Moments mean = moments_of(s);
  // The part with a1: P2(cos beta) = (3 cos^2 beta - 1)/2 times.
  const double square = 1.5 * mean.square_weighted - 0.5 * mean.square;
  const double fourth = 1.5 * mean.fourth_weighted - 0.5 * mean.fourth;
  return {legendre2(mean.square), 1.5 * square, legendre4(mean.square, mean.fourth),
          (35.0 * fourth - 30.0 * square) / 8.0};
}

RotationFactors rotation_by_area(const Spheroid& s) {
  require_sound(s);
  // At the height t along the axis, in semi-axes, cos^2 gamma = w t^2/(1 - kappa t^2); the area is
  // that of zone().
  const double ratio = s.across / s.along, w = ratio * ratio;
  const double kappa = kappa_of(ratio), area = half_zone(ratio);
  double square = 0.0, fourth = 0.0;  // the integrals over w and w^2
  if (std::abs(kappa) < kSeries) {
    double a = 1.0, b = 1.0;  // of (1 - kappa t^2)^(-1/2) and ^(-3/2)
    square = series([&, a](int n) mutable {
      const double term = a / (2 * n + 3);
      a *= (n + 0.5) / (n + 1.0) * kappa;
      return term;
    });
    fourth = series([&, b](int n) mutable {
      const double term = b / (2 * n + 5);
      b *= (n + 1.5) / (n + 1.0) * kappa;
      return term;
    });
  } else {
    square = (area - ratio) / kappa;
    fourth = (1.0 / ratio - 3.0 * square) / kappa;
  }
  const double mean_square = w * square / area;
  return {legendre2(mean_square), legendre4(mean_square, w * w * fourth / area)};
}

}  // namespace tangency::inline v0::micromechanics
