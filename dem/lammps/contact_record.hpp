// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// What LAMMPS keeps of a pair from step to step (FixNeighHistory), and a block of pairs with it.
#pragma once

#include <array>
#include <cstddef>

#include <tangency/dem/contact/narrow_phase.hpp>
#include <tangency/dem/lanes/contact_lanes.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::lammps {

/// A contact as dem::Contact has it, between the atom of the smaller tag, a, and that of the
/// larger, b: the same from both sides, so that it is copied as it is when LAMMPS moves atoms. All
/// 0: not known.
struct ContactRecord {
  Vec3 normal;              ///< unit, from a to b; of a pair apart: as last known
  Vec3 branch;              ///< x_b - x_a
  Vec3 arm;                 ///< contact point - x_a; of touching pairs only
  Vec3 shear_force;         ///< of a on b
  double overlap;           ///< length; > 0 where the pair touches, else 0
  double normal_force;      ///< >= 0 pushes
  double normal_stiffness;  ///< force/length
  double normal_energy;     ///< stored along the normal
  double shear_stiffness;   ///< the larger one at the last step
  double shear_energy;      ///< stored by the shear displacement

  /// Do the bodies overlap?
  bool touches() const { return overlap > 0.0; }
  /// Of a on b.
  Vec3 force() const { return normal_force * normal + shear_force; }
};

/// Numbers of a record, which lie one after the other.
inline constexpr int kRecordNumbers = 18;
static_assert(sizeof(ContactRecord) == kRecordNumbers * sizeof(double));

/// The record that lies there.
ContactRecord record_at(const double* history);

/// Pairs that wait to be asked about together, with their records in columns.
class PairBlock {
 public:
  /// A pair of atoms and where its record lies.
  struct Atoms {
    int a = 0, b = 0;           ///< a has the smaller tag
    double* history = nullptr;  ///< of the pair
  };

  /// Has it room for another pair?
  bool is_full() const { return count_ == dem::kPairBlock; }
  /// The number of pairs.
  std::size_t size() const { return count_; }
  /// Adds a pair; there is room.
  /// @param bodies  of a and b
  /// @param branch  x_b - x_a
  void add(const Atoms& atoms, const IndexedPair& bodies, const Vec3& branch);
  /// No pair.
  void clear() { count_ = 0; }

  /// How the pairs lie: bodies and branches are set.
  dem::BlockGeometry& geometry() { return geometry_; }
  /// Of the pairs' records.
  const Vec3* normals() const { return normal_.data(); }
  /// For dem::step_block(); what it gives stays until the next pair is added.
  dem::ContactBlock block();
  /// Which atoms pair k is of.
  const Atoms& atoms(std::size_t k) const { return atoms_[k]; }
  /// Do the bodies of pair k overlap?
  bool touches(std::size_t k) const { return overlap_[k] > 0.0; }
  /// Makes a record that of pair k.
  void put(std::size_t k, const ContactRecord& record);
  /// Pair k as it is now.
  ContactRecord record(std::size_t k) const;
  /// Writes the records to where they lie.
  void write_back() const;

  /// On b, of each pair.
  const Vec3& force(std::size_t k) const { return force_[k]; }
  /// Of that force on a, about its centre.
  const Vec3& moment_a(std::size_t k) const { return moment_a_[k]; }
  /// Of that force on b, about its centre.
  const Vec3& moment_b(std::size_t k) const { return moment_b_[k]; }
  /// Of the block.
  const dem::BlockSums& sums() const { return sums_; }

 private:
  template <class T>
  using Column = dem::BlockGeometry::Column<T>;

  std::size_t count_ = 0;
  std::array<Atoms, dem::kPairBlock> atoms_;
  dem::BlockGeometry geometry_;
  Column<Vec3> normal_, branch_, arm_, shear_force_;
  Column<double> overlap_, normal_force_, normal_stiffness_, normal_energy_;
  Column<double> shear_stiffness_, shear_energy_;
  Column<Vec3> force_, moment_a_, moment_b_;
  dem::BlockSums sums_{};
};

}  // namespace tangency::inline v0::lammps
