// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cell in simple shear and its least skewed description.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/simulation.hpp>

#include "scenes.hpp"
#include "stages.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

constexpr unsigned kSeed = 20261201;

// dem/cell.hpp
TEST(SimpleShear, HasACellWhoseNewEdgesAreHalfOffAtMostAndOfTheSameLattice) {
  std::mt19937 engine(kSeed);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  SCOPED_TRACE(kSeed);
  int described_anew = 0;
  for (int round = 0; round < 1000; ++round) {
    Cell cell = Cell::box({draw(1, 3), draw(1, 3), draw(1, 3)});
    cell.edges(0, 1) = draw(-4, 4);
    cell.edges(1, 2) = draw(-4, 4);
    cell.edges(0, 2) = draw(-4, 4);
    const Reset reset = cell.reset();
    const Mat3 now = reset.edges(cell.edges);
    for (const auto& [along, of] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)})
      EXPECT_LE(std::abs(now(along, of)), 0.5 * now(along, along) * (1.0 + 1e-9));
    EXPECT_EQ(now.diagonal(), cell.edges.diagonal());
    if (reset.is_none()) continue;
    ++described_anew;
    const Image image{-2, 3, 1};
    const Image same = reset.image(image);
    EXPECT_LT((now * Vec3(same[0], same[1], same[2]) - cell.translation(image)).norm(), 1e-13);
    const Vec3 place(0.3, 0.7, 0.2);
    EXPECT_LT((now * reset.reduced(place) - cell.edges * place).norm(), 1e-13);
    cell.edges = now;
    EXPECT_TRUE(cell.reset().is_none()) << "once is enough";
  }
  EXPECT_GT(described_anew, 900);
}

TEST(SimpleShear, HasTheShearStrainOfItsLayersInEveryDescriptionOfItsCell) {
  Cell cell = Cell::box({2, 3, 4});
  EXPECT_EQ(cell.shear_strain(), Vec3::Zero());
  cell.edges.diagonal() << 1, 2, 5;
  EXPECT_EQ(cell.shear_strain(), Vec3::Zero()) << "of another box";
  // Layers that lay 3 and 4 high, and lie 2 and 5 high now.
  Mat3 moved = Vec3(1, 2.0 / 3.0, 5.0 / 4.0).asDiagonal();
  moved(0, 1) = 1.9 / 3.0;
  moved(1, 2) = -6.0 / 4.0;
  moved(0, 2) = 3.5 / 4.0;
  cell.edges = moved * cell.reference_edges;
  const Vec3 strain(1.9 / 2.0, -6.0 / 5.0, 3.5 / 5.0);
  EXPECT_TRUE(cell.shear_strain().isApprox(strain, 1e-14)) << cell.shear_strain();
  const Reset reset = cell.reset();
  ASSERT_FALSE(reset.is_none());
  for (Mat3* edges : {&cell.edges, &cell.reference_edges}) *edges = reset.edges(*edges);
  EXPECT_TRUE(cell.shear_strain().isApprox(strain, 1e-14)) << cell.shear_strain();
  // Without a turn each of two lines leans by half.
  cell = Cell::box({2, 3, 4});
  cell.edges = (Mat3() << 1, 0.1, 0, 0.1, 1, 0, 0, 0, 1).finished() * cell.reference_edges;
  EXPECT_TRUE(cell.shear_strain().isApprox(Vec3(0.2, 0, 0), 1e-14)) << cell.shear_strain();
}

std::string sheared(const std::string& rates, std::int64_t cycles) {
  return "schema = 1\n[cell]\n[particles.grain]\ncount = 40\nmean_radius = 10.0\n"
         "elongation = 1.3\n[contact]\nnormal_stiffness = 1.5e10\nfriction_coefficient = 0.4\n"
         "[[stage]]\nkind = \"place\"\narrangement = \"random\"\nseed = 5\n"
         "[[stage]]\nkind = \"compress\"\nmean_stress = 60e6\nmax_strain_rate = 0.4\n"
         "stress_tolerance = 0.05\nfriction_coefficient = 0.1\n"
         "[[stage]]\nkind = \"servo\"\nmean_stress = 60e6\nmax_strain_rate = 0.3\n"
         "simple_shear_rate = " +
         rates + "\nduration = " + std::to_string(cycles) + "\n[output]\nframe_interval = 0\n";
}

