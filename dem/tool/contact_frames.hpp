// SPDX-License-Identifier: MIT
/// @file
/// Contacts to look at: one frame as text. Numbers and signs are those of packing.hpp and
/// contact_fields.hpp; all but places are of 32 bits, since tables of contacts hold them exactly.
#pragma once

#include <string>

#include <tangency/dem/scene/units.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/packing.hpp>

namespace tangency::inline v0::dem {

/// "mm/s"; "" without names.
std::string unit_of_velocity(const Units& units);

/// A point a contact, wrapped into the cell, with `a`, `b`, `normal`, `force`, `shear_force`,
/// `velocity`, `normal_force`, `gap`, `curvature` (the smaller one first) and `sliding`.
/// ParaView's filter Glyph draws arrows of them.
/// @param units  that arrays name (vtk_file.hpp); by default none
std::string contacts_vtp(const State& state, const Packing& packing, const Units& units = {});

/// A line a contact, from the centre of a, wrapped into the cell, to that of b's image, which may
/// lie outside. Of each line `a`, `b`, `normal_force`, `force_size`, `shear_size` and `sliding`,
/// and `normal_force` of its ends too: ParaView's filter Tube takes its radius from points.
std::string chains_vtp(const State& state, const Packing& packing, const Units& units = {});

/// The same contacts as OVITO's bonds: a file as LAMMPS' dump local writes, which the modifier Load
/// Trajectory reads. Particles are called by id + 1, as in frames.xyz; px, py, pz are the edges of
/// the cell that the bond crosses, both of them wrapped into it.
std::string bonds_dump(const State& state, const Packing& packing);

}  // namespace tangency::inline v0::dem
