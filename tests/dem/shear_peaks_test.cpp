// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <tangency/dem/tool/shear_peaks.hpp>

namespace {

using tangency::dem::shear_peaks;
using tangency::dem::ShearPeaks;
using tangency::dem::ShearRow;

/// Rows at equal steps of axial strain, the first a step from the start.
template <class Volume, class Angle>
std::vector<ShearRow> rows(double step, int count, Volume&& volume, Angle&& angle) {
  std::vector<ShearRow> made;
  for (int k = 1; k <= count; ++k) made.push_back({k * step, volume(k * step), angle(k * step)});
  return made;
}

double none(double) { return 0.0; }

TEST(ShearPeaks, OfNoRowAreNone) { EXPECT_FALSE(shear_peaks({})); }

// Six rows 0.002 apart lie in a window; those nearest to the top of 40 - 1e4 (e - 0.05)^2 have
// offsets -0.006 to 0.004 from it, whose mean square is (5^2 + 3^2 + 1) 2/6 1e-6 + 0.001^2.
TEST(ShearPeaks, OfFrictionAreTheHighestWindow) {
  const auto made =
      rows(0.002, 100, none, [](double e) { return 40.0 - 1e4 * (e - 0.05) * (e - 0.05); });
  const ShearPeaks peaks = shear_peaks(made).value();
  EXPECT_NEAR(peaks.friction_angle_deg, 40.0 - 1e4 * (35e-6 / 3.0 + 1e-6), 1e-9);
  EXPECT_NEAR(std::abs(peaks.strain_at_friction - 0.05), 0.001, 1e-12);
}

// The largest of single rows would be 32 here, 2 degrees above what the assembly bears.
TEST(ShearPeaks, OfFrictionAreNotThatOfOneNoisyRow) {
  auto made = rows(0.0002, 500, none, [](double) { return 30.0; });
  made[200].friction_angle_deg = 32.0;
  EXPECT_NEAR(shear_peaks(made)->friction_angle_deg, 30.0 + 2.0 / 51.0, 1e-9);
}

TEST(ShearPeaks, OfFrictionOfRowsFarApartAreThoseOfThreeNeighbours) {
  const auto made =
      rows(0.02, 10, none, [](double e) { return std::abs(e - 0.1) < 0.01 ? 33.0 : 30.0; });
  EXPECT_NEAR(shear_peaks(made)->friction_angle_deg, 31.0, 1e-12);
}

// dem/tool/shear_peaks.hpp (1)
TEST(ShearPeaks, OfALineHaveItsSlope) {
  const auto made = rows(
      0.0005, 300, [](double e) { return 0.7 * e; }, none);
  EXPECT_NEAR(shear_peaks(made)->dilation_rate, 0.7, 1e-12);
}

// The rate -cos(pi e / 0.1) is highest at e = 0.1. A least-squares slope over a window w of it is
// the rate less its mean square share: 1 - (pi w / 0.1)^2 / 40 to the leading order.
TEST(ShearPeaks, OfDilationAreTheSteepestWindow) {
  const double k = std::acos(-1.0) / 0.1;
  const auto made = rows(
      0.0001, 2000, [&](double e) { return -std::sin(k * e) / k; }, none);
  const ShearPeaks peaks = shear_peaks(made).value();
  const double width = tangency::dem::kPeakWindow;
  EXPECT_NEAR(peaks.dilation_rate, 1.0 - k * k * width * width / 40.0, 1e-4);
  EXPECT_NEAR(peaks.strain_at_dilation, 0.1, 1e-4);
}

TEST(ShearPeaks, OfDilationAreNotThoseOfOneNoisyRow) {
  auto made = rows(
      0.0002, 1000, [](double e) { return 0.5 * e; }, none);
  made[500].volumetric_strain += 1e-4;  // a slope of 1 to the row before
  EXPECT_NEAR(shear_peaks(made)->dilation_rate, 0.5, 0.02);
}

TEST(ShearPeaks, OfRowsFarApartAreThoseOfThreeNeighbours) {
  const auto made = rows(
      0.02, 10, [](double e) { return e < 0.11 ? 0.0 : 0.3 * (e - 0.1); }, none);
  EXPECT_NEAR(shear_peaks(made)->dilation_rate, 0.3, 1e-12);
}

// dem/tool/shear_peaks.hpp (2)
TEST(ShearPeaks, AreTakenOverTheFullWidthOrAllThereIs) {
  // Flat, but for the last two of 50 rows, which rise with slope 1: in the last full window, of 11
  // rows, offsets -5 to 5 of which the last two weigh 4 and 5 times 1 and 2, over 110.
  const auto late = [](double e) { return e > 0.0485 ? e - 0.048 : 0.0; };
  EXPECT_NEAR(shear_peaks(rows(0.001, 50, late, none))->dilation_rate, 14.0 / 110.0, 1e-9);
  // Six rows and the start, a kink: one window of them all, offsets -3 to 3, over 28.
  const auto kink = [](double e) { return e > 0.0035 ? e - 0.003 : 0.0; };
  EXPECT_NEAR(shear_peaks(rows(0.001, 6, kink, none))->dilation_rate, 14.0 / 28.0, 1e-9);
}

TEST(ShearPeaks, OfOneRowCountTheUnstrainedStart) {
  const ShearRow only{0.004, 0.001, 12.0};
  const ShearPeaks peaks = shear_peaks({&only, 1}).value();
  EXPECT_NEAR(peaks.dilation_rate, 0.25, 1e-12);
  EXPECT_EQ(peaks.strain_at_friction, 0.004);
}

TEST(ShearPeaks, OfARowWithoutStrainHaveNoRate) {
  const ShearRow only{0.0, 0.0, 3.0};
  EXPECT_EQ(shear_peaks({&only, 1})->dilation_rate, 0.0);
}

}  // namespace
