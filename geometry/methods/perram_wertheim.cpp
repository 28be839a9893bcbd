// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/perram_wertheim.hpp>

#include <algorithm>
#include <cmath>

namespace tangency::methods {

PerramWertheimForm::PerramWertheimForm(const Ellipsoid& a, const Ellipsoid& b,
                                       const Vec3& d) noexcept
    : d_(d),
      adjugate_a_(a.shape_adjugate()),
      adjugate_b_(b.shape_adjugate()),
      mixed_(mixed_adjugate(a.shape(), b.shape())),
      det_{a.shape_determinant(), trace_of_product(adjugate_a_, b.shape()),
           trace_of_product(adjugate_b_, a.shape()), b.shape_determinant()},
      num_{adjugate_a_.form(d), mixed_.form(d), adjugate_b_.form(d)} {}

double PerramWertheimForm::first_guess() const noexcept {
  return std::sqrt((num_[2] * det_[0]) / (num_[0] * det_[3]));
}

double PerramWertheimForm::maximise(double l, int steps) const noexcept {
  // A step multiplies l by at most e^2: far from the maximum log F is not concave in log l.
  constexpr double kLongestStep = 2.0;
  constexpr double kEnough = 0.01;
  for (int i = 0; i < steps; ++i) {
    const double det = det_[0] + l * (det_[1] + l * (det_[2] + l * det_[3]));
    const double det1 = l * (det_[1] + l * (2.0 * det_[2] + l * 3.0 * det_[3]));
    const double det2 = l * (det_[1] + l * (4.0 * det_[2] + l * 9.0 * det_[3]));
    const double num = num_[0] + l * (num_[1] + l * num_[2]);
    const double num1 = l * (num_[1] + l * 2.0 * num_[2]);
    const double num2 = l * (num_[1] + l * 4.0 * num_[2]);
    // Derivatives of log F with respect to log l; det1 = l D', det2 = l (l D')', num alike.
    const double s = 1.0 / (1.0 + l), p = num1 / num, q = det1 / det;
    const double slope = s + p - q;
    const double curvature = -l * s * s + (num2 / num - p * p) - (det2 / det - q * q);
    double step = curvature < 0.0 ? -slope / curvature : std::copysign(kLongestStep, slope);
    step = std::clamp(step, -kLongestStep, kLongestStep);
    l *= std::exp(step);
    if (std::abs(step) < kEnough) break;
  }
  return l;
}

Vec3 PerramWertheimForm::normal_direction(double l) const noexcept {
  return adjugate_a_ * d_ + l * (mixed_ * d_ + l * (adjugate_b_ * d_));
}

}  // namespace tangency::methods
