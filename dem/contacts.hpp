// SPDX-License-Identifier: MIT
/// @file
/// The contacts of an assembly: one record a listed pair.
///
/// A pair touches where its overlap, minus the signed gap, is > 0. The contact point is the
/// midpoint of the two witness points. Results do not depend on the number of threads: each pair
/// writes its own record and each particle adds its own pairs in the order of the list.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/contact_law.hpp>
#include <tangency/dem/narrow_phase.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::dem {

/// One listed pair (a, image of b, or a wall) at the current positions.
struct Contact {
  Vec3 normal = Vec3::Zero();  ///< unit, from a to b; of a pair apart: as last known; 0: not known
  /// c_b - c_a. To a wall: to where it is touched, so that force times branch is the work that the
  /// wall's motion does per strain.
  Vec3 branch = Vec3::Zero();
  Vec3 arm = Vec3::Zero();    ///< contact point - c_a; of touching pairs only
  Vec3 force = Vec3::Zero();  ///< of a on b; 0 for pairs apart
  ShearState shear;           ///< stays 0 without friction
  double overlap = 0.0;       ///< length; > 0 where the pair touches, else 0
  double normal_force = 0.0;
  double normal_stiffness = 0.0;  ///< at this overlap; of touching pairs only
  double normal_energy = 0.0;

  bool touches() const { return overlap > 0.0; }
};

/// Laws by the types of the two particles, symmetric; types x types, row by row. In a walled cell
/// the walls are the last type.
struct ContactLaws {
  std::size_t types = 0;
  std::vector<ContactLaw> law;

  const ContactLaw& between(std::size_t a, std::size_t b) const { return law[a * types + b]; }
  /// The largest stiffness of any law, normal or shear.
  double largest_stiffness() const;
};

/// What contacts did to energy during an update. Work is that of the mean of the forces before and
/// after on the displacement during the step, as leapfrog has it.
struct ContactWork {
  double sliding = 0.0;   ///< lost to friction, and with shear springs that were let go
  double boundary = 0.0;  ///< done on the assembly by the straining cell
  /// Gained where a pair went over to another branch, whose force and overlap are not the
  /// neighbours of those before, and where a Hertz contact rolled to other curvatures: its force
  /// does not feel that its energy changes with them.
  double branch = 0.0;

  ContactWork& operator+=(const ContactWork& other);
};

class Contacts {
 public:
  /// Brings every record to the current positions and velocities and renews the resultants.
  /// @param dt  time since the last update: the shear displacement is velocity times dt
  ContactWork update(const Particles& particles, const Cell& cell, const NeighbourList& list,
                     const ContactLaws& laws, double dt, Branch branch = Branch::follow);

  /// Keeps the records of pairs that are in both lists.
  void carry_over(const std::vector<Pair>& before, const std::vector<Pair>& now);

  /// Adds the saved records' forces up again: after a restore.
  void restore(std::vector<Contact> records, const Particles& particles, const NeighbourList& list);

  const std::vector<Contact>& records() const { return records_; }
  const Resultants& resultants() const { return resultants_; }

 private:
  struct Step;
  void update_block(std::size_t first, const Step& step);
  void apply(const Pair& pair, const PairGeometry& geometry, const Step& step, Contact& contact,
             ContactWork& work) const;
  void add_up(const NeighbourList& list, std::size_t particles);

  std::vector<Contact> records_;
  Resultants resultants_;
  NarrowPhase narrow_phase_;
  std::vector<ContactWork> work_;  ///< of each block, during an update
};

}  // namespace tangency::dem
