// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact laws in lanes against the same equations written down for one contact, and what their
// header promises of blocks.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <tangency/dem/lanes/contact_lanes.hpp>
#include <tangency/geometry/floating_point.hpp>

#include "golden_states.hpp"
#include "one_contact.hpp"

namespace tangency::testing {
namespace {

constexpr std::size_t kPairs = ContactArrays::kPairs;
constexpr unsigned kSeed = 20261130;

struct Draw {
  std::mt19937 engine{kSeed};

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(engine) == 1; }
  Vec3 vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
  Vec3 direction() { return vector().normalized(); }
};

dem::ContactLaw draw_law(Draw& draw) {
  return {draw.uniform(50, 200), draw.one_in(5) ? 0.0 : draw.uniform(20, 100),
          draw.one_in(4) ? 0.0 : draw.uniform(0, 1), draw.one_in(2) ? 0.0 : draw.uniform(0, 2)};
}

/// Contacts before a step in any state, and after it: begun, ended, turned a little, a lot, round.
ContactArrays draw_contacts(Draw& draw) {
  ContactArrays block;
  block.dt = 0.02;
  for (int k = 0; k < 9; ++k) block.rate.data()[k] = draw.uniform(-0.1, 0.1);
  for (dem::MotionRow& row : block.motion)
    for (std::size_t k = 0; k < 3; ++k) {
      row.velocity[k] = draw.uniform(-1, 1);
      row.spin[k] = draw.uniform(-1, 1);
    }
  for (std::size_t k = 0; k < kPairs; ++k) {
    const auto a = static_cast<std::uint32_t>(draw.uniform(0, 8));
    block.pairs[k] = {a, a + 1 + static_cast<std::uint32_t>(draw.uniform(0, 7))};
    block.set_law(k, draw_law(draw));
    block.viscosity[k] = draw.one_in(4) ? 0.0 : draw.uniform(0, 2);
    block.inverse_mass[k] = draw.uniform(0.1, 10);
    block.set_hertz(k, {draw.uniform(1, 9),
                        draw.uniform(50, 200),
                        draw.uniform(0.1, 1),
                        {draw.uniform(20, 80), draw.uniform(20, 80), Vec3::Zero()}});
    const bool touched = !draw.one_in(4);
    block.gap[k] = draw.one_in(4) ? draw.uniform(0, 0.1) : -draw.uniform(0.001, 0.1);
    const Vec3 before = draw.direction();
    block.normal_before[k] = before;
    block.normal[k] = draw.one_in(10)  ? Vec3(-before)
                      : draw.one_in(5) ? draw.direction()
                                       : (before + 0.05 * draw.vector()).normalized();
    block.direction[k] = block.normal[k].cross(draw.direction()).normalized();
    block.branch_before[k] = 2.0 * before + 0.2 * draw.vector();
    block.branch[k] = block.branch_before[k] + 0.02 * draw.vector();
    block.arm_before[k] = before + 0.2 * draw.vector();
    block.arm[k] = block.arm_before[k] + 0.02 * draw.vector();
    if (!touched) continue;
    block.overlap[k] = draw.uniform(0.001, 0.1);
    block.normal_force[k] = draw.uniform(0.1, 20);
    block.normal_energy[k] = draw.uniform(0.01, 1);
    block.normal_stiffness_now[k] = draw.uniform(50, 200);
    block.shear_force[k] = draw.uniform(0, 5) * before.cross(draw.direction());
    block.state_stiffness[k] = draw.uniform(20, 100);
    block.shear_energy[k] = draw.uniform(0, 1);
  }
  return block;
}

Vec3 turned_with(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 axis = from.cross(to);
  const double cosine = from.dot(to);
  if (!(1.0 + cosine > 0.0)) return -v;
  return cosine * v + axis.cross(v) + axis * (axis.dot(v) / (1.0 + cosine));
}

/// What pair k of a block is after the step, and its part of the sums.
struct PlainContact {
  Vec3 arm, shear = Vec3::Zero(), force = Vec3::Zero(), moment_a, moment_b;
  double overlap = 0.0, normal_force = 0.0, stiffness = 0.0, energy = 0.0, shear_energy = 0.0;
  double sliding = 0.0, boundary = 0.0, branch_work = 0.0, viscous = 0.0;
  double size = 1.0;  ///< what roundings are measured by