/// The multiset of all that contacts carry, but for what a change of sides turns.
std::vector<std::array<double, 3>> carried(const State& state) {
  std::vector<std::array<double, 3>> all;
  for (const Contact& contact : state.contacts.records())
    all.push_back({contact.overlap, contact.normal_force, contact.shear.force.norm()});
  std::sort(all.begin(), all.end());
  return all;
}

TEST(SimpleShear, GoesOnThroughEveryNewDescriptionOfItsCell) {
  Simulation simulation = at_stage(sheared("[0.2, 0.0, 0.0]", 100000), 2);
  int described_anew = 0;
  double tilt = 0.0;
  bool resumed = false;
  for (int k = 0; k < 20000 && described_anew < 3; ++k) {
    const bool due = !simulation.state().cell.reset().is_none();
    const Observation before = simulation.observe();
    const std::string saved = testing::TempDir() + "simple-shear.state";
    if (due && !resumed) save_state(simulation.state(), saved);
    const double coming = simulation.state().cell.edges(0, 1);
    simulation.step();
    const Cell& cell = simulation.state().cell;
    ASSERT_LE(std::abs(cell.edges(0, 1)), 0.51 * cell.edges(0, 0));
    if (!due) continue;
    ++described_anew;
    tilt += std::abs(cell.edges(0, 1) - coming) / cell.edges(0, 0);
    const Observation after = simulation.observe();
    EXPECT_NEAR(after.stress.mean(), before.stress.mean(), 0.02 * before.stress.mean());
    EXPECT_LE(std::abs(after.contacts - before.contacts), 2);
    EXPECT_NEAR(after.volumetric_strain, before.volumetric_strain, 1e-3);
    EXPECT_NEAR(after.shear_strain[0], before.shear_strain[0], 1e-3);
    if (resumed) continue;
    resumed = true;
    Simulation again(simulation.scene(), load_state(saved));
    again.step();
    EXPECT_EQ(state_hash(again.state()), state_hash(simulation.state()));
  }
  EXPECT_EQ(described_anew, 3);
  EXPECT_NEAR(tilt, 3.0, 0.1) << "each by an edge";
  const Observation seen = simulation.observe();
  EXPECT_GT(seen.stress.tensor(0, 1), 0.1 * seen.stress.mean()) << "of the rate's sign";
  EXPECT_LT(std::abs(seen.energy_error), 0.02 * seen.account.boundary);
  EXPECT_NEAR(seen.shear_strain[0], 3.0, 0.7) << "> 0 as the stress, by some edges of the cell";
  EXPECT_NEAR(seen.shear_strain[1], 0.0, 1e-9);
}

TEST(SimpleShear, IsTheSameInAnotherDescriptionAndContactsKeepTheirBits) {
  Simulation simulation = at_stage(sheared("[0.2, 0.1, 0.05]", 100000), 2);
  while (simulation.state().cell.edges(0, 1) > -0.3 * simulation.state().cell.edges(0, 0))
    simulation.step();
  // Described as more skewed than it has to be: the next step mends that.
  const Reset away{-1, 1, -1};
  State other = simulation.state();
  for (Mat3* edges : {&other.cell.edges, &other.cell.reference_edges}) *edges = away.edges(*edges);
  NeighbourList::Reference reference = other.list.reference();
  reference.edges = away.edges(reference.edges);
  for (Vec3& at : reference.reduced_position) at = away.reduced(at);
  std::vector<Pair> pairs = other.contacts.follow(other.list.pairs(), away);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  other.list.restore(std::move(reference), std::move(pairs));
  other.contacts.add_up(other.particles, other.list);
  EXPECT_EQ(carried(other), carried(simulation.state()));
  Simulation again(simulation.scene(), other);
  EXPECT_LT((again.observe().stress.tensor - simulation.observe().stress.tensor).norm(),
            1e-12 * again.observe().stress.mean());
  for (int k = 0; k < 100; ++k) {
    simulation.step();
    again.step();
  }
  EXPECT_TRUE(simulation.state().cell.edges.isApprox(again.state().cell.edges, 1e-9));
  EXPECT_LT((again.observe().stress.tensor - simulation.observe().stress.tensor).norm(),
            1e-6 * again.observe().stress.mean());
}

}  // namespace
