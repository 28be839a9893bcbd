// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/dem/parallel.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/spatial_order.hpp>

#include "../tool/process.hpp"
#include "assembly.hpp"
#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

void run_to_end(Simulation& simulation) {
  while (!simulation.finished()) {
    const StageStatus status = simulation.status();
    ASSERT_NE(status, StageStatus::out_of_cycles);
    if (status == StageStatus::done)
      simulation.next_stage();
    else
      simulation.step();
  }
}

void run_cycles(Simulation& simulation, int cycles) {
  for (int cycle = 0; cycle < cycles; ++cycle) simulation.step();
}

/// A dense start, so that a few hundred cycles have contacts: particles enough to be shared among
/// threads.
Simulation dense(std::size_t count) {
  const std::string text =
      with(with(small_scene(), "count = 27", "count = " + std::to_string(count)),
           "max_strain_rate = 0.05", "max_strain_rate = 1.0");
  return Simulation(parse_scene(text, "scene.toml"));
}

// dem/simulation.hpp (1)
TEST(Simulation, HasTheSameStateAtEveryThreadCount) {
  std::string hash[3];
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    Simulation simulation = dense(512);
    run_cycles(simulation, 250);
    ASSERT_GT(simulation.observe().contacts, 400);
    hash[threads - 1] = state_hash(simulation.state());
  }
  set_threads(0);
  EXPECT_EQ(hash[0], hash[1]);
  EXPECT_EQ(hash[0], hash[2]);
}

// dem/simulation.hpp (1)
TEST(Simulation, ContinuesFromASavedStateBitForBit) {
  const TemporaryFolder folder;
  Simulation uninterrupted = dense(64);
  for (const int cycles : {1, 150, 37}) {  // the last two with contacts, between renewed lists
    run_cycles(uninterrupted, cycles);
    save_state(uninterrupted.state(), folder.path("a.state"));
    Simulation resumed(uninterrupted.scene(), load_state(folder.path("a.state")));
    Simulation going_on = uninterrupted;
    run_cycles(resumed, 120);
    run_cycles(going_on, 120);
    EXPECT_EQ(state_hash(resumed.state()), state_hash(going_on.state()));
  }
  EXPECT_GT(uninterrupted.observe().contacts, 50);
}

TEST(Simulation, ContinuesFromAFinalStateIntoAddedStages) {
  const std::string whole = small_scene();
  const std::string first =
      with(whole, "[[stage]]\nkind = \"relax\"\nmean_stress = 10e6\nmax_strain_rate = 0.05\n", "");
  Simulation all(parse_scene(whole, "scene.toml")), part(parse_scene(first, "scene.toml"));
  run_to_end(all);
  run_to_end(part);
  Simulation rest(parse_scene(whole, "scene.toml"), part.state());
  run_to_end(rest);
  EXPECT_EQ(state_hash(rest.state()), state_hash(all.state()));
}

TEST(Simulation, RelaxesUntilEveryParticleIsInBalanceToTheWantedRatio) {
  const std::string strict =
      with(small_scene(), "kind = \"relax\"",
           "kind = \"relax\"\nstress_tolerance = 0.1\nmax_unbalanced_ratio = 1e-6");
  Simulation simulation(parse_scene(strict, "scene.toml"));
  while (simulation.state().stage < 2) {
    if (simulation.status() == StageStatus::done)
      simulation.next_stage();
    else
      simulation.step();
  }
  const auto worst = [&] {
    const Balance balance = simulation.observe().balance;
    return std::max(balance.largest_unbalanced_ratio, balance.largest_unbalanced_moment_ratio);
  };
  int cycles = 0;
  for (; simulation.status() == StageStatus::running; ++cycles) {
    ASSERT_GT(worst(), 1e-6);
    simulation.step();
  }
  EXPECT_EQ(simulation.status(), StageStatus::done);
  EXPECT_LE(worst(), 1e-6);
  EXPECT_GT(cycles, 100);
}

TEST(Simulation, StartsEachStageWithAFreshServoAndFreshStrains) {
  Simulation simulation = dense(64);
  run_cycles(simulation, 200);
  while (simulation.state().servos[0].integral == 0.0) simulation.step();
  ASSERT_LT(simulation.observe().volumetric_strain, -0.1);
  simulation.next_stage();
  EXPECT_EQ(simulation.state().servos[0].integral, 0.0);
  EXPECT_EQ(simulation.state().stage_cycle, 0);
  simulation.step();
  EXPECT_GT(simulation.observe().volumetric_strain, -0.01);
}

