// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// How the box of LAMMPS strains, by its edges alone.
#pragma once

#include <domain.h>

#include <array>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::lammps {

/// The affine motion of a box from step to step: from the change of Domain::h, whichever command
/// changes it. Domain::h_rate is not read: some commands store a rate of length there, some a
/// rate of strain, some nothing.
class BoxMotion {
 public:
  /// Edges of a box: xx yy zz yz xz xy, as Domain::h has them.
  using Edges = std::array<double, 6>;

  /// From this box on.
  void start(const LAMMPS_NS::Domain& domain);
  /// From a box of these edges on.
  void start(const Edges& edges) { edges_ = edges; }
  /// Those of the last call of start() or advance().
  const Edges& edges() const { return edges_; }
  /// Velocity gradient since the last call of start() or advance(), 1/time; a tilted box that was
  /// flipped since, described by other edges, has not moved. Of a box without any strain exactly 0.
  /// @param dt  > 0
  Mat3 advance(const LAMMPS_NS::Domain& domain, double dt);

  /// The distance between opposite faces, of each pair of them, length.
  static Vec3 thickness(const LAMMPS_NS::Domain& domain);

 private:
  Edges edges_{};
};

}  // namespace tangency::inline v0::lammps
