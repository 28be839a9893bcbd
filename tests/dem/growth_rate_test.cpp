// SPDX-License-Identifier: GPL-3.0-or-later
/// Growth by eccentricity: at so many cycles a per cent, and while the mean stress rises.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/growth.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/simulation.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"
#include "stages.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using namespace tangency::testing;

constexpr Shape kSphere{10.0, 1.0, 1.0};

Growth growth_to(double eccentricity, std::int64_t increments) {
  return {elongation_of(eccentricity), {}, increments, 0.01, true};
}

// dem/growth.hpp (1) (2)
TEST(GrowthByEccentricity, StepsEquallyFromTheStartToTheWantedEnd) {
  const Growth growth = growth_to(0.2, 40);
  const Shape start{10.0, 1.1, 1.3};
  EXPECT_EQ(growth.shape_after(start, 0).elongation, 1.1);
  EXPECT_EQ(growth.shape_after(start, 40).elongation, elongation_of(0.2));
  const double first = eccentricity_of(1.1);
  for (const std::int64_t done : {0, 1, 17, 40}) {
    const Shape shape = growth.shape_after(start, done);
    EXPECT_NEAR(eccentricity_of(shape.elongation),
                first + (0.2 - first) * static_cast<double>(done) / 40.0, 1e-15);
    EXPECT_EQ(shape.flatness, 1.3);
    EXPECT_NEAR(shape.semi_axes().prod(), 1000.0, 1e-11);
  }
  EXPECT_EQ(growth_to(0.176, 1).shape_after(kSphere, 1).elongation, elongation_of(0.176));
}

TEST(GrowthByEccentricity, LargestChangeIsThatOfTheWorstIncrement) {
  for (const auto& [e, start] : {std::pair(0.2, kSphere), std::pair(0.5, Shape{1.0, 1.0, 2.0}),
                                 std::pair(0.0, Shape{1.0, 5.0, 1.0})}) {
    const Growth growth = growth_to(e, 60);
    double worst = 0.0;
    for (std::int64_t done = 0; done < growth.increments; ++done) {
      const Vec3 before = growth.shape_after(start, done).semi_axes();
      const Vec3 after = growth.shape_after(start, done + 1).semi_axes();
      worst = std::max(worst, (after.cwiseQuotient(before) - Vec3::Ones()).cwiseAbs().maxCoeff());
    }
    EXPECT_NEAR(growth.largest_change(start, 3), worst, 1e-12);
  }
}

// dem/growth.hpp (3)
TEST(GrowthByEccentricity, TheRampEndsAtTheStressOfTheStage) {
  Growth growth = growth_to(0.02, 20);
  for (const std::int64_t done : {0, 7, 20})
    EXPECT_EQ(growth.stress_after(kSphere, done, 100e6), 100e6) << "without a ramp";
  growth.ramp = {10e6, 0.01};
  EXPECT_EQ(growth.stress_after(kSphere, 0, 100e6), 10e6);
  EXPECT_NEAR(growth.stress_after(kSphere, 1, 100e6), 19e6, 1.0);
  EXPECT_NEAR(growth.stress_after(kSphere, 9, 100e6), 91e6, 1.0);
  for (const std::int64_t done : {10, 11, 20})
    EXPECT_EQ(growth.stress_after(kSphere, done, 100e6), 100e6);
  growth.ramp = {10e6, 0.02};
  EXPECT_EQ(growth.stress_after(kSphere, 20, 100e6), 100e6) << "a ramp to the end";
  const Shape later{10.0, elongation_of(0.01), 1.0};
  EXPECT_EQ(growth.stress_after(later, 0, 100e6), 10e6) << "from the shape that it begins with";
}

TEST(GrowthByEccentricity, TakesTheCyclesOfItsPerCents) {
  EXPECT_EQ(increments_at(1000, 0.29), 29000);
  EXPECT_EQ(increments_at(1000, 0.22), 22000);
  EXPECT_EQ(increments_at(100, 0.0951), 951);
  EXPECT_EQ(increments_at(100, 0.09511), 952) << "the last cycle grows by less";
  EXPECT_EQ(increments_at(1, 1e-6), 1);
}

/// Of the scene of two sizes, whose stage 2 grows.
std::string grown_to(const std::string& keys) {
  return with(growing_scene(3), "elongation = 1.2\nincrements = 20\n", keys);
}

Simulation compacted(const std::string& scene) { return at_stage(scene, 2); }

const std::string kAtARate = "eccentricity = 0.025\ncycles_per_percent = 40\n";

TEST(GrowthAtARate, GrowsEachCycleOfAPerCentAndThenRelaxes) {
  Simulation simulation = compacted(grown_to(kAtARate));
  std::int64_t waited = 0, restless = 0;
  while (simulation.status() == StageStatus::running) {
    const std::int64_t done = simulation.state().increments;
    const Observation before = simulation.observe();
    simulation.step();
    const bool grew = simulation.state().increments == done + 1;
    if (!grew) {
      ASSERT_EQ(simulation.state().increments, done);
      ASSERT_TRUE(done % 40 == 0 || done == 100) << "in a per cent each cycle grows";
      ++waited;
    } else if (done % 40 == 0) {
      ASSERT_NEAR(before.stress.mean(), 50e6, 0.02 * 50e6) << "a per cent begins relaxed";
      ASSERT_LE(before.balance.inertial_fraction, 0.01);
    } else if (before.balance.inertial_fraction > 0.01) {
      ++restless;
    }
  }
  EXPECT_EQ(simulation.status(), StageStatus::done);
  EXPECT_EQ(simulation.state().increments, 100) << "two per cents and a half";
  EXPECT_GT(waited, 50);
  EXPECT_GT(restless, 20) << "else waiting within a per cent would show nothing";
  EXPECT_NEAR(simulation.observe().eccentricity, 0.025, 1e-15);
  EXPECT_NEAR(simulation.observe().elongation, elongation_of(0.025), 1e-15);
}