TEST(Simulation, DampsTurnsAtTheRateOfItsStage) {
  const auto after = [](const std::string& keys) {
    Simulation simulation(parse_scene(
        "schema = 1\n[cell]\nsize = [90.0, 90.0, 90.0]\n[particles.grain]\ncount = 1\n"
        "mean_radius = 10.0\n[contact]\nnormal_stiffness = 1e10\n[[stage]]\nkind = \"place\"\n"
        "arrangement = \"explicit\"\n[[body]]\ntype = \"grain\"\nposition = [1.0, 2.0, 3.0]\n"
        "velocity = [0.1, 0.0, 0.0]\nangular_velocity = [0.0, 0.2, 0.0]\n"
        "[[stage]]\nkind = \"servo\"\nduration = 1000\ntime_step_factor = 0.01\n" +
            keys,
        "scene.toml"));
    run_cycles(simulation, 200);
    const Particles& p = simulation.state().particles;
    return Vec3(p.velocity[0][0] / 0.1, p.angular_velocity[0][1] / 0.2, 0.0);
  };
  // 200 cycles are 2 characteristic times.
  const Vec3 two = after("damping = 0.5\nrotational_damping = 1.5\n"),
             one = after("damping = 0.5\n");
  EXPECT_LT((two - Vec3(std::exp(-1.0), std::exp(-3.0), 0.0)).norm(), 1e-4);
  EXPECT_LT((one - Vec3(std::exp(-1.0), std::exp(-1.0), 0.0)).norm(), 1e-4);
}

TEST(Simulation, StopsAskingForMoreWhenItsCyclesAreSpent) {
  Simulation simulation(
      parse_scene(with(small_scene(), "mean_stress", "max_cycles = 5\nmean_stress"), "scene.toml"));
  run_cycles(simulation, 4);
  EXPECT_EQ(simulation.status(), StageStatus::running);
  run_cycles(simulation, 1);
  EXPECT_EQ(simulation.status(), StageStatus::out_of_cycles);
}

/// Goes on to the stage of this number, and its first cycles.
Simulation in_stage(const std::string& scene, std::size_t stage, int cycles) {
  Simulation simulation(parse_scene(scene, "scene.toml"));
  while (simulation.state().stage < stage) {
    const StageStatus status = simulation.status();
    if (status == StageStatus::out_of_cycles)
      throw std::runtime_error("a stage before does not end");
    if (status == StageStatus::done)
      simulation.next_stage();
    else
      simulation.step();
  }
  run_cycles(simulation, cycles);
  return simulation;
}

/// Frictionless grains enough to be shared among threads, in the midst of relaxing.
const Simulation& relaxing() {
  static const Simulation simulation = [] {
    const std::string scene =
        with(with(small_scene(), "count = 27", "count = 512"), "friction_coefficient = 0.5\n", "");
    return in_stage(with(scene, "max_strain_rate = 0.05", "max_strain_rate = 1.0"), 2, 150);
  }();
  return simulation;
}

// dem/motion/fire.hpp (1) (2)
TEST(Fire, TurnsWhatRunsDownhillStopsWhatDoesNotAndAccountsForIt) {
  const Motion motion{Rotation::full, Vec3(0.0, 0.0, -0.5)};
  const Particles start = crowd(20, Cell::box(Vec3::Constant(4.0)), 3);
  std::vector<Vec3> none(start.size(), Vec3::Zero());
  const auto steered = [&](double along, double across) {
    Resultants forces{none, none};
    for (std::size_t i = 0; i < start.size(); ++i) {
      forces.force[i] = along * start.velocity[i] + across * Vec3(0.1, -0.3, 0.2) -
                        start.mass[i] * motion.gravity;
      forces.moment[i] = along * start.angular_velocity[i];
    }
    // The power of the forces over the root of the energy: how far they are along the velocities.
    const auto alignment = [&](const Particles& now) {
      double power = 0.0;
      for (std::size_t i = 0; i < now.size(); ++i)
        power += (forces.force[i] + now.mass[i] * motion.gravity).dot(now.velocity[i]) +
                 forces.moment[i].dot(now.angular_velocity[i]);
      return power / std::sqrt(kinetic_energy(now));
    };
    Particles p = start;
    Fire fire{0.05, 3};
    const double before = kinetic_energy_at(p, forces, motion, 0.01);
    const double taken = fire.steer(p, forces, motion, 0.01);
    EXPECT_NEAR(taken, before - kinetic_energy_at(p, forces, motion, 0.01), 1e-12 * before);
    EXPECT_LE(kinetic_energy(p), kinetic_energy(start) * (1.0 + 1e-12));
    EXPECT_EQ(fire.downhill, along > 0.0 ? 4 : 0);
    EXPECT_EQ(fire.mixing, along > 0.0 ? 0.05 : Fire().mixing) << "a new stretch begins anew";
    if (across > 0.0) {
      EXPECT_GT(alignment(p), (1.0 + 1e-6) * alignment(start)) << "turned towards the forces";
    }
    return p;
  };
  EXPECT_GT(kinetic_energy(steered(1.0, 1.0)), 0.5 * kinetic_energy(start));
  EXPECT_NE(steered(1.0, 1.0).velocity, start.velocity);
  for (const double uphill : {-1.0, 0.0}) EXPECT_EQ(kinetic_energy(steered(uphill, 0.0)), 0.0);
}

