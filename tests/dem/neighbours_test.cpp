// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using tangency::testing::crowd;
using tangency::testing::meeting_pairs;

Cell cell_of(const Vec3& edges) { return Cell::box(edges); }

bool lists_all(const NeighbourList& list, const std::vector<Pair>& pairs) {
  return std::includes(list.pairs().begin(), list.pairs().end(), pairs.begin(), pairs.end());
}

// dem/neighbours.hpp (1)
TEST(NeighbourList, HoldsEveryMeetingPairOfALargeCell) {
  const Cell cell = cell_of({9.0, 12.0, 10.0});
  const Particles particles = crowd(200, cell, 1);
  NeighbourList list;
  list.build(particles, cell, 0.2);
  const auto meeting = meeting_pairs(particles, cell, 4);
  ASSERT_GT(meeting.size(), 300u);
  EXPECT_TRUE(lists_all(list, meeting));
}

// dem/neighbours.hpp (3)
TEST(NeighbourList, HoldsEveryMeetingImageOfACellSmallerThanAParticle) {
  const Cell cell = cell_of({0.8, 1.1, 5.0});
  const Particles particles = crowd(6, cell, 2);
  NeighbourList list;
  list.build(particles, cell, 0.1);
  const auto meeting = meeting_pairs(particles, cell, 8);
  ASSERT_TRUE(std::any_of(meeting.begin(), meeting.end(),
                          [](const Pair& pair) { return pair.a == pair.b; }));
  EXPECT_TRUE(lists_all(list, meeting));
}

// dem/neighbours.hpp (2)
TEST(NeighbourList, ListsNoPairTwiceAndInAscendingOrder) {
  const Cell cell = cell_of({1.5, 3.0, 2.0});
  NeighbourList list;
  list.build(crowd(40, cell, 3), cell, 0.3);
  EXPECT_EQ(std::adjacent_find(list.pairs().begin(), list.pairs().end(), std::greater_equal<>()),
            list.pairs().end());
}

/// Moves a crowd and its cell until the list is out of date; asserts that it misses no meeting pair
/// until then. Returns the number of steps.
int steps_until_out_of_date(double speed, const Vec3& rate) {
  Cell cell = cell_of({8.0, 8.0, 8.0});
  Particles particles = crowd(100, cell, 4);
  NeighbourList list;
  list.build(particles, cell, 0.2);
  cell.rate = rate.asDiagonal();
  const double dt = 0.002;
  constexpr int most_steps = 1000;
  for (int steps = 0; steps < most_steps; ++steps) {
    for (std::size_t i = 0; i < particles.size(); ++i)
      particles.position[i] +=
          dt * (speed * particles.velocity[i] + cell.rate * particles.position[i]);
    cell.strain(dt);
    if (!list.is_current(particles, cell)) return steps;
    EXPECT_TRUE(lists_all(list, meeting_pairs(particles, cell, 4)));
  }
  ADD_FAILURE() << "the list never went out of date";
  return most_steps;
}

// A list that is renewed all the time would be no use: it must last a few steps too.

// dem/neighbours.hpp (1)
TEST(NeighbourList, MissesNoPairWhileCurrentAsParticlesMove) {
  EXPECT_GT(steps_until_out_of_date(1.0, Vec3(-0.5, 0.3, -0.2)), 10);
}

TEST(NeighbourList, IsOutOfDateBeforeTwoThatWereNotListedMeetHeadOn) {
  const Cell cell = cell_of({20.0, 20.0, 20.0});
  Particles particles;
  for (const double x : {8.0, 10.2 + 1e-9})
    particles.add({x, 5.0, 5.0}, Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 0);
  NeighbourList list;
  list.build(particles, cell, 0.2);
  ASSERT_TRUE(list.pairs().empty());
  const auto approach = [&](double by) {
    particles.position[0][0] += by;
    particles.position[1][0] -= by;
  };
  approach(0.099);
  EXPECT_TRUE(list.is_current(particles, cell));
  approach(0.002);
  EXPECT_FALSE(list.is_current(particles, cell));
}

// dem/neighbours.hpp (1)
TEST(NeighbourList, MissesNoPairWhileCurrentAsTheCellShrinks) {
  EXPECT_GT(steps_until_out_of_date(0.0, Vec3(-1.0, -1.0, -1.0)), 10);
}

TEST(NeighbourList, IsNotCurrentOnceParticlesHaveGrownIntoTheSkin) {
  const Cell cell = cell_of({8.0, 8.0, 8.0});
  Particles particles = crowd(30, cell, 5);
  NeighbourList list;
  list.build(particles, cell, 0.2);
  ASSERT_TRUE(list.is_current(particles, cell));
  for (Vec3& axes : particles.semi_axes) axes *= 1.2;
  EXPECT_FALSE(list.is_current(particles, cell));
}

TEST(NeighbourList, IncidencesAreThePairsOfEachParticle) {
  const Cell cell = cell_of({2.0, 2.0, 2.0});
  const Particles particles = crowd(12, cell, 6);
  NeighbourList list;
  list.build(particles, cell, 0.2);
  std::size_t found = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (const auto* at = list.begin_of(i); at != list.end_of(i); ++at, ++found) {
      const Pair& pair = list.pairs()[at->index];
      EXPECT_EQ(static_cast<std::size_t>(at->as_b ? pair.b : pair.a), i);
    }
  EXPECT_EQ(found, 2 * list.pairs().size());
}

}  // namespace
