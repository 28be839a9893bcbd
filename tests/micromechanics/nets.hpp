// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Centres in periodic cells, and contacts between them: what the tests of average strain draw.
/// Seeds are those of fields.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tangency/dem/micromechanics/average_strain.hpp>
#include <tangency/dem/micromechanics/strain_mesh.hpp>

#include "fields.hpp"

namespace tangency::testing {

/// Centres that keep themselves.
struct Centres {
  std::vector<Vec3> position;
  Mat3 edges = Mat3::Identity();
  int dimensions = 3;

  micromechanics::PeriodicCentres view() const { return {position, edges, dimensions}; }
};
/// Edges of lengths from 0.7 to 1.4 times `size`, sheared by up to half of them.
Mat3 random_cell(Random& random, int dimensions, const Vec3& size = Vec3::Ones());
/// At random places, up to a cell outside of it.
Centres random_centres(Random& random, std::size_t count, const Mat3& edges, int dimensions);
/// Cubes of unit edges, n along each axis, with centres at the given places in each.
Centres lattice(int n, int dimensions, const std::vector<Vec3>& places = {Vec3::Zero()});

/// Contacts that keep themselves.
struct Links {
  std::vector<std::array<std::int64_t, 2>> bodies;
  std::vector<micromechanics::PeriodicImage> image;

  micromechanics::PeriodicPairs view() const { return {bodies, image}; }
  void add(const micromechanics::MeshEdge& edge) {
    bodies.push_back(edge.bodies);
    image.push_back(edge.image);
  }
};
/// Edges of a net, each with the given probability.
Links some_edges(Random& random, const micromechanics::StrainMesh& mesh, double probability);
/// Every pair of images at that distance, to rounding.
Links pairs_at(const Centres& centres, double distance);

/// Velocities and contact points without any order, and what is slid.
struct Motions {
  std::vector<Vec3> normal, arm, sliding, velocity, spin;
  Mat3 rate = Mat3::Zero();
  micromechanics::ContactMotion of(const Links& links) const {
    return {links.view(), normal, arm, sliding, velocity, spin, rate};
  }
};
Motions random_motions(Random& random, const Centres& centres, const Links& links);

Vec3 random_vector(Random& random, int dimensions);
Mat3 random_matrix(Random& random, int dimensions);
/// The unit tensor, of the plane in the plane.
Mat3 unit(int dimensions);

}  // namespace tangency::testing
