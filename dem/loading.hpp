// SPDX-License-Identifier: MIT
/// @file
/// The servo that strains the cell until the assembly bears the wanted stress.
///
/// The thesis adds gain (p_measured - p_wanted) to the strain rate every cycle [Ouadfel1998,
/// eq. 3.36]; over a stiffness that is an integral controller on an integrator, which rings for
/// ever. Here the rate is proportional to the error, with a slow integral part that takes up what
/// creep leaves, and the error is taken as the strain that would remove it, so that gains need no
/// unit.
#pragma once

#include <tangency/dem/observe.hpp>

namespace tangency::dem {

struct PressureServo {
  double mean_stress;      ///< wanted, compression positive, force/area
  double gain;             ///< share of the error removed a cycle, in (0, 1)
  double max_strain_rate;  ///< > 0, 1/time

  /// The isotropic strain rate of the cell (extension positive, |rate| <= max_strain_rate) for the
  /// coming step. Without contacts to measure a stiffness on: the largest compressing rate.
  /// @param integral  the controller's memory, 0 at the start of a stage; a strain
  double rate(const Stress& measured, double dt, double& integral) const;
};

}  // namespace tangency::dem
