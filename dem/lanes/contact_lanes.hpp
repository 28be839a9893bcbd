// SPDX-License-Identifier: MIT
/// @file
/// The contact laws of contact_law.hpp for a block of pairs at once, one pair in each lane of a
/// vector register: from where the bodies of each pair are, what force acts between them before and
/// how they move to the force after, with the sums over the block that every step needs. Free
/// functions that own nothing. The instruction set is chosen when the program runs.
///
/// (1) To the bit, a pair's results do not depend on its neighbours in the block or on its place
///     there, and those of the sums not on the number of lanes. Last bits depend on whether the
///     instruction set has fused multiply-adds, as those of the gaps do.
/// (2) A pair that does not touch, and did not before, gets zeros and keeps its normal.
#pragma once

#include <cstddef>

#include <tangency/geometry/indexed_pair.hpp>

namespace tangency::inline v0::dem {

/// A particle's motion, half a step ago, as the lanes read it: a line of cache, for random access.
/// Rows have to stand where lines begin (geometry/large_pages.hpp).
struct MotionRow {
  double velocity[3];  ///< length per time
  double unused;       ///< fills the row to 32 bytes
  double spin[3];      ///< in space coordinates
  double unused_too;   ///< fills the row to 32 bytes
};
static_assert(sizeof(MotionRow) == 8 * sizeof(double));

/// What a block's contacts carry from step to step: the columns of ContactColumns at the block's
/// first pair. Vectors are x y z of one pair after the other.
struct ContactState {
  double *normal, *branch, *arm, *shear_force;  ///< three numbers a pair, as Contact has them
  /// one number a pair, as Contact has them
  double *overlap, *normal_force, *normal_stiffness, *normal_energy;
  double *shear_stiffness, *shear_energy;  ///< one number a pair, as Contact has them
};

/// The parameters of the law of each pair, as ContactLaw has them.
struct LawColumns {
  /// of each pair, as ContactLaw has them
  const double *normal_stiffness, *shear_stiffness, *friction_coefficient, *cohesion;
  const double* half_compliance;  ///< 1 / (2 shear_stiffness); finite where that is 0
};

/// What Hertz's law makes of each pair that touches (hertz_lanes.hpp); of the others finite.
struct HertzColumns {
  /// of each pair, as NormalResponse has them
  const double *force, *stiffness, *energy, *along, *across;
  const double* direction;  ///< x y z of each
};

/// How the approach of each pair is damped (contact_law.hpp); of pairs that do not touch finite.
struct DashpotColumns {
  const double* viscosity;     ///< damping force over approach and root of stiffness, >= 0
  const double* inverse_mass;  ///< of the pair along its normal, >= 0
};

/// Sums over the contacts of a block, as the lanes write them (ContactSums, ContactWork).
struct BlockSums {
  double force_branch[9];                     ///< column after column
  double affine_stiffness;                    ///< as ContactSums has it
  double sliding, boundary, branch, viscous;  ///< energies, as ContactWork has them
};

/// Up to kPairs pairs. Every array has kPairs entries; those from `count` on are pairs of any
/// particles that lie apart.
struct ContactBlock {
  static constexpr std::size_t kPairs = 64;  ///< pairs a block, at most

  std::size_t count;         ///< pairs in this block
  const IndexedPair* pairs;  ///< into `motion`; the walls, which do not move, follow the particles
  /// of the particles and, after them, of the walls
  const MotionRow* motion;
  double dt;       ///< time since the last update
  double rate[9];  ///< velocity gradient of the cell, column after column

  // Where the pairs are now (PairGeometry).
  /// of each pair, as Gap has them
  const double *gap, *normal, *branch, *arm;

  LawColumns law;                  ///< of each pair
  const HertzColumns* hertz;       ///< null: the linear law
  const DashpotColumns* dashpots;  ///< null: nothing is damped
  bool bears_shear;                ///< may any pair have a shear force, before or after?
  ContactState state;              ///< from the last step's to this one's

  // Results for the bodies: the force of a on b and the moments of it on a and on b.
  double *force, *moment_a, *moment_b;  ///< x y z of each pair
  /// of this block
  BlockSums* sums;
};

/// One step. Reads and writes what the block names.
void contact_lanes(const ContactBlock& block) noexcept;

/// Forces, moments and sums of contacts as they are saved, to the bit as contact_lanes() gave
/// them: of the block it reads count and state, and writes force, moments and sums.
void restored_lanes(const ContactBlock& block) noexcept;

/// Gap, normal and arm of pairs of spheres. Concentric ones have the normal of
/// geometry/primitives.hpp. Arrays of ContactBlock::kPairs entries.
void sphere_lanes(std::size_t count, const double* radius_a, const double* radius_b,
                  const double* branch, double* gap, double* normal, double* arm) noexcept;

}  // namespace tangency::inline v0::dem
