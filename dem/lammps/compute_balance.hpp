// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// compute tangency/balance: how far particles are from equilibrium, as dem::Balance has it.
///
///     compute ID group tangency/balance [least N]
///
/// A particle is out of balance by the resultant of all that acts on it: contacts, and fixes such
/// as gravity. Ratios are to the mean length of a contact force, 0 where no contact bears one. A
/// particle with fewer than N contacts is a rattler: 2 by default, 1 under gravity. Group: all.
///
/// Vector, intensive: [1] contacts; [2] mean contact force; [3] mean resultant of the particles
/// with contacts; [4] the largest; [5] the largest moment over the particle's largest semi-axis,
/// alike; [6] rattlers; [7] mean number of contacts of the others.
#pragma once

#include <compute.h>

#include <vector>

namespace tangency::inline v0::lammps {

/// What the head of this file says.
class ComputeBalance : public LAMMPS_NS::Compute {
 public:
  /// Reads the command. Ends LAMMPS with a line that says what is wrong with it.
  ComputeBalance(LAMMPS_NS::LAMMPS* lammps, int count, char** words);
  ~ComputeBalance() override;

  void init() override;
  void compute_vector() override;
  int pack_reverse_comm(int count, int first, double* buffer) override;
  void unpack_reverse_comm(int count, int* atoms, double* buffer) override;

 private:
  double least_ = 2.0;            ///< contacts of a particle that is no rattler
  std::vector<double> contacts_;  ///< of each atom and ghost of this rank
};

}  // namespace tangency::inline v0::lammps
