// SPDX-License-Identifier: GPL-3.0-or-later
//
// Motion in lanes against the scheme in long double, particle by particle.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <tangency/dem/lanes/particle_lanes.hpp>
#include <tangency/dem/motion/fire.hpp>
#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/parallel.hpp>

#include "golden_states.hpp"

namespace tangency::testing {
namespace {

using namespace tangency::dem;

using Long = long double;
using LongVec3 = Eigen::Matrix<Long, 3, 1>;
using LongMat3 = Eigen::Matrix<Long, 3, 3>;
using LongQuaternion = Eigen::Quaternion<Long>;

constexpr std::uint64_t kSeed = 20261130;

/// Particles of every kind with what acts on them.
struct Crowd {
  Particles particles;
  Cell cell = Cell::box(Vec3::Constant(10.0));
  Resultants resultants;

  Crowd(int count, double spin, int dimensions = 3) {
    std::mt19937_64 random(kSeed);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    particles.dimensions = dimensions;
    cell.dimensions = dimensions;
    cell.rate << -0.1, 0.02, 0.0, 0.03, 0.2, 0.01, 0.0, -0.04, 0.05;
    if (dimensions == 2) cell.rate.row(2).setZero();
    for (int i = 0; i < count; ++i) {
      const Eigen::Quaterniond axes =
          dimensions == 2
              ? Eigen::Quaterniond(normal(random), 0, 0, 1)
              : Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random));
      constexpr std::array<std::array<double, 3>, 4> kShapes{
          {{1.5, 1.0, 0.7}, {1.2, 1.2, 1.2}, {1.4, 1.0, 1.0}, {3.0, 3.0, 0.5}}};
      const auto& shape = kShapes[static_cast<std::size_t>(i) % 4];
      particles.add(5.0 * vector(), axes.normalized(), {shape[0], shape[1], shape[2]}, 2.0, 0);
      particles.velocity.back() = vector();
      particles.angular_velocity.back() = spin * vector();
      resultants.force.push_back(30.0 * vector());
      resultants.moment.push_back(30.0 * vector());
      if (dimensions == 3) continue;
      particles.position.back()[2] = particles.velocity.back()[2] = 0.0;
      particles.angular_velocity.back().head(2).setZero();
      resultants.force.back()[2] = 0.0;
      resultants.moment.back().head(2).setZero();
    }
  }
};

/// One particle by the scheme of dem/motion/motion.hpp.
struct LongParticle {
  LongVec3 position, velocity, spin, axes;
  LongQuaternion orientation;
  Long mass;

  LongParticle(const Particles& p, std::size_t i)
      : position(p.position[i].cast<Long>()),
        velocity(p.velocity[i].cast<Long>()),
        spin(p.angular_velocity[i].cast<Long>()),
        axes(p.semi_axes[i].cast<Long>()),
        orientation(p.orientation[i].cast<Long>()),
        mass(p.mass[i]) {}

  LongVec3 inertia(int dimensions) const {
    const LongVec3 s = axes.cwiseAbs2();
    if (dimensions == 2) return mass / 4 * LongVec3(s[1], s[0], s[0] + s[1]);
    return mass / 5 * LongVec3(s[1] + s[2], s[2] + s[0], s[0] + s[1]);
  }
  static LongQuaternion turn(const LongVec3& v) {
    return LongQuaternion(Eigen::AngleAxis<Long>(v.norm(), v.stableNormalized()));
  }
  /// Returns what damping took and gravity gave.
  std::array<Long, 2> move(const Crowd& crowd, std::size_t i, const Motion& motion, Long dt) {
    const Long half = Long(motion.damping) * dt / 2, keep = (1 - half) / (1 + half);
    const Long push = dt / (1 + half);
    const int dimensions = crowd.particles.dimensions;
    const LongVec3 gravity = motion.gravity.cast<Long>(), before = velocity;
    velocity = keep * before + push * (crowd.resultants.force[i].cast<Long>() / mass + gravity);
    position += dt * (velocity + crowd.cell.rate.cast<Long>() * position);
    std::array<Long, 2> work{
        dt * Long(motion.damping) * mass * ((before + velocity) / 2).squaredNorm(),
        dt * mass * gravity.dot(velocity)};
    if (motion.rotation == Rotation::none) return work;
    const LongMat3 axes_in_space = orientation.toRotationMatrix();
    const LongMat3 tensor =
        axes_in_space * inertia(dimensions).asDiagonal() * axes_in_space.transpose();
    const LongVec3 spin_before = spin, moment = crowd.resultants.moment[i].cast<Long>();
    const Long rate = motion.rotational_damping.value_or(motion.damping), slowed = rate * dt / 2;
    spin = ((1 - slowed) * spin + dt * tensor.inverse() * moment) / (1 + slowed);
    const LongVec3 mean = (spin_before + spin) / 2;
    work[0] += dt * rate * mean.dot(tensor * mean);
    if (motion.rotation == Rotation::simplified || dimensions == 2 ||
        (axes[0] == axes[1] && axes[1] == axes[2])) {
      orientation = turn(dt * spin) * orientation;
      return work;
    }
    const LongVec3 momentum = tensor * spin;  // stays where it is in space
    for (const int axis : {0, 1, 2, 1, 0}) {
      const LongVec3 in_body = orientation.conjugate() * momentum;
      const Long angle = (axis == 2 ? dt : dt / 2) * in_body[axis] / inertia(dimensions)[axis];
      orientation = orientation * turn(angle * LongVec3::Unit(axis));
    }
    const LongVec3 in_body = orientation.conjugate() * momentum;
    spin = orientation * in_body.cwiseQuotient(inertia(dimensions));
    return work;
  }
};

