// SPDX-License-Identifier: MIT
/// @file
/// Does a contact slide? Tables, pictures and LAMMPS say it by the same rule.
#pragma once

#include <tangency/dem/contact/contact_law.hpp>

namespace tangency::inline v0::dem {

/// In parts of the limit. Chosen: a force that was cut back to it is off by rounding alone, and one
/// that comes as near by chance is at it.
inline constexpr double kAtTheLimit = 1e-12;

/// The largest shear force that a law allows, >= 0.
/// @param normal_force  > 0 pushes
inline double shear_limit(const ContactLaw& law, double normal_force) {
  return law.cohesion + law.friction_coefficient * normal_force;
}

/// Is the shear force as large as the law allows? None that is 0 slides.
/// @param shear_force  its size, >= 0
inline bool slides(const ContactLaw& law, double normal_force, double shear_force) {
  return shear_force > 0.0 && shear_force >= (1.0 - kAtTheLimit) * shear_limit(law, normal_force);
}

}  // namespace tangency::inline v0::dem
