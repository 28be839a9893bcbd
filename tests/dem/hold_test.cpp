// SPDX-License-Identifier: GPL-3.0-or-later
//
// What compress and relax hold: a mean, each normal stress, or nothing, as bodies settle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <string>

#include <tangency/dem/simulation.hpp>

#include "scenes.hpp"
#include "stages.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using namespace tangency::testing;

std::string pressed(const std::string& hold, int dimensions) {
  const std::string held = "mean_stress = 10e6\nmax_strain_rate = 0.05\n" + hold;
  return "schema = 1\n[cell]\ndimensions = " + std::to_string(dimensions) +
         "\n[particles.grain]\ncount = 27\nmean_radius = 10.0\nelongation = 1.4\n[contact]\n"
         "normal_stiffness = 1.5e10\nfriction_coefficient = 0.5\n[[stage]]\nkind = \"place\"\n"
         "[[stage]]\nkind = \"compress\"\n" +
         held + "[[stage]]\nkind = \"relax\"\n" + held;
}

/// The largest difference of a normal stress from the mean, over it, at the end.
double uneven(const std::string& scene) {
  const Simulation simulation = at_end(scene);
  const Stress stress = simulation.observe().stress;
  double most = 0.0;
  for (int k = 0; k < stress.dimensions; ++k)
    most = std::max(most, std::abs(stress.tensor(k, k) - 10e6) / 10e6);
  EXPECT_NEAR(stress.mean(), 10e6, 0.002 * 10e6);
  return most;
}

TEST(Hold, OfComponentsBringsEachNormalStressToTheWanted) {
  for (const int dimensions : {2, 3}) {
    const double mean = uneven(pressed("", dimensions));
    const double components = uneven(pressed("hold = \"components\"\n", dimensions));
    std::cout << "off by " << mean << " with the mean held, " << components
              << " with each component\n";
    EXPECT_GT(mean, 0.02) << "there was something to even out";
    EXPECT_LE(components, 0.002) << "the stage's stress_tolerance";
  }
}

/// Spheroids that fall onto the floor of a box without a lid in reach.
std::string poured(int count, const std::string& contact) {
  return "schema = 1\n[cell]\nsize = [6.0, 6.0, 30.0]\nwalls = \"xyz\"\n[motion]\n"
         "gravity = [0.0, 0.0, -9.81]\n[particles.needle]\ncount = " +
         std::to_string(count) +
         "\nmean_radius = 0.5\nelongation = 3.0\ndensity = 2500.0\n[contact]\n"
         "normal_stiffness = 1e7\nfriction_coefficient = 0.4\n" +
         contact +
         "[contact.needle-wall]\nfriction_coefficient = 0.2\n"
         "[[stage]]\nkind = \"place\"\narrangement = \"random\"\nseed = 3\n"
         "[[stage]]\nkind = \"servo\"\nname = \"pour\"\nduration = 4000\ndamping = 0.02\n"
         "[[stage]]\nkind = \"relax\"\nmax_unbalanced_ratio = 0.05\n";
}

TEST(Settling, EndsWhereEveryBodyLiesAndTheFloorBearsAllWeights) {
  const Simulation simulation = at_end(poured(60, "restitution = 0.3\n"));
  const State& state = simulation.state();
  const Particles& particles = state.particles;
  double weight = 0.0, floor = 0.0, highest = 0.0, contact_force = 0.0;
  std::int64_t contacts = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    weight += particles.mass[i] * 9.81;
    highest = std::max(highest, particles.position[i][2]);
    EXPECT_GT(state.contacts.resultants().contacts[i], 0) << "nothing is left in the air";
  }
  for (std::size_t k = 0; k < state.list.pairs().size(); ++k) {
    if (!state.contacts.touches(k)) continue;
    ++contacts;
    contact_force += state.contacts.force(k).norm();
    if (state.list.pairs()[k].b == static_cast<std::int32_t>(particles.size()) + 4)
      floor -= state.contacts.force(k)[2];
    if (state.list.pairs()[k].b < static_cast<std::int32_t>(particles.size())) continue;
    floor -= state.list.pairs()[k].b == static_cast<std::int32_t>(particles.size()) + 4
                 ? 0.0
                 : state.contacts.force(k)[2];  // what friction at the sides bears
  }
  contact_force /= static_cast<double>(contacts);
  EXPECT_NEAR(floor, weight, 0.05 * 60.0 * contact_force);
  EXPECT_NEAR(floor, weight, 0.02 * weight);
  EXPECT_LT(highest, 10.0) << "fallen from up to 30";
  EXPECT_EQ(state.cell.edges.diagonal(), Vec3(6.0, 6.0, 30.0)) << "nothing strains";
  // The balance is that of the forces themselves.
  double largest = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    largest = std::max(
        largest,
        (state.contacts.resultants().force[i] - particles.mass[i] * 9.81 * Vec3::UnitZ()).norm());
  const Balance balance = simulation.observe().balance;
  EXPECT_NEAR(balance.largest_unbalanced_ratio, largest / contact_force, 1e-9);
  EXPECT_LE(largest, 0.05 * contact_force);
  EXPECT_EQ(balance.rattlers, 0);
}

// Dampers that forces went by before velocities were taken away kept these moving for ever.
TEST(Settling, EndsWhereContactsOfBodiesAndWallsHaveARestitution) {
  std::string scene = with(poured(30, "restitution = 0.3\n"), "6.0, 30.0]", "6.0, 24.0]");
  scene = with(scene, "[contact.needle-wall]\nfriction_coefficient = 0.2\n", "");
  scene = with(scene, "seed = 3\n", "");
  scene = with(scene, "duration = 4000", "duration = 2500");
  const Simulation simulation = at_end(scene + "max_cycles = 10000\n");
  const Observation seen = simulation.observe();
  EXPECT_LE(seen.balance.largest_unbalanced_ratio, 0.05);
  EXPECT_EQ(seen.balance.rattlers, 0);
  EXPECT_LT(std::abs(seen.energy_error), 2e-3 * seen.account.gravity);
}

TEST(Settling, IsNotOverWhileABodyFalls) {
  std::string scene = poured(2, "");
  scene = with(scene, "kind = \"servo\"\nname = \"pour\"\nduration = 4000\n",
               "kind = \"servo\"\nname = \"pour\"\nduration = 1\n");
  const Simulation simulation = at_stage(scene, 2);
  EXPECT_EQ(simulation.observe().contacts, 0);
  EXPECT_EQ(simulation.status(), StageStatus::running);
}

}  // namespace
