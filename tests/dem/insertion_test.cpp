// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/dem/samples/insertion.hpp>
#include <tangency/dem/samples/sample.hpp>
#include <tangency/dem/samples/start_axes.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/vectors.hpp>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Relation;
using tangency::Vec3;
using namespace tangency::testing;

Batch batch_of(const Shape& shape, std::size_t count) {
  Batch batch{shape, 1000.0, count};
  batch.directed_axis = directed_axis(shape);
  return batch;
}

Placement filling(double volume_fraction, std::uint64_t seed = 1) {
  Placement how{{}, 0.0, seed, Arrangement::insertion};
  how.volume_fraction = volume_fraction;
  return how;
}

/// Pairs of images, of all whose bounding spheres meet, that share a point.
std::size_t pairs_that_meet(const Particles& particles, const Cell& cell) {
  std::size_t meet = 0;
  for (const Pair& pair : meeting_pairs(particles, cell, 1)) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    if (cell.dimensions == 2 && pair.image[2] != 0) continue;
    if (relation(body(particles, a), body(particles, b), branch_vector(pair, particles, cell))
            .relation != Relation::separate)
      ++meet;
  }
  return meet;
}

double filled(const Particles& particles, const Cell& cell) {
  double volume = 0.0;
  for (const Vec3& axes : particles.semi_axes) volume += volume_of(axes, particles.dimensions);
  return volume / cell.volume();
}

// dem/samples/insertion.hpp (1)
TEST(Insertion, LeavesNoTwoBodiesSharingAPointNearTheDensityWhereItEnds) {
  for (const Shape& shape : {Shape{1.0, 1.0, 1.0}, Shape{1.0, 1.5, 1.0}, Shape{1.0, 3.0, 1.0},
                             Shape{1.0, 1.0, 3.0}, Shape{0.01, 1.3, 1.4}}) {
    Cell cell;
    const Particles particles = insert({batch_of(shape, 250)}, filling(0.37), cell);
    ASSERT_EQ(particles.size(), 250u);
    EXPECT_NEAR(filled(particles, cell), 0.37, 1e-12);
    EXPECT_EQ(pairs_that_meet(particles, cell), 0u) << shape.elongation << ' ' << shape.flatness;
  }
}

// Bounding spheres of needles of aspect 3 would need nine times their volume.
TEST(Insertion, LooksAtTheBodiesAndNotAtTheirBoundingSpheres) {
  Cell cell;
  const Particles particles = insert({batch_of({1.0, 3.0, 1.0}, 250)}, filling(0.3), cell);
  EXPECT_GT(meeting_pairs(particles, cell, 1).size(), 250u);
}

// dem/samples/insertion.hpp (1), of walls
TEST(Insertion, KeepsBodiesWithinWallsByTheirExtentAndNotByTheirLargestAxis) {
  Placement how = filling(0.25, 2);
  how.walled = {true, false, true};
  Cell cell;
  const Particles particles = insert({batch_of({1.0, 3.0, 1.0}, 200)}, how, cell);
  std::size_t nearer = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Mat3 rotation = particles.orientation[i].toRotationMatrix();
    for (const int k : {0, 2}) {
      const double extent =
          Vec3(rotation.row(k).transpose().cwiseProduct(particles.semi_axes[i])).norm();
      EXPECT_GE(particles.position[i][k], extent);
      EXPECT_LE(particles.position[i][k], cell.edges(k, k) - extent);
      nearer += particles.position[i][k] < particles.semi_axes[i][0] ? 1U : 0U;
    }
  }
  EXPECT_GT(nearer, 0u) << "a body lies nearer to a wall than it is long";
  EXPECT_EQ(pairs_that_meet(particles, cell), 0u);
}

// dem/samples/insertion.hpp (2)
// And another seed has another sample.
TEST(Insertion, OfOneSeedIsOneSample) {
  Cell cell;
  const auto of_seed = [&](std::uint64_t seed) {
    return insert({batch_of({1.0, 2.0, 1.0}, 60)}, filling(0.35, seed), cell);
  };
  const Particles first = of_seed(3), again = of_seed(3), other = of_seed(4);
  EXPECT_EQ(first.position, again.position);
  EXPECT_NE(first.position, other.position);
}

// dem/samples/insertion.hpp (3)
TEST(Insertion, KeepsCentresOfLayersWithinThem) {
  std::vector<Batch> batches{batch_of({1.0, 1.5, 1.0}, 120), batch_of({0.8, 1.0, 1.0}, 150)};
  batches[0].layer = {0.0, 0.5};
  batches[1].layer = {0.5, 1.0};
  Cell cell;
  const Particles particles = insert(batches, filling(0.3), cell);
  const double height = cell.edges(2, 2);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double share = particles.position[i][2] / height;
    EXPECT_GE(share, particles.type[i] == 0 ? 0.0 : 0.5);
    EXPECT_LE(share, particles.type[i] == 0 ? 0.5 : 1.0);
  }
  EXPECT_EQ(pairs_that_meet(particles, cell), 0u);
}

