// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// In what the versions of LAMMPS differ, as far as these sources use it: that of 29 Sep 2021,
/// which Debian 12 has and `tangency-lammps` is linked with, and later ones, which load the plugin;
/// of these it was compiled for those of 4 Feb 2025 and 4 Jul 2026. What a version has is asked of
/// its own classes: no number of a version is needed.
#pragma once

#include <atom_vec_ellipsoid.h>

namespace tangency::inline v0::lammps {

/// The shape and the turn of an ellipsoid of LAMMPS: its half axes and its quaternion, w first.
using Body = LAMMPS_NS::AtomVecEllipsoid::Bonus;

/// That of an atom; `atom_style ellipsoid superellipsoid` (since 2026) keeps it in another array.
/// @param k  Atom::ellipsoid of the atom, >= 0
template <class Ellipsoids>
Body& body_at(const Ellipsoids& ellipsoids, int k) {
  if constexpr (requires { ellipsoids.bonus_super; }) {
    if (ellipsoids.bonus_super != nullptr) return ellipsoids.bonus_super[k];
  }
  return ellipsoids.bonus[k];
}

/// What is said of an atom that is another superellipsoid, behind its number.
inline constexpr const char* kNoEllipsoid =
    " is a superellipsoid that is no ellipsoid: the exponents 2 and 2 are allowed";

/// Is the body an ellipsoid? A superellipsoid is one where both its exponents are 2.
/// @param k  Atom::ellipsoid of the atom, >= 0
template <class Ellipsoids>
bool is_ellipsoid(const Ellipsoids& ellipsoids, [[maybe_unused]] int k) {
  if constexpr (requires { ellipsoids.bonus_super; }) {
    if (ellipsoids.bonus_super != nullptr)
      return ellipsoids.bonus_super[k].block[0] == 2.0 && ellipsoids.bonus_super[k].block[1] == 2.0;
  }
  return true;
}

/// Adds what ghosts have of a compute to their atoms (Compute::pack_reverse_comm).
template <class Comm, class Compute>
void add_ghosts_to_atoms(Comm& comm, Compute* compute) {
  if constexpr (requires { comm.reverse_comm(compute); })
    comm.reverse_comm(compute);
  else
    comm.reverse_comm_compute(compute);
}

}  // namespace tangency::inline v0::lammps