/// The largest error of one step, over the sizes of what it computes, in unit roundoffs.
double error_of_a_step(const Crowd& before, const Motion& motion, double dt) {
  Crowd after = before;
  const MotionWork work = move(after.particles, after.cell, after.resultants, motion, dt);
  Long largest = 0, damping = 0, gravity = 0, given = 0;
  const auto compare = [&](Long error, Long size) { largest = std::max(largest, error / size); };
  for (std::size_t i = 0; i < before.particles.size(); ++i) {
    LongParticle truth(before.particles, i);
    const LongVec3 spin_before = truth.spin;
    const auto [lost, fallen] = truth.move(before, i, motion, dt);
    damping += lost;
    gravity += fallen;
    given += std::abs(fallen);
    const LongParticle is(after.particles, i);
    compare((is.position - truth.position).norm(), truth.position.norm() + 1);
    compare((is.velocity - truth.velocity).norm(), truth.velocity.norm() + 1);
    compare((is.spin - truth.spin).norm(), truth.spin.norm() + spin_before.norm() + 1);
    compare((is.orientation.coeffs() - truth.orientation.coeffs()).norm(), 1);
  }
  compare(std::abs(Long(work.damping) - damping), damping + 1);
  compare(std::abs(Long(work.gravity) - gravity), given + 1);
  return static_cast<double>(largest / Long(kUnitRoundoff));
}

// Measured: 6 with small turns and 24 with turns of up to a radian, whose rounded angles are off by
// more.
TEST(MotionLanes, MoveAsTheSchemeInLongDouble) {
  const Vec3 gravity(0.1, -0.2, -9.81);
  for (const int count : {1, 7, 8, 131})
    for (const Rotation rotation : {Rotation::none, Rotation::simplified, Rotation::full})
      for (const auto& [damping, of_turns] : std::vector<std::pair<double, std::optional<double>>>{
               {0.0, {}}, {3.0, {}}, {0.0, 5.0}, {3.0, 0.0}, {3.0, 5.0}}) {
        const Motion motion{rotation, gravity, damping, of_turns};
        EXPECT_LT(error_of_a_step(Crowd(count, 1.0), motion, 1e-3), 12.0) << count;
        EXPECT_LT(error_of_a_step(Crowd(count, 1000.0), motion, 1e-3), 40.0) << count;
        EXPECT_LT(error_of_a_step(Crowd(count, 1.0, 2),
                                  {rotation, {0.1, -9.0, 0.0}, damping, of_turns}, 1e-3),
                  12.0)
            << count;
      }
}

