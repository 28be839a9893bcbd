// SPDX-License-Identifier: MIT
/// @file
/// Tables of a state's contacts and particles, CSV: of one state, and of a run every so many cycles
/// in DIR/contacts/CYCLE.csv. Rows, ids, units and signs are those of packing.hpp; numbers read
/// back to the same double.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <tangency/dem/simulation.hpp>

namespace tangency::inline v0::dem {

/// With the friction that the contacts have: that to which the stage has come, on a ramp too; where
/// it has not moved yet that of the stage before, and of a run that is over that of the last one.
ContactLaws laws_of(const Simulation& simulation);

/// A row a touching contact between particles, a, b, ix, iy, iz, x, y, z, nx, ny, nz, gap, bx, by,
/// bz, ax, ay, az, fn, fx, fy, fz, sliding, and those of contact_fields.hpp: shear force sx, sy,
/// sz, relative velocity vx, vy, vz, curvature_min, curvature_max; the header alone where there is
/// none.
/// @param laws  whose Coulomb limit `sliding` means
std::string contact_table(const State& state, const ContactLaws& laws);

/// A row a particle, id, type, x, y, z, r1, r2, r3, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz,
/// contacts, and the particle's stress s_xx, s_yy, s_zz, s_xy, s_yz, s_zx; the type counts from 0
/// in the alphabetical order of names.
std::string particle_table(const State& state);

class ContactTables {
 public:
  /// @param last_cycle  tables of later cycles are taken away; -1: all are
  /// @param adds        else add() does nothing
  ContactTables(const std::filesystem::path& directory, std::int64_t last_cycle, bool adds);

  /// The table of the simulation as it is now, with the laws of its stage; a second one of the same
  /// cycle is left out.
  /// @throws WriteError
  void add(const Simulation& simulation);

 private:
  std::filesystem::path file_of(std::int64_t cycle) const;

  std::filesystem::path folder_;
  bool adds_;
  std::int64_t last_cycle_;
};

}  // namespace tangency::inline v0::dem
