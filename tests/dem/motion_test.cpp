// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/samples/sample.hpp>

namespace {

using namespace tangency::dem;
using tangency::Vec3;

struct One {
  Particles particles;
  Cell cell = Cell::box(Vec3::Constant(10.0));
  Resultants resultants{{Vec3::Zero()}, {Vec3::Zero()}};

  One() {
    particles.add({1.0, 2.0, 3.0}, Eigen::Quaterniond(0.5, 0.1, -0.7, 0.2), {1.5, 1.0, 0.7}, 2.0,
                  0);
  }
  void move(double damping, double dt) {
    tangency::dem::move(particles, cell, resultants, {Rotation::simplified, Vec3::Zero(), damping},
                        dt);
  }
  /// A spring to the place where it started; returns where it is after a time of 1.
  double oscillate(int steps) {
    const Vec3 rest = particles.position[0];
    const double stiffness = particles.mass[0] * 4.0, dt = 1.0 / steps;
    particles.position[0] += Vec3(1.0, 0.0, 0.0);
    // Half a kick backwards: velocities belong to half steps.
    particles.velocity[0][0] = 0.5 * dt * 4.0;
    for (int k = 0; k < steps; ++k) {
      resultants.force[0] = stiffness * (rest - particles.position[0]);
      move(0.0, dt);
    }
    return (particles.position[0] - rest)[0];
  }
};

// dem/motion/motion.hpp (1)
TEST(Motion, WithoutForceIsUniform) {
  One one;
  one.particles.velocity[0] = {0.1, -0.2, 0.3};
  one.particles.angular_velocity[0] = {0.0, 0.0, std::numbers::pi / 2.0};
  const Eigen::Quaterniond start = one.particles.orientation[0];
  for (int k = 0; k < 100; ++k) one.move(0.0, 0.01);
  EXPECT_LT((one.particles.position[0] - Vec3(1.1, 1.8, 3.3)).norm(), 1e-13);
  const Eigen::Quaterniond quarter(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
  EXPECT_LT(one.particles.orientation[0].angularDistance(quarter * start), 1e-7);
  EXPECT_NEAR(one.particles.orientation[0].norm(), 1.0, 4e-16);
}

// dem/motion/motion.hpp (2)
TEST(Motion, HasAnErrorOfSecondOrderInTheStep) {
  const double exact = std::cos(2.0);
  const double coarse = std::abs(One().oscillate(50) - exact);
  const double fine = std::abs(One().oscillate(100) - exact);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05);
}

// dem/motion/motion.hpp (2)
TEST(Motion, WithoutDampingIsReversible) {
  One one;
  const Vec3 start = one.particles.position[0];
  const auto push = [&] { one.resultants.force[0] = -3.0 * one.particles.position[0]; };
  one.particles.velocity[0] = {0.3, 0.1, -0.2};
  for (int k = 0; k < 200; ++k) {
    push();
    one.move(0.0, 0.02);
  }
  // Turned round, the velocity of the half step just passed is that of the one ahead: the first
  // step back has no kick.
  one.particles.velocity[0] *= -1.0;
  one.resultants.force[0].setZero();
  one.move(0.0, 0.02);
  for (int k = 1; k < 200; ++k) {
    push();
    one.move(0.0, 0.02);
  }
  EXPECT_LT((one.particles.position[0] - start).norm(), 1e-11);
}

TEST(Motion, DampingSlowsAFreeParticleExponentially) {
  One one;
  one.particles.velocity[0] = {1.0, 0.0, 0.0};
  one.particles.angular_velocity[0] = {0.0, 2.0, 0.0};
  for (int k = 0; k < 1000; ++k) one.move(3.0, 0.001);
  EXPECT_NEAR(one.particles.velocity[0][0], std::exp(-3.0), 1e-6);
  EXPECT_NEAR(one.particles.angular_velocity[0][1], 2.0 * std::exp(-3.0), 1e-6);
}

TEST(Motion, AFreeSpinDecaysAtItsOwnRateWhereItHasOne) {
  for (const Rotation rotation : {Rotation::simplified, Rotation::full})
    for (const auto& [shift, turn] :
         {std::pair(3.0, 1.0), std::pair(0.5, 4.0), std::pair(0.0, 2.0), std::pair(2.0, 0.0)}) {
      One one;
      one.particles.velocity[0] = {1.0, 0.0, 0.0};
      // About a body axis, which stays where it is.
      const Vec3 axis = one.particles.orientation[0] * Vec3::UnitZ();
      one.particles.angular_velocity[0] = 2.0 * axis;
      const double before = kinetic_energy(one.particles);
      double lost = 0.0;
      for (int k = 0; k < 1000; ++k)
        lost += tangency::dem::move(one.particles, one.cell, one.resultants,
                                    {rotation, Vec3::Zero(), shift, turn}, 0.001)
                    .damping;
      EXPECT_NEAR(one.particles.velocity[0][0], std::exp(-shift), 1e-5);
      EXPECT_LT((one.particles.angular_velocity[0] - 2.0 * std::exp(-turn) * axis).norm(), 1e-5);
      EXPECT_NEAR(lost, before - kinetic_energy(one.particles), 1e-12 * before);
    }
}

TEST(Motion, DampingLeavesTheAffineMotionAlone) {
  One one;
  one.cell.rate = Vec3(-0.1, 0.2, 0.05).asDiagonal();
  const Vec3 reduced = one.cell.reduced(one.particles.position[0]);
  for (int k = 0; k < 1000; ++k) one.move(5.0, 0.01);
  EXPECT_LT((one.cell.reduced(one.particles.position[0]) - reduced).norm(), 1e-13);
  EXPECT_LT((one.cell.logarithmic_strain().diagonal() - Vec3(-1.0, 2.0, 0.5)).norm(), 0.03);
}

TEST(Motion, AMomentAboutABodyAxisTurnsAboutItByItsMomentOfInertia) {
  One one;
  const Vec3 axis = one.particles.orientation[0] * Vec3::UnitZ();
  one.resultants.moment[0] = 2.0 * axis;
  one.move(0.0, 0.1);
  const double mass = one.particles.mass[0];
  const double inertia = mass / 5.0 * (1.5 * 1.5 + 1.0);
  EXPECT_LT((one.particles.angular_velocity[0] - 0.2 / inertia * axis).norm(), 1e-15);
  EXPECT_NEAR(kinetic_energy(one.particles), 0.5 * inertia * std::pow(0.2 / inertia, 2), 1e-15);
}

// dem/motion/motion.hpp (3)
TEST(Motion, OrientationsStayUnitAndExactForWholeTurns) {
  One one;
  const tangency::Quaternion start = one.particles.orientation[0];
  one.particles.angular_velocity[0] = 2.0 * std::numbers::pi * Vec3(1.0, -2.0, 2.0) / 3.0;
  for (int k = 0; k < 10000; ++k) {
    one.move(0.0, 1e-4);
    ASSERT_NEAR(one.particles.orientation[0].norm(), 1.0, 4e-16);
  }
  EXPECT_LT((one.particles.orientation[0].coeffs() + start.coeffs()).norm(), 1e-11);
}

TEST(Motion, ThatBlowsUpIsReported) {
  One one;
  one.resultants.force[0][1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(one.move(0.0, 0.1), Diverged);
}

// Users write Eigen's own quaternions; geometry/vectors.hpp says why these are not.
TEST(Orientations, AreTakenFromAndGivenToEigensOwnType) {
  const Eigen::Quaterniond turn(0.3, -0.5, 0.1, 0.8);
  Particles particles;
  particles.add(Vec3::Zero(), turn, Vec3::Ones(), 1.0, 0);
  particles.add(Vec3::Ones(), Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vec3::UnitY())),
                Vec3::Ones(), 1.0, 0);
  particles.orientation[1] = particles.orientation[0] * Eigen::Quaterniond(0, 1, 0, 0);
  particles.orientation.push_back(turn);
  particles.orientation.resize(4, Eigen::Quaterniond::Identity());
  for (auto& q : particles.orientation) q.normalize();
  for (const Eigen::Quaterniond q : particles.orientation) EXPECT_NEAR(q.norm(), 1.0, 1e-15);
  const Eigen::Quaterniond turned =
      particles.orientation[0] * Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Vec3::UnitZ()));
  EXPECT_NEAR(turned.angularDistance(particles.orientation[0]), 1.0, 1e-14);
  const Body body{0, Vec3::Zero(), turn};
  EXPECT_EQ(body.orientation.coeffs(), turn.coeffs());
}

}  // namespace