TEST(MotionLanes, CosineAndSineAreWithinTheirBoundOfTheTruth) {
  std::mt19937_64 random(kSeed);
  double largest = 0.0, largest_small = 0.0;
  for (int k = 0; k < 1500; ++k) {
    std::array<double, kChunk> angle, cosine, sine;
    // 1e-12 to 6e5 and, every fourth time, next to whole quarters.
    for (double& one : angle) {
      one = std::pow(10.0, std::uniform_real_distribution<double>(-12.0, 5.8)(random));
      if (k % 4 == 0) one = std::round(one) * 0x1.921fb54442d18p+0 * (1.0 + 1e-9 * (k % 7));
      if (k % 2 == 0) one = -one;
    }
    detail::cosine_sine_lanes(angle.data(), cosine.data(), sine.data(), kChunk);
    for (std::size_t j = 0; j < kChunk; ++j) {
      const auto ulps = [](double is, Long truth) {
        const auto size = static_cast<double>(std::abs(truth));
        const double ulp = size - std::nextafter(size, 0.0);
        return static_cast<double>(std::abs(Long(is) - truth)) /
               std::max(ulp, std::numeric_limits<double>::denorm_min());
      };
      const double error = std::max(ulps(cosine[j], std::cos(Long(angle[j]))),
                                    ulps(sine[j], std::sin(Long(angle[j]))));
      double& worst = std::abs(angle[j]) <= 0.1 ? largest_small : largest;
      worst = std::max(worst, error);
      ASSERT_LE(error, detail::kSineError) << angle[j];
    }
  }
  std::printf("errors up to %.3f ulp, %.3f of small angles\n", largest, largest_small);
  EXPECT_LE(largest_small, 0.55);
  EXPECT_GT(largest, 0.5) << "the truth is not the same arithmetic";
}

/// Does a step of a body that lies along the axes and turns about one of them blow up?
bool blows_up(Rotation rotation, int axis, double turn) {
  Crowd crowd(5, 0.0);
  constexpr double dt = 0x1p-10;
  crowd.particles.orientation[0] = Eigen::Quaterniond::Identity();
  crowd.particles.angular_velocity[0] = turn / dt * Vec3::Unit(axis);
  for (Vec3& moment : crowd.resultants.moment) moment.setZero();
  try {
    move(crowd.particles, crowd.cell, crowd.resultants, {rotation, Vec3::Zero(), 0.0}, dt);
  } catch (const Diverged&) {
    return true;
  }
  EXPECT_NEAR(crowd.particles.orientation[0].norm(), 1.0, 4e-16);
  return false;
}

// dem/motion/motion.hpp: Euler's equations turn about x and y twice in a step, about z once.
TEST(MotionLanes, ATurnOfMoreThanTwoMillionIsReported) {
  constexpr double below = 1.0 - 1e-12, above = 1.0 + 1e-12;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_FALSE(blows_up(Rotation::simplified, axis, 0x1p21 * below)) << axis;
    EXPECT_TRUE(blows_up(Rotation::simplified, axis, 0x1p21 * above)) << axis;
  }
  EXPECT_FALSE(blows_up(Rotation::full, 2, 0x1p21 * below));
  EXPECT_TRUE(blows_up(Rotation::full, 2, 0x1p21 * above));
  EXPECT_FALSE(blows_up(Rotation::full, 0, 0x1p22 * below));
  EXPECT_TRUE(blows_up(Rotation::full, 0, 0x1p22 * above));

  const std::array<double, 2> angle{0x1p20, 0x1p20 * above};
  std::array<double, 2> cosine, sine;
  detail::cosine_sine_lanes(angle.data(), cosine.data(), sine.data(), 2);
  EXPECT_TRUE(std::isfinite(cosine[0]) && std::isfinite(sine[0]));
  EXPECT_TRUE(std::isnan(cosine[1]) && std::isnan(sine[1]));
}

// In any component, body and lane, full ones and padded ones.
TEST(MotionLanes, ANumberThatIsNoneIsReported) {
  using Columns = std::vector<Vec3>* (*)(Crowd&);
  struct Case {
    const char* name;
    Columns column;
    Rotation rotation;
  };
  const Columns force = [](Crowd& c) { return &c.resultants.force; };
  const Columns velocity = [](Crowd& c) { return &c.particles.velocity; };
  const Columns position = [](Crowd& c) { return &c.particles.position; };
  const Columns moment = [](Crowd& c) { return &c.resultants.moment; };
  const Columns spin = [](Crowd& c) { return &c.particles.angular_velocity; };
  at_every_level([&](std::int64_t level) {
    for (const Case& one : {Case{"force", force, Rotation::none},
                            {"velocity", velocity, Rotation::none},
                            {"position", position, Rotation::none},
                            {"moment", moment, Rotation::simplified},
                            {"moment", moment, Rotation::full},
                            {"spin", spin, Rotation::simplified},
                            {"spin", spin, Rotation::full}})
      for (std::size_t i = 0; i < 13; ++i)
        for (int k = 0; k < 3; ++k)
          for (const double none : {std::numeric_limits<double>::quiet_NaN(),
                                    std::numeric_limits<double>::infinity()}) {
            Crowd crowd(13, 1.0);
            (*one.column(crowd))[i][k] = none;
            EXPECT_THROW(move(crowd.particles, crowd.cell, crowd.resultants,
                              {one.rotation, Vec3::Zero(), 0.0}, 1e-3),
                         Diverged)
                << hwy::TargetName(level) << ", " << one.name << " " << k << " of " << i;
          }
  });
}

