// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <tangency/dem/loading.hpp>

namespace tangency::dem {
namespace {

/// The integral part works this much slower than the proportional one; 4 would be critical damping
/// of the two on a pure spring, more keeps them apart while the particles' own motion lags behind.
constexpr double integral_slowness = 20.0;

}  // namespace

double PressureServo::rate(const Stress& measured, double dt, double& integral) const {
  const double missing = mean_stress - measured.mean();
  if (!(measured.affine_stiffness > 0.0)) return -std::copysign(max_strain_rate, missing);
  const double error = missing / measured.affine_stiffness;
  const double wanted = gain * (error + integral) / dt;
  const double allowed = std::clamp(wanted, -max_strain_rate, max_strain_rate);
  // No wind-up: the integral rests while the rate is at its bound.
  if (allowed == wanted) integral += gain / integral_slowness * error;
  return -allowed;
}

}  // namespace tangency::dem
