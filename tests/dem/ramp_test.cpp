// SPDX-License-Identifier: GPL-3.0-or-later
/// Ramps of stress and friction, and rates by an inertial number.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/simulation.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"
#include "stages.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using namespace tangency::testing;

/// Spheres of two sizes compacted at random to 50e6 with two frictions, then `stage`.
std::string compacted_then(const std::string& stage) {
  return "schema = 1\n[particles.grain]\ncount = 25\nmean_radius = 10.0\nelongation = 1.2\n"
         "[particles.stone]\ncount = 25\nmean_radius = 7.0\ndensity = 2000.0\n[contact]\n"
         "normal_stiffness = 1.5e10\nfriction_coefficient = 0.5\n"
         "[contact.grain-stone]\nfriction_coefficient = 0.3\n"
         "[[stage]]\nkind = \"place\"\narrangement = \"random\"\nbounding_fraction = 0.3\n"
         "[[stage]]\nkind = \"compress\"\nfriction_coefficient = 0.0\nmean_stress = 50e6\n"
         "max_strain_rate = 0.1\ntime_step_factor = 0.3\ndamping = 0.3\n"
         "[[stage]]\nkind = \"relax\"\nmean_stress = 50e6\nmax_unbalanced_ratio = 0.02\n"
         "max_strain_rate = 0.1\ntime_step_factor = 0.3\n" +
         stage;
}

/// Compacted, at the start of `stage`.
Simulation at_start_of(const std::string& stage) {
  static const State state = at_end(compacted_then("")).state();
  return Simulation(parse_scene(compacted_then("[[stage]]\n" + stage), "scene.toml"), state);
}

void step(Simulation& simulation, int cycles) {
  for (int k = 0; k < cycles; ++k) simulation.step();
}

const std::string kServo =
    "kind = \"servo\"\ntime_step_factor = 0.3\nmax_strain_rate = 0.05\nduration = 3000\n";

TEST(Ramp, TakesEachStressLinearlyFromWhatItIsAndHoldsItFromThenOn) {
  Simulation simulation = at_start_of(
      kServo + "stress_xx = 40e6\nstress_yy = 50e6\nstress_zz = 70e6\nramp_cycles = 2000\n");
  const double ends[] = {40e6, 50e6, 70e6};
  const Mat3 first = simulation.observe().stress.tensor;
  for (const double share : {0.25, 0.5, 1.0, 1.0}) {
    step(simulation, share < 1.0 ? 500 : 750);
    const Stress now = simulation.observe().stress;
    for (int axis = 0; axis < 3; ++axis) {
      const double reached = static_cast<double>(simulation.state().stage_cycle) / 2000.0;
      const double wanted = std::lerp(first(axis, axis), ends[axis], std::min(reached, 1.0));
      EXPECT_NEAR(simulation.loading().targets[static_cast<std::size_t>(axis)].wanted, wanted,
                  1e-12 * wanted);
      EXPECT_NEAR(now.tensor(axis, axis), wanted, 0.01 * 70e6) << axis << " at " << reached;
    }
  }
}

TEST(Ramp, ByTimeAndByStrainIsThatByTheCyclesWhichTheseTake) {
  const std::string loading = kServo + "stress_zz = 70e6\nsimple_shear_rate = [0.004, 0.0, 0.0]\n";
  const double dt = at_start_of(loading).time_step();
  const auto wanted = [&](const std::string& ramp, int cycles) {
    Simulation simulation = at_start_of(loading + ramp + "\n");
    step(simulation, cycles);
    return simulation.loading().targets.front().wanted;
  };
  const std::string time = "ramp_time = " + std::to_string(400.0 * dt);
  const std::string strain = "ramp_strain = " + std::to_string(400.0 * dt * 0.004);
  for (const int cycles : {100, 399}) {
    const double by_cycles = wanted("ramp_cycles = 400", cycles);
    EXPECT_LT(by_cycles, 70e6);
    EXPECT_NEAR(wanted(time, cycles), by_cycles, 1e-4 * by_cycles);
    EXPECT_NEAR(wanted(strain, cycles), by_cycles, 1e-2 * by_cycles);
  }
  EXPECT_EQ(wanted(time, 401), 70e6);
  EXPECT_EQ(wanted("ramp_cycles = 400", 400), 70e6);
}

TEST(Ramp, OverAnAxialStrainIsOverAtThatStrain) {
  Simulation simulation = at_start_of(
      "kind = \"shear\"\nlateral_stress = 60e6\naxial_strain_rate = 0.01\naxial_strain = 0.02\n"
      "time_step_factor = 0.3\nramp_strain = 0.01\n");
  const double first = simulation.loading().targets.front().wanted;
  while (simulation.strain() < 0.005) simulation.step();
  EXPECT_NEAR(simulation.loading().targets.front().wanted, 0.5 * (first + 60e6), 0.01 * 60e6);
  while (simulation.strain() < 0.01) simulation.step();
  EXPECT_EQ(simulation.loading().targets.front().wanted, 60e6);
  EXPECT_NEAR(simulation.observe().stress.tensor(0, 0), 60e6, 0.01 * 60e6);
}

