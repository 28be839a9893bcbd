// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <tangency/dem/spatial_order.hpp>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using namespace tangency::testing;

std::vector<std::uint32_t> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937_64 random(seed);
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random() % i)]);
  return order;
}

/// Mean distance in memory of two particles that touch.
double distance_in_memory(const Particles& particles, const Cell& cell) {
  NeighbourList list;
  list.build(particles, cell, 0.05);
  double sum = 0.0;
  for (const Pair& pair : list.pairs()) sum += pair.b - pair.a;
  return sum / static_cast<double>(list.pairs().size());
}

TEST(SpatialOrder, BringsNeighboursNearEachOtherInMemory) {
  const std::array cells{Cell::box({20.0, 20.0, 20.0}), Cell::box({80.0, 10.0, 10.0}),
                         Cell::box({20.0, 20.0, 20.0}, 3, {true, true, true})};
  for (const Cell& cell : cells) {
    Particles particles = crowd(2000, cell, 21);
    if (cell.has_walls())
      for (Vec3& x : particles.position) x = (x + cell.edges.diagonal()) / 3.0;
    const double random = distance_in_memory(particles, cell);
    EXPECT_GT(random, 600.0);  // a third of all
    particles.permute(spatial_order(particles, cell));
    EXPECT_LT(distance_in_memory(particles, cell), 0.4 * random);
  }
}

TEST(SpatialOrder, DoesNotDependOnTheOrderBefore) {
  const Cell cell = Cell::box({5.0, 8.0, 6.0});
  Particles particles = crowd(200, cell, 22);
  particles.position[7] = particles.position[3];  // two at one place
  Particles other = particles;
  other.permute(shuffled(200, 23));
  ASSERT_NE(other.id, particles.id);
  particles.permute(spatial_order(particles, cell));
  other.permute(spatial_order(other, cell));
  EXPECT_EQ(other.id, particles.id);
  EXPECT_EQ(other.position, particles.position);
}

TEST(SpatialOrder, OfAPlaneAssemblyLooksAtThePlaneAlone) {
  const Cell cell = Cell::box({10.0, 10.0, 1.0}, 2);
  Particles particles;
  particles.dimensions = 2;
  for (const auto& [x, y] : {std::pair{9.0, 9.0}, {1.0, 1.0}, {9.0, 1.0}, {1.0, 9.0}})
    particles.add({x, y, 0.0}, tangency::Quaternion::Identity(), Vec3::Ones(), 1.0, 0);
  EXPECT_EQ(spatial_order(particles, cell), (std::vector<std::uint32_t>{1, 2, 3, 0}));
}

TEST(Particles, MoveWithAllTheirNumbersWhenTheyArePermuted) {
  const Cell cell = Cell::box({5.0, 8.0, 6.0});
  const Particles before = crowd(50, cell, 24);
  Particles after = before;
  for (std::size_t i = 0; i < 50; ++i) after.type[i] = static_cast<std::int32_t>(i % 3);
  for (std::size_t i = 0; i < 50; ++i) after.mass[i] = static_cast<double>(i);
  after.permute(shuffled(50, 25));
  const std::vector<std::uint32_t> at = after.index_of_id();
  ASSERT_EQ(at.size(), 50u);
  for (std::size_t id = 0; id < 50; ++id) {
    const std::size_t i = at[id];
    EXPECT_EQ(after.id[i], static_cast<std::int32_t>(id));
    EXPECT_EQ(after.position[i], before.position[id]);
    EXPECT_EQ(after.velocity[i], before.velocity[id]);
    EXPECT_EQ(after.angular_velocity[i], before.angular_velocity[id]);
    EXPECT_EQ(after.orientation[i].coeffs(), before.orientation[id].coeffs());
    EXPECT_EQ(after.semi_axes[i], before.semi_axes[id]);
    EXPECT_EQ(after.mass[i], static_cast<double>(id));
    EXPECT_EQ(after.type[i], static_cast<std::int32_t>(id % 3));
  }
}

TEST(Particles, TakeNoOrderThatIsNoPermutation) {
  const Cell cell = Cell::box({5.0, 8.0, 6.0});
  Particles particles = crowd(3, cell, 26);
  EXPECT_THROW(particles.permute(std::vector<std::uint32_t>{0, 1}), std::invalid_argument);
  EXPECT_THROW(particles.permute(std::vector<std::uint32_t>{0, 1, 1}), std::invalid_argument);
  EXPECT_THROW(particles.permute(std::vector<std::uint32_t>{0, 1, 3}), std::invalid_argument);
}

}  // namespace
