// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/growth.hpp>
#include <tangency/dem/saved/state_file.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

constexpr Growth kGrowth{1.5, 1.2, 50, 0.01};
constexpr Shape kSphere{10.0, 1.0, 1.0};

// dem/growth.hpp (2)
TEST(Growth, EndsAtTheWantedRatiosExactly) {
  const Shape end = kGrowth.shape_after(kSphere, 50);
  EXPECT_EQ(end.elongation, 1.5);
  EXPECT_EQ(end.flatness, 1.2);
  EXPECT_EQ((Growth{1.5, {}, 50, 0.01}.shape_after({10.0, 1.0, 1.1}, 50).flatness), 1.1);
}

// dem/growth.hpp (1)
TEST(Growth, KeepsVolumeAndArea) {
  for (const std::int64_t done : {0, 1, 17, 50}) {
    EXPECT_NEAR(kGrowth.shape_after(kSphere, done).semi_axes().prod(), 1000.0, 1e-11);
    const Vec3 plane = kGrowth.shape_after(kSphere, done).semi_axes(2);
    EXPECT_NEAR(plane[0] * plane[1], 100.0, 1e-12);
  }
}

TEST(Growth, LargestChangeIsThatOfTheWorstIncrement) {
  for (const auto& [growth, start] :
       {std::pair(kGrowth, kSphere), std::pair(Growth{1.0, 3.0, 70, 0.01}, Shape{1.0, 5.0, 1.0})}) {
    double worst = 0.0;
    for (std::int64_t done = 0; done < growth.increments; ++done) {
      const Vec3 before = growth.shape_after(start, done).semi_axes();
      const Vec3 after = growth.shape_after(start, done + 1).semi_axes();
      worst = std::max(worst, (after.cwiseQuotient(before) - Vec3::Ones()).cwiseAbs().maxCoeff());
    }
    EXPECT_NEAR(growth.largest_change(start, 3), worst, 1e-12);
  }
}

/// Goes on to the stage of this number.
void go_to_stage(Simulation& simulation, std::size_t stage) {
  while (simulation.state().stage < stage) {
    const StageStatus status = simulation.status();
    ASSERT_NE(status, StageStatus::out_of_cycles);
    if (status == StageStatus::done)
      simulation.next_stage();
    else
      simulation.step();
  }
}

/// Compacted spheres or disks, about to grow.
const Simulation& compacted(int dimensions) {
  const auto made = [](int of) {
    Simulation simulation(parse_scene(growing_scene(of), "scene.toml"));
    go_to_stage(simulation, 2);
    return simulation;
  };
  static const Simulation plane = made(2), space = made(3);
  return dimensions == 2 ? plane : space;
}

/// The same after half of the increments.
const Simulation& half_grown(int dimensions) {
  const auto made = [](int of) {
    Simulation simulation = compacted(of);
    while (simulation.state().increments < 10) simulation.step();
    return simulation;
  };
  static const Simulation plane = made(2), space = made(3);
  return dimensions == 2 ? plane : space;
}

double solid_volume(const State& state) {
  double sum = 0.0;
  for (const Vec3& axes : state.particles.semi_axes) sum += volume_of(axes, state.cell.dimensions);
  return sum;
}

class GrowthIn : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Dimensions, GrowthIn, testing::Values(2, 3),
                         [](const auto& one) { return std::to_string(one.param); });

TEST_P(GrowthIn, AStageKeepsTheVolumeAndEndsAtTheShape) {
  Simulation simulation = compacted(GetParam());
  const double volume = solid_volume(simulation.state());
  const std::vector<double> mass = simulation.state().particles.mass;
  go_to_stage(simulation, 3);
  const Particles& grown = simulation.state().particles;
  EXPECT_NEAR(solid_volume(simulation.state()) / volume, 1.0, 1e-14);
  EXPECT_EQ(grown.mass, mass);
  for (std::size_t i = 0; i < grown.size(); ++i) {
    const Shape wanted{grown.type[i] == 0 ? 10.0 : 7.0, 1.2, 1.0};
    EXPECT_EQ(grown.semi_axes[i], wanted.semi_axes(GetParam()));
  }
}

