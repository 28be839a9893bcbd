// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using namespace tangency::testing;

constexpr ContactLaw kFrictionless{100.0, 0.0, 0.0, 0.0};
constexpr ContactLaw kFrictional{100.0, 80.0, 0.3, 0.0};

struct Assembly {
  Cell cell = Cell::box(Vec3::Constant(5.0));
  Particles particles = crowd(60, cell, 11);
  NeighbourList list;
  Contacts contacts;

  void update(const ContactLaw& law, double dt = 0.01) {
    if (!list.is_current(particles, cell)) {
      const std::vector<Pair> before = list.pairs();
      list.build(particles, cell, 0.3);
      contacts.carry_over(before, list.pairs());
    }
    contacts.update(particles, cell, list, laws(law), dt);
  }
  void move(double dt) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.position[i] += dt * particles.velocity[i];
      const Vec3 turn = 0.5 * dt * particles.angular_velocity[i];
      const Eigen::Quaterniond& q = particles.orientation[i];
      particles.orientation[i] =
          (Eigen::Quaterniond(1.0, turn[0], turn[1], turn[2]) * q).normalized();
    }
  }
};

TEST(Contacts, OfTwoSpheresPushAlongTheLineOfCentres) {
  Assembly two;
  two.particles = Particles();
  two.particles.add({0.5, 2.0, 2.0}, Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 0);
  two.particles.add({4.0, 2.0, 2.0}, Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 0);
  two.update(kFrictionless);  // they meet through the boundary at x = 0: 1.5 apart
  const auto& records = two.contacts.records();
  ASSERT_EQ(
      std::count_if(records.begin(), records.end(), [](const Contact& c) { return c.touches(); }),
      1);
  EXPECT_LT((two.contacts.resultants().force[0] - Vec3(50.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((two.contacts.resultants().force[1] + Vec3(50.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_LT(two.contacts.resultants().moment[0].norm(), 1e-12);
}

/// Two spheres at rest, radii 1 and 2, overlapping by 0.4 along a diagonal.
Assembly two_on_a_diagonal() {
  Assembly two;
  two.particles = Particles();
  const Vec3 direction = Vec3(1.0, 2.0, 2.0) / 3.0;
  two.particles.add(Vec3::Ones(), Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 0);
  two.particles.add(Vec3::Ones() + 2.6 * direction, Eigen::Quaterniond::Identity(),
                    Vec3::Constant(2.0), 1.0, 0);
  two.cell = Cell::box(Vec3::Constant(20.0));
  return two;
}

TEST(Contacts, AreAtTheMidpointOfTheTwoWitnessPoints) {
  Assembly two = two_on_a_diagonal();
  two.update(kFrictionless);
  ASSERT_EQ(two.contacts.records().size(), 1u);
  EXPECT_LT((two.contacts.records()[0].arm - 0.8 * Vec3(1.0, 2.0, 2.0) / 3.0).norm(), 1e-14);
}

TEST(Contacts, ShearByTheStrainOfTheCellAndByRotation) {
  Assembly two = two_on_a_diagonal();
  const Vec3 n = Vec3(1.0, 2.0, 2.0) / 3.0;
  two.cell.rate = Vec3(-0.01, 0.02, 0.005).asDiagonal();
  two.particles.angular_velocity[1] = {0.001, 0.002, -0.003};
  two.update(kFrictional, 0.1);
  const Vec3 velocity =
      two.cell.rate * (2.6 * n) + two.particles.angular_velocity[1].cross(-1.8 * n);
  const Vec3 expected = -80.0 * 0.1 * (velocity - n * n.dot(velocity));
  EXPECT_LT((two.contacts.records()[0].shear.force - expected).norm(), 1e-14);
}

// Pairs that are followed by their stored normal, skipped by it, or new: none may be missed.
TEST(Contacts, OfAMovingCrowdAreThosePairsWithANegativeGap) {
  Assembly crowd_of;
  std::size_t seen = 0;
  for (int step = 0; step < 40; ++step) {
    crowd_of.move(0.02);
    crowd_of.update(kFrictionless);
    const auto& pairs = crowd_of.list.pairs();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto a = static_cast<std::size_t>(pairs[k].a), b = static_cast<std::size_t>(pairs[k].b);
      const Vec3 d = branch_vector(pairs[k], crowd_of.particles, crowd_of.cell);
      const double gap =
          tangency::signed_gap(body(crowd_of.particles, a), body(crowd_of.particles, b), d).gap;
      const Contact& contact = crowd_of.contacts.records()[k];
      ASSERT_EQ(contact.touches(), gap < 0.0) << "gap " << gap;
      if (!contact.touches()) continue;
      ++seen;
      // Deep pairs may stay on a local answer, which is never shallower than the global one.
      ASSERT_GE(contact.overlap, -gap - 1e-13);
      if (gap > -0.05) {
        ASSERT_NEAR(contact.overlap, -gap, 1e-13);
      }
    }
  }
  EXPECT_GT(seen, 1000u);
}

TEST(Contacts, ForcesAddUpToNothing) {
  Assembly crowd_of;
  for (int step = 0; step < 5; ++step) {
    crowd_of.move(0.01);
    crowd_of.update(kFrictional);
  }
  Vec3 sum = Vec3::Zero();
  double largest = 0.0;
  for (const Vec3& force : crowd_of.contacts.resultants().force) {
    sum += force;
    largest = std::max(largest, force.norm());
  }
  ASSERT_GT(largest, 1.0);
  EXPECT_LT(sum.norm(), 1e-13 * largest * static_cast<double>(crowd_of.particles.size()));
}

TEST(Contacts, MomentsAreThoseOfTheForcesAtTheContactPoints) {
  Assembly crowd_of;
  crowd_of.update(kFrictional);
  std::vector<Vec3> moment(crowd_of.particles.size(), Vec3::Zero());
  for (std::size_t k = 0; k < crowd_of.list.pairs().size(); ++k) {
    const Pair& pair = crowd_of.list.pairs()[k];
    const Contact& contact = crowd_of.contacts.records()[k];
    if (!contact.touches()) continue;
    const Vec3& centre_a = crowd_of.particles.position[static_cast<std::size_t>(pair.a)];
    const Vec3 centre_b = centre_a + contact.branch, point = centre_a + contact.arm;
    moment[static_cast<std::size_t>(pair.a)] += (point - centre_a).cross(-contact.force);
    moment[static_cast<std::size_t>(pair.b)] += (point - centre_b).cross(contact.force);
  }
  for (std::size_t i = 0; i < moment.size(); ++i)
    EXPECT_LT((crowd_of.contacts.resultants().moment[i] - moment[i]).norm(), 1e-9);
}

TEST(Contacts, AreTheSameAmongParticlesInAnotherOrder) {
  Assembly crowd_of;
  for (int step = 0; step < 5; ++step) crowd_of.update(kFrictional);
  Assembly mixed = crowd_of;
  const std::size_t count = mixed.particles.size();
  std::vector<std::uint32_t> order(count), place(count);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  for (std::uint32_t k = 0; k < count; ++k) place[order[k]] = k;
  mixed.particles.permute(order);
  const std::vector<Pair> pairs = mixed.contacts.renumber(crowd_of.list.pairs(), place);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  mixed.list.build(mixed.particles, mixed.cell, 0.3);
  mixed.contacts.carry_over(pairs, mixed.list.pairs());
  mixed.contacts.restore(mixed.contacts.columns(), mixed.particles, mixed.list);
  for (int step = 0; step < 2; ++step) {
    double largest = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const Resultants &here = mixed.contacts.resultants(), &there = crowd_of.contacts.resultants();
      EXPECT_LT((here.force[k] - there.force[order[k]]).norm(), 1e-11);
      EXPECT_LT((here.moment[k] - there.moment[order[k]]).norm(), 1e-11);
      EXPECT_EQ(here.contacts[k], there.contacts[order[k]]);
      largest = std::max(largest, there.force[order[k]].norm());
    }
    EXPECT_GT(largest, 1.0);
    // And they go on alike, springs and all.
    crowd_of.update(kFrictional);
    mixed.update(kFrictional);
  }
}

TEST(Contacts, ShearForcesSurviveARenewedList) {
  Assembly crowd_of;
  for (int step = 0; step < 5; ++step) crowd_of.update(kFrictional);
  const std::vector<Pair> before = crowd_of.list.pairs();
  const ContactRecords then = crowd_of.contacts.records();
  const std::vector<Contact> kept(then.begin(), then.end());
  crowd_of.list.build(crowd_of.particles, crowd_of.cell, 0.6);
  crowd_of.contacts.carry_over(before, crowd_of.list.pairs());
  ASSERT_GT(crowd_of.list.pairs().size(), before.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const auto now =
        std::lower_bound(crowd_of.list.pairs().begin(), crowd_of.list.pairs().end(), before[k]) -
        crowd_of.list.pairs().begin();
    EXPECT_EQ(crowd_of.contacts.records()[static_cast<std::size_t>(now)].shear.force,
              kept[k].shear.force);
    largest = std::max(largest, kept[k].shear.force.norm());
  }
  EXPECT_GT(largest, 0.1);
}

TEST(Contacts, WithoutFrictionCarryNoShear) {
  Assembly crowd_of;
  crowd_of.update(kFrictional);
  crowd_of.update(kFrictionless);
  for (const Contact& contact : crowd_of.contacts.records())
    EXPECT_EQ(contact.shear.force, Vec3::Zero());
}

TEST(Contacts, TakeTheLawOfTheTwoTypes) {
  Assembly two;
  two.particles = Particles();
  two.particles.add({1.0, 2.0, 2.0}, Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 0);
  two.particles.add({2.5, 2.0, 2.0}, Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 1);
  const ContactLaws of_types{
      2, {{1.0, 0.0, 0.0, 0.0}, {7.0, 0.0, 0.0, 0.0}, {7.0, 0.0, 0.0, 0.0}, {3.0, 0.0, 0.0, 0.0}}};
  two.list.build(two.particles, two.cell, 0.3);
  two.contacts.carry_over({}, two.list.pairs());
  two.contacts.update(two.particles, two.cell, two.list, of_types, 0.0);
  EXPECT_NEAR(two.contacts.resultants().force[1].norm(), 3.5, 1e-12);
}

}  // namespace
