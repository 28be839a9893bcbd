// SPDX-License-Identifier: MIT
/// @file
/// Samples from text files of other programs. What they refuse is a tables::Error of one line,
/// file, line, what and what is allowed. Of several frames the last is taken, or the one that is
/// asked for.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <tangency/dem/tool/exchange_sample.hpp>

namespace tangency::inline v0::dem {

/// A data file of LAMMPS with atoms of style ellipsoid (each with its ellipsoid) or sphere. Types
/// are called by their numbers. The cell counts as periodic: such files do not say.
Sample read_lammps_data(const std::string& file, std::string_view text);

/// A dump of LAMMPS, style custom, with the columns id, x y z or xu yu zu or xs ys zs or xsu ysu
/// zsu, and shapex shapey shapez (diameters), diameter or radius; where they are there type, vx vy
/// vz, omegax omegay omegaz, quatw quati quatj quatk, mass.
/// @param frame  from 0
Sample read_lammps_dump(const std::string& file, std::string_view text, std::optional<int> frame);

/// Extended XYZ with a Lattice and the properties pos, aspherical_shape (radii) or radius; where
/// they are there species or type, orientation (x y z w), velo, angular_velocity, mass.
Sample read_extended_xyz(const std::string& file, std::string_view text, std::optional<int> frame);

}  // namespace tangency::inline v0::dem
