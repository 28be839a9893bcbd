// SPDX-License-Identifier: GPL-3.0-or-later
//
// Momentum, angular momentum and energy of assemblies, every term accounted for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include <tangency/dem/simulation.hpp>

#include "assembly.hpp"
#include "few_bodies.hpp"
#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

constexpr const char* kLinear =
    "normal_stiffness = 1.5e10\nshear_stiffness = 1.0e10\nfriction_coefficient = 0.4\n";
constexpr const char* kHertz =
    "law = \"hertz\"\nyoung_modulus = 1e10\nlargest_overlap = 0.05\nfriction_coefficient = 0.4\n";
constexpr const char* kShear =
    "kind = \"shear\"\naxial_strain_rate = 0.3\naxial_strain = 1.0\nmean_stress = 60e6\n"
    "max_strain_rate = 0.3\ndamping = 0.1\n";
constexpr const char* kGrow =
    "kind = \"grow\"\nelongation = 1.5\nincrements = 20\nmean_stress = 60e6\n"
    "max_strain_rate = 0.3\ndamping = 0.3\nmax_inertial_fraction = 0.1\nstress_tolerance = 0.1\n";
constexpr const char* kRelax = "kind = \"relax\"\nmean_stress = 30e6\nmax_strain_rate = 0.3\n";

/// How an assembly is made and driven.
struct Case {
  const char* name;
  const char* cell;   ///< lines of [cell] and [motion]
  const char* law;    ///< of [contact]
  const char* drive;  ///< of the stage that is looked at
  double elongation;
  double largest;  ///< residual at a factor of 0.2, of the energy that went through
  double order;    ///< that it falls with
  int count = 30;  ///< of particles; without friction they pack so that 30 would double a contact
};

std::string scene(const Case& one, double time_step_factor) {
  return std::string("schema = 1\n") + one.cell +
         "[particles.grain]\ncount = " + std::to_string(one.count) +
         "\nmean_radius = 10.0\nflatness = 1.0\nelongation = " + number(one.elongation) +
         "\n[contact]\n" + one.law +
         "[[stage]]\nkind = \"place\"\narrangement = \"random\"\nseed = 5\n"
         "[[stage]]\nkind = \"compress\"\nmean_stress = 60e6\nmax_strain_rate = 0.4\n"
         "stress_tolerance = 0.05\nfriction_coefficient = 0.1\n"
         "[[stage]]\n" +
         one.drive + "time_step_factor = " + number(time_step_factor) +
         "\n[output]\nframe_interval = 0\n";
}

/// The state at the start of the stage that is looked at.
State compressed(const Case& one) {
  Simulation simulation(parse_scene(scene(one, 0.2), "scene.toml"));
  while (simulation.state().stage < 2) {
    if (simulation.status() == StageStatus::out_of_cycles)
      throw std::runtime_error("not compressed");
    if (simulation.status() == StageStatus::done)
      simulation.next_stage();
    else
      simulation.step();
  }
  return simulation.state();
}

/// What does not add up after `time`, over what went through.
double residual(const Case& one, const State& start, double factor, double time) {
  Simulation simulation(parse_scene(scene(one, factor), "scene.toml"), start);
  const Observation before = simulation.observe();
  const double end = simulation.state().time + time;
  while (simulation.state().time < end) simulation.step();
  if (one.drive == kGrow) {
    EXPECT_GT(simulation.state().increments, 0);
  }
  const Observation after = simulation.observe();
  const EnergyAccount &a = before.account, &b = after.account;
  const double through = std::abs(b.boundary - a.boundary) + std::abs(b.gravity - a.gravity) +
                         std::abs(b.growth - a.growth) + std::abs(b.branch - a.branch) +
                         std::abs(b.sliding - a.sliding) + std::abs(b.damping - a.damping);
  return (after.energy_error - before.energy_error) / through;
}

class Energy : public testing::TestWithParam<Case> {};

// Forces at the ends of a step, in the mean, do the work of those between up to the third order of
// the step; so the account is off by the second order, and by the first, with a small factor, where
// frictional contacts turn with their bodies. `largest` is two or three times what was measured.
TEST_P(Energy, IsAccountedForUpToWhatTheStepLosesAndLessForShorterSteps) {
  const Case& one = GetParam();
  const State start = compressed(one);
  const double unit = std::sqrt(start.particles.mass[0] / 1.5e10);
  std::cout << one.name << ':';
  for (const double factor : {0.2, 0.1, 0.05}) {
    const double off = residual(one, start, factor, 60.0 * unit);
    std::cout << ' ' << off;
    EXPECT_LT(std::abs(off), one.largest * std::pow(factor / 0.2, one.order));
  }
  std::cout << " of the energy that went through\n";
}

