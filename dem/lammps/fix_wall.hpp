// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// fix wall/tangency: a plane wall at any angle that ellipsoids touch by the
/// simulator's law.
///
///     fix ID group wall/tangency plane PX PY PZ NX NY NZ [velocity VX VY VZ]
///     law WORDS...
///
/// The half-space behind the plane through P with the normal N, of any length,
/// is solid; bodies are on the side that N points to. V is the velocity of the
/// wall's material: what is along N moves the face. WORDS are those of
/// pair_coeff (pair_coefficients.hpp). One wall a fix.
///
/// As in the simulator such walls do not strain with a box, so none may be
/// strained. Each particle keeps the record of its contact, which goes with it
/// from rank to rank and into restart files. After a restart a damped approach
/// begins without its damper for a step.
///
/// Scalar: energy stored; it is added to the potential energy after `fix_modify
/// ID energy yes`. The virial is added to that of pairs. Vector, extensive:
/// [1-3] force on the wall; [4] contacts; [5] lost to friction, [6] given by
/// the wall, [7] gained by contacts that changed their branch, [8] lost to
/// damped approach, since the fix was made.
#pragma once

#include <fix.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/contact/contact_laws.hpp>
#include <tangency/dem/contact/narrow_phase.hpp>
#include <tangency/dem/lammps/contact_record.hpp>
#include <tangency/dem/lanes/contact_lanes.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/dem/plane_wall.hpp>
#include <tangency/geometry/large_pages.hpp>

namespace tangency::inline v0::lammps {

class Words;

/// What the head of this file says.
class FixWall : public LAMMPS_NS::Fix {
 public:
  /// Reads the command. Ends LAMMPS with a line that says what is wrong with
  /// it.
  FixWall(LAMMPS_NS::LAMMPS* lammps, int count, char** words);
  ~FixWall() override;
  FixWall(const FixWall&) = delete;
  FixWall& operator=(const FixWall&) = delete;

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void initial_integrate(int) override;
  void post_force(int vflag) override;
  double compute_scalar() override;
  double compute_vector(int entry) override;
  double memory_usage() override;

  // The records, as LAMMPS moves and saves what a fix keeps of atoms.
  void grow_arrays(int atoms) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int atom) override;
  int pack_exchange(int atom, double* buffer) override;
  int unpack_exchange(int atom, double* buffer) override;
  int pack_restart(int atom, double* buffer) override;
  void unpack_restart(int atom, int nth) override;
  int size_restart(int atom) override;
  int maxsize_restart() override;
  void write_restart(FILE* file) override;
  void restart(char* saved) override;

 private:
  static constexpr std::size_t kNumbers = 8;  ///< of compute_vector()
  void read_plane(Words& words);
  void collect();
  void touch(std::size_t first, std::size_t count, double dt);
  double* record_of(int i) { return &records_[static_cast<std::size_t>(i) * kRecordNumbers]; }

  dem::Cell cell_;                       ///< of which only the one plane counts
  dem::ContactLaws laws_;                ///< the one law
  std::vector<double> records_;          ///< ContactRecord, one after the other, an atom each
  std::array<double, kNumbers> here_{};  ///< of this rank
  double energy_ = 0.0;                  ///< of this rank

  // The particles near the wall in this step.
  std::vector<int> atom_;
  dem::Particles particles_;
  dem::NarrowPhase narrow_phase_;
  std::vector<dem::MotionRow, LargePages<dem::MotionRow>> motion_;  ///< and after them the wall's
  PairBlock block_;
};

}  // namespace tangency::inline v0::lammps
