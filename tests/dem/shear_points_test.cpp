// SPDX-License-Identifier: GPL-3.0-or-later
/// The rules of the points A to D on made-up tests whose points are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <tangency/dem/micromechanics/plane.hpp>
#include <tangency/dem/micromechanics/stress_force_fabric.hpp>
#include <tangency/dem/observe.hpp>
#include <tangency/dem/tool/shear_points.hpp>
#include <tangency/geometry/vectors.hpp>

namespace {

namespace mm = tangency::micromechanics;

using tangency::Mat3;
using tangency::Quaternion;
using tangency::dem::kConstantVolumeRate;
using tangency::dem::kYieldShare;
using tangency::dem::shear_points;
using tangency::dem::ShearPointRow;
using tangency::dem::ShearPoints;

/// A test of `count` rows after its start: the stress ratio is 1 - exp(-e / 0.01), the angle has
/// its peak at 0.1, and the volume grows at rate(e) per strain.
template <class Rate>
std::vector<ShearPointRow> rows(double step, int count, Rate&& rate) {
  std::vector<ShearPointRow> made{{0.0, 0.0, 0.0, 0.0}};
  for (int k = 1; k <= count; ++k) {
    const double e = k * step;
    made.push_back({e, made.back().volumetric_strain + step * rate(e - step / 2.0),
                    40.0 - 500.0 * (e - 0.1) * (e - 0.1), 1.0 - std::exp(-e / 0.01)});
  }
  return made;
}

/// Falls from 0.5 by a straight line, to 0 at 0.3 and on.
double slowing(double e) { return 0.5 * (1.0 - e / 0.3); }
double steady(double) { return 0.5; }

TEST(ShearPoints, OfAStartAloneAreNone) {
  EXPECT_FALSE(shear_points({}));
  EXPECT_FALSE(shear_points(rows(0.001, 0, steady)));
}

// The derivative has fallen to a share s of that at the start at -0.01 ln s; the steepest window is
// the first, and all windows are alike, so that the one which tells it lies that far behind.
TEST(ShearPoints, AreWhereTheRulesPutThem) {
  const double step = 0.0002;
  const ShearPoints points = *shear_points(rows(step, 2000, slowing));
  EXPECT_EQ(points.a, 0u);
  const double first_window = 0.001;
  EXPECT_NEAR(static_cast<double>(points.b) * step, first_window - 0.01 * std::log(kYieldShare),
              1.01 * step);
  EXPECT_NEAR(static_cast<double>(points.c) * step, 0.1, 1.01 * step);
  EXPECT_NEAR(static_cast<double>(points.d) * step, 0.3 * (1.0 - kConstantVolumeRate / 0.5),
              1.01 * step);
  EXPECT_FALSE(points.d_is_last_row);
}

TEST(ShearPoints, OfAVolumeThatGoesOnGrowingEndWithTheLastRow) {
  for (const auto rate : {0.5, 0.021, -0.021}) {
    const auto made = rows(0.001, 400, [&](double) { return rate; });
    const ShearPoints points = *shear_points(made);
    EXPECT_EQ(points.d, 400u) << rate;
    EXPECT_TRUE(points.d_is_last_row) << rate;
  }
  EXPECT_FALSE(shear_points(rows(0.001, 400, [](double) { return 0.019; }))->d_is_last_row);
}

// After its peak this test is strained by 0.04 more, less than the window of a constant volume.
TEST(ShearPoints, OfATestThatEndsSoonAfterItsPeakEndWithTheLastRow) {
  const auto still = [](double) { return 0.0; };
  EXPECT_TRUE(shear_points(rows(0.001, 140, still))->d_is_last_row);
  EXPECT_FALSE(shear_points(rows(0.001, 160, still))->d_is_last_row);
}

// A volume that is constant before the peak alone is no D.
TEST(ShearPoints, DoNotTakeAConstantVolumeBeforeThePeak) {
  const auto made = rows(0.001, 400, [](double e) { return e < 0.095 ? 0.0 : 0.5; });
  EXPECT_TRUE(shear_points(made)->d_is_last_row);
}

// A rise that ends before the steep one comes is no yielding.
TEST(ShearPoints, DoNotTakeTheEndOfAGentleStartForYielding) {
  auto made = rows(0.0002, 2000, steady);
  const double delay = 0.02;
  for (ShearPointRow& row : made) {
    const double after = std::max(0.0, row.axial_strain - delay);
    row.stress_ratio = std::min(5.0 * row.axial_strain, 0.025) + 1.0 - std::exp(-after / 0.01);
  }
  EXPECT_NEAR(static_cast<double>(shear_points(made)->b) * 0.0002,
              delay - 0.01 * std::log(kYieldShare), 0.002);
}

TEST(ShearPoints, OfRowsFarApartTakeThreeNeighbours) {
  const ShearPoints points = *shear_points(rows(0.02, 20, slowing));
  EXPECT_EQ(points.b, 2u);  // rows 1 to 3, after the steepest 0 to 2
  EXPECT_EQ(points.c, 5u);
  EXPECT_EQ(points.d, 15u);  // the rate of rows 14 to 16 is 0, of those before 0.033
}

// dem/tool/shear_points.hpp (2)
TEST(ShearPoints, StandInTheirOrder) {
  std::mt19937_64 draw(20261130);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<ShearPointRow> made{{0.0, 0.0, 0.0, unit(draw)}};
    const int count = 1 + static_cast<int>(40 * unit(draw));
    const double step = std::pow(10.0, -4.0 + 3.0 * unit(draw));
    for (int k = 0; k < count; ++k)
      made.push_back({made.back().axial_strain + step * (unit(draw) - 0.1), unit(draw) * 0.1,
                      40.0 * unit(draw), unit(draw)});
    const ShearPoints points = *shear_points(made);
    EXPECT_LE(points.a, points.b) << trial;
    EXPECT_LE(points.b, points.c) << trial;
    EXPECT_LE(points.c, points.d) << trial;
    EXPECT_LT(points.d, made.size()) << trial;
  }
}

