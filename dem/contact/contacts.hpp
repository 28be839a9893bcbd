// SPDX-License-Identifier: MIT
/// @file
/// The contacts of an assembly, one a listed pair, in columns.
///
/// A pair touches where its overlap, minus the signed gap, is > 0. The contact point is the
/// midpoint of the two witness points. Results do not depend on the number of threads, to the bit:
/// pairs are taken in blocks that are the same for any number, each particle adds its own pairs in
/// the order of the list, and sums over blocks are taken in their order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/contact/contact_law.hpp>
#include <tangency/dem/contact/contact_laws.hpp>
#include <tangency/dem/contact/contact_sums.hpp>
#include <tangency/dem/contact/narrow_phase.hpp>
#include <tangency/dem/lanes/contact_lanes.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/dem/profile.hpp>
#include <tangency/geometry/large_pages.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// One listed pair (a, image of b, or a wall) at the current positions.
struct Contact {
  Vec3 normal = Vec3::Zero();  ///< unit, from a to b; of a pair apart: as last known; 0: not known
  /// c_b - c_a. To a wall: to where it is touched, so that force times branch is the work that the
  /// wall's motion does per strain.
  Vec3 branch = Vec3::Zero();
  Vec3 arm = Vec3::Zero();        ///< contact point - c_a; of touching pairs only
  Vec3 force = Vec3::Zero();      ///< of a on b; 0 for pairs apart
  ShearState shear;               ///< stays 0 without friction
  double overlap = 0.0;           ///< length; > 0 where the pair touches, else 0
  double normal_force = 0.0;      ///< force, >= 0 pushes
  double normal_stiffness = 0.0;  ///< at this overlap; of touching pairs only
  double normal_energy = 0.0;     ///< energy stored along the normal

  /// Do the bodies overlap?
  bool touches() const { return overlap > 0.0; }
};

/// What contacts carry from step to step, a column a quantity of Contact; the force is normal_force
/// normal + shear_force. Each column is filled up to whole blocks with pairs of no extent, apart.
struct ContactColumns {
  std::vector<Vec3> normal, branch, arm, shear_force;  ///< a vector a pair, as Contact has them
  /// a number a pair, as Contact has them
  std::vector<double> overlap, normal_force, normal_stiffness, normal_energy;
  std::vector<double> shear_stiffness, shear_energy;  ///< a number a pair, as Contact has them

  /// All columns, so that whoever copies, saves or sorts them forgets none.
  static constexpr std::array kVectors{&ContactColumns::normal, &ContactColumns::branch,
                                       &ContactColumns::arm, &ContactColumns::shear_force};
  /// All columns of numbers.
  static constexpr std::array kNumbers{
      &ContactColumns::overlap,          &ContactColumns::normal_force,
      &ContactColumns::normal_stiffness, &ContactColumns::normal_energy,
      &ContactColumns::shear_stiffness,  &ContactColumns::shear_energy};
  /// Fills up, or cuts off.
  void resize(std::size_t entries);
};

class Contacts;

/// The contacts of all listed pairs, each made from the columns when it is asked for.
class ContactRecords {
 public:
  /// Looks at contacts, which have to outlive it.
  explicit ContactRecords(const Contacts& contacts) : contacts_(&contacts) {}
  /// The number of pairs, those that do not touch included.
  std::size_t size() const;
  /// The record of a pair, made when it is asked for.
  Contact operator[](std::size_t pair) const;
  /// The record of the first pair.
  Contact front() const { return (*this)[0]; }

  class Iterator;
  /// Of the first pair.
  Iterator begin() const;
  /// Behind the last pair.
  Iterator end() const;

 private:
  const Contacts* contacts_;
};

/// Reads the records one after the other; a record is made at each step.
class ContactRecords::Iterator {
 public:
  /// As of an input iterator.
  using iterator_category = std::input_iterator_tag;
  /// What it reads.
  using value_type = Contact;
  /// Between two places.
  using difference_type = std::ptrdiff_t;
  /// There is none: records are values.
  using pointer = void;
  /// Records are values.
  using reference = Contact;

  /// At a place among the records.
  Iterator(const ContactRecords& records, std::size_t at) : records_(records), at_(at) {}
  /// The record at this place.
  Contact operator*() const { return records_[at_]; }
  /// To the next record.
  Iterator& operator++() {
    ++at_;
    return *this;
  }
  /// At the same place?
  bool operator==(const Iterator& other) const { return at_ == other.at_; }

 private:
  ContactRecords records_;
  std::size_t at_;
};