TEST(Ramp, TakesTheFrictionOfEachPairFromThatOfTheStageBefore) {
  Simulation simulation =
      at_start_of(kServo + "friction_coefficient = 0.1\nramp_cycles = 100\nmean_stress = 50e6\n");
  const auto friction = [&](std::size_t a, std::size_t b) {
    return simulation.laws().between(a, b).friction_coefficient;
  };
  EXPECT_EQ(friction(0, 0), 0.5);
  EXPECT_EQ(friction(0, 1), 0.3);
  step(simulation, 50);
  EXPECT_NEAR(friction(0, 0), 0.3, 1e-15);
  EXPECT_NEAR(friction(0, 1), 0.2, 1e-15);
  step(simulation, 50);
  EXPECT_EQ(friction(0, 0), 0.1);
  EXPECT_EQ(friction(1, 0), 0.1);
  const Simulation next = at_start_of(
      "kind = \"relax\"\nfriction_coefficient = 0.2\n[[stage]]\nkind = \"servo\"\nduration = 9\n"
      "friction_coefficient = 0.4\nramp_cycles = 9\n");
  Simulation second = next;
  second.next_stage();
  EXPECT_EQ(second.laws().between(0, 1).friction_coefficient, 0.2) << "that stage's, of all pairs";
}

/// Of a sheared sample: shear forces near their limits.
Simulation sheared_then(const std::string& stage) {
  Simulation simulation = at_start_of(
      "kind = \"shear\"\nmean_stress = 50e6\naxial_strain_rate = 0.02\naxial_strain = 0.03\n"
      "time_step_factor = 0.3\n[[stage]]\n" +
      stage);
  while (simulation.status() == StageStatus::running) simulation.step();
  simulation.next_stage();
  return simulation;
}

// In a cell that stands still nothing works from outside: what the falling friction lets go is lost
// to sliding and to damping.
TEST(Ramp, OfFrictionDoesNoWorkAndItsSlidingIsAccountedFor) {
  for (const std::string ramp : {"", "ramp_cycles = 300\n"}) {
    Simulation simulation = sheared_then(
        "kind = \"servo\"\nduration = 600\ntime_step_factor = 0.1\nfriction_coefficient = 0.05\n" +
        ramp);
    const EnergyAccount before = simulation.state().energy;
    const double error = simulation.energy_error();
    step(simulation, 600);
    const EnergyAccount& after = simulation.state().energy;
    EXPECT_EQ(after.boundary, before.boundary);
    const double lost = std::abs(after.sliding - before.sliding);
    EXPECT_GT(lost, 0.0);
    EXPECT_LT(std::abs(simulation.energy_error() - error), 0.02 * lost) << ramp;
    EXPECT_EQ(simulation.laws().between(0, 0).friction_coefficient, 0.05);
    for (const Contact& contact : simulation.state().contacts.records())
      if (contact.touches()) {
        EXPECT_LE(contact.shear.force.norm(), 0.05 * contact.normal_force * (1.0 + 1e-12));
      }
  }
}

TEST(Ramp, InItsMiddleIsSavedAndGoesOnBitForBit) {
  const TemporaryFolder folder;
  for (const std::string ramp : {"ramp_cycles = 301", "ramp_time = 2.0", "ramp_strain = 0.0123"}) {
    const std::string stage = kServo +
                              "simple_shear_rate = [0.01, 0.0, 0.0]\nstress_yy = 70e6\n"
                              "friction_coefficient = 0.2\n" +
                              ramp + "\n";
    Simulation whole = at_start_of(stage);
    step(whole, 77);
    EXPECT_LT(whole.loading().targets.front().wanted, 70e6) << ramp;
    save_state(whole.state(), folder.path("state"));
    Simulation resumed(whole.scene(), load_state(folder.path("state")));
    EXPECT_EQ(resumed.loading().targets.front().wanted, whole.loading().targets.front().wanted);
    step(whole, 300);
    step(resumed, 300);
    EXPECT_EQ(state_hash(resumed.state()), state_hash(whole.state())) << ramp;
  }
}

