// SPDX-License-Identifier: GPL-3.0-or-later
#include "nets.hpp"

#include <cmath>

namespace tangency::testing {

using micromechanics::MeshEdge;
using micromechanics::PeriodicImage;

Vec3 random_vector(Random& random, int dimensions) {
  Vec3 v = Vec3::Zero();
  for (int k = 0; k < dimensions; ++k) v[k] = uniform(random, -1.0, 1.0);
  return v;
}

Mat3 random_matrix(Random& random, int dimensions) {
  Mat3 m = Mat3::Zero();
  for (int k = 0; k < dimensions; ++k) m.col(k) = random_vector(random, dimensions);
  return m;
}

Mat3 unit(int dimensions) {
  Mat3 m = Mat3::Zero();
  for (int k = 0; k < dimensions; ++k) m(k, k) = 1.0;
  return m;
}

Mat3 random_cell(Random& random, int dimensions, const Vec3& size) {
  Mat3 edges = Mat3::Identity();
  for (int k = 0; k < dimensions; ++k) {
    edges.col(k) = 0.5 * size[k] * random_vector(random, dimensions);
    edges(k, k) = size[k] * uniform(random, 0.7, 1.4);
  }
  return edges;
}

Centres random_centres(Random& random, std::size_t count, const Mat3& edges, int dimensions) {
  Centres centres{{}, edges, dimensions};
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 at = Vec3::Zero();
    for (int k = 0; k < dimensions; ++k) at[k] = uniform(random, -1.0, 2.0);
    centres.position.push_back(edges * at);
  }
  return centres;
}

Centres lattice(int n, int dimensions, const std::vector<Vec3>& places) {
  Centres centres{{}, Mat3::Identity(), dimensions};
  for (int k = 0; k < dimensions; ++k) centres.edges(k, k) = n;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < (dimensions == 3 ? n : 1); ++z)
        for (const Vec3& place : places) centres.position.push_back(Vec3(x, y, z) + place);
  return centres;
}

Links some_edges(Random& random, const micromechanics::StrainMesh& mesh, double probability) {
  Links links;
  for (const MeshEdge& edge : mesh.edges)
    if (uniform(random, 0.0, 1.0) < probability) links.add(edge);
  return links;
}

Links pairs_at(const Centres& centres, double distance) {
  Links links;
  const auto count = static_cast<std::int64_t>(centres.position.size());
  const std::int32_t deep = centres.dimensions == 3 ? 1 : 0;
  for (std::int64_t a = 0; a < count; ++a)
    for (std::int64_t b = a; b < count; ++b)
      for (std::int32_t x = -1; x <= 1; ++x)
        for (std::int32_t y = -1; y <= 1; ++y)
          for (std::int32_t z = -deep; z <= deep; ++z) {
            const PeriodicImage image{x, y, z};
            if (a == b && image <= PeriodicImage{}) continue;
            if (std::abs(centres.view().branch({a, b}, image).norm() - distance) < 1e-9)
              links.add({{a, b}, image, Vec3::Zero(), Vec3::Zero()});
          }
  return links;
}

Motions random_motions(Random& random, const Centres& centres, const Links& links) {
  const int dimensions = centres.dimensions;
  Motions motions;
  motions.rate = random_matrix(random, dimensions);
  for (std::size_t i = 0; i < centres.position.size(); ++i) {
    motions.velocity.push_back(random_vector(random, dimensions));
    motions.spin.push_back(dimensions == 3 ? random_vector(random, 3)
                                           : Vec3(0.0, 0.0, uniform(random, -1.0, 1.0)));
  }
  for (std::size_t c = 0; c < links.bodies.size(); ++c) {
    motions.normal.push_back(random_vector(random, dimensions).normalized());
    motions.arm.push_back(random_vector(random, dimensions));
    motions.sliding.push_back(random_vector(random, dimensions));
  }
  return motions;
}

}  // namespace tangency::testing
