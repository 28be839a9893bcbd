// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

const std::vector<Batch> kProlate = {{{10.0, 1.0 / 0.7, 1.0}, 1000.0, 100}};

TEST(Shape, KeepsItsVolumeAndRatios) {
  const Vec3 axes = Shape{2.0, 1.5, 3.0}.semi_axes();
  EXPECT_NEAR(axes.prod(), 8.0, 1e-14);
  EXPECT_NEAR(axes[0] / axes[1], 1.5, 1e-15);
  EXPECT_NEAR(axes[1] / axes[2], 3.0, 1e-15);
}

// dem/samples/sample.hpp (1)
TEST(PlaceOnLattice, LeavesNoTwoParticlesOverlappingWhateverTheJitter) {
  for (const double jitter : {0.0, 0.01, 10.0}) {
    Cell cell;
    const Particles particles = place_on_lattice(kProlate, {{}, jitter, 7}, cell);
    ASSERT_EQ(particles.size(), 100u);
    EXPECT_TRUE(meeting_pairs(particles, cell, 1).empty());
  }
}

TEST(PlaceOnLattice, FillsTheSmallestCubeWithoutASize) {
  Cell cell;
  place_on_lattice({{{1.0, 1.0, 1.0}, 1.0, 28}}, {{}, 0.0, 1}, cell);
  EXPECT_LT((cell.edges.diagonal() - Vec3::Constant(8.0)).norm(), 1e-4);
}

TEST(PlaceOnLattice, SpreadsOverAGivenCellAndRefusesOneTooSmall) {
  Cell cell;
  const Vec3 edges(200.0, 150.0, 300.0);
  const Particles particles = place_on_lattice(kProlate, {edges, 0.0, 1}, cell);
  EXPECT_EQ(Vec3(cell.edges.diagonal()), edges);
  for (const Vec3& x : particles.position) EXPECT_TRUE((x.array() < edges.array()).all());
  EXPECT_THROW(place_on_lattice(kProlate, {Vec3::Constant(100.0), 0.0, 1}, cell), DoesNotFit);
  EXPECT_THROW(check_room(kProlate, {Vec3::Constant(1e6), 0.0, 1}), DoesNotFit);
}

// dem/samples/sample.hpp (2)
TEST(PlaceOnLattice, OfOneSeedIsOneSample) {
  Cell cell;
  const Particles first = place_on_lattice(kProlate, {{}, 0.1, 3}, cell);
  const Particles again = place_on_lattice(kProlate, {{}, 0.1, 3}, cell);
  const Particles other = place_on_lattice(kProlate, {{}, 0.1, 4}, cell);
  EXPECT_EQ(first.position, again.position);
  EXPECT_NE(first.position, other.position);
  // Golden, from a program of its own (the generator of Nishimura and Matsumoto 2000 in Python, the
  // steps of sample.hpp): the same sample on every machine.
  const Vec3 golden(12.786256089489266, 12.732182009029035, 12.734106763169578);
  EXPECT_LT((first.position[0] - golden).norm(), 1e-13);
}

TEST(PlaceOnLattice, ShufflesKindsOfTheRightNumbers) {
  Cell cell;
  const Particles particles = place_on_lattice(
      {{{1.0, 1.0, 1.0}, 1.0, 40}, {{2.0, 1.5, 1.0}, 3.0, 24}}, {{}, 0.0, 5}, cell);
  EXPECT_EQ(std::count(particles.type.begin(), particles.type.end(), 0), 40);
  EXPECT_EQ(std::count(particles.type.begin(), particles.type.end(), 1), 24);
  EXPECT_FALSE(std::is_sorted(particles.type.begin(), particles.type.end()));
  for (std::size_t i = 0; i < particles.size(); ++i)
    EXPECT_NEAR(particles.mass[i] / volume_of(particles.semi_axes[i]),
                particles.type[i] == 0 ? 1.0 : 3.0, 1e-13);
}

// The second moment of an isotropic direction is a third; 20000 draws leave an error of 0.002.
TEST(UniformRotation, FavoursNoDirection) {
  std::mt19937_64 random(9);
  Mat3 moment = Mat3::Zero();
  Vec3 mean = Vec3::Zero();
  constexpr int draws = 20000;
  for (int k = 0; k < draws; ++k) {
    const Vec3 axis = uniform_rotation(random) * Vec3::UnitX();
    moment += axis * axis.transpose() / draws;
    mean += axis / draws;
  }
  EXPECT_LT((moment - Mat3::Identity() / 3.0).norm(), 0.01);
  EXPECT_LT(mean.norm(), 0.02);
}

}  // namespace