TEST(Insertion, PutsSmallBodiesBetweenLargeOnes) {
  const std::vector<Batch> batches{batch_of({1.0, 1.2, 1.0}, 10), batch_of({0.1, 1.0, 1.0}, 1500)};
  Cell cell;
  const Particles particles = insert(batches, filling(0.4), cell);
  EXPECT_EQ(std::count(particles.type.begin(), particles.type.end(), 1), 1500);
  EXPECT_EQ(pairs_that_meet(particles, cell), 0u);
}

TEST(Insertion, OfThePlaneLeavesNoTwoDisksSharingAPoint) {
  Placement how = filling(0.5, 5);
  how.dimensions = 2;
  Cell cell;
  const Particles particles = insert({batch_of({1.0, 1.5, 1.0}, 200)}, how, cell);
  for (const Vec3& x : particles.position) EXPECT_EQ(x[2], 0.0);
  EXPECT_EQ(pairs_that_meet(particles, cell), 0u);
}

// Of a drawn unit vector the mean square of a component is a third, with a deviation of
// sqrt(4 / 45 / n); the test allows five of them.
TEST(Insertion, FavoursNoDirectionWhereDrawsAreMoved) {
  Cell cell;
  const std::size_t count = 1000;
  const Particles particles = insert({batch_of({1.0, 2.0, 1.0}, count)}, filling(0.37, 6), cell);
  Vec3 squares = Vec3::Zero();
  for (const auto& turned : particles.orientation)
    squares += Vec3(turned * Vec3::UnitX()).cwiseAbs2() / static_cast<double>(count);
  const double deviation = std::sqrt(4.0 / 45.0 / static_cast<double>(count));
  EXPECT_LT((squares - Vec3::Constant(1.0 / 3.0)).cwiseAbs().maxCoeff(), 5.0 * deviation);
}

TEST(Insertion, SaysHowFarItCameWhereThereIsNoMoreRoom) {
  Cell cell;
  try {
    insert({batch_of({1.0, 1.0, 1.0}, 100)}, filling(0.45), cell);
    FAIL() << "spheres do not go so far";
  } catch (const DoesNotFit& error) {
    EXPECT_NE(std::string(error.what()).find("of 100, the volume fraction being 0.3"),
              std::string::npos)
        << error.what();
  }
  Placement small = filling(0.3);
  small.cell_size = Vec3(10.0, 10.0, 1.9);
  EXPECT_THROW(insertion_edges({batch_of({1.0, 1.0, 1.0}, 1)}, small), DoesNotFit);
  small.cell_size = Vec3(10.0, 10.0, 10.0);
  EXPECT_THROW(insertion_edges({batch_of({1.0, 1.0, 1.0}, 130)}, small), DoesNotFit);
}

// 0.45 of a layer that is a fifth of the cell.
TEST(Insertion, SaysHowFullALayerIsWhereItHasNoMoreRoom) {
  Placement how{{}, 0.0, 1, Arrangement::insertion};
  how.cell_size = Vec3(20.0, 20.0, 20.0);
  Batch batch = batch_of({1.0, 1.0, 1.0}, 180);
  batch.layer = {0.4, 0.5};
  Cell cell;
  try {
    insert({batch}, how, cell);
    FAIL() << "spheres do not go so far";
  } catch (const DoesNotFit& error) {
    EXPECT_NE(std::string(error.what()).find("of 180, the volume fraction of its layer being 0.3"),
              std::string::npos)
        << error.what();
  }
}

TEST(Insertion, RefusesLayersThatCannotHoldTheirBodiesBeforeItDraws) {
  const auto refusal = [](const std::array<double, 2>& layer, std::size_t count, bool walled) {
    Placement how{{}, 0.0, 1, Arrangement::insertion};
    how.cell_size = Vec3(20.0, 20.0, 20.0);
    how.walled = {false, false, walled};
    Batch batch = batch_of({1.0, 1.0, 1.0}, count);
    batch.layer = layer;
    try {
      insertion_edges({batch}, how);
    } catch (const DoesNotFit& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  // Bodies of a layer of 2 reach 1 beyond it: 400 spheres in 20 by 20 by 4.
  EXPECT_EQ(refusal({0.4, 0.5}, 400, false),
            "the layer from 0.4 to 0.5 would be filled to 1.0472, more than 0.5");
  EXPECT_EQ(refusal({0.4, 0.5}, 190, false), "");
  EXPECT_EQ(refusal({0.0, 0.04}, 1, true),
            "the layer from 0 to 0.04 lies nearer to a wall than its particles are thick, 1 to a "
            "side");
  EXPECT_EQ(refusal({0.0, 0.04}, 1, false), "");
  EXPECT_EQ(refusal({0.0, 0.06}, 1, true), "");
}

}  // namespace
