// SPDX-License-Identifier: GPL-3.0-or-later
/// How axes start: the draws themselves, and what a scene places and compacts with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <tangency/dem/samples/start_axes.hpp>
#include <tangency/dem/scene.hpp>
#include <tangency/dem/simulation.hpp>

#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Quaternion;
using tangency::Vec3;
using namespace tangency::testing;
using Rule = StartAxes::Rule;

constexpr int kDraws = 4000;
/// Of a deviation that a test lets pass. One in 15000 draws of a sum is further off.
constexpr double kDeviations = 4.0;

/// Mean and variance of the squared component along the direction.
struct Square {
  double mean, variance;
};
Square square_in(const StartAxes& axes, int dimensions) {
  if (axes.rule != Rule::cone) return {axes.rule == Rule::aligned ? 1.0 : 0.0, 0.0};
  const double h = axes.half_angle;
  if (dimensions == 2) {
    const double mean = 0.5 * (1.0 + std::sin(2.0 * h) / (2.0 * h));
    const double fourth =
        3.0 / 8.0 + std::sin(2.0 * h) / (4.0 * h) + std::sin(4.0 * h) / (32.0 * h);
    return {mean, std::max(0.0, fourth - mean * mean)};
  }
  const double c = std::cos(h), mean = (1.0 + c + c * c) / 3.0;
  const double fourth = (1.0 + c + c * c + c * c * c + c * c * c * c) / 5.0;
  return {mean, std::max(0.0, fourth - mean * mean)};
}

std::vector<StartAxes> all_axes(int dimensions) {
  std::vector<StartAxes> all;
  const std::vector<Vec3> directions =
      dimensions == 2
          ? std::vector<Vec3>{Vec3::UnitY(), {-3.0, 1.0, 0.0}, -Vec3::UnitX()}
          : std::vector<Vec3>{
                Vec3::UnitZ(), -Vec3::UnitZ(), {1e-200, -2e-200, -3e-200}, Vec3::UnitX()};
  for (const Vec3& direction : directions) {
    all.push_back({Rule::aligned, direction});
    all.push_back({Rule::across, direction});
    for (const double degrees : {1.0, 20.0, 60.0, 90.0})
      all.push_back({Rule::cone, direction, degrees * std::numbers::pi / 180.0});
  }
  return all;
}

std::string text_of(const StartAxes& axes) {
  return "rule " + std::to_string(static_cast<int>(axes.rule)) + ", half angle " +
         std::to_string(axes.half_angle) + ", direction " + std::to_string(axes.direction[0]) +
         " " + std::to_string(axes.direction[1]) + " " + std::to_string(axes.direction[2]);
}

// dem/samples/start_axes.hpp (1)
TEST(StartAxes, HaveTheMeanSquareOfTheirRuleAlongTheDirection) {
  std::mt19937_64 random(3);
  for (const int dimensions : {2, 3})
    for (const int axis : {0, 2})
      for (const StartAxes& axes : all_axes(dimensions)) {
        if (dimensions == 2 && axis == 2) continue;
        const Vec3 along = axes.direction.stableNormalized();
        double sum = 0.0;
        for (int k = 0; k < kDraws; ++k) {
          const Vec3 u = axes.draw(random, axis, dimensions) * Vec3::Unit(axis);
          ASSERT_NEAR(u.norm(), 1.0, 1e-14);
          ASSERT_TRUE(dimensions == 3 || u[2] == 0.0);
          const double part = u.dot(along);
          ASSERT_GE(std::abs(part), axes.rule == Rule::cone      ? std::cos(axes.half_angle) - 1e-14
                                    : axes.rule == Rule::aligned ? 1.0 - 1e-14
                                                                 : 0.0);
          sum += part * part;
        }
        const auto [mean, variance] = square_in(axes, dimensions);
        EXPECT_NEAR(sum / kDraws, mean, kDeviations * std::sqrt(variance / kDraws) + 1e-14)
            << text_of(axes) << ", " << dimensions;
      }
}

// dem/samples/start_axes.hpp (2)
TEST(StartAxes, PreferNoDirectionAcross) {
  std::mt19937_64 random(4);
  for (const int axis : {0, 2})
    for (const StartAxes& axes : all_axes(3)) {
      Mat3 directed = Mat3::Zero(), other = Mat3::Zero();
      for (int k = 0; k < kDraws; ++k) {
        const Quaternion q = axes.draw(random, axis, 3);
        const Vec3 u = q * Vec3::Unit(axis), v = q * Vec3::Unit((axis + 1) % 3);
        directed += u * u.transpose() / kDraws;
        other += v * v.transpose() / kDraws;
      }
      const Vec3 along = axes.direction.stableNormalized();
      const double mean = square_in(axes, 3).mean;
      const Mat3 wanted = mean * along * along.transpose() +
                          0.5 * (1.0 - mean) * (Mat3::Identity() - along * along.transpose());
      // A component's square has a variance of at most 1/8 here, and there are nine.
      const double bound = 3.0 * kDeviations * std::sqrt(0.125 / kDraws);
      EXPECT_LT((directed - wanted).norm(), bound) << text_of(axes);
      EXPECT_LT((other - 0.5 * (Mat3::Identity() - wanted)).norm(), bound) << text_of(axes);
    }
}

// dem/samples/start_axes.hpp (3)
TEST(StartAxes, OfRuleRandomAreUniformRotationsBitForBit) {
  for (const int dimensions : {2, 3}) {
    std::mt19937_64 one(5), other(5);
    for (int k = 0; k < 100; ++k)
      ASSERT_EQ(StartAxes{}.draw(one, 2, dimensions).coeffs(),
                uniform_rotation(other, dimensions).coeffs());
  }
}

