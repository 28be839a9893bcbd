// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// tangency-lammps: the LAMMPS of the machine with this project's styles, which its input script
/// names like LAMMPS' own. Its command line is LAMMPS'.
#include <exceptions.h>
#include <force.h>
#include <input.h>
#include <lammps.h>
#include <modify.h>
#include <mpi.h>

#include <exception>
#include <iostream>

#include <tangency/dem/lammps/styles.hpp>

namespace tangency::inline v0::lammps {
namespace {

void add_styles(LAMMPS_NS::LAMMPS& lammps) {
  for (const PairEntry& style : pair_styles()) (*lammps.force->pair_map)[style.name] = style.create;
  for (const FixEntry& style : fix_styles()) (*lammps.modify->fix_map)[style.name] = style.create;
  for (const ComputeEntry& style : compute_styles())
    (*lammps.modify->compute_map)[style.name] = style.create;
}

/// Runs the input script. Exit status: 0, or 1 after an error that all ranks have met; LAMMPS has
/// printed its line. One rank's error ends them all.
int run(int argc, char** argv) {
  try {
    LAMMPS_NS::LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    add_styles(lammps);
    lammps.input->file();
  } catch (const LAMMPS_NS::LAMMPSAbortException& one) {
    MPI_Abort(one.universe, 1);
  } catch (const LAMMPS_NS::LAMMPSException&) {
    return 1;
  } catch (const std::exception& other) {
    std::cerr << "tangency-lammps: " << other.what() << '\n';
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  return 0;
}

}  // namespace
}  // namespace tangency::inline v0::lammps

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int status = tangency::lammps::run(argc, argv);
  MPI_Finalize();
  return status;
}
