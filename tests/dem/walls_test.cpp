// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <tangency/dem/simulation.hpp>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using namespace tangency::testing;

/// Every particle and wall that touch.
std::vector<Pair> meeting_walls(const Particles& particles, const Cell& cell) {
  std::vector<Pair> pairs;
  const Vec3 far = cell.edges.diagonal();
  const auto count = static_cast<std::int32_t>(particles.size());
  for (std::int32_t i = 0; i < count; ++i) {
    const Vec3& x = particles.position[static_cast<std::size_t>(i)];
    for (int axis = 0; axis < 3; ++axis) {
      if (!cell.walled[static_cast<std::size_t>(axis)]) continue;
      const double half = body(particles, static_cast<std::size_t>(i)).support(Vec3::Unit(axis));
      if (x[axis] < half) pairs.push_back({i, count + 2 * axis, Image{}});
      if (far[axis] - x[axis] < half) pairs.push_back({i, count + 2 * axis + 1, Image{}});
    }
  }
  return pairs;
}

class Walls : public testing::TestWithParam<std::array<bool, 3>> {};

// dem/neighbours.hpp (5)
TEST_P(Walls, AreListedWithEveryParticleThatTouchesThemWhileTheListIsCurrent) {
  Cell cell = Cell::box({7.0, 8.0, 6.0}, 3, GetParam());
  Particles particles = crowd(150, cell, 61);
  for (Vec3& x : particles.position)  // inside along walled axes, with some behind the walls
    for (int k = 0; k < 3; ++k)
      if (cell.walled[static_cast<std::size_t>(k)])
        x[k] = (x[k] + cell.edges(k, k)) / 3.0 * 1.1 - 0.05 * cell.edges(k, k);
  cell.rate = Vec3(-0.6, 0.2, -0.4).asDiagonal();
  NeighbourList list;
  list.build(particles, cell, 0.25);
  int steps = 0;
  for (; list.is_current(particles, cell); ++steps) {
    ASSERT_LT(steps, 1000);
    const auto meeting = meeting_walls(particles, cell);
    ASSERT_GT(meeting.size(), 20u);
    ASSERT_TRUE(
        std::includes(list.pairs().begin(), list.pairs().end(), meeting.begin(), meeting.end()));
    for (std::size_t i = 0; i < particles.size(); ++i)
      particles.position[i] +=
          0.002 * (0.5 * particles.velocity[i] + cell.rate * particles.position[i]);
    cell.strain(0.002);
  }
  EXPECT_GT(steps, 10);
}

INSTANTIATE_TEST_SUITE_P(Along, Walls,
                         testing::Values(std::array{true, false, false},
                                         std::array{false, true, true},
                                         std::array{true, true, true}),
                         [](const auto& one) {
                           std::string name;
                           for (std::size_t k = 0; k < 3; ++k)
                             if (one.param[k]) name += "XYZ"[k];
                           return name;
                         });

/// One body in a box of walls on all sides, under gravity along -z, damped for long.
State fallen(const std::string& shape, const std::string& contact, const std::string& body) {
  const std::string text =
      "schema = 1\n[cell]\nsize = [4, 4, 4]\nwalls = \"xyz\"\n[motion]\n"
      "gravity = [0.0, 0.0, -9.81]\n[particles.stone]\ncount = 1\ndensity = 2500.0\n" +
      shape + "[contact]\nfriction_coefficient = 0.5\n" + contact + "[contact.stone-wall]\n" +
      "[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\n[[body]]\ntype = \"stone\"\n" +
      body +
      "[[stage]]\nkind = \"servo\"\nduration = 60000\ndamping = 0.02\ntime_step_factor = 0.2\n";
  Simulation simulation(parse_scene(text, "scene.toml"));
  while (simulation.status() == StageStatus::running) simulation.step();
  return simulation.state();
}

/// The only touch of a body that has come to rest: with the floor.
Contact floor_of(const State& state) {
  std::vector<Contact> touching;
  for (std::size_t k = 0; k < state.list.pairs().size(); ++k)
    if (state.contacts.records()[k].touches()) {
      EXPECT_EQ(state.list.pairs()[k].b, 1 + 4) << "wall 4 is that at z = 0";
      touching.push_back(state.contacts.records()[k]);
    }
  EXPECT_EQ(touching.size(), 1u);
  return touching.at(0);
}

