// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <tangency/dem/loading.hpp>

namespace {

using namespace tangency::dem;
using tangency::Mat3;

constexpr double kStep = 0.01;

const Target kTarget = Target::mean_stress(100.0, 3);
constexpr Servo kServo{0.01, 0.05};

/// A body whose mean stress is stiffness * (compressive strain - slack), and creeps.
struct Spring {
  double stiffness, slack, creep_rate, strain = 0.0;

  Stress stress() const {
    const double pressure = std::max(0.0, stiffness * (strain - slack));
    return {pressure * Mat3::Identity(), pressure > 0.0 ? stiffness : 0.0};
  }
  std::vector<double> load(const Servo& servo, int cycles) {
    std::vector<double> pressures;
    ServoMemory memory;
    for (int cycle = 0; cycle < cycles; ++cycle) {
      strain -= servo.rate(kTarget, stress(), kStep, memory) * kStep;
      slack += creep_rate * kStep;
      pressures.push_back(stress().mean());
    }
    return pressures;
  }
};

TEST(Servo, ReachesTheWantedStressWithoutRinging) {
  const auto pressures = Spring{1000.0, 0.2, 0.0}.load(kServo, 20000);
  EXPECT_NEAR(pressures.back(), 100.0, 0.01);
  EXPECT_LT(*std::max_element(pressures.begin(), pressures.end()), 105.0);
  int crossings = 0;
  for (std::size_t k = 1; k < pressures.size(); ++k)
    crossings += (pressures[k - 1] < 100.0) != (pressures[k] < 100.0) ? 1 : 0;
  EXPECT_LE(crossings, 2);
}

TEST(Servo, TakesUpSteadyCreepWithoutALastingError) {
  const auto pressures = Spring{1000.0, 0.0, 0.005}.load(kServo, 20000);
  EXPECT_NEAR(pressures.back(), 100.0, 0.01);
}

TEST(Servo, KeepsItsRateWithinTheBoundAndCompressesWhatBearsNothing) {
  ServoMemory memory;
  EXPECT_EQ(kServo.rate(kTarget, Stress{}, kStep, memory), -0.05);
  const Stress far{1e9 * Mat3::Identity(), 1.0};
  EXPECT_EQ(kServo.rate(kTarget, far, kStep, memory), 0.05);
  EXPECT_EQ(memory.integral, 0.0) << "no wind-up at the bound";
}

/// Rise of the stress of a medium with <n n n n> of contacts that point everywhere alike.
Mat3 rise(const Mat3& compression) {
  return compression.trace() * Mat3::Identity() + 2.0 * compression;
}

TEST(IntermediateRatio, IsMetWhereTheIntermediateStressDividesTheOthersSo) {
  for (const double ratio : {0.0, 0.25, 0.5, 1.0}) {
    const Target target = Target::intermediate_ratio(ratio);
    const double low = 3.0, high = 11.0, between = low + ratio * (high - low);
    Stress stress{tangency::Vec3(low, between, high).asDiagonal(), rise(Mat3::Identity())(0, 0)};
    EXPECT_NEAR(target.measured(stress), 0.0, 1e-14);
    // Its actuator lowers it by its stiffness, and leaves the mean stress and its own alone.
    const Mat3 change = rise(-0.01 * target.actuator);
    EXPECT_NEAR(change.trace(), 0.0, 1e-15);
    const double lowered = target.measured({stress.tensor + change, 0.0});
    EXPECT_NEAR(lowered, -0.01 * target.affine_stiffness(stress), 1e-12);
    EXPECT_LT(lowered, 0.0);
    Loading loading{Mat3::Zero(), {Target::mean_stress(22.0 / 3.0, 3), target}, kServo};
    EXPECT_TRUE(loading.is_independent());
    stress.tensor(1, 1) += 0.1;
    EXPECT_NEAR(target.measured(stress), 0.1, 1e-14);
  }
}

}  // namespace
