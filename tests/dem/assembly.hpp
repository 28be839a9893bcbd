// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Small assemblies for the tests of the simulator, and a brute-force look at their contacts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <tangency/dem/contacts.hpp>
#include <tangency/dem/sample.hpp>
#include <tangency/geometry/gap.hpp>

namespace tangency::testing {

/// `count` ellipsoids of axes drawn from [0.5, 1] at random places of a cube: many overlap.
inline dem::Particles crowd(std::size_t count, const dem::Cell& cell, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform3 = [&] {
    return Vec3(dem::uniform(random), dem::uniform(random), dem::uniform(random));
  };
  dem::Particles particles;
  for (std::size_t i = 0; i < count; ++i) {
    // Up to a cell length outside: particles are not wrapped.
    const Vec3 centre = cell.edges * (3.0 * uniform3() - Vec3::Ones());
    const Vec3 radii = 0.5 * (Vec3::Ones() + uniform3());
    particles.add(centre, dem::uniform_rotation(random), radii, 1.0, 0);
    particles.velocity.back() = uniform3() - Vec3::Constant(0.5);
    particles.angular_velocity.back() = uniform3() - Vec3::Constant(0.5);
  }
  return particles;
}

inline Ellipsoid body(const dem::Particles& particles, std::size_t i) {
  return Ellipsoid(Vec3::Zero(), particles.semi_axes[i], particles.orientation[i]);
}

/// Every pair of images within `images` cells of each other whose bounding spheres meet.
inline std::vector<dem::Pair> meeting_pairs(const dem::Particles& particles, const dem::Cell& cell,
                                            std::int32_t images) {
  std::vector<dem::Pair> pairs;
  const auto count = static_cast<std::int32_t>(particles.size());
  dem::Pair pair{};
  for (pair.a = 0; pair.a < count; ++pair.a)
    for (pair.b = pair.a; pair.b < count; ++pair.b)
      for (pair.image[0] = -images; pair.image[0] <= images; ++pair.image[0])
        for (pair.image[1] = -images; pair.image[1] <= images; ++pair.image[1])
          for (pair.image[2] = -images; pair.image[2] <= images; ++pair.image[2]) {
            if (pair.a == pair.b && pair.image <= dem::Image{0, 0, 0}) continue;
            const double reach = particles.semi_axes[static_cast<std::size_t>(pair.a)].maxCoeff() +
                                 particles.semi_axes[static_cast<std::size_t>(pair.b)].maxCoeff();
            if (branch_vector(pair, particles, cell).norm() < reach) pairs.push_back(pair);
          }
  return pairs;
}

/// One law for all pairs of one type.
inline dem::ContactLaws laws(const dem::ContactLaw& law) { return {1, {law}}; }

}  // namespace tangency::testing