TEST(Walls, BearASphereAtTheOverlapOfItsWeight) {
  const State state =
      fallen("mean_radius = 0.5\n", "normal_stiffness = 1e6\n", "position = [1.5, 2.5, 0.6]\n");
  const double weight = state.particles.mass[0] * 9.81;
  const Contact floor = floor_of(state);
  EXPECT_NEAR(floor.overlap, weight / 1e6, 1e-9 * floor.overlap);
  EXPECT_NEAR(state.particles.position[0][2], 0.5 - weight / 1e6, 1e-12);
  EXPECT_NEAR(floor.force[2], -weight, 1e-9 * weight) << "of the particle on the wall";
  EXPECT_LT(state.particles.velocity[0].norm(), 1e-9);
}

TEST(Walls, BearAHertzSphereAtTheOverlapOfItsWeight) {
  const State state =
      fallen("mean_radius = 0.5\n", "law = \"hertz\"\nyoung_modulus = 1e8\npoisson_ratio = 0.25\n",
             "position = [1.5, 2.5, 0.5]\n");
  const double weight = state.particles.mass[0] * 9.81;
  const double modulus = 1e8 / (2.0 * (1.0 - 0.25 * 0.25));
  const double overlap = std::pow(weight / (4.0 / 3.0 * modulus * std::sqrt(0.5)), 2.0 / 3.0);
  EXPECT_NEAR(floor_of(state).overlap, overlap, 1e-9 * overlap);
}

TEST(Walls, BearATiltedEllipsoidOnItsFlatSideInTheEnd) {
  const State state =
      fallen("mean_radius = 0.5\nelongation = 1.3\nflatness = 1.6\n", "normal_stiffness = 1e6\n",
             "position = [2.0, 2.0, 0.8]\norientation = [1.0, 0.2, 0.15, 0.1]\n");
  const double weight = state.particles.mass[0] * 9.81;
  const double c = state.particles.semi_axes[0][2];
  EXPECT_NEAR(state.particles.position[0][2], c - weight / 1e6, 1e-6 * c);
  const Vec3 flat = state.particles.orientation[0] * Vec3::UnitZ();
  EXPECT_GT(std::abs(flat[2]), 1.0 - 1e-6);
  EXPECT_NEAR(floor_of(state).overlap, weight / 1e6, 1e-6 * weight / 1e6);
}

/// Balls of two densities between walls along z, under gravity, whose weights are as large as what
/// presses them: compacted, relaxed, grown and unloaded.
std::string pressed_by_their_weight() {
  const std::string motion =
      "stress_tolerance = 0.1\nservo_gain = 0.02\nmax_strain_rate = 2.0\n"
      "time_step_factor = 0.3\ndamping = 0.1\nmax_cycles = 20000\n";
  return "schema = 1\n[cell]\nsize = [6.0, 6.0, 12.0]\nwalls = \"z\"\n[motion]\n"
         "gravity = [0.0, 0.0, -10.0]\n"
         "[particles.light]\ncount = 12\nmean_radius = 1.0\ndensity = 1000.0\n"
         "[particles.heavy]\ncount = 12\nmean_radius = 0.9\ndensity = 5000.0\n"
         "[contact]\nnormal_stiffness = 5e7\n[contact.light-wall]\n[contact.heavy-wall]\n"
         "[[stage]]\nkind = \"place\"\narrangement = \"random\"\n"
         "[[stage]]\nkind = \"relax\"\nmean_stress = 100e3\nmax_unbalanced_ratio = 0.03\n" +
         motion +
         "[[stage]]\nkind = \"grow\"\nelongation = 1.05\nincrements = 5\n"
         "max_inertial_fraction = 0.02\nmean_stress = 100e3\n" +
         motion +
         "[[stage]]\nkind = \"unload\"\nmean_stress = 60e3\nmax_unbalanced_ratio = 0.03\n" + motion;
}

/// The largest force out of balance over the mean contact force, and the mean, from the records of
/// the contacts and the weights: none of the simulator's sums.
struct Unbalanced {
  double largest = 0.0, mean = 0.0, without_weights = 0.0;
  std::int64_t without_contacts = 0;

