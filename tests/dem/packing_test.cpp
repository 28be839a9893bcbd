// SPDX-License-Identifier: GPL-3.0-or-later
/// A state as plain arrays by ids.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <tangency/dem/tool/packing.hpp>
#include <tangency/geometry/gap.hpp>

#include "assembly.hpp"
#include "assembly_state.hpp"

namespace tangency::testing {
namespace {

constexpr dem::ContactLaw kRough{100.0, 80.0, 0.2, 0.0};

/// Of particles that have moved for a time: some of the contacts slide, others stick.
dem::State state_of(dem::Particles particles, const dem::Cell& cell, double dt) {
  return testing::state_of(std::move(particles), cell, kRough, dt);
}

/// The same with the particles in another order in memory.
dem::State shuffled(const dem::State& state, double dt) {
  std::vector<std::uint32_t> order(state.particles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(5));
  dem::Particles particles = state.particles;
  particles.permute(order);
  return state_of(std::move(particles), state.cell, dt);
}

dem::Cell cube() { return dem::Cell::box(Vec3::Constant(4.0)); }

TEST(Packing, HasEveryTouchingPairOfIdsOnceInAscendingOrder) {
  const dem::State state = shuffled(state_of(crowd(40, cube(), 3), cube(), 0.05), 0.05);
  const dem::Packing packing = dem::packing_of(state);
  std::vector<std::tuple<std::int64_t, std::int64_t, dem::Image>> found;
  for (std::size_t c = 0; c < packing.contacts.size(); ++c) {
    const auto [a, b] = packing.contacts.bodies[c];
    EXPECT_LE(a, b);
    EXPECT_TRUE(a < b || packing.contacts.image[c] > (dem::Image{0, 0, 0}));
    found.emplace_back(a, b, packing.contacts.image[c]);
  }
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
  // By brute force over the particles in the order of ids.
  const dem::Particles by_id = crowd(40, cube(), 3);
  std::vector<std::tuple<std::int64_t, std::int64_t, dem::Image>> expected;
  for (const dem::Pair& pair : touching_pairs(by_id, cube()))
    expected.emplace_back(pair.a, pair.b, pair.image);
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 50u);
}

TEST(Packing, ColumnsFitTogether) {
  const dem::State state = shuffled(state_of(crowd(40, cube(), 3), cube(), 0.05), 0.05);
  const dem::Packing packing = dem::packing_of(state);
  const dem::PackingContacts& all = packing.contacts;
  std::size_t sliding = 0;
  std::vector<std::int32_t> count(packing.particles.size(), 0);
  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto a = static_cast<std::size_t>(all.bodies[c][0]);
    const auto b = static_cast<std::size_t>(all.bodies[c][1]);
    const Vec3 &of_a = packing.particles.position[a], &of_b = packing.particles.position[b];
    const Vec3 branch = of_b + state.cell.translation(all.image[c]) - of_a;
    EXPECT_LT((all.branch[c] - branch).norm(), 1e-13);
    EXPECT_LT((of_a + all.arm[c] - all.point[c]).norm(), 1e-13);
    EXPECT_NEAR(all.normal[c].norm(), 1.0, 1e-12);
    EXPECT_NEAR(all.force[c].dot(all.normal[c]), all.normal_force[c], 1e-10);
    EXPECT_GT(all.normal_force[c], 0.0);
    const auto body = [&](std::size_t i) {
      return Ellipsoid(Vec3::Zero(), packing.particles.semi_axes[i],
                       packing.particles.orientation[i]);
    };
    EXPECT_NEAR(all.gap[c], signed_gap(body(a), body(b), branch).gap, 1e-9);
    const Vec3 shear = all.force[c] - all.normal_force[c] * all.normal[c];
    const double of_limit = shear.norm() / (0.2 * all.normal_force[c]);
    EXPECT_LT(of_limit, 1.0 + 1e-12);
    EXPECT_EQ(all.sliding[c] == 1, of_limit > 1.0 - 1e-9) << of_limit;
    sliding += all.sliding[c];
    ++count[a];
    ++count[b];
  }
  EXPECT_GT(sliding, 5u);
  EXPECT_LT(sliding, all.size() - 5);
  EXPECT_EQ(packing.particles.contacts, count);
  const auto arrays = packing.arrays();
  EXPECT_NO_THROW(micromechanics::require_sound(arrays));
  EXPECT_EQ(arrays.volume, 64.0);
  EXPECT_LT(
      (micromechanics::stress_of(arrays) - state.contacts.sums().force_branch / state.cell.volume())
          .norm(),
      1e-12 * micromechanics::stress_of(arrays).norm());
}

TEST(Packing, DoesNotDependOnTheOrderInMemory) {
  const dem::State state = state_of(crowd(40, cube(), 7), cube(), 0.05);
  const dem::Packing one = dem::packing_of(state), other = dem::packing_of(shuffled(state, 0.05));
  ASSERT_EQ(one.contacts.bodies, other.contacts.bodies);
  EXPECT_EQ(one.contacts.image, other.contacts.image);
  EXPECT_EQ(one.contacts.sliding, other.contacts.sliding);
  EXPECT_EQ(one.particles.position, other.particles.position);
  EXPECT_EQ(one.particles.angular_velocity, other.particles.angular_velocity);
  EXPECT_EQ(one.particles.contacts, other.particles.contacts);
  // Ways out of deep overlaps may be several: compare where both found the same.
  std::size_t same = 0;
  for (std::size_t c = 0; c < one.contacts.size(); ++c) {
    if ((one.contacts.normal[c] - other.contacts.normal[c]).norm() > 1e-6) continue;
    EXPECT_LT((one.contacts.force[c] - other.contacts.force[c]).norm(), 1e-5);
    EXPECT_LT((one.contacts.arm[c] - other.contacts.arm[c]).norm(), 1e-6);
    ++same;
  }
  EXPECT_GT(10 * same, 9 * one.contacts.size());
}

TEST(Packing, CountsWallContactsAloneAndKeepsThemOut) {
  dem::Particles particles;
  for (const double x : {0.9, 2.5, 8.0})
    particles.add({x, 5.0, 5.0}, Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 0);
  const dem::Cell cell = dem::Cell::box(Vec3::Constant(10.0), 3, {true, false, false});
  const dem::Packing packing = dem::packing_of(state_of(particles, cell, 0.0));
  EXPECT_EQ(packing.contacts.size(), 1u);
  EXPECT_EQ(packing.wall_contacts, 1);
  EXPECT_EQ(packing.particles.contacts, (std::vector<std::int32_t>{2, 1, 0}));
}

}  // namespace
}  // namespace tangency::testing