const std::string kRamp = "mean_stress_start = 20e6\nramp_eccentricity = 0.01\n";
/// Compacted at the ramp's start.
std::string ramped(const std::string& keys) {
  return with(grown_to(keys + kRamp), "mean_stress = 50e6", "mean_stress = 20e6");
}

TEST(GrowthUnderARamp, HoldsTheMeanStressOfItsEccentricity) {
  Simulation simulation = compacted(ramped("eccentricity = 0.02\nincrements = 100\n"));
  while (simulation.status() == StageStatus::running) {
    const Observation before = simulation.observe();
    const std::int64_t done = simulation.state().increments;
    simulation.step();
    if (simulation.state().increments == done) continue;
    const double wanted = done < 50 ? 20e6 + 30e6 * static_cast<double>(done) / 50.0 : 50e6;
    ASSERT_NEAR(before.eccentricity, 0.02 * static_cast<double>(done) / 100.0, 1e-15);
    ASSERT_NEAR(before.stress.mean(), wanted, 0.02 * wanted) << done;
  }
  EXPECT_EQ(simulation.status(), StageStatus::done);
  EXPECT_NEAR(simulation.observe().stress.mean(), 50e6, 0.02 * 50e6);
}

// Without waiting the servo alone keeps to the ramp, in each cycle; at a rate that it can follow.
TEST(GrowthUnderARamp, IsFollowedByTheServoWhereNothingWaits) {
  Simulation simulation =
      compacted(ramped("eccentricity = 0.01\ncycles_per_percent = 1000\nservo_gain = 0.2\n"));
  double worst = 0.0;
  while (simulation.status() == StageStatus::running) {
    simulation.step();
    if (simulation.state().increments == 0) continue;
    const double wanted = simulation.loading().targets.front().wanted;
    const double e = simulation.observe().eccentricity;
    ASSERT_NEAR(wanted, 20e6 + 30e6 * e / 0.01, 1.0);
    worst = std::max(worst, std::abs(simulation.observe().stress.mean() / wanted - 1.0));
  }
  EXPECT_EQ(simulation.status(), StageStatus::done);
  EXPECT_LT(worst, 0.02);
}

TEST(GrowthAtARate, ContinuesFromASavedStateBitForBit) {
  const TemporaryFolder folder;
  Simulation uninterrupted = compacted(ramped(kAtARate));
  for (const std::int64_t increments : {25, 40, 60}) {  // on the ramp, at its end, after it
    while (uninterrupted.state().increments < increments) uninterrupted.step();
    save_state(uninterrupted.state(), folder.path("a.state"));
    Simulation resumed(uninterrupted.scene(), load_state(folder.path("a.state")));
    Simulation going_on = uninterrupted;
    for (int k = 0; k < 30; ++k) {
      resumed.step();
      going_on.step();
    }
    EXPECT_EQ(state_hash(resumed.state()), state_hash(going_on.state())) << increments;
  }
}

TEST(GrowthAtARate, SummaryHasTheShareOfTheCyclesThatRelaxed) {
  const TemporaryFolder folder;
  // A later stage of the same name does not grow.
  const std::string scene = folder.write(
      "scene.toml",
      with(grown_to(kAtARate), "kind = \"relax\"\n", "kind = \"relax\"\nname = \"grow\"\n"));
  ASSERT_EQ(run_tool({"run", scene, "--out", folder.path("out"), "--quiet"}).status, 0);
  const auto summary = nlohmann::json::parse(std::ifstream(folder.path("out/summary.json")));
  Simulation same = compacted(grown_to(kAtARate));
  while (same.status() == StageStatus::running) same.step();
  const auto cycles = static_cast<double>(same.state().stage_cycle);
  ASSERT_GT(cycles, 150.0);
  EXPECT_DOUBLE_EQ(summary.at("relaxation_share").get<double>(), 1.0 - 100.0 / cycles);

  const std::string still = folder.write("still.toml", small_scene());
  ASSERT_EQ(run_tool({"run", still, "--out", folder.path("still"), "--quiet"}).status, 0);
  EXPECT_FALSE(nlohmann::json::parse(std::ifstream(folder.path("still/summary.json")))
                   .contains("relaxation_share"));

  // Of a run that is over the row of its end alone goes elsewhere.
  const std::string text = grown_to(kAtARate);
  const std::string last =
      folder.write("last.toml", text.substr(0, text.find("[[stage]]\nkind = \"relax\"")));
  ASSERT_EQ(run_tool({"run", last, "--out", folder.path("last"), "--quiet"}).status, 0);
  ASSERT_EQ(run_tool({"run", last, "--out", folder.path("again"), "--quiet", "--resume",
                      folder.path("last/final.state")})
                .status,
            0);
  EXPECT_TRUE(nlohmann::json::parse(std::ifstream(folder.path("last/summary.json")))
                  .contains("relaxation_share"));
  EXPECT_FALSE(nlohmann::json::parse(std::ifstream(folder.path("again/summary.json")))
                   .contains("relaxation_share"));
}

}  // namespace