/// q / p, of rows without a mean stress not defined.
double stress_ratio_of(const Mat3& stress, int dimensions = 3) {
  return tangency::dem::deviator_of(stress, dimensions) /
         (stress.topLeftCorner(dimensions, dimensions).trace() / dimensions);
}

TEST(StressRatio, DependsOnNeitherAxesNorUnits) {
  Mat3 stress = tangency::Vec3(1.0, 2.0, 5.0).asDiagonal();
  const double ratio = stress_ratio_of(stress);
  EXPECT_NEAR(ratio, std::sqrt(13.0) / (8.0 / 3.0), 1e-15);  // sqrt(((1-2)^2 + 3^2 + 4^2) / 2)
  const Mat3 turn = Quaternion(0.8, 0.36, -0.288, 0.384).normalized().toRotationMatrix();
  EXPECT_NEAR(stress_ratio_of(1e7 * turn * stress * turn.transpose()), ratio, 1e-14);
}

// The two libraries have it each, since the simulator links none for one formula.
TEST(StressRatio, IsThatOfMicromechanicsWhereItIsDefined) {
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 20; ++k) {
    Mat3 stress;
    for (double& x : stress.reshaped()) x = normal(random);
    stress = Mat3(stress + stress.transpose() + 9.0 * Mat3::Identity());
    ASSERT_GT(stress.topLeftCorner(2, 2).trace(), 0.0);
    EXPECT_NEAR(stress_ratio_of(stress), mm::shear_stress_ratio(stress), 1e-14);
    EXPECT_NEAR(stress_ratio_of(stress, 2), mm::plane_shear_ratio(stress), 1e-14);
  }
}

// Triaxial: 6 sin(phi) / (3 - sin(phi)). In the plane: sin(phi), whatever stands across it.
TEST(StressRatio, IsThatOfTheFrictionAngle) {
  const double sine = std::sin(40.0 * std::numbers::pi / 180.0);
  const Mat3 triaxial = tangency::Vec3(1.0 - sine, 1.0 - sine, 1.0 + sine).asDiagonal();
  EXPECT_NEAR(stress_ratio_of(triaxial), 6.0 * sine / (3.0 - sine), 1e-14);
  Mat3 plane = Mat3::Zero();
  plane.diagonal() << 1.0 - sine, 1.0 + sine, 77.0;
  EXPECT_NEAR(stress_ratio_of(plane, 2), sine, 1e-15);
}

}  // namespace