  PlainContact(const ContactArrays& block, std::size_t k, bool hertz)
      : arm(block.arm_before[k]), moment_a(Vec3::Zero()), moment_b(Vec3::Zero()) {
    const bool touches = block.gap[k]<0.0, touched = block.overlap[k]> 0.0;
    if (!touches && !touched) return;
    if (touches) arm = block.arm[k];
    const Vec3 &normal = block.normal[k], &branch = block.branch[k];
    const Vec3 from_normal = touched ? block.normal_before[k] : normal;
    const Vec3 from_branch = touched ? block.branch_before[k] : branch;
    const Vec3 from_arm = touched ? block.arm_before[k] : arm;
    const Vec3 middle_arm = 0.5 * (from_arm + arm), middle = 0.5 * (from_branch + branch);
    const Vec3 strained = block.dt * (block.rate * from_branch);
    const dem::MotionRow &a = block.motion[block.pairs[k].a], &b = block.motion[block.pairs[k].b];
    const auto at = [](const double* v) { return Vec3(v[0], v[1], v[2]); };
    const Vec3 moved =
        strained + block.dt * (at(b.velocity) + at(b.spin).cross(Vec3(middle_arm - middle)) -
                               at(a.velocity) - at(a.spin).cross(middle_arm));
    const Vec3 force_before = block.normal_force[k] * block.normal_before[k] + block.shear_force[k];
    sliding = block.shear_energy[k];
    if (touches) {
      overlap = -block.gap[k];
      stiffness = hertz ? block.hertz_stiffness[k] : block.normal_stiffness[k];
      normal_force = hertz ? block.hertz_force[k] : stiffness * overlap;
      energy = hertz ? block.hertz_energy[k] : 0.5 * normal_force * overlap;
      if (block.damped)
        damp(block, k, hertz, -moved.dot(normal), moved.dot(block.normal_before[k]));
      const double cohesion = block.cohesion[k], friction = block.friction_coefficient[k];
      if (block.shear_stiffness[k] > 0.0 && (friction > 0.0 || cohesion > 0.0))
        slide(block, k, hertz, 0.5 * (moved + turned_with(moved, from_normal, normal)),
              turned_with(block.shear_force[k], from_normal, normal),
              cohesion + normal_force * friction);
      force = normal_force * normal + shear;
    }
    if (block.damped && !touches)
      viscous = -0.5 * push_of_damper(block, k, hertz) * moved.dot(block.normal_before[k]);
    const Vec3 mean_force = 0.5 * (force_before + force);
    boundary = -mean_force.dot(strained);
    moment_a = -arm.cross(force);
    moment_b = (arm - branch).cross(force);
    size = 1.0 + force_before.norm() + force.norm() + sliding + energy + block.normal_energy[k];
    if (!touches || !touched) return;
    const double gained = energy + shear_energy - block.normal_energy[k] - block.shear_energy[k];
    if (block.normal_before[k].dot(normal) < 0.9) {
      branch_work = gained + sliding + viscous + mean_force.dot(moved);
    } else if (hertz) {
      const double power = std::pow(overlap / block.overlap[k], 2.5);
      branch_work =
          0.5 * (energy - block.normal_energy[k] * power + energy / power - block.normal_energy[k]);
      size *= 1.0 + power + 1.0 / power;
    }
  }

  /// Of the step before: what its push had beside that of the overlap.
  static double push_of_damper(const ContactArrays& block, std::size_t k, bool hertz) {
    const double elastic = block.normal_stiffness_now[k] * block.overlap[k];
    return block.normal_force[k] - (hertz ? 2.0 / 3.0 : 1.0) * elastic;
  }

  /// Adds the damper's push of an overlap that grew, and what it and that of the step before lost.
  void damp(const ContactArrays& block, std::size_t k, bool hertz, double grew,
            double moved_before) {
    double share = 1.0;
    if (!(block.overlap[k] > 0.0) && grew > 0.0) {
      const double since = std::clamp(overlap / grew, 0x1p-20, 1.0), until = since + 0.5;
      share = hertz ? 0.8 * std::pow(until, 1.25) / std::pow(since, 0.25) : until;
    }
    const double viscosity = share * block.viscosity[k] * std::sqrt(stiffness);
    const double elastic = normal_force;
    normal_force = std::max(0.0, (elastic + viscosity * grew / block.dt) /
                                     (1.0 + 0.5 * block.dt * viscosity * block.inverse_mass[k]));
    viscous =
        0.5 * ((normal_force - elastic) * grew - push_of_damper(block, k, hertz) * moved_before);
  }

