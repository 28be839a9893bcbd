// SPDX-License-Identifier: MIT
#include "spheroid_integrals.hpp"

#include <cmath>

namespace tangency::micromechanics {

double kappa_of(double ratio) { return (1.0 - ratio) * (1.0 + ratio); }

double zone(double ratio, double height, double across_squared) {
  const double kappa = kappa_of(ratio);
  const double root = std::sqrt(across_squared + ratio * ratio * height * height);
  double turned = height;  // the integral of 1/sqrt(1 - kappa t^2)
  if (kappa > 0.0)
    turned = std::atan2(std::sqrt(kappa) * height, root) / std::sqrt(kappa);
  else if (kappa < 0.0)
    turned = std::asinh(std::sqrt(-kappa) * height) / std::sqrt(-kappa);
  return 0.5 * (height * root + turned);
}

double half_zone(double ratio) { return zone(ratio, 1.0, 0.0); }

}  // namespace tangency::micromechanics
