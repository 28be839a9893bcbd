// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells that strain at any homogeneous rate, and so become parallelepipeds.
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include <tangency/dem/observe.hpp>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

bool lists_all(const NeighbourList& list, const std::vector<Pair>& pairs) {
  return std::includes(list.pairs().begin(), list.pairs().end(), pairs.begin(), pairs.end());
}

Mat3 matrix(std::initializer_list<double> rows) {
  Mat3 made;
  int k = 0;
  for (const double x : rows) made(k / 3, k % 3) = x, ++k;
  return made;
}

/// Cells far from a box: sheared by up to 0.9 across, in each plane and in all at once.
std::vector<Cell> skewed_cells() {
  std::vector<Cell> cells;
  for (const Mat3& shear :
       {matrix({1, 0.9, 0, 0, 1, 0, 0, 0, 1}), matrix({1, 0, 0, 0, 1, 0, -0.8, 0, 1}),
        matrix({1, 0.3, -0.2, 0.3, 0.8, 0.4, -0.2, 0.4, 1.2})}) {
    Cell cell = Cell::box({5.0, 4.0, 6.0});
    cell.edges = shear * cell.edges;
    cells.push_back(cell);
  }
  return cells;
}

TEST(SkewedCell, NeighboursAreThoseOfBruteForce) {
  for (const Cell& cell : skewed_cells()) {
    const Particles particles = crowd(60, cell, 51);
    NeighbourList list;
    list.build(particles, cell, 0.2);
    const auto touching = touching_pairs(particles, cell);
    ASSERT_GT(touching.size(), 100u);
    EXPECT_TRUE(lists_all(list, touching));
    for (const Pair& pair : list.pairs()) {  // and none that is further away than the skins
      const double skins =
          0.2 * (mean_radius(particles.semi_axes[static_cast<std::size_t>(pair.a)]) +
                 mean_radius(particles.semi_axes[static_cast<std::size_t>(pair.b)]));
      EXPECT_LT(gap_of(pair, particles, cell), skins + 1e-5);
    }
  }
}

TEST(SkewedCell, MissesNoPairWhileItsListIsCurrent) {
  Cell cell = skewed_cells().back();
  cell.rate = matrix({-0.5, 0.8, -0.3, 0.8, 0.2, 0.6, -0.3, 0.6, 0.4});
  Particles particles = crowd(30, cell, 52);
  NeighbourList list;
  list.build(particles, cell, 0.3);
  int steps = 0;
  for (; list.is_current(particles, cell); ++steps) {
    ASSERT_LT(steps, 1000);
    ASSERT_TRUE(lists_all(list, touching_pairs(particles, cell)));
    for (std::size_t i = 0; i < particles.size(); ++i)
      particles.position[i] +=
          0.002 * (0.3 * particles.velocity[i] + cell.rate * particles.position[i]);
    cell.strain(0.002);
  }
  EXPECT_GT(steps, 5);
}

TEST(SkewedCell, CarriesFreeParticlesWithIt) {
  Cell cell = Cell::box({5.0, 4.0, 6.0});
  cell.rate = matrix({-0.5, 0.8, -0.3, 0.8, 0.2, 0.6, -0.3, 0.6, 0.4});
  Particles particles = crowd(20, cell, 53);
  for (Vec3& v : particles.velocity) v.setZero();
  const Cell before = cell;
  const Particles start = particles;
  const std::size_t count = particles.size();
  const Resultants none{std::vector<Vec3>(count, Vec3::Zero()),
                        std::vector<Vec3>(count, Vec3::Zero())};
  for (int step = 0; step < 200; ++step) move(particles, cell, none, {}, 0.005);
  ASSERT_FALSE(cell.is_box());
  const Mat3 gradient = cell.edges * before.edges.inverse();
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_LT((particles.position[i] - gradient * start.position[i]).norm(), 1e-12);
    EXPECT_LT((cell.reduced(particles.position[i]) - before.reduced(start.position[i])).norm(),
              1e-12);
  }
  // A constant symmetric rate strains by rate times time, to the first order of the steps.
  EXPECT_LT((cell.logarithmic_strain() - before.rate).norm(), 0.005);
  EXPECT_NEAR(cell.logarithmic_strain().trace(), std::log(cell.volume() / before.volume()), 1e-12);
}

/// Sheared by `rate`, the stress at the end.
Mat3 stress_after(const Moving& from, const Mat3& rate, const ContactLaw& law) {
  Moving made = from;
  made.cell.rate = rate;
  made.run(law, 60, 0.005, 5.0);
  return stress_of(made.contacts, made.cell).tensor;
}

TEST(SkewedCell, OfPureShearOnTurnedAxesHasTheTurnedStress) {
  const ContactLaw law{100.0, 80.0, 0.3, 0.0};
  const Cell cell = Cell::box({4.5, 5.0, 5.5});
  Moving made{cell, crowd(50, cell, 54)};
  for (Vec3& axes : made.particles.semi_axes) axes *= 0.7;
  const Mat3 shear = matrix({0, 0.8, 0, 0.8, 0, 0, 0, 0, 0});  // in xy; turned: in yz, zx, yx ...
  const Mat3 stress = stress_after(made, shear, law);
  ASSERT_GT(std::abs(stress(0, 1)), 0.01 * stress.norm());
  for (const Mat3& turn : axis_rotations()) {
    const Moving there{Cell::box((turn * cell.edges.diagonal()).cwiseAbs()),
                       turned(made.particles, turn)};
    const Mat3 seen = stress_after(there, turn * shear * turn.transpose(), law);
    EXPECT_LT((seen - turn * stress * turn.transpose()).norm(), 1e-10 * stress.norm());
  }
}

// The same lattice of images by other edges, b + a for b: nothing else changes.
TEST(SkewedCell, OfOtherEdgesOfTheSameLatticeIsTheSameAssembly) {
  const ContactLaw law{100.0, 80.0, 0.3, 0.0};
  const Cell cell = Cell::box({4.5, 5.0, 5.5});
  Moving here{cell, crowd(50, cell, 55)};
  for (Vec3& axes : here.particles.semi_axes) axes *= 0.7;
  Moving there = here;
  there.cell.edges.col(1) += there.cell.edges.col(0);
  there.cell.edges.col(2) -= there.cell.edges.col(1);
  for (Moving* one : {&here, &there}) {
    one->cell.rate = matrix({-0.5, 0.8, -0.3, 0.8, 0.2, 0.6, -0.3, 0.6, 0.4});
    one->run(law, 40, 0.005);
  }
  ASSERT_GT(here.touching(), 25u);
  ASSERT_EQ(here.touching(), there.touching());
  for (std::size_t i = 0; i < here.particles.size(); ++i)
    EXPECT_LT((here.contacts.resultants().force[i] - there.contacts.resultants().force[i]).norm(),
              1e-10 * here.largest_force());
}

}  // namespace