INSTANTIATE_TEST_SUITE_P(
    Of, Energy,
    testing::Values(Case{"Shear", "[cell]\n", kLinear, kShear, 1.3, 1e-4, 1.0},
                    Case{"FrictionlessShear", "[cell]\n", "normal_stiffness = 1.5e10\n", kShear,
                         1.3, 4e-3, 1.5, 50},
                    Case{"HertzShear", "[cell]\n", kHertz, kShear, 1.0, 5e-5, 1.5},
                    Case{"HertzShearOfEllipsoids", "[cell]\n", kHertz, kShear, 1.3, 6e-5, 1.0},
                    Case{"WallsAndGravity",
                         "[cell]\nwalls = \"xyz\"\n[motion]\ngravity = [0.0, 30.0, -1000.0]\n",
                         kLinear, kShear, 1.3, 1e-5, 1.0},
                    Case{"Growth", "[cell]\n", kLinear, kGrow, 1.2, 1e-3, 1.5},
                    Case{"Relaxation", "[cell]\n", kLinear, kRelax, 1.3, 6e-7, 1.0}),
    [](const auto& one) { return std::string(one.param.name); });

/// A cluster that flies apart, in a cell so wide that no image is met.
FewBodies cluster(const ContactLaw& law) {
  FewBodies bodies(law);
  bodies.particles = crowd(40, Cell::box(Vec3::Constant(1.2)), 12);
  for (Vec3& x : bodies.particles.position) x += Vec3::Constant(50.0);
  bodies.update();
  return bodies;
}

Vec3 momentum(const Particles& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.velocity[i];
  return sum;
}

/// About the middle of the cell.
Vec3 angular_momentum(const FewBodies& bodies) {
  const Particles& p = bodies.particles;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
    sum += p.mass[i] * (p.position[i] - Vec3::Constant(50.0)).cross(p.velocity[i]) +
           bodies.inertia(i) * p.angular_velocity[i];
  return sum;
}

TEST(Cluster, KeepsItsMomentumAndItsAngularMomentumWhateverItsContactsDo) {
  ContactLaw hertz{100.0, 80.0, 0.3, 0.0};
  hertz.hertz = Material{100.0, 0.3};
  for (const ContactLaw& law : {ContactLaw{100.0, 80.0, 0.3, 0.1}, hertz}) {
    FewBodies bodies = cluster(law);
    ASSERT_GT(bodies.touching(), 100u);
    const Vec3 linear = momentum(bodies.particles), angular = angular_momentum(bodies);
    const double energy = kinetic_energy(bodies.particles);
    double largest = 0.0;
    for (int k = 0; k < 300; ++k) {
      bodies.step(0.003);
      Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
      for (std::size_t i = 0; i < bodies.particles.size(); ++i) {
        const Vec3& force = bodies.contacts.resultants().force[i];
        sum += force;
        moment += (bodies.particles.position[i] - Vec3::Constant(50.0)).cross(force) +
                  bodies.contacts.resultants().moment[i];
        largest = std::max(largest, force.norm());
      }
      // Some 1000 terms of the size of the largest force, and arms of ten.
      ASSERT_LT(sum.norm(), 1000.0 * 0x1p-53 * largest);
      ASSERT_LT(moment.norm(), 10.0 * 1000.0 * 0x1p-53 * largest);
    }
    EXPECT_GT(kinetic_energy(bodies.particles), 3.0 * energy) << "the contacts did something";
    // The same, over 300 steps of 0.003.
    EXPECT_LT((momentum(bodies.particles) - linear).norm(), 1000.0 * 0x1p-53 * largest);
    EXPECT_LT((angular_momentum(bodies) - angular).norm(), 10.0 * 1000.0 * 0x1p-53 * largest);
  }
}

/// Two needles, of which one is shot across the other, so that the way out goes over from one
/// branch to another: energy that came with that, and what is not accounted for.
struct Crossing {
  double branch, error, kinetic;