  void slide(const ContactArrays& block, std::size_t k, bool hertz, const Vec3& moved,
             const Vec3& old, double limit) {
    const double along = hertz ? block.along[k] : block.shear_stiffness[k];
    const double across = hertz ? block.across[k] : block.shear_stiffness[k];
    const Vec3& direction = block.direction[k];
    const auto by = [&](double x, double y, const Vec3& v) {
      return Vec3(y * v + (x - y) * direction.dot(v) * direction);
    };
    const double most = std::max(along, across), before = block.state_stiffness[k];
    const Vec3 kept = hertz && most < before ? Vec3(old * (most / before)) : old;
    shear = kept - by(along, across, moved);
    shear -= block.normal[k] * block.normal[k].dot(shear);
    if (shear.norm() > limit) shear *= limit / shear.norm();
    shear_energy = 0.5 * shear.dot(by(1.0 / along, 1.0 / across, shear));
    sliding = block.shear_energy[k] - 0.5 * (old + shear).dot(moved) - shear_energy;
  }
};

template <class T>
auto bits_of(const T& of) {
  return std::bit_cast<std::array<std::uint64_t, sizeof(T) / sizeof(std::uint64_t)>>(of);
}

/// The bits of all that a step writes for a pair: zeros have their signs.
std::vector<std::uint64_t> results_of(const ContactArrays& block, std::size_t k) {
  std::vector<std::uint64_t> bits;
  using A = ContactArrays;
  for (const auto column : {&A::normal_before, &A::branch_before, &A::arm_before, &A::shear_force,
                            &A::force, &A::moment_a, &A::moment_b})
    for (const double x : (block.*column)[k]) bits.push_back(std::bit_cast<std::uint64_t>(x));
  for (const auto column : {&A::overlap, &A::normal_force, &A::normal_stiffness_now,
                            &A::normal_energy, &A::state_stiffness, &A::shear_energy})
    bits.push_back(std::bit_cast<std::uint64_t>((block.*column)[k]));
  return bits;
}

struct Law {
  bool hertz, damped;
};

class ContactLanes : public ::testing::TestWithParam<Law> {
 protected:
  /// Of the law that is asked about.
  static ContactArrays draw_block(Draw& draw) {
    ContactArrays block = draw_contacts(draw);
    block.damped = GetParam().damped;
    return block;
  }
};

TEST_P(ContactLanes, AreThePlainEquationsAtEveryInstructionSet) {
  const bool hertz = GetParam().hertz;
  std::cout << "seed " << kSeed << std::endl;
  at_every_level([&](std::int64_t level) {
    Draw draw;
    std::array<int, 4> seen{};  // began, ended, stayed, stayed apart
    for (int round = 0; round < 40; ++round) {
      const ContactArrays before = draw_block(draw);
      ContactArrays after = before;
      after.step(kPairs, hertz);
      dem::BlockSums sums{};
      Mat3 force_branch = Mat3::Zero();
      double size = 0.0;
      for (std::size_t k = 0; k < kPairs; ++k) {
        const PlainContact plain(before, k, hertz);
        const double allowed = 256.0 * kUnitRoundoff * plain.size;
        ++seen[(plain.overlap > 0.0 ? 0u : 1u) +
               (before.overlap[k] > 0.0) * (plain.overlap > 0.0 ? 2u : 0u) +
               (before.overlap[k] > 0.0 || plain.overlap > 0.0 ? 0u : 2u)];
        ASSERT_EQ(after.normal_before[k], before.normal[k]);
        ASSERT_EQ(after.branch_before[k], before.branch[k]);
        ASSERT_EQ(after.overlap[k], plain.overlap);
        ASSERT_NEAR(after.normal_force[k], plain.normal_force, allowed);
        ASSERT_NEAR(after.normal_energy[k], plain.energy, allowed);
        ASSERT_NEAR(after.shear_energy[k], plain.shear_energy, allowed);
        ASSERT_NEAR((after.shear_force[k] - plain.shear).norm(), 0.0, allowed);
        ASSERT_NEAR((after.force[k] - plain.force).norm(), 0.0, allowed);
        ASSERT_NEAR((after.moment_a[k] - plain.moment_a).norm(), 0.0, 4.0 * allowed);
        ASSERT_NEAR((after.moment_b[k] - plain.moment_b).norm(), 0.0, 4.0 * allowed);
        if (plain.overlap > 0.0) {
          ASSERT_EQ(after.arm_before[k], plain.arm);
        }
        size += allowed;
        force_branch += plain.force * before.branch[k].transpose();
        const double along = before.normal[k].dot(before.branch[k]);
        sums.affine_stiffness += plain.stiffness * along * along;
        sums.sliding += plain.sliding;
        sums.boundary += plain.boundary;
        sums.branch += plain.branch_work;
        sums.viscous += plain.viscous;
      }
      const dem::BlockSums& got = after.sums;
      EXPECT_LT((Eigen::Map<const Mat3>(got.force_branch) - force_branch).norm(), 8.0 * size);
      EXPECT_NEAR(got.affine_stiffness, sums.affine_stiffness, 1e3 * size);
      EXPECT_NEAR(got.sliding, sums.sliding, size);
      EXPECT_NEAR(got.boundary, sums.boundary, size);
      EXPECT_NEAR(got.branch, sums.branch, size);
      EXPECT_NEAR(got.viscous, sums.viscous, size);
    }
    EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 100) << hwy::TargetName(level);
  });
}

