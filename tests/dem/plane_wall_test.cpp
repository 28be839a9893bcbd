// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plane walls at any angle: what lies on them, slides and rolls down them, and what moving and
// pushed ones do, against theory.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <variant>

#include <tangency/dem/observe.hpp>
#include <tangency/dem/plane_wall.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/simulation.hpp>

#include "scenes.hpp"
#include "stages.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using namespace tangency::testing;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}
std::string numbers(const Vec3& v) {
  return "[" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + "]";
}

TEST(PlaneWall, HasTheAreaOfItsFaceWithinTheCell) {
  const auto area = [](const Vec3& normal, double offset, const Vec3& edges) {
    return section_area({normal.normalized(), offset}, edges);
  };
  EXPECT_NEAR(area({0, 0, 1}, 2.0, {3, 4, 5}), 12.0, 1e-13);
  EXPECT_NEAR(area({0, -1, 0}, -2.0, {3, 4, 5}), 15.0, 1e-13);
  EXPECT_NEAR(area({1, 0, 1}, std::sqrt(0.5), {1, 1, 1}), std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(area({1, 1, 1}, std::sqrt(0.75), {1, 1, 1}), 0.75 * std::sqrt(3.0), 1e-14)
      << "a hexagon";
  EXPECT_NEAR(area({1, 1, 1}, 0.5 / std::sqrt(3.0), {1, 1, 1}), std::sqrt(3.0) / 8.0, 1e-14);
  EXPECT_EQ(area({0, 0, 1}, 7.0, {3, 4, 5}), 0.0);
}

constexpr double kGravity = 10.0, kSlope = 0.5;  // rad

/// A ball of radius 1 that touches a plane through the middle of a box of 40.
std::string ball(const Vec3& normal, const std::string& wall, const std::string& contact,
                 const Vec3& gravity, double above = 0.0) {
  const Vec3 middle = Vec3::Constant(20.0);
  return "schema = 1\n[cell]\nsize = [40.0, 40.0, 40.0]\nwalls = \"xyz\"\n[[wall]]\npoint = " +
         numbers(middle) + "\nnormal = " + numbers(3.0 * normal) + "\n" + wall +
         "[motion]\ngravity = " + numbers(gravity) +
         "\n[particles.ball]\ncount = 1\nmean_radius = 1.0\ndensity = 1000.0\n[contact]\n"
         "normal_stiffness = 1e9\nfriction_coefficient = 9.0\n[contact.ball-wall]\n" +
         contact +
         "[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\n[[body]]\ntype = \"ball\"\n"
         "position = " +
         numbers(middle + (1.0 + above) * normal) +
         "\n[[stage]]\nkind = \"servo\"\nduration = 1000000\ndamping = 0.0\n"
         "time_step_factor = 0.1\n";
}

Simulation after(const std::string& scene, double time) {
  Simulation simulation(parse_scene(scene, "scene.toml"));
  while (simulation.state().time < time) simulation.step();
  return simulation;
}

const Vec3 kTilted(std::sin(kSlope), 0.0, std::cos(kSlope)), kDown(0.0, 0.0, -kGravity);
const Vec3 kDownhill(std::cos(kSlope), 0.0, -std::sin(kSlope));

/// The speed downhill over that of a free fall along the slope.
double share_of_fall(double friction) {
  const double weight = 1000.0 * 4.0 / 3.0 * std::numbers::pi * kGravity;
  const double sunk = weight * std::cos(kSlope) / 1e9;
  const Simulation simulation = after(
      ball(kTilted, "", "friction_coefficient = " + number(friction) + "\n", kDown, -sunk), 0.2);
  const State& state = simulation.state();
  EXPECT_NEAR(state.particles.velocity[0].dot(kTilted), 0.0, 1e-4) << "it stays on the plane";
  const Observation seen = simulation.observe();
  EXPECT_LT(std::abs(seen.energy_error), 1e-3 * seen.account.gravity);
  return state.particles.velocity[0].dot(kDownhill) / (kGravity * std::sin(kSlope) * state.time);
}

TEST(PlaneWall, LetsABallSlideAndRollDownASlopeByTheFrictionOfItsOwnMaterial) {
  EXPECT_NEAR(share_of_fall(0.0), 1.0, 1e-4);
  const double friction = 0.1;  // less than 2/7 tan(slope), so that it slides
  EXPECT_NEAR(share_of_fall(friction), 1.0 - friction / std::tan(kSlope), 1e-3);
  EXPECT_NEAR(share_of_fall(0.5), 5.0 / 7.0, 2e-3) << "rolls";
}

TEST(PlaneWall, ThatMovesAlongItselfCarriesABallToTwoSeventhsOfItsSpeed) {
  const double weight = 1000.0 * 4.0 / 3.0 * std::numbers::pi * kGravity, speed = 0.3;
  const Simulation simulation =
      after(ball(Vec3::UnitZ(), "velocity = " + numbers({speed, 0.0, 0.0}) + "\n",
                 "friction_coefficient = 0.4\n", kDown, -weight / 1e9),
            0.2);
  const State& state = simulation.state();
  // When it sticks its spring across swings on from the force of sliding, and nothing damps that.
  const double mass = weight / kGravity;
  const double swing = 0.4 * weight / 1e9 * std::sqrt(3.5 * 1e9 / mass);
  EXPECT_NEAR(state.particles.velocity[0][0], 2.0 / 7.0 * speed, 2.0 / 7.0 * swing);
  EXPECT_NEAR(state.particles.angular_velocity[0][1], -5.0 / 7.0 * speed, 5.0 / 7.0 * swing);
  EXPECT_LT(swing, 0.06 * speed);
  EXPECT_EQ(state.cell.planes[0].offset, 20.0) << "its face stays";
  // The belt gives what moves now and what slid away: force times its way.
  const Observation seen = simulation.observe();
  const double impulse = mass * 2.0 / 7.0 * speed;
  EXPECT_NEAR(seen.account.boundary, impulse * speed, 2.0 / 7.0 * swing * mass * speed);
  EXPECT_LT(std::abs(seen.energy_error), 1e-2 * seen.account.boundary);
}

TEST(PlaneWall, ThatHitsABallDrivesItOffByItsRestitution) {
  for (const double given : {0.2, 0.5, 1.0}) {
    const double speed = 2.0;
    std::string scene = ball(kTilted, "velocity = " + numbers(speed * kTilted) + "\n",
                             "restitution = " + number(given) + "\n", Vec3::Zero(), 0.1);
    scene = with(scene, "time_step_factor = 0.1", "time_step_factor = 0.04");
    const Simulation simulation = after(scene, 0.1);
    const State& state = simulation.state();
    EXPECT_NEAR(state.particles.velocity[0].dot(kTilted), (1.0 + given) * speed, 4e-3);
    EXPECT_NEAR(state.cell.planes[0].height_of(Vec3::Constant(20.0)), -speed * state.time, 1e-9);
    const Observation seen = simulation.observe();
    EXPECT_LT(std::abs(seen.energy_error), 4e-3 * seen.kinetic_energy);
  }
}

/// Grains under a plane that presses them onto the floor.
std::string pressed() {
  return "schema = 1\n[cell]\nsize = [5.0, 5.0, 16.0]\nwalls = \"xyz\"\n[[wall]]\n"
         "point = [0.0, 0.0, 15.9]\nnormal = [0.0, 0.0, -1.0]\nstress = 50e3\nmax_speed = 5.0\n"
         "[particles.grain]\ncount = 40\nmean_radius = 0.6\nelongation = 1.3\ndensity = 1000.0\n"
         "[contact]\nnormal_stiffness = 5e7\nfriction_coefficient = 0.3\nrestitution = 0.5\n"
         "[contact.grain-wall]\nfriction_coefficient = 0.1\n[[stage]]\nkind = \"place\"\n"
         "arrangement = \"random\"\nbounding_fraction = 0.2\n[[stage]]\nkind = \"servo\"\n"
         "name = \"press\"\nduration = 9500\ndamping = 0.05\n[[stage]]\nkind = \"relax\"\n"
         "max_unbalanced_ratio = 0.02\ndamping = 0.1\n";
}

TEST(PlaneWall, ThatHoldsAStressBearsItInTheEnd) {
  Simulation simulation = at_end(pressed());
  const State& state = simulation.state();
  const auto count = static_cast<std::int32_t>(state.particles.size());
  const double force = state.contacts.borne_by(count + 6, state.list).force;
  EXPECT_NEAR(force / 25.0, 50e3, 0.01 * 50e3);
  EXPECT_LT(state.cell.planes[0].height_of(Vec3::Zero()), 14.0) << "it has come down";
  EXPECT_LT(std::abs(simulation.observe().energy_error),
            0.05 * std::abs(simulation.observe().account.boundary));
}

// What lies below is at rest while the wall is still on its way.
TEST(PlaneWall, IsWaitedForByAStageThatComesToRest) {
  const Simulation simulation = at_end(with(pressed(), "duration = 9500", "duration = 1"));
  const State& state = simulation.state();
  const auto count = static_cast<std::int32_t>(state.particles.size());
  EXPECT_NEAR(state.contacts.borne_by(count + 6, state.list).force / 25.0, 50e3, 0.02 * 50e3);
  EXPECT_LE(simulation.observe().balance.largest_unbalanced_ratio, 0.02);
}

TEST(PlaneWall, IsSavedWithTheBitsThatItGoesOnWith) {
  const auto file = std::filesystem::path(testing::TempDir()) / "plane_wall.state";
  Simulation whole = at_stage(pressed(), 1);
  const auto pushes = [](const State& state) {
    const auto count = static_cast<std::int32_t>(state.particles.size());
    return state.contacts.borne_by(count + 6, state.list).force > 0.0;
  };
  for (int k = 0; k < 3000 && !pushes(whole.state()); ++k) whole.step();
  ASSERT_TRUE(pushes(whole.state()));
  save_state(whole.state(), file);
  Simulation resumed(whole.scene(), load_state(file));
  for (int k = 0; k < 300; ++k) {
    whole.step();
    resumed.step();
  }
  EXPECT_EQ(state_hash(resumed.state()), state_hash(whole.state()));
  const std::string without = with(pressed(),
                                   "[[wall]]\npoint = [0.0, 0.0, 15.9]\nnormal = [0.0, 0.0, -1.0]\n"
                                   "stress = 50e3\nmax_speed = 5.0\n",
                                   "");
  EXPECT_THROW(Simulation(parse_scene(without, "scene.toml"), load_state(file)),
               std::invalid_argument);
  std::filesystem::remove(file);
}

std::string refusal_of(const std::string& scene, const State& state) {
  try {
    const Simulation resumed(parse_scene(scene, "scene.toml"), state);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PlaneWall, OfAStateIsThatOfTheSceneOrTheDifferenceIsSaid) {
  const std::string still = ball(Vec3::UnitZ(), "", "", kDown);
  const std::string moving = ball(Vec3::UnitZ(), "velocity = [0.0, 0.0, -1.0]\n", "", kDown);
  const State stood = after(still, 0.01).state(), moved = after(moving, 0.01).state();
  const auto said = [](const std::string& scene, const State& state) {
    return Simulation(parse_scene(scene, "scene.toml"), state).changed_walls();
  };
  EXPECT_EQ(said(still, stood), "");
  EXPECT_EQ(said(moving, moved), "") << "it is elsewhere by right";
  EXPECT_EQ(said(moving, stood), "wall[0].velocity = [ 0, 0, 0 ], and here [ 0, 0, -1 ]");
  const std::string lower = with(still, "point = [20, 20, 20]", "point = [20, 20, 19.5]");
  EXPECT_EQ(said(lower, stood),
            "wall[0].point at 20 along its normal, and here 19.5: it stays where it is");
  EXPECT_EQ(refusal_of(ball(kTilted, "", "", kDown), stood),
            "a state with wall[0].normal = [ 0, 0, 1 ]; the scene has [ 0.479426, 0, 0.877583 ]");
}

TEST(PlaneWall, OfAStateTakesOverTheScenesVelocityAndStress) {
  const std::string still = ball(Vec3::UnitZ(), "", "", kDown);
  const std::string moving = ball(Vec3::UnitZ(), "velocity = [0.0, 0.0, -1.0]\n", "", kDown);
  const Simulation moves(parse_scene(moving, "scene.toml"), after(still, 0.01).state());
  EXPECT_EQ(moves.state().cell.planes[0].velocity, Vec3(0.0, 0.0, -1.0));
  const Simulation pressing(parse_scene(pressed(), "scene.toml"));
  const Simulation less(
      parse_scene(with(pressed(), "stress = 50e3", "stress = 40e3"), "scene.toml"),
      pressing.state());
  ASSERT_TRUE(less.state().cell.planes[0].held);
  EXPECT_EQ(less.state().cell.planes[0].held->stress, 40e3);
}

const std::string kDamped = "restitution = 0.5\n";

TEST(PlaneWall, ThatTouchesABallAndBearsNothingLeavesNoInfinityInTheHistory) {
  Simulation simulation(parse_scene(ball(Vec3::UnitZ(), "", kDamped, kDown, 0.01), "scene.toml"));
  Observation seen = simulation.observe();
  for (int k = 0; k < 1000 && !(seen.contacts == 1 && seen.mean_normal_force == 0.0); ++k) {
    simulation.step();
    seen = simulation.observe();
  }
  ASSERT_EQ(seen.contacts, 1);
  ASSERT_EQ(seen.mean_normal_force, 0.0) << "its damper would pull at the end of the impact";
  EXPECT_EQ(seen.balance.inertial_fraction, 0.0);
  EXPECT_EQ(seen.balance.largest_unbalanced_ratio, 0.0);
  EXPECT_EQ(seen.balance.largest_unbalanced_moment_ratio, 0.0);
  for (const Field& field : history_fields(0, 0.0, "", 0, seen))
    if (const double* value = std::get_if<double>(&field.value)) {
      EXPECT_TRUE(std::isfinite(*value)) << field.name;
    }
}

TEST(PlaneWall, BearsTheWeightOfABallWhereARelaxEndsNotWhereItsContactBearsNothing) {
  const Simulation relaxed =
      at_end(with(ball(Vec3::UnitZ(), "", kDamped, kDown, 0.01),
                  "kind = \"servo\"\nduration = 1000000\ndamping = 0.0\n",
                  "kind = \"relax\"\nmax_unbalanced_ratio = 0.01\ndamping = 0.02\n"));
  const double weight = relaxed.state().particles.mass[0] * kGravity;
  EXPECT_NEAR(relaxed.observe().balance.mean_contact_force, weight, 0.02 * weight);
}

TEST(PlaneWall, WithABodyBehindItIsRefused) {
  EXPECT_THROW(Simulation(parse_scene(ball(kTilted, "", "", kDown, -1.5), "scene.toml")),
               DoesNotFit);
}

}  // namespace