  Crossing(Branch rule, double dt) {
    FewBodies pair({3.0, 0.0, 0.0, 0.0});
    pair.branch = rule;
    pair.add(Vec3::Constant(50.0), Eigen::Quaterniond::Identity(), {2.0, 0.6, 0.5});
    pair.add(Vec3(50.3, 50.1, 51.2), Eigen::Quaterniond(1.0, 0.05, 0.1, 0.2).normalized(),
             {0.8, 0.5, 0.45}, {0.0, 0.0, -6.0});
    pair.update();
    kinetic = kinetic_energy(pair.particles);
    for (double time = 0.0; time < 1.5; time += dt) pair.step(dt);
    double stored = 0.0;
    for (const Contact& contact : pair.contacts.records()) stored += contact.normal_energy;
    branch = pair.work.branch;
    error = kinetic_energy_at(pair.particles, pair.contacts.resultants(), pair.motion, dt) +
            stored - kinetic - branch;
  }
};

TEST(BranchWork, IsWhatAPairGainsThatGoesOverToAnotherBranch) {
  // Followed until it is there no more: the overlap jumps by a finite amount.
  const Crossing follow(Branch::follow, 1e-3), fine(Branch::follow, 0.5e-3);
  EXPECT_GT(std::abs(follow.branch), 0.05 * follow.kinetic);
  EXPECT_NEAR(follow.branch, fine.branch, 0.01 * std::abs(fine.branch));
  // The shortest way out changes where two are equally long: what the pair gains is what it moves
  // meanwhile, (v dt) times the force.
  const Crossing global(Branch::global, 1e-3), fine_global(Branch::global, 0.5e-3);
  EXPECT_NE(global.branch, 0.0);
  EXPECT_LT(std::abs(global.branch), 6.0 * 1e-3 * 3.0 * 0.9);
  EXPECT_LT(std::abs(fine_global.branch), 6.0 * 0.5e-3 * 3.0 * 0.9);
  // What is left over, two jumps of a mean force by arms that change, falls with the step.
  EXPECT_LT(std::abs(follow.error), 1e-3 * std::abs(follow.branch));
  EXPECT_LT(std::abs(fine.error), 0.6 * std::abs(follow.error));
  EXPECT_LT(std::abs(fine_global.error), 0.6 * std::abs(global.error));
}

/// Energy of a periodic lattice of equal frictional spheres after some steps of `ratio` times the
/// critical one, over that at the start.
double growth_of_energy(double ratio) {
  FewBodies lattice({100.0, 100.0, 1e9, 0.0});
  lattice.cell = Cell::box(Vec3::Constant(4.0 * 1.98));
  std::mt19937_64 random(4);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z)
        lattice.add(
            1.98 * Vec3(x + 0.5, y + 0.5, z + 0.5), Eigen::Quaterniond::Identity(), Vec3::Ones(),
            1e-6 * Vec3(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5),
            1e-6 * Vec3(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5));
  lattice.update();
  const double dt = ratio * critical_time_step(lattice.particles, lattice.contacts, lattice.list);
  const double start = kinetic_energy(lattice.particles);
  double largest = 0.0;
  for (int k = 0; k < 300; ++k) {
    lattice.step(dt);
    largest = std::max(largest, kinetic_energy(lattice.particles));
  }
  return largest / start;
}

// A lattice of which every other sphere swings and turns against its neighbours has the very
// frequency of the bound. Beyond it leapfrog multiplies that mode by (r + sqrt(r^2 - 1))^2 a step.
TEST(CriticalTimeStep, PartsWhatBlowsUpFromWhatDoesNot) {
  EXPECT_LT(growth_of_energy(0.5), 1.5);
  EXPECT_LT(growth_of_energy(0.97), 4.0);
  EXPECT_GT(growth_of_energy(1.03), 1e6);
}

TEST(CriticalTimeStep, OfTwoSpheresIsTwoOverTheirFrequency) {
  // Head on 2 K / m. With a shear spring that turns them too: K_s (2 / m + 2 r^2 / I) = 7 K_s / m.
  for (const auto& [shear, w2] : {std::pair(0.0, 2.0 * 100.0), std::pair(100.0, 7.0 * 100.0)}) {
    FewBodies pair({100.0, shear, 1e9, 0.0});
    for (const double x : {50.0, 52.0 - 1e-9})
      pair.add({x, 50.0, 50.0}, Eigen::Quaterniond::Identity(), Vec3::Ones());
    pair.update();
    EXPECT_NEAR(critical_time_step(pair.particles, pair.contacts, pair.list),
                2.0 / std::sqrt(w2 / pair.mass(0)), 1e-8);
  }
}

}  // namespace
