// SPDX-License-Identifier: MIT
/// @file
/// Sums over the contacts of an assembly.
#pragma once

#include <cstdint>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// What contacts did to energy during an update. Work is that of the mean of the forces before and
/// after on the displacement during the step, as leapfrog has it.
struct ContactWork {
  double sliding = 0.0;   ///< lost to friction, and with shear springs that were let go
  double boundary = 0.0;  ///< done on the assembly by the straining cell
  /// Gained where a pair went over to another branch, whose force and overlap are not the
  /// neighbours of those before, and where a Hertz contact rolled to other curvatures: its force
  /// does not feel that its energy changes with them.
  double branch = 0.0;
  double viscous = 0.0;  ///< lost to the damped approach of contacts

  /// Adds term by term.
  ContactWork& operator+=(const ContactWork& other) {
    sliding += other.sliding;
    boundary += other.boundary;
    branch += other.branch;
    viscous += other.viscous;
    return *this;
  }
};

/// Over all pairs that touch: what the next step needs.
struct ContactSums {
  Mat3 force_branch = Mat3::Zero();  ///< of force times branch': V times the stress, not symmetric
  double affine_stiffness = 0.0;     ///< of normal stiffness times (normal . branch)^2
};

/// Over all pairs that touch: what is looked at now and then.
struct ContactTotals {
  std::int64_t contacts = 0;                 ///< that there are
  double force_length = 0.0;                 ///< of |force|
  double normal_force = 0.0, overlap = 0.0;  ///< sums over contacts: force, length
  double energy = 0.0;                       ///< stored, in normal and shear springs

  /// Adds term by term.
  ContactTotals& operator+=(const ContactTotals& other) {
    contacts += other.contacts;
    force_length += other.force_length;
    normal_force += other.normal_force;
    overlap += other.overlap;
    energy += other.energy;
    return *this;
  }
};

}  // namespace tangency::inline v0::dem