// dem/lanes/contact_lanes.hpp (1)
TEST_P(ContactLanes, DoNotDependOnPlaceOrNeighboursToTheBit) {
  at_every_level([&](std::int64_t level) {
    Draw draw;
    for (int round = 0; round < 10; ++round) {
      const ContactArrays before = draw_block(draw);
      ContactArrays whole = before;
      whole.step(kPairs, GetParam().hertz);
      for (std::size_t k = 0; k < kPairs; k += 5) {
        ContactArrays alone;
        alone.motion = before.motion;
        alone.dt = before.dt;
        alone.rate = before.rate;
        alone.damped = before.damped;
        const auto take = [&](auto column) { (alone.*column)[0] = (before.*column)[k]; };
        take(&ContactArrays::pairs);
        using A = ContactArrays;
        for (const auto column :
             {&A::gap, &A::normal_stiffness, &A::shear_stiffness, &A::friction_coefficient,
              &A::cohesion, &A::half_compliance, &A::hertz_force, &A::hertz_stiffness,
              &A::hertz_energy, &A::along, &A::across, &A::overlap, &A::normal_force,
              &A::normal_stiffness_now, &A::normal_energy, &A::state_stiffness, &A::shear_energy,
              &A::viscosity, &A::inverse_mass})
          take(column);
        for (const auto column : {&A::normal, &A::branch, &A::arm, &A::direction, &A::normal_before,
                                  &A::branch_before, &A::arm_before, &A::shear_force})
          take(column);
        alone.step(1, GetParam().hertz);
        EXPECT_EQ(results_of(alone, 0), results_of(whole, k))
            << hwy::TargetName(level) << ", pair " << k << ", gap " << before.gap[k];
      }
    }
  });
}

// dem/lanes/contact_lanes.hpp (1): instruction sets of one arithmetic have unlike numbers of lanes
TEST_P(ContactLanes, OfOneArithmeticHaveTheSameBitsWhateverTheNumberOfLanes) {
  std::map<std::string, std::vector<std::uint64_t>> known;
  std::map<std::string, int> levels;
  at_every_level([&](std::int64_t level) {
    Draw draw;
    std::vector<std::uint64_t> all;
    for (int round = 0; round < 40; ++round) {
      ContactArrays block = draw_block(draw);
      block.step(kPairs, GetParam().hertz);
      const auto sums = bits_of(block.sums);
      all.insert(all.end(), sums.begin(), sums.end());
      for (std::size_t k = 0; k < kPairs; ++k) {
        const std::vector<std::uint64_t> pair = results_of(block, k);
        all.insert(all.end(), pair.begin(), pair.end());
      }
    }
    const std::string arithmetic = arithmetic_of(level);
    const auto [one, is_new] = known.emplace(arithmetic, all);
    EXPECT_TRUE(is_new || one->second == all) << hwy::TargetName(level);
    ++levels[arithmetic];
  });
  EXPECT_GE(levels["no-FMA"], 2) << "there was something to compare";
}

std::string name_of(const ::testing::TestParamInfo<Law>& law) {
  return std::string(law.param.hertz ? "Hertz" : "linear") + (law.param.damped ? "Damped" : "");
}

INSTANTIATE_TEST_SUITE_P(Laws, ContactLanes,
                         ::testing::Values(Law{false, false}, Law{true, false}, Law{false, true},
                                           Law{true, true}),
                         name_of);

// dem/lanes/contact_lanes.hpp (2)
TEST(ContactLanesApart, APairKeepsItsNormalAndHasNoForce) {
  ContactArrays one;
  one.set_law(0, {100.0, 50.0, 0.5, 0.0});
  one.normal[0] = Vec3(0.6, 0.0, 0.8);
  one.force[0] = one.moment_a[0] = Vec3::Ones();
  one.step(1, false);
  EXPECT_EQ(one.normal_before[0], Vec3(0.6, 0.0, 0.8));
  EXPECT_EQ(one.force[0], Vec3::Zero());
  EXPECT_EQ(one.moment_a[0], Vec3::Zero());
  EXPECT_EQ(one.sums.affine_stiffness, 0.0);
}

}  // namespace
}  // namespace tangency::testing
