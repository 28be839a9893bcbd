// SPDX-License-Identifier: MIT
/// @file
/// Sums over the contacts of an assembly, which each update of them gives beside the forces.
#pragma once

#include <cstdint>

#include <tangency/geometry/vectors.hpp>

namespace tangency::dem {

/// What contacts did to energy during an update. Work is that of the mean of the forces before and
/// after on the displacement during the step, as leapfrog has it.
struct ContactWork {
  double sliding = 0.0;   ///< lost to friction, and with shear springs that were let go
  double boundary = 0.0;  ///< done on the assembly by the straining cell
  /// Gained where a pair went over to another branch, whose force and overlap are not the
  /// neighbours of those before, and where a Hertz contact rolled to other curvatures: its force
  /// does not feel that its energy changes with them.
  double branch = 0.0;

  ContactWork& operator+=(const ContactWork& other) {
    sliding += other.sliding;
    boundary += other.boundary;
    branch += other.branch;
    return *this;
  }
};

/// Over all pairs that touch.
struct ContactSums {
  Mat3 force_branch = Mat3::Zero();  ///< of force times branch': V times the stress, not symmetric
  double affine_stiffness = 0.0;     ///< of normal stiffness times (normal . branch)^2
  double force_length = 0.0;         ///< of |force|
  double energy = 0.0;               ///< stored, in normal and shear springs
  std::int64_t contacts = 0;         ///< that there are

  ContactSums& operator+=(const ContactSums& other) {
    force_branch += other.force_branch;
    affine_stiffness += other.affine_stiffness;
    force_length += other.force_length;
    energy += other.energy;
    contacts += other.contacts;
    return *this;
  }
};

}  // namespace tangency::dem