/// All that a few steps and their energies are made of.
std::vector<double> numbers_after_steps(Crowd crowd, int dimensions) {
  const Motion motion{Rotation::full, {0.1, -9.0, dimensions == 2 ? 0.0 : 1.0}, 3.0, 1.5};
  std::vector<double> all;
  Fire fire;
  for (int k = 0; k < 5; ++k) {
    all.push_back(fire.steer(crowd.particles, crowd.resultants, motion, 0.02));
    const MotionWork work = move(crowd.particles, crowd.cell, crowd.resultants, motion, 0.02);
    all.insert(all.end(), {work.damping, work.gravity});
    all.push_back(kinetic_energy(crowd.particles));
    all.push_back(kinetic_energy_at(crowd.particles, crowd.resultants, motion, 0.02));
  }
  for (std::size_t i = 0; i < crowd.particles.size(); ++i) {
    for (const auto* column :
         {&crowd.particles.position, &crowd.particles.velocity, &crowd.particles.angular_velocity})
      all.insert(all.end(), (*column)[i].begin(), (*column)[i].end());
    const auto& q = crowd.particles.orientation[i].coeffs();
    all.insert(all.end(), q.begin(), q.end());
  }
  return all;
}

// dem/motion/motion.hpp (4)
// dem/lanes/particle_lanes.hpp (1)
TEST(MotionLanes, HaveTheSameBitsAtEveryInstructionSetAndThreadCount) {
  for (const int dimensions : {2, 3}) {
    const Crowd crowd(1003, 8.0, dimensions);
    const std::vector<double> once = numbers_after_steps(crowd, dimensions);
    at_every_level([&](std::int64_t level) {
      EXPECT_EQ(numbers_after_steps(crowd, dimensions), once) << hwy::TargetName(level);
    });
    for (const int threads : {2, 4}) {
      dem::set_threads(threads);
      EXPECT_EQ(numbers_after_steps(crowd, dimensions), once) << threads << " threads";
    }
    dem::set_threads(0);
  }
}

// Of a shape alone, beside others, and in lanes that are padded.
// dem/lanes/particle_lanes.hpp (2)
TEST(MotionLanes, WhatHappensToAParticleDoesNotDependOnThoseBesideIt) {
  const Motion motion{Rotation::full, {0.0, 0.0, -9.81}, 3.0};
  const Crowd crowd(803, 300.0);  // half angles on both sides of where the long series begins
  Crowd together = crowd;
  move(together.particles, together.cell, together.resultants, motion, 1e-3);
  for (std::size_t i = 0; i < crowd.particles.size(); ++i) {
    Crowd alone(1, 0.0);
    Particles& one = alone.particles;
    const Particles& all = crowd.particles;
    one.position[0] = all.position[i];
    one.velocity[0] = all.velocity[i];
    one.angular_velocity[0] = all.angular_velocity[i];
    one.orientation[0] = all.orientation[i];
    one.semi_axes[0] = all.semi_axes[i];
    one.mass[0] = all.mass[i];
    alone.resultants = {{crowd.resultants.force[i]}, {crowd.resultants.moment[i]}};
    move(one, alone.cell, alone.resultants, motion, 1e-3);
    EXPECT_EQ(one.position[0], together.particles.position[i]) << i;
    EXPECT_EQ(one.velocity[0], together.particles.velocity[i]) << i;
    EXPECT_EQ(one.angular_velocity[0], together.particles.angular_velocity[i]) << i;
    EXPECT_EQ(one.orientation[0].coeffs(), together.particles.orientation[i].coeffs()) << i;
  }
}

}  // namespace
}  // namespace tangency::testing