// dem/motion/fire.hpp (3)
// dem/simulation.hpp (1)
// The cell shears by a half in the first stage: places in it change, and their order.
TEST(Simulation, KeepsManyParticlesInAnOrderOfSpaceFromStageToStage) {
  const std::string stage =
      "[[stage]]\nkind = \"servo\"\nstrain_rate = [0.0, 0.0, 0.0]\nshear_rate = [5.0, 0.0, 0.0]\n";
  Simulation simulation(parse_scene(
      "schema = 1\n[cell]\n[particles.grain]\ncount = 2100\nmean_radius = 1.0\n[contact]\n"
      "normal_stiffness = 1e9\nfriction_coefficient = 0.5\n[[stage]]\nkind = \"place\"\n"
      "arrangement = \"random\"\n" +
          stage + "duration = 40\n" + stage + "duration = 20\n",
      "scene.toml"));
  const auto is_in_order = [&] {
    const std::vector<std::uint32_t> order =
        spatial_order(simulation.state().particles, simulation.state().cell);
    return std::is_sorted(order.begin(), order.end());
  };
  EXPECT_TRUE(is_in_order()) << "placed";
  while (simulation.status() == StageStatus::running) simulation.step();
  EXPECT_FALSE(is_in_order());
  const Observation before = simulation.observe();
  const std::vector<std::int32_t> ids = simulation.state().particles.id;
  simulation.next_stage();
  EXPECT_TRUE(is_in_order()) << "sorted";
  EXPECT_NE(simulation.state().particles.id, ids);
  const Observation after = simulation.observe();
  EXPECT_EQ(after.contacts, before.contacts);
  EXPECT_NEAR(after.elastic_energy, before.elastic_energy, 1e-12 * before.elastic_energy);
  EXPECT_LT((after.stress.tensor - before.stress.tensor).norm(),
            1e-12 * before.stress.tensor.norm());
}

TEST(Relaxation, HasTheSameStateAtEveryThreadCountAndFromASavedState) {
  const TemporaryFolder folder;
  ASSERT_LT(relaxing().state().fire.mixing, 0.1) << "what is saved is not what a stage starts with";
  ASSERT_FALSE(relaxing().stage().drive->damping);
  save_state(relaxing().state(), folder.path("a.state"));
  std::string hash[3];
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    Simulation simulation = relaxing();
    if (threads == 3)
      simulation = Simulation(simulation.scene(), load_state(folder.path("a.state")));
    run_cycles(simulation, 100);
    hash[threads - 1] = state_hash(simulation.state());
  }
  set_threads(0);
  EXPECT_EQ(hash[0], hash[1]);
  EXPECT_EQ(hash[0], hash[2]);
}

// With the default there was before, a constant damping of 0.5, both take more than 60,000 cycles.
TEST(Relaxation, WithoutFrictionEndsWithinTwelveThousandCyclesOfTheDefaults) {
  const std::string spheres =
      with(with(with(read_file(TANGENCY_DATA "/scenes/frictionless-packing-relax.toml"),
                     "count = 150", "count = 100"),
                "flatness = 1.9\n", ""),
           "bounding_fraction = 0.1", "bounding_fraction = 0.25");
  const std::string spheroids =
      with(read_file(TANGENCY_DATA "/scenes/frictionless-packing-relax.toml"), "count = 150",
           "count = 100");
  for (const std::string& scene : {spheres, spheroids}) {
    Simulation simulation = in_stage(scene, 2, 0);
    while (simulation.status() == StageStatus::running && simulation.state().stage_cycle < 12000)
      simulation.step();
    EXPECT_EQ(simulation.status(), StageStatus::done);
    std::cout << simulation.state().stage_cycle << " cycles\n";
  }
}

