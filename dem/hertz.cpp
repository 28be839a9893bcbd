// SPDX-License-Identifier: MIT
#include <tangency/dem/hertz.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace tangency::dem {
namespace {

using std::numbers::pi;

/// K and D of modulus sqrt(1 - k^2) by the arithmetic-geometric mean (DLMF, section 19.8): with
/// c_0^2 = 1 - k^2, c_(n+1) = c_n^2 / (4 a_(n+1)) and D / K = (1/2) sum over n of 2^n c_n^2 /
/// c_0^2. No term cancels another, near the circle or near the line.
std::pair<double, double> elliptic_integrals(double k) {
  double a = 0.5 * (1.0 + k), b = std::sqrt(k);
  double c = 0.5 * (1.0 - k);                   // c_1
  double share = 0.25 * (1.0 - k) / (1.0 + k);  // c_1^2 / c_0^2
  double sum = 1.0, weight = 2.0;
  // Quadratic: c_n falls below u after eight steps from k = 1e-200.
  while (weight * share > 0x1p-60) {
    sum += weight * share;
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
    share *= c * c / (16.0 * a * a);
    c = c * c / (4.0 * a);
    weight *= 2.0;
  }
  const double K = pi / (a + b);
  return {K, 0.5 * sum * K};
}

}  // namespace

ContactEllipse contact_ellipse(double ratio) {
  // Secant method for ln k in ln(k^2 D / (K - D)) = ln(ratio), which rises with a slope between 1.5
  // (the circle) and 2 (the line): from the circle's slope every step lands above the root or on
  // it.
  const double wanted = std::log(ratio);
  double x = wanted / 1.5, slope = 1.5;
  double before = 0.0, value_before = 0.0;
  // Measured on 400,000 ratios down to 1e-300: at most 6.
  constexpr int most_steps = 20;
  for (int step = 0; step < most_steps; ++step) {
    const double k = std::exp(x);
    const auto [K, D] = elliptic_integrals(k);
    const double value = 2.0 * x + std::log(D / (K - D)) - wanted;
    // The logarithms' own rounding.
    if (std::abs(value) <= 0x1p-51 * (1.0 + std::abs(wanted))) return {k, K, D};
    if (step > 0 && x != before) slope = (value - value_before) / (x - before);
    before = x;
    value_before = value;
    x = std::fmin(0.0, x - value / slope);
  }
  // Of a ratio that is no number: no force either, which move() reports.
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {none, none, none};
}

HertzContact hertz_contact(const double curvature[2], double overlap, const Material& material) {
  const auto [k, K, D] = contact_ellipse(std::fmin(1.0, curvature[1] / curvature[0]));
  const double a = std::sqrt(2.0 * overlap * D / (K * curvature[1]));
  const double force = 2.0 * pi / 3.0 * a * overlap * material.contact_modulus() / K;
  // One body gives way along a by Q ((1 - nu) K + nu D) / (2 pi a G), along b with K - D for D: the
  // tangential traction of a rigid elliptic stamp, integrated over the ellipse [Mindlin1949].
  const double nu = material.poisson_ratio;
  const double stamp = pi * a * material.shear_modulus();
  return {force,
          1.5 * force / overlap,
          0.4 * force * overlap,
          {a, k * a},
          {stamp / ((1.0 - nu) * K + nu * D), stamp / ((1.0 - nu) * K + nu * (K - D))}};
}

}  // namespace tangency::dem
