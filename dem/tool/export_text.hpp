// SPDX-License-Identifier: MIT
/// @file
/// Samples as text files of other programs. Numbers read back to the same double.
#pragma once

#include <string>

#include <tangency/dem/tool/exchange_sample.hpp>

namespace tangency::inline v0::dem {

/// A data file of LAMMPS, atom_style ellipsoid: ids from 1, diameters, quaternions w x y z, and
/// angular momenta in place of angular velocities. Centres are not wrapped, as read_data takes
/// them.
/// @param sample  of a cell as with_triangular_cell() has them
std::string lammps_data(const Sample& sample);

/// A dump of LAMMPS, style custom: id, type, xu yu zu, velocities, omega, diameters as shapex
/// shapey shapez, quatw quati quatj quatk, mass. @param sample  as above
std::string lammps_dump(const Sample& sample);

/// One frame of extended XYZ under OVITO's names: radii as aspherical_shape, orientation x y z w,
/// and angular_velocity and mass. No species: ASE takes them for chemical symbols.
std::string extended_xyz(const Sample& sample);

}  // namespace tangency::inline v0::dem
