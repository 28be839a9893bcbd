// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// fix tangency/move: the simulator's law of motion for ellipsoids of LAMMPS.
///
///     fix ID group tangency/move [damping D | damping fire] [rotational D]
///                                [rotation full|simplified|none] [affine yes|no]
///
/// The leapfrog of dem::move(), to the bit where numbers are the same: velocities belong to half a
/// step before the positions and are fluctuations, what particles move in addition to the affine
/// motion; turns are exact. D is the rate at which a free particle's velocity decays, 1/time, of
/// translation, and of rotation where `rotational` does not say another; `fire` steers velocities
/// downhill instead (dem/motion/fire.hpp).
///
/// With `affine yes`, the default, particles follow the box, as it changed since the step before:
/// then nothing else may move them with it, so fix deform needs `remap none`. It works beside fix
/// tangency/servo, which has to be defined before it. With `affine no` the box may be anybody's
/// whose fix moves particles with it (fix deform remap x, fix press/berendsen). What a box strains
/// at the end of the last step of a run, after particles moved, they follow at the end of the run.
///
/// Vector, extensive: [1] energy that damping took; [2] kinetic energy at the time of the
/// positions, with which energies add up; [3] kinetic energy of the velocities, half a step before.
/// Restart: the damping's energy, fire's state and the box that particles have followed.
#pragma once

#include <atom_vec_ellipsoid.h>
#include <fix.h>

#include <array>
#include <cstdio>
#include <optional>

#include <tangency/dem/lammps/box_motion.hpp>
#include <tangency/dem/lanes/particle_lanes.hpp>
#include <tangency/dem/motion/fire.hpp>
#include <tangency/dem/motion/motion.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::lammps {

/// What the head of this file says.
class FixMove : public LAMMPS_NS::Fix {
 public:
  /// Reads the command. Ends LAMMPS with a line that says what is wrong with it.
  FixMove(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_run() override;
  void reset_dt() override {}  ///< the step is asked for each time
  double compute_vector(int entry) override;
  void write_restart(FILE* file) override;
  void restart(char* saved) override;

 private:
  struct Chunk;
  template <class F>
  void for_each_chunk(const F& f);
  detail::InertiaProducts products();
  void steer();
  void require_nobody_else_follows_the_box();

  dem::Motion motion_;
  std::optional<dem::Fire> fire_;  ///< in place of damping
  bool is_affine_ = true;
  BoxMotion box_;                     ///< since particles followed it last
  Vec3 low_ = Vec3::Zero();           ///< its corner then
  bool is_restarted_ = false;         ///< are these of a restart, and the next setup() keeps them?
  double lost_ = 0.0;                 ///< to damping, of this rank
  std::array<double, 3> sums_{};      ///< of compute_vector()
  LAMMPS_NS::bigint summed_at_ = -1;  ///< the step of sums_
  LAMMPS_NS::AtomVecEllipsoid* bodies_ = nullptr;
};

}  // namespace tangency::inline v0::lammps
