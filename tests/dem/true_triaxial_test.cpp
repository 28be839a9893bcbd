// SPDX-License-Identifier: GPL-3.0-or-later
/// True triaxial shear: the intermediate stress is held at its ratio between the two others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <string>

#include <tangency/dem/simulation.hpp>

#include "scenes.hpp"
#include "stages.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

constexpr double kPressure = 10e6;

/// 125 spheroids compacted to kPressure without friction and brought to rest, then `stage`.
std::string sheared(const std::string& stage) {
  return "schema = 1\n[particles.grain]\ncount = 125\nmean_radius = 10.0\nelongation = 1.4\n"
         "[contact]\nnormal_stiffness = 1.5e10\nfriction_coefficient = 0.5\n"
         "[[stage]]\nkind = \"place\"\narrangement = \"random\"\nseed = 3\n"
         "[[stage]]\nkind = \"compress\"\nfriction_coefficient = 0.0\nmean_stress = 10e6\n"
         "max_strain_rate = 0.05\ntime_step_factor = 0.3\n"
         "[[stage]]\nkind = \"relax\"\nfriction_coefficient = 0.0\nmean_stress = 10e6\n"
         "max_unbalanced_ratio = 0.02\nmax_strain_rate = 0.05\ntime_step_factor = 0.3\n" +
         stage;
}

/// At the start of the last stage.
const State& at_rest() {
  static const State state = at_end(sheared("")).state();
  return state;
}

/// How far s_yy is off, over s_zz - s_xx; and the mean stress, over the wanted.
struct Off {
  double ratio = 0.0, mean = 0.0;
};

/// The worst of all cycles from an axial strain of a hundredth on.
Off worst_in(double ratio, const std::string& stage) {
  Simulation simulation(parse_scene(sheared(stage), "scene.toml"), at_rest());
  Off worst;
  int seen = 0;
  while (simulation.status() == StageStatus::running) {
    simulation.step();
    const Observation now = simulation.observe();
    if (now.axial_strain < 0.01) continue;
    const Mat3& s = now.stress.tensor;
    const double deviator = s(2, 2) - s(0, 0);
    EXPECT_GT(deviator, 0.2 * kPressure);
    const double off = (s(1, 1) - s(0, 0) - ratio * deviator) / deviator;
    worst.ratio = std::max(worst.ratio, std::abs(off));
    worst.mean = std::max(worst.mean, std::abs(now.stress.mean() / kPressure - 1.0));
    ++seen;
  }
  EXPECT_EQ(simulation.status(), StageStatus::done);
  EXPECT_GT(seen, 500);
  const Vec3 strain = simulation.state().cell.logarithmic_strain().diagonal();
  std::cout << "ratio " << ratio << ": off by " << worst.ratio << ", mean stress by " << worst.mean
            << ", lateral strains " << strain[0] << ", " << strain[1] << "\n";
  // b = 0 leaves x and y alike; the larger it is the more y is kept from extending.
  if (ratio == 0.0)
    EXPECT_NEAR(strain[0], strain[1], 0.002);
  else
    EXPECT_LT(strain[1], strain[0] - 0.002);
  return worst;
}

class TrueTriaxial : public testing::TestWithParam<double> {};

TEST_P(TrueTriaxial, ShearHoldsTheIntermediateStressAtItsRatio) {
  const double ratio = GetParam();
  const Off worst =
      worst_in(ratio,
               "[[stage]]\nkind = \"shear\"\nmean_stress = 10e6\naxial_strain = 0.02\n"
               "axial_strain_rate = 0.001\ntime_step_factor = 0.3\nintermediate_ratio = " +
                   std::to_string(ratio) + "\n");
  EXPECT_LT(worst.ratio, 1e-4);
  EXPECT_LT(worst.mean, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Ratios, TrueTriaxial, testing::Values(0.0, 0.25, 0.5, 1.0));

// Without a rate that is made for the ratio: the servo alone keeps it.
TEST(TrueTriaxial, ServoHoldsTheIntermediateStressAtItsRatioUnderAnyGivenRate) {
  const Off worst = worst_in(0.5,
                             "[[stage]]\nkind = \"servo\"\nmean_stress = 10e6\nduration = 3600\n"
                             "strain_rate = [-0.0005, -0.0005, 0.001]\nmax_strain_rate = 0.05\n"
                             "time_step_factor = 0.3\nintermediate_ratio = 0.5\n");
  EXPECT_LT(worst.ratio, 0.01);
  EXPECT_LT(worst.mean, 0.01);
}

}  // namespace