  explicit Unbalanced(const Simulation& simulation) {
    const State& state = simulation.state();
    const Particles& p = state.particles;
    std::vector<Vec3> force(p.size(), Vec3::Zero());
    std::vector<int> touching(p.size(), 0);
    double contact_force = 0.0;
    int contacts = 0, bodies = 0;
    for (std::size_t k = 0; k < state.list.pairs().size(); ++k) {
      const Contact& contact = state.contacts.records()[k];
      if (!contact.touches()) continue;
      contact_force += contact.force.norm();
      ++contacts;
      const auto a = static_cast<std::size_t>(state.list.pairs()[k].a);
      const auto b = static_cast<std::size_t>(state.list.pairs()[k].b);
      force[a] -= contact.force;
      ++touching[a];
      if (b >= p.size()) continue;
      force[b] += contact.force;
      ++touching[b];
    }
    const double scale = contact_force / contacts;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (touching[i] == 0) {
        ++without_contacts;
        continue;
      }
      const double off = (force[i] + p.mass[i] * simulation.scene().gravity).norm() / scale;
      largest = std::max(largest, off);
      mean += off;
      without_weights = std::max(without_weights, force[i].norm() / scale);
      ++bodies;
    }
    mean /= bodies;
  }
};

// What stands in balance has contact resultants that bear the weights: by dem/observe.hpp (1) the
// stress at the boundary, whose floor is at height 0, is less by the weights times their heights.
TEST(Gravity, IsWhatBoundaryStressAndContactStressDifferBy) {
  Simulation simulation(parse_scene(pressed_by_their_weight(), "scene.toml"));
  while (simulation.status() != StageStatus::done || simulation.state().stage < 1) {
    ASSERT_NE(simulation.status(), StageStatus::out_of_cycles);
    simulation.step();
  }
  const State& state = simulation.state();
  double weights = 0.0;  // times their heights, over the volume
  for (std::size_t i = 0; i < state.particles.size(); ++i)
    weights += state.particles.mass[i] * 10.0 * state.particles.position[i][2];
  weights /= state.cell.volume();
  const Observation seen = simulation.observe();
  const double more = seen.boundary_stress(2, 2) - seen.stress.tensor(2, 2);
  ASSERT_GT(std::abs(weights), 0.1 * seen.stress.mean());
  EXPECT_NEAR(more, -weights, 0.05 * weights);
  // All of it comes from the wall at the top: the floor is at height 0.
  double top = 0.0;
  for (std::size_t k = 0; k < state.list.pairs().size(); ++k)
    if (state.list.pairs()[k].b == static_cast<std::int32_t>(state.particles.size()) + 5)
      top += state.contacts.force(k)[2];
  EXPECT_NEAR(seen.boundary_stress(2, 2), top * state.cell.edges(2, 2) / state.cell.volume(),
              1e-12 * seen.stress.mean());
}

TEST(Gravity, CountsInTheBalanceOfRelaxingGrowingAndUnloadingBetweenWalls) {
  Simulation simulation(parse_scene(pressed_by_their_weight(), "scene.toml"));
  int increments = 0;
  while (!simulation.finished()) {
    const StageStatus status = simulation.status();
    ASSERT_NE(status, StageStatus::out_of_cycles) << simulation.stage().name;
    if (status == StageStatus::done) {
      const Unbalanced off(simulation);
      const Balance balance = simulation.observe().balance;
      EXPECT_GT(off.without_weights, 0.2) << "there was a weight to count";
      EXPECT_NEAR(balance.largest_unbalanced_ratio, off.largest, 1e-9);
      EXPECT_NEAR(balance.inertial_fraction, off.mean, 1e-9);
      EXPECT_EQ(balance.rattlers, off.without_contacts);
      if (simulation.stage().growth) {
        EXPECT_LE(off.mean, 0.02);
      } else {
        EXPECT_LE(off.largest, 0.03);
      }
      simulation.next_stage();
      continue;
    }
    if (simulation.stage().growth) {
      const Unbalanced before(simulation);
      const std::int64_t made = simulation.state().increments;
      simulation.step();
      if (simulation.state().increments == made) continue;
      EXPECT_LE(before.mean, 0.02) << "an increment waits for the balance";
      ++increments;
    } else {
      simulation.step();
    }
  }
  EXPECT_EQ(increments, 5);
}

}  // namespace
