// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A block of contacts for the lanes, and one contact at a time through them.
#pragma once

#include <array>
#include <cstddef>

#include <tangency/dem/contact/contact_law.hpp>
#include <tangency/dem/lanes/contact_lanes.hpp>
#include <tangency/geometry/indexed_pair.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::testing {

/// The arrays of a block, at first of pairs of particles 0 and 1 that lie apart.
struct ContactArrays {
  static constexpr std::size_t kPairs = dem::ContactBlock::kPairs;
  using Numbers = std::array<double, kPairs>;
  using Vectors = std::array<Vec3, kPairs>;

  std::array<IndexedPair, kPairs> pairs;
  alignas(64) std::array<dem::MotionRow, 16> motion{};
  Numbers gap, normal_stiffness{}, shear_stiffness{}, friction_coefficient{}, cohesion{};
  Numbers half_compliance{};
  Vectors normal, branch, arm;
  Numbers hertz_force{}, hertz_stiffness{}, hertz_energy{}, along{}, across{};
  Vectors direction;
  bool damped = false;  ///< by these
  Numbers viscosity{}, inverse_mass{};
  Vectors normal_before, branch_before, arm_before, shear_force;  ///< and after
  Numbers overlap{}, normal_force{}, normal_stiffness_now{}, normal_energy{};
  Numbers state_stiffness{}, shear_energy{};
  Vectors force, moment_a, moment_b;
  dem::BlockSums sums{};
  double dt = 1.0;
  Mat3 rate = Mat3::Zero();

  ContactArrays() {
    pairs.fill({0, 1});
    gap.fill(1.0);
    for (Vectors* column : {&normal, &branch, &arm, &direction, &normal_before, &branch_before,
                            &arm_before, &shear_force})
      column->fill(Vec3::Zero());
  }

  void set_law(std::size_t k, const dem::ContactLaw& law) {
    normal_stiffness[k] = law.normal_stiffness;
    shear_stiffness[k] = law.shear_stiffness;
    friction_coefficient[k] = law.friction_coefficient;
    cohesion[k] = law.cohesion;
    half_compliance[k] = law.shear_stiffness > 0.0 ? 0.5 / law.shear_stiffness : 0.0;
  }
  void set_hertz(std::size_t k, const dem::NormalResponse& response) {
    hertz_force[k] = response.force;
    hertz_stiffness[k] = response.stiffness;
    hertz_energy[k] = response.energy;
    along[k] = response.shear.along;
    across[k] = response.shear.across;
    direction[k] = response.shear.direction;
  }

  void step(std::size_t count, bool hertz, bool bears_shear = true) {
    const dem::HertzColumns columns{hertz_force.data(),  hertz_stiffness.data(),
                                    hertz_energy.data(), along.data(),
                                    across.data(),       direction[0].data()};
    dem::ContactBlock block{};
    block.count = count;
    block.pairs = pairs.data();
    block.motion = motion.data();
    block.dt = dt;
    for (int k = 0; k < 9; ++k) block.rate[k] = rate.data()[k];
    block.gap = gap.data();
    block.normal = normal[0].data();
    block.branch = branch[0].data();
    block.arm = arm[0].data();
    block.law = {normal_stiffness.data(), shear_stiffness.data(), friction_coefficient.data(),
                 cohesion.data(), half_compliance.data()};
    const dem::DashpotColumns dashpots{viscosity.data(), inverse_mass.data()};
    block.hertz = hertz ? &columns : nullptr;
    block.dashpots = damped ? &dashpots : nullptr;
    block.bears_shear = bears_shear;
    block.state = {normal_before[0].data(),     branch_before[0].data(), arm_before[0].data(),
                   shear_force[0].data(),       overlap.data(),          normal_force.data(),
                   normal_stiffness_now.data(), normal_energy.data(),    state_stiffness.data(),
                   shear_energy.data()};
    block.force = force[0].data();
    block.moment_a = moment_a[0].data();
    block.moment_b = moment_b[0].data();
    block.sums = &sums;
    contact_lanes(block);
  }
};

/// The push of a linear contact.
inline dem::NormalResponse linear_push(const dem::ContactLaw& law, double overlap) {
  const double force = law.normal_stiffness * overlap, shear = law.shear_stiffness;
  return {force, law.normal_stiffness, 0.5 * force * overlap, {shear, shear, Vec3::Zero()}};
}

/// How a contact moves during a step.
struct ContactStep {
  Vec3 previous_normal;  ///< unit
  Vec3 normal;           ///< unit
  /// Of b relative to a at the contact, length; half of it comes before the normal turns, half
  /// after.
  Vec3 displacement;
};

/// A touching contact's shear after a step under a push. Returns the work lost to sliding.
inline double shear_step(const dem::ContactLaw& law, dem::ShearState& state,
                         const ContactStep& step, const dem::NormalResponse& push) {
  ContactArrays one;
  one.set_law(0, law);
  one.set_hertz(0, push);
  one.gap[0] = law.hertz ? -1.0 : -push.force / law.normal_stiffness;
  one.normal[0] = step.normal;
  one.normal_before[0] = step.previous_normal;
  one.overlap[0] = one.normal_energy[0] = 1.0;
  one.shear_force[0] = state.force;
  one.state_stiffness[0] = state.stiffness;
  one.shear_energy[0] = state.energy;
  for (std::size_t k = 0; k < 3; ++k)
    one.motion[1].velocity[k] = step.displacement[static_cast<Eigen::Index>(k)];
  one.step(1, law.hertz.has_value());
  state = {one.shear_force[0], one.state_stiffness[0], one.shear_energy[0]};
  return one.sums.sliding;
}

}  // namespace tangency::testing
