// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// The ellipsoids of a rank as the simulator's functions read them.
#pragma once

#include <atom.h>
#include <atom_vec_ellipsoid.h>
#include <lammps.h>
#include <pointers.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/dem/contact/narrow_phase.hpp>
#include <tangency/dem/lanes/contact_lanes.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/large_pages.hpp>

namespace tangency::inline v0::lammps {

/// The owned and ghost atoms of a rank, made anew at every step from LAMMPS' arrays. A ghost that
/// is an image of an owned atom shares that one's body, where LAMMPS has a map of atoms and gives
/// images the same velocity: pairs come with their separations. No Ellipsoid is made.
class AtomBodies : protected LAMMPS_NS::Pointers {
 public:
  /// Looks at the atoms of a LAMMPS, which has to outlive it.
  explicit AtomBodies(LAMMPS_NS::LAMMPS* lammps) : Pointers(lammps) {}

  /// Takes over shapes, orientations, masses and motions as they are now. Ends LAMMPS with one line
  /// where an atom is no ellipsoid or its numbers are no numbers.
  /// @param listed_anew  were the neighbour lists built since the last call?
  void refresh(bool listed_anew);

  /// Of an owned or ghost atom: its index among the bodies.
  std::uint32_t body_of(int i) const { return body_[static_cast<std::size_t>(i)]; }
  /// The radius of the sphere around an atom's centre that its ellipsoid fills, length.
  double reach_of(int i) const { return reach_[body_of(i)]; }
  /// Types count from 0; positions, velocities and ids are not filled in.
  const dem::Particles& particles() const { return particles_; }
  /// Of these bodies.
  const dem::NarrowPhase& narrow_phase() const { return narrow_phase_; }
  /// One row a body.
  std::span<const dem::MotionRow> motion() const { return motion_; }
  /// In bytes.
  double memory_usage() const;

  /// The ellipsoids of a LAMMPS; null where its atom style has none.
  static LAMMPS_NS::AtomVecEllipsoid* ellipsoids(LAMMPS_NS::LAMMPS* lammps);
  /// Why an atom is no body that can be asked about, to be said behind its number; null where it is
  /// one.
  static const char* fault_of(const LAMMPS_NS::Atom& atoms, const LAMMPS_NS::AtomVecEllipsoid& from,
                              int i);
  /// The angular velocity that an angular momentum is of.
  static Vec3 spin_of(const Vec3& momentum, const Quaternion& turn, double mass, const Vec3& axes);
  /// The largest reach of each type over all ranks, length; entry 0 is of no type.
  static std::vector<double> reach_by_type(LAMMPS_NS::LAMMPS* lammps);

 private:
  void place();
  void take(std::size_t body, const LAMMPS_NS::AtomVecEllipsoid& from);

  std::vector<std::uint32_t> body_;  ///< of each atom
  std::vector<int> atom_;            ///< of each body, the one that it is made from
  std::vector<double> reach_;        ///< of each body
  dem::Particles particles_;
  dem::NarrowPhase narrow_phase_;
  std::vector<dem::MotionRow, LargePages<dem::MotionRow>> motion_;
};

}  // namespace tangency::inline v0::lammps
