// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// The box of LAMMPS as a matrix of edges. How one strained into another: box_motion.hpp.
#pragma once

#include <domain.h>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::lammps {

/// A parallelepiped as LAMMPS has it: the first edge along x, the second in the plane of x and y.
struct Box {
  Vec3 low = Vec3::Zero();        ///< the corner that the edges start from
  Mat3 edges = Mat3::Identity();  ///< columns; upper triangular, the diagonal > 0; length

  /// The box as it is now.
  static Box of(const LAMMPS_NS::Domain& domain);
  /// Makes it the box of LAMMPS, on every rank alike; particles stay where they are. A tilt of a
  /// box that LAMMPS takes for a rectangular one is lost.
  void set(LAMMPS_NS::Domain& domain) const;
  /// Of the parallelepiped, length^3.
  double volume() const { return edges.diagonal().prod(); }
};

}  // namespace tangency::inline v0::lammps
