// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// pair_style tangency: the simulator's contacts between the ellipsoids of LAMMPS.
///
///     pair_style tangency [branch follow|global] [accuracy certified|standard] [timing yes|no]
///     pair_coeff I J ...                          (pair_coefficients.hpp)
///
/// Geometry and law are the simulator's own functions (NarrowPhase, step_block()), so that a study
/// goes on here with the same physics to rounding. A contact's record is kept with LAMMPS' history
/// of neighbours and goes with the atoms from rank to rank and into restart files.
///
/// (1) Forces do not depend on ranks, newton and the order of atoms but by rounding.
/// (2) Velocities are the fluctuations about the strain of the box, which is taken from its edges
///     (box_motion.hpp); under `fix deform ... remap v` they are whole velocities.
/// (3) Where LAMMPS computes forces without a step before (setup, minimisation) no time passes: the
///     shear forces stay, but for the turn of the contact.
/// (4) The virial is the symmetric part of the sum of branch times force, the energy that of the
///     springs. `compute pair` has the account of works since the style was made: sliding,
///     boundary, branch, viscous (dem::ContactWork); and, with `timing yes`, the time that was
///     spent on bodies, on gathering pairs, in the kernel, on the law and what is given to atoms.
///
/// Refused with one line: atoms that are no ellipsoids, numbers that are none, a plane box,
/// r-RESPA, ghosts without velocities, a floating-point environment that flushes or rounds
/// otherwise, and periodic boxes in which a pair could meet twice.
#pragma once

#include <lammps.h>
#include <pair.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <tangency/dem/contact/contact_laws.hpp>
#include <tangency/dem/contact/narrow_phase.hpp>
#include <tangency/dem/lammps/atom_bodies.hpp>
#include <tangency/dem/lammps/box_motion.hpp>
#include <tangency/dem/lammps/contact_record.hpp>
#include <tangency/dem/lammps/contact_source.hpp>
#include <tangency/dem/lammps/fix_contact_history.hpp>
#include <tangency/geometry/gap_batch.hpp>

namespace tangency::inline v0::lammps {

/// Numbers of a contact that `compute pair/local` knows as p1, p2, ...
inline constexpr int kPairColumns = 27;

/// The pair style; LAMMPS makes it, calls it and owns it.
class PairTangency : public LAMMPS_NS::Pair, public ContactSource {
 public:
  /// Made by the command pair_style.
  explicit PairTangency(LAMMPS_NS::LAMMPS* lammps);
  ~PairTangency() override;
  PairTangency(const PairTangency&) = delete;
  PairTangency& operator=(const PairTangency&) = delete;

  /// Forces, moments, energy and virial of all pairs; brings their records to now.
  void compute(int eflag, int vflag) override;
  /// The words of pair_style.
  void settings(int count, char** words) override;
  /// The words of pair_coeff.
  void coeff(int count, char** arguments) override;
  /// Refuses what it cannot do, asks for a half list and for the history.
  void init_style() override;
  /// The distance within which two types can touch.
  double init_one(int i, int j) override;
  /// The energy of a pair; its force along the branch and, in svector, the columns of
  /// `compute pair/local`: docs/lammps.md.
  double single(int i, int j, int itype, int jtype, double rsq, double factor_coul,
                double factor_lj, double& fforce) override;
  /// "affine_stiffness": the share of this rank in the sum of K_n (n . branch)^2 over all contacts
  /// of the last step, what a servo needs (dem::ContactSums).
  void* extract(const char* name, int& dimension) override;
  /// For computes: the contacts of the last call of compute().
  void for_each_contact(const std::function<void(const SeenContact&)>& look) const override;
  /// A record is the same from both sides. Of the two that of this LAMMPS overrides: since 2022 it
  /// gives the types of the atoms too.
  void transfer_history(double* source, double* target);
  /// The same.
  void transfer_history(double* source, double* target, int itype, int jtype);

  /// Laws and settings into a restart file.
  void write_restart(FILE* file) override;
  /// The same out of it.
  void read_restart(FILE* file) override;
  /// Settings alone.
  void write_restart_settings(FILE* file) override;
  /// Settings alone.
  void read_restart_settings(FILE* file) override;
  /// In bytes.
  double memory_usage() override;

 private:
  struct Step;
  void allocate();
  dem::ContactLaw& law_between(int i, int j);
  void make_history();
  void require_host();
  void require_one_law();
  double longest_cutoff() const;
  void require_room(double cutoff);
  Step step();
  void collect(const Step& step);
  void finish(PairBlock& block, const Step& step, double weight);
  void apply(const PairBlock& block, std::size_t k);
  void lap(std::size_t part);
  const double* history_of(int i, int j) const;
  Vec3 velocity_at(int i, int j, const ContactRecord& record, double side) const;
  std::array<double, 2> curvatures(int i, int j, const ContactRecord& record) const;

  dem::Branch branch_ = dem::Branch::follow;
  Accuracy accuracy_ = Accuracy::certified();
  dem::ContactLaws laws_;
  std::vector<double> reach_;  ///< of each type
  AtomBodies bodies_;
  BoxMotion box_;
  Mat3 rate_ = Mat3::Zero();   ///< of the box, which the last forces have seen
  PairBlock within_, across_;  ///< pairs of owned atoms; those that another rank has too
  std::array<double, 4> work_{};
  bool is_timed_ = false;
  double lap_began_ = 0.0;           ///< on MPI's clock
  std::array<double, 4> seconds_{};  ///< of each part, on this rank
  double affine_stiffness_ = 0.0;
  bool laws_are_new_ = false;  ///< since the last compute()
  FixContactHistory* history_ = nullptr;
  std::string history_id_;
};

}  // namespace tangency::inline v0::lammps