// The pressure may wander while particles turn; at every increment it is within the tolerance, and
// the assembly as calm as asked for.
TEST_P(GrowthIn, AnIncrementWaitsForStressAndBalance) {
  Simulation simulation = compacted(GetParam());
  std::int64_t waited = 0;
  while (simulation.status() == StageStatus::running) {
    const Observation before = simulation.observe();
    const std::int64_t increments = simulation.state().increments;
    simulation.step();
    ASSERT_LE(simulation.state().increments, increments + 1);
    if (simulation.state().increments == increments) {
      ++waited;
      continue;
    }
    ASSERT_NEAR(before.stress.mean(), 50e6, 0.02 * 50e6);
    ASSERT_LE(before.balance.inertial_fraction, 0.01);
  }
  EXPECT_EQ(simulation.status(), StageStatus::done);
  EXPECT_EQ(simulation.state().increments, 20);
  EXPECT_GT(waited, 100) << "there was something to wait for";
}

TEST_P(GrowthIn, IsWithoutFriction) {
  const Simulation& simulation = half_grown(GetParam());
  ASSERT_GT(simulation.scene().laws.between(0, 0).friction_coefficient, 0.0);
  ASSERT_GT(simulation.observe().contacts, 50);
  for (const Contact& contact : simulation.state().contacts.records())
    EXPECT_EQ(contact.shear.force, Vec3::Zero());
}

// Without friction, and one isotropic rate, no direction is preferred but by the few particles.
TEST_P(GrowthIn, HoldsAnIsotropicStressUntilTheEnd) {
  Simulation simulation = compacted(GetParam());
  go_to_stage(simulation, 4);
  const Stress stress = simulation.observe().stress;
  EXPECT_NEAR(stress.mean(), 50e6, 0.02 * 50e6);
  const auto block = stress.tensor.topLeftCorner(GetParam(), GetParam());
  const Eigen::MatrixXd off =
      block - stress.mean() * Eigen::MatrixXd::Identity(GetParam(), GetParam());
  EXPECT_LT(off.norm(), 0.15 * block.norm());
}

TEST_P(GrowthIn, ContinuesFromASavedStateBitForBit) {
  const TemporaryFolder folder;
  Simulation uninterrupted = half_grown(GetParam());
  for (const int cycles : {0, 37}) {
    for (int k = 0; k < cycles; ++k) uninterrupted.step();
    save_state(uninterrupted.state(), folder.path("a.state"));
    Simulation resumed(uninterrupted.scene(), load_state(folder.path("a.state")));
    Simulation going_on = uninterrupted;
    while (going_on.state().increments < 12) {
      resumed.step();
      going_on.step();
    }
    EXPECT_EQ(state_hash(resumed.state()), state_hash(going_on.state()));
  }
}

TEST(GrowthState, OfAnotherNumberOfIncrementsOrOfAnotherSpaceIsRefused) {
  const Simulation& simulation = half_grown(2);
  const auto refusal = [&](const std::string& scene, std::int64_t increments) -> std::string {
    State state = simulation.state();
    state.increments = increments;
    try {
      Simulation(parse_scene(scene, "scene.toml"), state);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(growing_scene(2), 10), "");
  EXPECT_EQ(refusal(growing_scene(2), 21),
            "a state after 21 increments of growth; the scene's stage has 20");
  EXPECT_EQ(refusal(with(growing_scene(2), "increments = 20", "increments = 30"), 10),
            "a state with particles.grain.elongation = 1.1; the scene has 1.066666667");
  EXPECT_EQ(refusal(growing_scene(3), 10), "a state with cell.dimensions = 2; the scene has 3");
}

}  // namespace
