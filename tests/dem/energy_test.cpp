// SPDX-License-Identifier: GPL-3.0-or-later
//
// Momentum, angular momentum and energy of assemblies, every term accounted for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <tangency/dem/simulation.hpp>

#include "assembly.hpp"
#include "few_bodies.hpp"
#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::test;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

/// How an assembly is made and driven.
struct Case {
  const char* name;
  const char* cell;    ///< lines of [cell] and [motion]
  const char* law;     ///< of [contact]
  const char* drive;   ///< of the stage that is looked at
  double least_order;  ///< of the residual
  double largest;      ///< residual at a factor of 0.2, of the energy that went through
};

std::string scene(const Case& one, double time_step_factor) {
  return std::string("schema = 1\n") + one.cell +
         "[particles.grain]\ncount = 30\nmean_radius = 10.0\nelongation = 1.3\nflatness = 1.1\n"
         "[contact]\n" +
         one.law +
         "[[stage]]\nkind = \"place\"\narrangement = \"random\"\nseed = 5\n"
         "[[stage]]\nkind = \"compress\"\nmean_stress = 60e6\nmax_strain_rate = 0.4\n"
         "stress_tolerance = 0.05\nfriction_coefficient = 0.1\n"
         "[[stage]]\n" +
         one.drive + "time_step_factor = " + number(time_step_factor) +
         "\n[output]\nframe_interval = 0\n";
}

/// The state at the start of the stage that is looked at.
State compressed(const Case& one) {
  Simulation simulation(parse_scene(scene(one, 0.2), "scene.toml"));
  while (simulation.state().stage < 2) {
    if (simulation.status() == StageStatus::out_of_cycles) throw std::runtime_error("not compressed");
    if (simulation.status() == StageStatus::done)
      simulation.next_stage();
    else
      simulation.step();
  }
  return simulation.state();
}

struct Residual {
  double error, through;
  EnergyAccount account;
};

/// What does not add up after the stage, or after `time`.
Residual residual(const Case& one, const State& start, double factor, double time) {
  Simulation simulation(parse_scene(scene(one, factor), "scene.toml"), start);
  const Observation before = simulation.observe();
  const double end = simulation.state().time + time;
  while (simulation.state().time < end) simulation.step();
  const Observation after = simulation.observe();
  const EnergyAccount &a = before.account, &b = after.account;
  const double through = std::abs(b.boundary - a.boundary) + std::abs(b.gravity - a.gravity) +
                         std::abs(b.growth - a.growth) + std::abs(b.branch - a.branch) +
                         std::abs(b.sliding - a.sliding) + std::abs(b.damping - a.damping);
  return {after.energy_error - before.energy_error, through, b};
}

class Energy : public testing::TestWithParam<Case> {};

TEST_P(Energy, IsAccountedForButForWhatTheTimeStepLoses) {
  const Case& one = GetParam();
  const State start = compressed(one);
  const double unit = std::sqrt(start.particles.mass[0] / 1.5e10);
  double size[3];
  for (int k = 0; k < 3; ++k) {
    const Residual found = residual(one, start, 0.2 / (1 << k), 200.0 * unit);
    size[k] = std::abs(found.error) / found.through;
    std::cout << one.name << ' ' << 0.2 / (1 << k) << ' ' << found.error / found.through
              << " b " << found.account.boundary << " g " << found.account.gravity << " gr "
              << found.account.growth << " br " << found.account.branch << " s "
              << found.account.sliding << " d " << found.account.damping << " t " << found.through << '\n';
  }
  EXPECT_LT(size[0], one.largest);
  EXPECT_GT(0.5 * order(size[0], size[2]) , one.least_order);
}

constexpr const char* kLinear =
    "normal_stiffness = 1.5e10\nshear_stiffness = 1.0e10\nfriction_coefficient = 0.4\n";
constexpr const char* kHertz =
    "law = \"hertz\"\nyoung_modulus = 1e10\nlargest_overlap = 0.05\nfriction_coefficient = 0.4\n";
constexpr const char* kShear =
    "kind = \"shear\"\naxial_strain_rate = 0.3\naxial_strain = 1.0\nmean_stress = 60e6\n"
    "max_strain_rate = 0.3\ndamping = 0.1\n";

INSTANTIATE_TEST_SUITE_P(
    Of, Energy,
    testing::Values(
        Case{"Shear", "[cell]\n", kLinear, kShear, 0.8, 0.05},
        Case{"FrictionlessShear", "[cell]\n", "normal_stiffness = 1.5e10\n", kShear, 0.8, 0.05},
        Case{"HertzShear", "[cell]\n", kHertz, kShear, 0.8, 0.05},
        Case{"Walls", "[cell]\nwalls = \"xyz\"\n[motion]\ngravity = [0.0, 30.0, -1000.0]\n", kLinear,
             kShear, 0.8, 0.05},
        Case{"Growth", "[cell]\n", kLinear,
             "kind = \"grow\"\nelongation = 1.4\nincrements = 20\nmean_stress = 60e6\n"
             "max_strain_rate = 0.3\ndamping = 0.3\nmax_inertial_fraction = 0.1\nstress_tolerance = 0.1\n",
             0.8, 0.05}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