inline ContactRecords::Iterator ContactRecords::begin() const { return {*this, 0}; }
inline ContactRecords::Iterator ContactRecords::end() const { return {*this, size()}; }

/// The contacts of all pairs of a neighbour list, and their history.
class Contacts {
 public:
  /// Brings every contact to the current positions and velocities and renews resultants and sums.
  /// @param particles  all of them
  /// @param cell  the cell they are in
  /// @param list  the pairs, with separations where they are given
  /// @param laws  between all types
  /// @param branch  which gap is a contact
  /// @param dt  time since the last update: the shear displacement is velocity times dt
  /// @param profile  what the times and counts of the pairs are added to; null: none
  ContactWork update(const Particles& particles, const Cell& cell, const NeighbourList& list,
                     const ContactLaws& laws, double dt, Branch branch = Branch::follow,
                     Profile* profile = nullptr);

  /// Keeps the contacts of pairs that are in both lists.
  void carry_over(const std::vector<Pair>& before, const std::vector<Pair>& now);

  /// Follows particles that were permuted: particle i is now at place[i]. Returns the pairs that
  /// the contacts are now of, in ascending order: where a and b of one went over to the other
  /// order, its contact is seen from the other side. Resultants and sums wait for the next update.
  std::vector<Pair> renumber(const std::vector<Pair>& pairs, std::span<const std::uint32_t> place);

  /// Follows a cell that is described anew: the pairs that the contacts are now of, in ascending
  /// order. The contacts keep their bits; one of a particle with its own image may be seen from the
  /// other side. Resultants and sums wait for add_up().
  std::vector<Pair> follow(const std::vector<Pair>& pairs, const Reset& reset);

  /// Takes over saved contacts: each column has an entry a pair, or is filled up. Adds them up.
  void restore(ContactColumns columns, const Particles& particles, const NeighbourList& list);

  /// Resultants and sums of the contacts as they are: after carry_over() where none follows them.
  void add_up(const Particles& particles, const NeighbourList& list);

  /// The number of pairs, those that do not touch included.
  std::size_t size() const { return count_; }
  /// As long as size(); the columns go on.
  const ContactColumns& columns() const { return columns_; }
  /// Do the bodies of a pair overlap?
  bool touches(std::size_t pair) const { return columns_.overlap[pair] > 0.0; }
  /// On body b of a pair.
  Vec3 force(std::size_t pair) const {
    return columns_.normal_force[pair] * columns_.normal[pair] + columns_.shear_force[pair];
  }
  /// All pairs, as records.
  ContactRecords records() const { return ContactRecords(*this); }

  /// Force and moment on each particle.
  const Resultants& resultants() const { return resultants_; }
  /// Sums over all contacts of the last step.
  const ContactSums& sums() const { return sums_; }
  /// Totals over the contacts as they are now.
  ContactTotals totals() const;

  /// What a wall bears: of its contacts the force along their normals, and their stiffness.
  struct Borne {
    double force = 0.0, stiffness = 0.0;  ///< sums
  };
  /// By the number that the wall has as a body in the pairs of the list (Pair).
  Borne borne_by(std::int32_t body, const NeighbourList& list) const;

  /// Of the contacts as they are, those of two ellipsoids that the published scheme has no answer
  /// for (trace_contact.hpp): Branch::trace takes the certified one.
  std::int64_t unanswered(const Particles& particles, const Cell& cell,
                          const NeighbourList& list) const;

 private:
  struct Step;
  struct MovedPair;
  std::vector<Pair> reorder(std::vector<MovedPair> moved);
  struct BlockTimes;
  void refresh(const Particles& particles, const Cell& cell, Profile* profile);
  void update_blocks(const Step& step, Profile* profile);
  double power_of_planes(const Step& step, std::size_t first, std::size_t count) const;
  BlockTimes update_block(std::size_t index, const Step& step, bool is_timed);
  ContactBlock block_at(std::size_t index);
  void resize(std::size_t pairs);
  ContactWork add_up_blocks();
  void add_up_particles(const NeighbourList& list, std::size_t particles);

  std::size_t count_ = 0;
  ContactColumns columns_;
  bool may_have_shear_ = false;  ///< else shear forces are all 0
  Resultants resultants_;
  ContactSums sums_;

  // Made anew in every update.
  NarrowPhase narrow_phase_;
  std::vector<MotionRow, LargePages<MotionRow>> motion_;  ///< of particles and walls
  std::vector<Vec3> force_, moment_a_, moment_b_;  ///< of each pair, filled up like the columns
  std::vector<BlockSums> block_sums_;
};

}  // namespace tangency::inline v0::dem
