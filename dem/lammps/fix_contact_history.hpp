// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// Where pair_style tangency keeps the records of its pairs: LAMMPS' history of neighbours, which
/// goes with the atoms. The pair style makes it; a script does not name it.
///
/// LAMMPS' own (29 Sep 2021) loses records across periodic boundaries where the command
/// write_restart stands between two runs: the command makes ghosts anew, and then the history is
/// gathered once more, by the neighbour list of the ghosts before. At the end of a run it has been
/// gathered already: here that is not done a second time.
#pragma once

#include <fix_neigh_history.h>

#include <cstdio>

namespace tangency::inline v0::lammps {

/// Made by `fix ID all NEIGH_HISTORY_TANGENCY numbers`.
class FixContactHistory : public LAMMPS_NS::FixNeighHistory {
 public:
  using FixNeighHistory::FixNeighHistory;

  /// Records change, those of the list of neighbours: the pair style calls it at every step.
  void change() { atoms_have_them_ = false; }
  /// Gathers the records, of the atoms from then on.
  void post_run() override;
  /// Gathers the records unless the atoms have them.
  void write_restart(FILE* file) override;

 private:
  bool atoms_have_them_ = false;
};

}  // namespace tangency::inline v0::lammps
