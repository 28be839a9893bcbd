// SPDX-License-Identifier: MIT
/// @file
/// A run as a script of LAMMPS with the styles of tangency-lammps (dem/lammps).
#pragma once

#include <string>
#include <vector>

#include <tangency/dem/simulation.hpp>

namespace tangency::inline v0::dem {

/// The script that does the rest of a run: `in.NAME`, which reads the data file `NAME.data`
/// (lammps_data()), sets the laws of contacts and does the stages that are left, one after the
/// other, each by fix tangency/servo and fix tangency/move. Numbers read back to the same double.
/// @param run  from where the script goes on; is taken through its stages
/// @param name  NAME: letters, digits, and . _ - alone
/// @param scene  in messages
/// @throws SceneError  where the scene has what the styles have not: it says which key
std::string lammps_script(Simulation run, const std::string& name, const std::string& scene);

/// What the data file cannot hold of a state, a line each: shear forces of contacts, and what its
/// servos remember. Empty where nothing is lost.
std::vector<std::string> lost_in_lammps(const State& state);

}  // namespace tangency::inline v0::dem