TEST(StartAxes, TurnTheLongestAxisAndOfOblateBodiesTheAxisOfSymmetry) {
  EXPECT_EQ(directed_axis({1.0, 1.5, 1.0}), 0);
  EXPECT_EQ(directed_axis({1.0, 1.5, 1.2}), 0);
  EXPECT_EQ(directed_axis({1.0, 1.0, 1.2}), 2);
  EXPECT_EQ(directed_axis({1.0, 1.0, 1.0}), 0);
}

/// Axial anisotropy (15/2)(<u_k^2> - 1/3) of one body axis, in space axis k.
double axial_anisotropy(const Particles& particles, int body_axis, int k) {
  double sum = 0.0;
  for (const Quaternion& q : particles.orientation) {
    const double part = (q * Vec3::Unit(body_axis))[k];
    sum += part * part;
  }
  return 7.5 * (sum / static_cast<double>(particles.size()) - 1.0 / 3.0);
}

std::string placed_scene(const std::string& place, const std::string& shape = "elongation = 1.4") {
  return with(with(with(small_scene(), "count = 27", "count = 1000"), "elongation = 1.4", shape),
              "kind = \"place\"\n", "kind = \"place\"\n" + place + "\n");
}

Particles placed(const std::string& text) {
  return Simulation(parse_scene(text, "scene.toml")).state().particles;
}

// The anisotropies of the three rules, in closed form, for both ways of placing.
TEST(PlacedAxes, HaveTheAnisotropyOfTheirRule) {
  const std::vector<std::string> arrangements{"arrangement = \"lattice\"\n",
                                              "arrangement = \"random\"\n"};
  for (const std::string& arrangement : arrangements) {
    const auto axial = [&](const std::string& axes, int k = 2) {
      return axial_anisotropy(placed(placed_scene(arrangement + axes)), 0, k);
    };
    EXPECT_NEAR(axial("axes = \"aligned\""), 5.0, 1e-12);
    EXPECT_NEAR(axial("axes = \"plane\""), -2.5, 1e-12);
    EXPECT_NEAR(axial("axes = \"aligned\"\naxes_direction = [0.0, -7.0, 0.0]", 1), 5.0, 1e-12);
    EXPECT_NEAR(axial("axes = \"plane\"\naxes_direction = [2.0, 0.0, 0.0]", 0), -2.5, 1e-12);
    for (const double degrees : {30.0, 60.0}) {
      const StartAxes axes{Rule::cone, Vec3::UnitZ(), degrees * std::numbers::pi / 180.0};
      const double c = std::cos(axes.half_angle);
      EXPECT_NEAR(axial("axes = \"cone\"\naxes_cone_deg = " + std::to_string(degrees)),
                  2.5 * (c + c * c),
                  7.5 * kDeviations * std::sqrt(square_in(axes, 3).variance / 1000.0));
    }
  }
}

TEST(PlacedAxes, InThePlaneAreAboutYUnlessADirectionIsGiven) {
  const auto first_axis = [](const std::string& axes) {
    const std::string text = with(placed_scene(axes), "[cell]\n", "[cell]\ndimensions = 2\n");
    return Vec3(placed(text).orientation.front() * Vec3::UnitX()).cwiseAbs().eval();
  };
  EXPECT_LT((first_axis("axes = \"aligned\"") - Vec3::UnitY()).norm(), 1e-14);
  EXPECT_LT((first_axis("axes = \"plane\"") - Vec3::UnitX()).norm(), 1e-14);
  EXPECT_LT(
      (first_axis("axes = \"aligned\"\naxes_direction = [3.0, 0.0, 0.0]") - Vec3::UnitX()).norm(),
      1e-14);
}

TEST(PlacedAxes, OfSpheresAreThoseOfWhatTheyGrowInto) {
  const auto axes_of = [](const std::string& shape, const std::string& growth) {
    const std::string text = placed_scene("axes = \"aligned\"", shape) +
                             "[[stage]]\nkind = \"grow\"\n" + growth +
                             "\nincrements = 1000\nmean_stress = 1e6\nmax_strain_rate = 0.05\n";
    return parse_scene(text, "scene.toml").batches().front().directed_axis;
  };
  EXPECT_EQ(axes_of("elongation = 1.0", "elongation = 1.2"), 0);
  EXPECT_EQ(axes_of("elongation = 1.0", "elongation = 1.0\nflatness = 1.2"), 2);
  EXPECT_EQ(axes_of("elongation = 1.2", "elongation = 1.0\nflatness = 1.2"), 0) << "not a sphere";
  const Particles oblate = placed(placed_scene("axes = \"aligned\"", "flatness = 1.4"));
  EXPECT_NEAR(axial_anisotropy(oblate, 2, 2), 5.0, 1e-12);
}

// The published start: nothing tells one particle from another, so that each keeps its six
// neighbours and the assembly no deviation.
TEST(CubicStart, CompactedALittleHasSixContactsOfEveryParticle) {
  for (const int count : {27, 125}) {
    Simulation simulation(parse_scene(
        with(with(with(small_scene(), "count = 27", "count = " + std::to_string(count)),
                  "elongation = 1.4\n", ""),
             "kind = \"place\"\n", "kind = \"place\"\njitter = 0.0\naxes = \"aligned\"\n"),
        "scene.toml"));
    ASSERT_EQ(simulation.observe().contacts, 0);
    while (simulation.status() == StageStatus::running) simulation.step();
    ASSERT_EQ(simulation.status(), StageStatus::done);
    const Observation seen = simulation.observe();
    EXPECT_NEAR(seen.stress.mean(), 10e6, 0.002 * 10e6);
    EXPECT_EQ(seen.coordination_number, 6.0);
    EXPECT_EQ(seen.coordination_std, 0.0);
  }
}

}  // namespace
