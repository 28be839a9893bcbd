// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// fix tangency/servo: strains the box at given rates and holds stresses, as the simulator's stages
/// do (dem/loading.hpp).
///
///     fix ID group tangency/servo [rate xx|yy|zz|xy|xz|yz R]... [mean|plane|x|y|z P]... [lode B]
///                                 [direction A] [max R] [gain G] [published G] [integral yes|no]
///                                 [modulus K]
///
/// `rate` is given, extension positive, 1/time; of a tilted box dv_x/dy and alike. Stresses are
/// held: the mean of all or of x and y, or components, compression positive; s_yy - s_xx = B
/// (s_zz - s_xx) with `lode`; no shear on the axes that lie A degrees from z towards x with
/// `direction`. `max` bounds each target's rate. Group: it does not matter.
///
/// The stress is that of `compute pressure NULL virial`: of contacts, and of walls that say theirs.
/// Errors count as the strain that would remove them, by a stiffness that the pair style gives
/// (Pair::extract "affine_stiffness", the sum of K_n (n . branch)^2 over the pairs of the rank);
/// with another style `modulus` is the rise of the mean stress per linear isotropic strain.
///
/// The corner of the box stays where it is. The box is strained before particles move, so that fix
/// tangency/move takes them along; fixes that do not follow the box leave them where they are.
/// A tilt beyond half an edge is described by the least tilted edges.
///
/// Vector, intensive: [1-6] the rate of the last step, xx yy zz xy xz yz; [7...] how far each
/// target is off, in the order of the command. Restart: what the servos remember.
#pragma once

#include <compute.h>
#include <fix.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/lammps/box.hpp>
#include <tangency/dem/loading.hpp>
#include <tangency/dem/observe.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::lammps {

class Words;

/// What the head of this file says.
class FixServo : public LAMMPS_NS::Fix {
 public:
  /// Reads the command. Ends LAMMPS with a line that says what is wrong with it.
  FixServo(LAMMPS_NS::LAMMPS* lammps, int count, char** words);
  ~FixServo() override;

  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void pre_exchange() override;
  void end_of_step() override;
  double compute_vector(int entry) override;
  void write_restart(FILE* file) override;
  void restart(char* saved) override;

 private:
  void read(Words& words);
  void check(Words& words) const;
  void measure();

  dem::Loading loading_;
  std::optional<double> modulus_;
  std::vector<dem::ServoMemory> memory_;
  dem::Stress stress_;        ///< at the end of the last step
  Mat3 rate_ = Mat3::Zero();  ///< of the last step
  std::string pressure_id_;
  LAMMPS_NS::Compute* pressure_ = nullptr;
  bool flips_ = false;  ///< has the box to be described anew before particles are exchanged?
};

}  // namespace tangency::inline v0::lammps