TEST(Resumed, UnderOtherContactLawsSaysWhichAreOthers) {
  const Simulation simulation = dense(27);
  const auto changed = [&](const std::string& before, const std::string& after) {
    const std::string scene =
        with(with(small_scene(), "max_strain_rate = 0.05", "max_strain_rate = 1.0"), before, after);
    return Simulation(parse_scene(scene, "scene.toml"), simulation.state()).changed_laws();
  };
  EXPECT_EQ(changed("", ""), "");
  EXPECT_EQ(changed("normal_stiffness = 1.5e10", "normal_stiffness = 2e10"),
            "contact.grain-grain.normal_stiffness = 1.5e+10, and here 2e+10; "
            "contact.grain-grain.shear_stiffness = 1.5e+10, and here 2e+10");
  EXPECT_EQ(changed("friction_coefficient = 0.5", "friction_coefficient = 0.0"),
            "contact.grain-grain.friction_coefficient = 0.5, and here 0");
  EXPECT_EQ(changed("normal_stiffness = 1.5e10", "law = \"hertz\"\nyoung_modulus = 1e10"),
            "another contact.law");
}

/// Stress and balance anew from the state's positions and shear forces alone: normal forces from
/// signed_gap() for every pair that brute force finds, none of the simulator's sums.
struct Recount {
  Mat3 stress = Mat3::Zero();
  double mean_force = 0.0, worst = 0.0;
  std::size_t contacts = 0;
  std::int64_t rattlers = 0;

  explicit Recount(const Simulation& simulation) {
    const State& state = simulation.state();
    const Particles& p = state.particles;
    std::vector<Vec3> resultant(p.size(), Vec3::Zero());
    std::vector<int> touching(p.size(), 0);
    for (const Pair& pair : meeting_pairs(p, state.cell, 2)) {
      const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
      const Vec3 d = branch_vector(pair, p, state.cell);
      const tangency::Gap gap = tangency::signed_gap(body(p, a), body(p, b), d);
      if (gap.gap >= 0.0) continue;
      const auto& pairs = state.list.pairs();
      const auto at = std::lower_bound(pairs.begin(), pairs.end(), pair) - pairs.begin();
      const Contact& record = state.contacts.records()[static_cast<std::size_t>(at)];
      const double stiffness = simulation.scene().laws.between(0, 0).normal_stiffness;
      const Vec3 force = -stiffness * gap.gap * gap.normal + record.shear.force;
      stress += force * d.transpose() / state.cell.volume();
      mean_force += force.norm();
      ++contacts;
      resultant[a] -= force;
      resultant[b] += force;
      ++touching[a];
      ++touching[b];
    }
    mean_force /= static_cast<double>(contacts);
    for (std::size_t i = 0; i < p.size(); ++i)
      if (touching[i] > 0) worst = std::max(worst, resultant[i].norm());
    rattlers = std::count_if(touching.begin(), touching.end(), [](int count) { return count < 2; });
  }
};

// Its bounding spheres filled more of the cell than random placement allows.
TEST(Simulation, OfTheSceneOfNeedlesThatSettleFindsRoomForAll) {
  const Simulation simulation(load_scene(std::string(TANGENCY_SCENES) + "/settle-1000.toml"));
  EXPECT_EQ(simulation.state().particles.size(), 1000u);
}

class Assembly : public testing::TestWithParam<const char*> {};

TEST_P(Assembly, ComesToItsStressAndIntoBalance) {
  Simulation simulation(load_scene(std::string(TANGENCY_SCENES) + "/" + GetParam()));
  run_to_end(simulation);
  const Recount recount(simulation);
  EXPECT_NEAR(recount.stress.trace() / 3.0, 10e6, 0.01 * 10e6);
  EXPECT_LT(recount.worst, 0.01 * recount.mean_force);
  const Observation seen = simulation.observe();
  EXPECT_EQ(static_cast<std::size_t>(seen.contacts), recount.contacts);
  EXPECT_EQ(seen.balance.rattlers, recount.rattlers);
  EXPECT_NEAR(seen.balance.largest_unbalanced_ratio, recount.worst / recount.mean_force, 1e-6);
  EXPECT_GT(seen.coordination_number, 4.0) << "what stands has at least four contacts";
  const double mean = recount.stress.trace() / 3.0;
  EXPECT_NEAR(seen.asymmetry, (recount.stress - recount.stress.transpose()).norm() / mean, 1e-9);
  EXPECT_GT(seen.asymmetry, 0.0);
  EXPECT_LE(seen.asymmetry, 1e-3);
  EXPECT_LT((seen.boundary_stress - recount.stress).norm(), 0.005 * mean);
}

INSTANTIATE_TEST_SUITE_P(Of, Assembly, testing::Values("assembly-125.toml", "assembly-1000.toml"),
                         [](const auto& one) {
                           const std::string file = one.param;
                           return file.substr(9, file.find('.') - 9);
                         });

}  // namespace
