// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// compute tangency/fabric: the tensors of contact normals, forces and branch vectors of order 2,
/// by the functions of dem/micromechanics.
///
///     compute ID group tangency/fabric [estimator unbiased|published|contact_sums]
///                                      [partition near_uniform|polar N]
///
/// Normals are those of the surfaces, where compute fabric of LAMMPS takes the branch vectors,
/// which is right of spheres alone. The first rank gathers all contacts, 72 bytes each: it is for
/// up to some 1e8 of them, now and then. Group: all.
///
/// Vector, intensive, tensors as xx yy zz xy xz yz: [1-6] a^r of the normals; [7-12] a^n and
/// [13-18] a^t of forces; [19-24] a^z and [25-30] a^zt of branch vectors; [31] f0, [32] z0, the
/// means of f . n and z . n over orientations; [33] contact sides per volume; [34] contacts. What
/// the contacts leave open is NaN.
#pragma once

#include <compute.h>

#include <vector>

#include <tangency/dem/micromechanics/averages.hpp>
#include <tangency/dem/micromechanics/fabric.hpp>

namespace tangency::inline v0::lammps {

/// What the head of this file says.
class ComputeFabric : public LAMMPS_NS::Compute {
 public:
  /// Reads the command. Ends LAMMPS with a line that says what is wrong with it.
  ComputeFabric(LAMMPS_NS::LAMMPS* lammps, int count, char** words);
  ~ComputeFabric() override;

  void init() override;
  void compute_vector() override;

 private:
  std::vector<double> gathered();

  micromechanics::Classes classes_;
  micromechanics::Estimator estimator_ = micromechanics::Estimator::unbiased;
};

}  // namespace tangency::inline v0::lammps
