// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <tangency/dem/lanes/elementary.hpp>
#include <tangency/dem/lanes/particle_lanes.hpp>

namespace tangency::testing {
namespace {

using Long = long double;

constexpr std::uint64_t kSeed = 20261130;

double ulps(double is, Long truth) {
  const auto size = static_cast<double>(std::abs(truth));
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::abs(Long(is) - truth)) / ulp;
}

/// From 2^-1021 to 2^1023, every third of them within 2^-k of 1.
double some_number(std::mt19937_64& random, int index) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  if (index % 3 == 0) return 1.0 + std::ldexp(uniform(random), -1 - index % 50);
  return std::ldexp(1.5 + 0.5 * uniform(random), static_cast<int>(1021.0 * uniform(random)));
}

TEST(Elementary, LogarithmIsWithinItsBoundOfTheTruth) {
  std::mt19937_64 random(kSeed);
  double largest = 0.0;
  for (int k = 0; k < 300000; ++k) {
    const double x = some_number(random, k);
    const double error =
        x == 1.0 ? std::abs(dem::logarithm(x)) : ulps(dem::logarithm(x), std::log(Long(x)));
    largest = std::max(largest, error);
    ASSERT_LE(error, dem::kLogarithmError) << x;
  }
  RecordProperty("largest_error_millionths_ulp", static_cast<int>(1e6 * largest));
  EXPECT_GT(largest, 0.5) << "the truth is not the same arithmetic";
  EXPECT_EQ(dem::logarithm(1.0), 0.0);
  EXPECT_EQ(dem::logarithm(0.0), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(dem::logarithm(-1.0)));
}

TEST(Elementary, ExponentialIsWithinItsBoundOfTheTruth) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double largest = 0.0;
  for (int k = 0; k < 300000; ++k) {
    const double x = (k % 3 == 0 ? 700.0 : k % 3 == 1 ? 2.0 : 1e-3) * uniform(random);
    const double error = ulps(dem::exponential(x), std::exp(Long(x)));
    largest = std::max(largest, error);
    ASSERT_LE(error, dem::kExponentialError) << x;
  }
  RecordProperty("largest_error_millionths_ulp", static_cast<int>(1e6 * largest));
  EXPECT_GT(largest, 0.5) << "the truth is not the same arithmetic";
  EXPECT_EQ(dem::exponential(0.0), 1.0);
}

TEST(Elementary, CubeRootIsTheDoubleNearestToTheTruth) {
  std::mt19937_64 random(kSeed);
  for (int k = 0; k < 300000; ++k) {
    const double x = (k % 2 == 0 ? 1.0 : -1.0) * some_number(random, k);
    // That of long double is itself off by up to 2^-10 of a double's ulp.
    ASSERT_LE(ulps(dem::cube_root(x), std::cbrt(Long(x))), 0.5 + 0x1p-9) << x;
  }
  for (int k = 1; k < 2000; ++k) ASSERT_EQ(dem::cube_root(1.0 * k * k * k), k);
  EXPECT_EQ(dem::cube_root(0.0), 0.0);
  EXPECT_LE(ulps(dem::cube_root(0x1p-1074), std::cbrt(Long(0x1p-1074))), 0.5 + 0x1p-9);
  EXPECT_LE(ulps(dem::logarithm(0x3p-1073), std::log(Long(0x3p-1073))), dem::kLogarithmError);
}

TEST(Elementary, CosineAndSineAreWithinTheirBoundOfTheTruth) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform(-7.0, 7.0);
  for (int k = 0; k < 100000; ++k) {
    const double x = uniform(random);
    const auto [cosine, sine] = dem::cosine_sine(x);
    ASSERT_LE(ulps(cosine, std::cos(Long(x))), detail::kSineError) << x;
    ASSERT_LE(ulps(sine, std::sin(Long(x))), detail::kSineError) << x;
  }
}

}  // namespace
}  // namespace tangency::testing
