// SPDX-License-Identifier: GPL-3.0-or-later
/// How fast contacts slide, against what their next short step does.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tangency/dem/tool/packing.hpp>
#include <tangency/dem/tool/sliding.hpp>

#include "assembly.hpp"
#include "assembly_state.hpp"

namespace tangency::testing {
namespace {

const dem::Cell kCube = dem::Cell::box(Vec3::Constant(4.0));

/// Of bodies that do not turn.
std::vector<Vec3> velocities_at(const dem::Packing& packing) {
  std::vector<Vec3> all;
  for (const auto& [a, b] : packing.contacts.bodies)
    all.push_back(packing.particles.velocity[static_cast<std::size_t>(b)] -
                  packing.particles.velocity[static_cast<std::size_t>(a)]);
  return all;
}

dem::Particles shifting_crowd(std::uint64_t seed) {
  dem::Particles particles = crowd(40, kCube, seed);
  for (Vec3& spin : particles.angular_velocity) spin.setZero();
  return particles;
}

Vec3 shear_of(const dem::Packing& packing, std::size_t c) {
  return packing.contacts.force[c] - packing.contacts.normal_force[c] * packing.contacts.normal[c];
}

/// What a law makes of a step.
struct Law {
  const char* name;
  dem::ContactLaw law;
  bool of_spheres;  ///< whose Hertz contacts have one tangential stiffness
};
class SlidingOf : public ::testing::TestWithParam<Law> {};

// dem/tool/sliding.hpp (1)
TEST_P(SlidingOf, IsWhatTheSpringDoesNotTakeUpInAShortStep) {
  constexpr double kStep = 1e-5;
  // Rates change within the step by its length over the bodies' radii, 1/2 to 1.
  constexpr double kShort = 1e-3;
  const dem::ContactLaw& law = GetParam().law;
  dem::Particles particles = shifting_crowd(3);
  if (GetParam().of_spheres)
    for (Vec3& radii : particles.semi_axes) radii.setConstant(radii[0]);
  dem::State state = state_of(particles, kCube, law, 0.05);
  const dem::Packing before = dem::packing_of(state);
  const std::vector<Vec3> velocity = velocities_at(before);
  const std::vector<Vec3> sliding = dem::sliding_of(before, state.laws, velocity);
  for (std::size_t i = 0; i < state.particles.size(); ++i)
    state.particles.position[i] += kStep * state.particles.velocity[i];
  state.contacts.update(state.particles, kCube, state.list, state.laws, kStep);
  const dem::Packing after = dem::packing_of(state);
  ASSERT_EQ(before.contacts.bodies, after.contacts.bodies);
  std::size_t slide = 0, stick = 0;
  for (std::size_t c = 0; c < sliding.size(); ++c) {
    const Vec3 shear = shear_of(before, c);
    const double stiffness = before.contacts.shear_stiffness[c];
    // What is unloaded shrinks with its stiffness.
    const double kept = std::min(1.0, after.contacts.shear_stiffness[c] / stiffness);
    const double growth = shear_of(after, c).norm() - kept * shear.norm();
    // Of the stretch along the force, which is against the velocity.
    const double lost = velocity[c].dot(shear.normalized()) + growth / (stiffness * kStep);
    EXPECT_NEAR(sliding[c].dot(shear.normalized()), lost, kShort) << c;
    EXPECT_LT(sliding[c].cross(shear.normalized()).norm(), 1e-12);
    if (before.contacts.sliding[c] == 0) ++stick;
    if (sliding[c].norm() > kShort) ++slide;
  }
  EXPECT_GT(slide, 5u);
  EXPECT_GT(stick, 5u);
}
INSTANTIATE_TEST_SUITE_P(
    Laws, SlidingOf,
    ::testing::Values(Law{"linear", {100.0, 80.0, 0.2, 0.0}, false},
                      Law{"cohesive", {100.0, 80.0, 0.2, 0.1}, false},
                      Law{"hertz", {100.0, 80.0, 0.2, 0.0, dem::Material{100.0, 0.3}}, true}),
    [](const auto& law) { return std::string(law.param.name); });

// dem/tool/sliding.hpp (2)
TEST(Sliding, OfContactsWithoutAShearSpringIsTheTangentialVelocity) {
  const dem::State state =
      state_of(shifting_crowd(4), kCube, dem::ContactLaw{100.0, 0.0, 0.2, 0.0}, 0.05);
  const dem::Packing packing = dem::packing_of(state);
  const std::vector<Vec3> velocity = velocities_at(packing);
  const std::vector<Vec3> sliding = dem::sliding_of(packing, state.laws, velocity);
  ASSERT_GT(sliding.size(), 20u);
  for (std::size_t c = 0; c < sliding.size(); ++c) {
    const Vec3& n = packing.contacts.normal[c];
    EXPECT_LT((sliding[c] - (velocity[c] - velocity[c].dot(n) * n)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace tangency::testing
