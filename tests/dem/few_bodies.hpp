// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A few bodies without a scene, for what theory says about one or two of them.
#pragma once

#include <cmath>
#include <vector>

#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/motion/motion.hpp>

namespace tangency::testing {

struct FewBodies {
  dem::Cell cell = dem::Cell::box(Vec3::Constant(100.0));
  dem::Particles particles;
  dem::ContactLaws laws;  ///< of one type, walls included
  dem::Motion motion;
  dem::Branch branch = dem::Branch::follow;
  dem::NeighbourList list;
  dem::Contacts contacts;
  dem::ContactWork work;
  dem::MotionWork motion_work;

  explicit FewBodies(const dem::ContactLaw& law) : laws{1, {law}} {}

  /// Of density 1, with velocities.
  std::size_t add(const Vec3& centre, const Eigen::Quaterniond& axes, const Vec3& radii,
                  const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero()) {
    particles.add(centre, axes, radii, 1.0, 0);
    particles.velocity.back() = velocity;
    particles.angular_velocity.back() = spin;
    return particles.size() - 1;
  }
  /// Contacts at the current positions, `dt` after the last.
  void update(double dt = 0.0) {
    if (!list.is_current(particles, cell)) {
      const std::vector<dem::Pair> before = list.pairs();
      list.build(particles, cell, 0.3);
      contacts.carry_over(before, list.pairs());
    }
    work += contacts.update(particles, cell, list, laws, dt, branch);
  }
  void step(double dt) {
    const dem::MotionWork one = move(particles, cell, contacts.resultants(), motion, dt);
    motion_work.damping += one.damping;
    motion_work.gravity += one.gravity;
    update(dt);
  }
  std::size_t touching() const {
    std::size_t count = 0;
    for (const dem::Contact& contact : contacts.records()) count += contact.touches() ? 1u : 0u;
    return count;
  }
  /// The first pair's record.
  dem::Contact contact() const { return contacts.records().front(); }
  double mass(std::size_t i) const { return particles.mass[i]; }
  /// Tensor of inertia in space.
  Mat3 inertia(std::size_t i) const {
    const Mat3 axes = particles.orientation[i].toRotationMatrix();
    return axes * dem::principal_inertia(particles.mass[i], particles.semi_axes[i]).asDiagonal() *
           axes.transpose();
  }
};

/// cross(r) v = r x v.
inline Mat3 cross(const Vec3& r) {
  Mat3 matrix;
  matrix << 0.0, -r[2], r[1], r[2], 0.0, -r[0], -r[1], r[0], 0.0;
  return matrix;
}

/// Order of convergence from two errors, the second at half the step.
inline double order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace tangency::testing
