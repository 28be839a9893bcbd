// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/fix_contact_history.hpp>

#include <comm.h>

#include <cstdio>

namespace tangency::inline v0::lammps {

void FixContactHistory::post_run() {
  FixNeighHistory::post_run();
  atoms_have_them_ = true;
}

void FixContactHistory::write_restart(FILE* file) {
  if (!atoms_have_them_) return FixNeighHistory::write_restart(file);
  // What that writes of the fix as a whole: nothing.
  constexpr int kSize = 0;
  if (comm->me == 0) std::fwrite(&kSize, sizeof kSize, 1, file);
}

}  // namespace tangency::inline v0::lammps
