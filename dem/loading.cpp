// SPDX-License-Identifier: MIT
#include <tangency/dem/loading.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

#include <tangency/dem/lanes/elementary.hpp>

namespace tangency::inline v0::dem {
namespace {

/// The integral part works this much slower than the proportional one; 4 would be critical damping
/// of the two on a pure spring, more keeps them apart while the particles' own motion lags behind.
constexpr double kIntegralSlowness = 20.0;

/// Unit tensor of the axes that strain.
Mat3 unit(int dimensions) { return Vec3(1.0, 1.0, dimensions == 3 ? 1.0 : 0.0).asDiagonal(); }

double largest_wanted(const std::vector<Target>& targets) {
  double largest = 0.0;
  for (const Target& target : targets) largest = std::max(largest, std::abs(target.wanted));
  return largest;
}

}  // namespace

Target Target::mean_stress(double wanted, int dimensions) {
  return {"mean stress", unit(dimensions), static_cast<double>(dimensions), wanted,
          unit(dimensions)};
}

Target Target::plane_mean_stress(double wanted) {
  return {"plane mean stress", unit(2), 2.0, wanted, unit(2)};
}

Target Target::component(int axis, double wanted) {
  const Mat3 along = Vec3::Unit(axis).asDiagonal();
  constexpr const char* names[] = {"stress along x", "stress along y", "stress along z"};
  return {names[axis], along, 1.0, wanted, along};
}

Target Target::direction(int from, int to, double angle) {
  const auto [cosine, sine] = cosine_sine(angle);
  const Vec3 major = cosine * Vec3::Unit(from) + sine * Vec3::Unit(to);
  const Vec3 minor = cosine * Vec3::Unit(to) - sine * Vec3::Unit(from);
  const Mat3 shear = 0.5 * (major * minor.transpose() + minor * major.transpose());
  return {"shear across the major direction", shear, 1.0, 0.0, shear};
}

Target Target::intermediate_ratio(double ratio) {
  const Mat3 weights = Vec3(ratio - 1.0, 1.0, -ratio).asDiagonal();
  return {"difference of stress_yy from its intermediate ratio", weights, 1.0, 0.0,
          Vec3(-1.0, 1.0, 0.0).asDiagonal()};
}

double Target::measured(const Stress& stress) const {
  return (weights * stress.tensor).trace() / divisor;
}

double Target::affine_stiffness(const Stress& stress) const {
  // <n_i n_j n_k n_l> is (1/15) of the three products of unit tensors, in the plane 1/8.
  const double pairs =
      weights.trace() * actuator.trace() + 2.0 * weights.cwiseProduct(actuator).sum();
  const double of_mean = stress.dimensions == 3 ? 5.0 : 4.0;  // 3/15 and 2/8, inverted
  return stress.affine_stiffness * (pairs / divisor / of_mean);
}

double Servo::rate(const Target& target, const Stress& measured, double dt,
                   ServoMemory& memory) const {
  const double missing = target.wanted - target.measured(measured);
  if (published_gain > 0.0) {
    memory.rate =
        std::clamp(memory.rate - published_gain * missing, -max_strain_rate, max_strain_rate);
    return memory.rate;
  }
  const double stiffness = target.affine_stiffness(measured);
  if (!(stiffness > 0.0)) return missing == 0.0 ? 0.0 : -std::copysign(max_strain_rate, missing);
  const double error = missing / stiffness;
  const double wanted = gain * (error + memory.integral) / dt;
  const double allowed = std::clamp(wanted, -max_strain_rate, max_strain_rate);
  // No wind-up: the integral rests while the rate is at its bound.
  if (integral && allowed == wanted) memory.integral += gain / kIntegralSlowness * error;
  return -allowed;
}

Mat3 Loading::rate(const Stress& measured, double dt, std::vector<ServoMemory>& memory) const {
  Mat3 sum = strain_rate;
  for (std::size_t k = 0; k < targets.size(); ++k)
    sum += servo.rate(targets[k], measured, dt, memory[k]) * targets[k].actuator;
  return sum;
}

bool Loading::is_met(const Stress& measured, double tolerance) const {
  const double largest = largest_wanted(targets);
  return std::all_of(targets.begin(), targets.end(), [&](const Target& target) {
    return std::abs(target.measured(measured) - target.wanted) <= tolerance * largest;
  });
}

void Loading::watch(const Stress& measured, bool on_arrival,
                    std::vector<ServoMemory>& memory) const {
  const double largest = std::max(largest_wanted(targets), least_scale);
  const double scale = largest > 0.0 ? largest : measured.mean();
  if (!(scale > 0.0)) return;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const double off = (targets[k].measured(measured) - targets[k].wanted) / scale;
    const bool held = std::abs(off) <= kHeldWithin;
    ServoMemory& seen = memory[k];
    if (on_arrival && seen.watched == 0 && !held) continue;
    ++seen.watched;
    if (!held) ++seen.missed;
    if (std::abs(off) > std::abs(seen.worst)) seen.worst = off;
  }
}

bool Loading::is_independent() const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(targets.size()), 9);
  for (Eigen::Index k = 0; k < rows.rows(); ++k)
    rows.row(k) = targets[static_cast<std::size_t>(k)].weights.reshaped();
  return targets.empty() || rows.colPivHouseholderQr().rank() == rows.rows();
}

}  // namespace tangency::inline v0::dem
