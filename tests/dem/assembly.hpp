// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Small assemblies for the tests of the simulator: a crowd, a brute-force look at its contacts,
/// its motion by the simulator's own parts without a scene, and ways to look at it from another
/// place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/samples/sample.hpp>
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

inline double gap_of(const dem::Pair& pair, const dem::Particles& particles,
                     const dem::Cell& cell) {
  return signed_gap(body(particles, static_cast<std::size_t>(pair.a)),
                    body(particles, static_cast<std::size_t>(pair.b)),
                    branch_vector(pair, particles, cell))
      .gap;
}

/// Every pair of images that touches, by looking at all whose bounding spheres meet.
inline std::vector<dem::Pair> touching_pairs(const dem::Particles& particles,
                                             const dem::Cell& cell) {
  std::vector<dem::Pair> pairs;
  const auto count = static_cast<std::int32_t>(particles.size());
  const Vec3 heights = cell.heights();
  dem::Pair pair{};
  for (pair.a = 0; pair.a < count; ++pair.a)
    for (pair.b = pair.a; pair.b < count; ++pair.b) {
      const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
      const double reach = particles.semi_axes[a].maxCoeff() + particles.semi_axes[b].maxCoeff();
      const Vec3 near = cell.reduced(particles.position[a] - particles.position[b]);
      dem::Image low, high;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<int>(k);
        low[k] = static_cast<std::int32_t>(std::floor(near[axis] - reach / heights[axis]));
        high[k] = static_cast<std::int32_t>(std::ceil(near[axis] + reach / heights[axis]));
        if (cell.walled[k] || axis >= cell.dimensions) low[k] = high[k] = 0;
      }
      for (pair.image[0] = low[0]; pair.image[0] <= high[0]; ++pair.image[0])
        for (pair.image[1] = low[1]; pair.image[1] <= high[1]; ++pair.image[1])
          for (pair.image[2] = low[2]; pair.image[2] <= high[2]; ++pair.image[2]) {
            if (pair.a == pair.b && pair.image <= dem::Image{0, 0, 0}) continue;
            if (branch_vector(pair, particles, cell).norm() >= reach) continue;
            if (gap_of(pair, particles, cell) < 0.0) pairs.push_back(pair);
          }
    }
  return pairs;
}

inline double mean_radius(const Vec3& axes) { return std::cbrt(axes.prod()); }

/// One law for all pairs of one type.
inline dem::ContactLaws laws(const dem::ContactLaw& law) { return {1, {law}}; }

/// An assembly that moves.
struct Moving {
  dem::Cell cell;
  dem::Particles particles;
  dem::NeighbourList list{};
  dem::Contacts contacts{};
  dem::Branch branch = dem::Branch::global;

  void update(const dem::ContactLaw& law, double dt) {
    if (!list.is_current(particles, cell)) {
      const std::vector<dem::Pair> before = list.pairs();
      list.build(particles, cell, 0.3);
      contacts.carry_over(before, list.pairs());
    }
    // In a walled cell the walls are a second type.
    const std::size_t types = cell.has_walls() ? 2 : 1;
    contacts.update(particles, cell, list, {types, std::vector(types * types, law)}, dt, branch);
  }
  void step(const dem::ContactLaw& law, const dem::Motion& motion, double dt) {
    dem::move(particles, cell, contacts.resultants(), motion, dt);
    update(law, dt);
  }
  void run(const dem::ContactLaw& law, int steps, double dt, double damping = 0.0) {
    update(law, 0.0);
    for (int k = 0; k < steps; ++k) step(law, {dem::Rotation::full, Vec3::Zero(), damping}, dt);
  }

  double largest_force() const {
    double largest = 0.0;
    for (const Vec3& force : contacts.resultants().force) largest = std::max(largest, force.norm());
    return largest;
  }
  double largest_contact_force() const {
    double largest = 0.0;
    for (const dem::Contact& contact : contacts.records())
      largest = std::max(largest, contact.force.norm());
    return largest;
  }
  std::size_t touching() const {
    const auto& all = contacts.records();
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const auto& one) { return one.touches(); }));
  }
};

/// The same assembly seen from turned axes: x becomes `turn` x.
inline dem::Particles turned(const dem::Particles& particles, const Mat3& turn) {
  dem::Particles seen = particles;
  const Eigen::Quaterniond q(turn);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen.position[i] = turn * particles.position[i];
    seen.velocity[i] = turn * particles.velocity[i];
    seen.angular_velocity[i] = turn * particles.angular_velocity[i];
    seen.orientation[i] = (q * particles.orientation[i]).normalized();
  }
  return seen;
}

/// The 24 rotations that take coordinate axes to coordinate axes.
inline std::vector<Mat3> axis_rotations() {
  std::vector<Mat3> all;
  int order[3] = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Mat3 turn = Mat3::Zero();
      for (int k = 0; k < 3; ++k) turn(order[k], k) = (signs >> k & 1) != 0 ? -1.0 : 1.0;
      if (turn.determinant() > 0.0) all.push_back(turn);
    }
  } while (std::next_permutation(order, order + 3));
  return all;
}

}  // namespace tangency::testing
