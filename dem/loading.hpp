// SPDX-License-Identifier: MIT
/// @file
/// How a stage strains the cell: a given rate, and servos that hold stresses.
///
/// The thesis adds gain (p_measured - p_wanted) to the strain rate every cycle [Ouadfel1998,
/// eq. 3.36]; over a stiffness that is an integral controller on an integrator, which rings. Here
/// the rate is proportional to the error, with a slow integral part that takes up what creep
/// leaves, and the error is taken as the strain that would remove it, so that gains need no unit.
/// The published one is there by choice.
#pragma once

#include <cstdint>
#include <vector>

#include <tangency/dem/observe.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// One stress to hold, and the strain rate that does it.
struct Target {
  const char* name;  ///< in messages
  /// The stress is weights : stress / divisor, compression positive.
  Mat3 weights;
  double divisor = 1.0;  ///< see weights
  double wanted = 0.0;   ///< force/area
  /// A symmetric strain rate of extension that lowers it.
  Mat3 actuator;

  /// The mean of the normal components in 2 or 3 dimensions.
  static Target mean_stress(double wanted, int dimensions);
  /// (s_xx + s_yy) / 2 in space.
  static Target plane_mean_stress(double wanted);
  /// s_kk.
  static Target component(int axis, double wanted);
  /// No shear on the axes of which the first is turned by `angle` from axis `from` towards axis
  /// `to`: the principal stresses of that plane lie along them, as in a ring shear test.
  static Target direction(int from, int to, double angle);

  /// s_yy - s_xx = ratio (s_zz - s_xx), in space: with the principal stresses along the axes, a
  /// Lode angle of tan(theta) = sqrt(3) ratio / (2 - ratio). Its actuator strains y against x.
  /// @param ratio  in [0, 1]
  static Target intermediate_ratio(double ratio);

  /// The stress that weights and divisor name.
  double measured(const Stress& stress) const;
  /// Rise of the stress per strain against the actuator, if particles only followed the cell and
  /// contacts pointed everywhere alike: that of the mean stress times
  /// <(n.A n)(n.W n)> over its own.
  double affine_stiffness(const Stress& stress) const;
};

/// What a servo remembers, and what is to be said of it.
struct ServoMemory {
  double integral = 0.0;  ///< of the error, a strain
  double rate = 0.0;      ///< of the published servo, 1/time
  // How the target was held, in the cycles that count (Loading::watch):
  std::int64_t watched = 0;  ///< cycles that count
  std::int64_t missed = 0;   ///< those in which it was off by more than kHeldWithin
  double worst = 0.0;        ///< how far it was off where that was largest, relative; above: > 0
};

/// A stress is held while it is this close to the wanted, relatively.
inline constexpr double kHeldWithin = 0.01;

/// How the strain rate follows what the stress lacks.
struct Servo {
  double gain = 0.5;             ///< share of the error removed a cycle, in (0, 1)
  double max_strain_rate = 0.0;  ///< bound of one target's rate, > 0, 1/time
  /// gain of the published servo, 1/(stress time); 0: the proportional-integral one.
  double published_gain = 0.0;
  /// Without it no lasting creep is taken up, and nothing winds up while an assembly collapses that
  /// will come to rest.
  bool integral = true;

  /// The rate along the actuator for the coming step, extension positive, at most max_strain_rate
  /// in size. Without contacts to measure a stiffness on: the largest compressing rate.
  double rate(const Target& target, const Stress& measured, double dt, ServoMemory& memory) const;
};

/// The loading of a stage.
struct Loading {
  Mat3 strain_rate = Mat3::Zero();  ///< given, extension positive, 1/time
  std::vector<Target> targets;      ///< what is held at a stress
  Servo servo;                      ///< how it is held
  /// What is off is seen against this stress at least: that of a ramp's larger end, > 0 or 0.
  double least_scale = 0.0;

  /// The cell's rate for the coming step.
  /// @param measured  the stress as it is
  /// @param dt  time step
  /// @param memory  one entry a target
  Mat3 rate(const Stress& measured, double dt, std::vector<ServoMemory>& memory) const;

  /// Are all targets met, each within `tolerance` of the largest wanted stress?
  bool is_met(const Stress& measured, double tolerance) const;

  /// Notes how far each target is off, relative to the largest wanted stress and least_scale, or to
  /// the mean stress where only directions are held.
  /// @param measured  the stress as it is
  /// @param memory  of the servo, one entry a target
  /// @param on_arrival  a target counts only from when it is first within kHeldWithin
  void watch(const Stress& measured, bool on_arrival, std::vector<ServoMemory>& memory) const;

  /// Can the targets be met one by one: is none a combination of the others?
  bool is_independent() const;
};

}  // namespace tangency::inline v0::dem