// So many particles are sorted in space at a stage's start, and contacts are then summed in another
// order: a ramp begins from the sums of that order, which are those of the saved state.
TEST(Ramp, BeginsFromTheSameBitsInAStateThatWasSavedAtItsStart) {
  const std::string servo = "[[stage]]\nkind = \"servo\"\n";
  Simulation whole(parse_scene(
      "schema = 1\n[cell]\n[particles.grain]\ncount = 2100\nmean_radius = 1.0\n[contact]\n"
      "normal_stiffness = 1e9\n[[stage]]\nkind = \"place\"\narrangement = \"random\"\n" +
          servo + "shear_rate = [5.0, 0.0, 0.0]\nduration = 40\n" + servo +
          "stress_xx = 1e6\nstress_yy = 1e6\nstress_zz = 1e6\nmax_strain_rate = 0.1\n"
          "ramp_cycles = 20\nduration = 20\n",
      "scene.toml"));
  step(whole, 40);
  const auto unsorted = whole.state().particles.id;
  whole.next_stage();
  ASSERT_NE(whole.state().particles.id, unsorted);
  const Simulation resumed(whole.scene(), whole.state());
  ASSERT_EQ(whole.state().ramp_start.size(), 3u);
  EXPECT_EQ(resumed.state().ramp_start, whole.state().ramp_start);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(whole.loading().targets[k].wanted, whole.state().ramp_start[k]);
}

TEST(Ramp, IsAskedForByTheStateThatItWasSavedIn) {
  const std::string held = kServo + "mean_stress = 60e6\n";
  Simulation with_ramp = at_start_of(held + "ramp_cycles = 50\n"), without = at_start_of(held);
  step(with_ramp, 5);
  step(without, 5);
  const auto refusal_of = [](const Simulation& scene, const Simulation& state) -> std::string {
    try {
      const Simulation resumed(scene.scene(), state.state());
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal_of(without, with_ramp), "a state on a ramp; the scene's stage has none");
  EXPECT_EQ(refusal_of(with_ramp, without), "a state on no ramp; the scene's stage has one");
  const Simulation two = at_start_of(kServo +
                                     "stress_xx = 60e6\nstress_yy = 60e6\n"
                                     "ramp_cycles = 50\n");
  EXPECT_EQ(refusal_of(two, with_ramp),
            "a state of a stage that holds 1 stresses; the scene's stage holds 2");
}

TEST(Ramp, KeepsAStageFromEndingOnTheWay) {
  Simulation simulation = at_start_of(
      "kind = \"relax\"\nmean_stress = 51e6\nmax_strain_rate = 0.1\nmax_unbalanced_ratio = 0.1\n"
      "ramp_cycles = 800\n");
  EXPECT_EQ(simulation.cycles_needed().cycles, 800.0);
  EXPECT_STREQ(simulation.cycles_needed().key, "ramp_cycles");
  while (simulation.status() == StageStatus::running) simulation.step();
  EXPECT_EQ(simulation.status(), StageStatus::done);
  EXPECT_GE(simulation.state().stage_cycle, 800);
  EXPECT_NEAR(simulation.observe().stress.mean(), 51e6, 0.002 * 51e6);
}

/// The largest rate of the last stage.
double rate_of(const std::string& stage) {
  const Scene scene = parse_scene(compacted_then("[[stage]]\n" + stage), "scene.toml");
  return scene.stages.back().drive->loading.strain_rate.cwiseAbs().maxCoeff();
}

// I = rate d sqrt(density / stress), of the type where it is largest: stones' are smaller by 0.7
// and denser by 2, sqrt(2) 0.7 < 1.
TEST(InertialNumber, GivesTheRateByTheStressThatIsHeld) {
  const double of_50 = 1e-3 / 20.0 * std::sqrt(50e6 / 1000.0);
  const std::string shear = "kind = \"shear\"\naxial_strain = 0.1\ninertial_number = 1e-3\n";
  EXPECT_NEAR(rate_of(shear + "mean_stress = 100e6\n"), std::sqrt(2.0) * of_50, 1e-14);
  EXPECT_NEAR(rate_of(shear + "lateral_stress = 25e6\n"), std::sqrt(0.5) * of_50, 1e-14);
  EXPECT_NEAR(rate_of(shear), of_50, 1e-14) << "at constant volume: that of the stage before";
  const std::string servo = "kind = \"servo\"\nduration = 9\ninertial_number = 1e-3\n";
  EXPECT_NEAR(rate_of(servo + "simple_shear_rate = [3.0, 0.0, 0.0]\n"), of_50, 1e-14);
  EXPECT_NEAR(rate_of(servo + "simple_shear_rate = [1e-320, 0.0, 0.0]\n"), of_50, 1e-14)
      << "proportions alone";
  EXPECT_NEAR(rate_of(servo + "strain_rate = [1.0, 0.0, -4.0]\nstress_yy = 100e6\n"
                              "max_strain_rate = 0.1\n"),
              std::sqrt(2.0) * of_50, 1e-14);
}

}  // namespace
