// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ios>
#include <numbers>
#include <vector>

#include <tangency/dem/lanes/elementary.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/dem/samples/body_sizes.hpp>

namespace tangency::testing {
namespace {

using dem::BodyRatios;
using dem::BodySizes;
using dem::Shape;
using Rule = dem::BodySizes::Rule;

std::vector<double> radii_of(const BodySizes& sizes, std::size_t count) {
  std::vector<double> radii;
  for (const Shape& shape : dem::shapes_of(sizes, {}, count, 3)) radii.push_back(shape.mean_radius);
  return radii;
}

double mean_of(const std::vector<double>& numbers) {
  double sum = 0.0;
  for (const double x : numbers) sum += x;
  return sum / static_cast<double>(numbers.size());
}

double deviation_of(const std::vector<double>& numbers) {
  const double mean = mean_of(numbers);
  double sum = 0.0;
  for (const double x : numbers) sum += (x - mean) * (x - mean);
  return std::sqrt(sum / static_cast<double>(numbers.size()));
}

TEST(NormalQuantile, GivesBackTheShareBelowIt) {
  for (double share = 1e-7; share < 1.0 - 1e-7; share += 1.3e-3) {
    const double z = dem::normal_quantile(share);
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::numbers::sqrt2), share, 1e-9 * density + 1e-16) << share;
  }
  EXPECT_EQ(dem::normal_quantile(0.5), 0.0);
  EXPECT_EQ(dem::normal_quantile(0.25), -dem::normal_quantile(0.75));
}

TEST(BodySizes, UniformOnesHaveTheMeanAndTheWidth) {
  const auto radii = radii_of({Rule::uniform, 2.0, 0.25}, 1000);
  EXPECT_NEAR(mean_of(radii), 2.0, 1e-12);
  EXPECT_NEAR(deviation_of(radii), 0.5 / std::sqrt(3.0), 1e-6);
  EXPECT_GT(radii.front(), 1.5);
  EXPECT_LT(radii.back(), 2.5);
}

// A normal distribution cut at -z and z has the variance 1 - 2 z f(z) / (1 - 2 tails).
TEST(BodySizes, NormalOnesHaveTheMeanAndTheDeviationOfTheCutDistribution) {
  const double tails = 0.02, z = dem::normal_quantile(1.0 - tails);
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  const auto radii = radii_of({Rule::normal, 3.0, 0.1, tails}, 10000);
  EXPECT_NEAR(mean_of(radii), 3.0, 1e-9);
  EXPECT_NEAR(deviation_of(radii), 0.3 * std::sqrt(1.0 - 2.0 * z * density / (1.0 - 2.0 * tails)),
              1e-5);
}

TEST(BodySizes, LognormalOnesHaveTheMedianAndNormalLogarithms) {
  auto lognormal = radii_of({Rule::lognormal, 0.5, 0.4}, 2001);
  const auto normal = radii_of({Rule::normal, 1.0, 0.4}, 2001);
  EXPECT_NEAR(lognormal[1000], 0.5, 1e-15);
  for (std::size_t i = 0; i < lognormal.size(); ++i)
    ASSERT_NEAR(std::log(lognormal[i] / 0.5), normal[i] - 1.0, 1e-14);
}

/// Share of the mass that passes an opening.
double passing(const std::vector<Shape>& shapes, double opening, int dimensions) {
  double all = 0.0, through = 0.0;
  for (const Shape& shape : shapes) {
    const double mass = dem::volume_of(shape.semi_axes(dimensions), dimensions);
    all += mass;
    if (dem::sieve_opening(shape, dimensions) <= opening) through += mass;
  }
  return through / all;
}

// dem/samples/body_sizes.hpp (1)
// One particle of the opening more or less, of the mass of all.
TEST(BodySizes, OfASieveCurvePassTheSievesByItsMasses) {
  BodySizes sizes;
  sizes.rule = Rule::sieve;
  sizes.openings = {0.001, 0.002, 0.004, 0.006};
  sizes.passing = {0.0, 0.3, 0.3, 1.0};
  for (const int dimensions : {2, 3}) {
    BodyRatios ratios;
    ratios.elongation = {1.5, 1.5};
    if (dimensions == 3) ratios.flatness = {1.2, 1.2};
    const auto shapes = dem::shapes_of(sizes, ratios, 3000, dimensions);
    double all = 0.0, largest = 0.0;
    for (const Shape& shape : shapes) {
      const double mass = dem::volume_of(shape.semi_axes(dimensions), dimensions);
      all += mass;
      largest = std::max(largest, mass);
    }
    for (std::size_t k = 0; k < sizes.openings.size(); ++k)
      EXPECT_NEAR(passing(shapes, sizes.openings[k] * (1.0 + 1e-12), dimensions), sizes.passing[k],
                  2.0 * largest / all)
          << dimensions << ' ' << k;
    // Between two openings: linear in the logarithm.
    EXPECT_NEAR(passing(shapes, 0.001 * std::numbers::sqrt2, dimensions), 0.15,
                2.0 * largest / all);
  }
}

BodySizes three_sieves() {
  BodySizes sieve;
  sieve.rule = Rule::sieve;
  sieve.openings = {0.5, 1.0, 4.0};
  sieve.passing = {0.0, 0.25, 1.0};
  return sieve;
}

BodyRatios some_ratios() {
  BodyRatios ratios;
  ratios.elongation = {1.25, 2.0};
  ratios.flatness = {1.0, 1.5};
  return ratios;
}

// dem/samples/body_sizes.hpp (2)
TEST(BodySizes, LieWithinTheEndsOfTheirDistribution) {
  const double tails = 0.05, z = dem::normal_quantile(1.0 - tails);
  const BodySizes sieve = three_sieves();
  const BodyRatios ratios = some_ratios();
  const auto hold = [&](const BodySizes& sizes, double least, double most) {
    for (const std::size_t count : {1u, 2u, 777u}) {
      for (const Shape& shape : dem::shapes_of(sizes, ratios, count, 3)) {
        const bool sieved = sizes.rule == Rule::sieve;
        const double size = sieved ? dem::sieve_opening(shape, 3) : shape.mean_radius;
        ASSERT_GE(size, least * (1.0 - 1e-14));
        ASSERT_LE(size, most * (1.0 + 1e-14));
        ASSERT_TRUE(shape.elongation >= 1.25 && shape.elongation <= 2.0) << shape.elongation;
        ASSERT_TRUE(shape.flatness >= 1.0 && shape.flatness <= 1.5) << shape.flatness;
      }
    }
  };
  hold({Rule::equal, 3.0}, 3.0, 3.0);
  hold({Rule::uniform, 2.0, 0.25}, 1.5, 2.5);
  hold({Rule::normal, 2.0, 0.5, tails}, 2.0 - z, 2.0 + z);
  hold({Rule::lognormal, 2.0, 0.5, tails}, 2.0 * std::exp(-0.5 * z), 2.0 * std::exp(0.5 * z));
  hold(sieve, 0.5, 4.0);
  // The smallest of as many as there are is above 0 up to this deviation.
  for (const double size : radii_of({Rule::normal, 1.0, 0.999 / z, tails}, 100000))
    ASSERT_GT(size, 0.0);
}

// dem/samples/body_sizes.hpp (3)
TEST(BodySizes, AreTheSameBitsOnEveryMachine) {
  const BodySizes sieve = three_sieves();
  const BodyRatios ratios = some_ratios();
  const auto hold = [&](const BodySizes& sizes, const Shape& wanted) {
    const Shape shape = dem::shapes_of(sizes, ratios, 1000, 3)[777];
    EXPECT_EQ(shape.mean_radius, wanted.mean_radius) << std::hexfloat << shape.mean_radius;
    EXPECT_EQ(shape.elongation, wanted.elongation) << std::hexfloat << shape.elongation;
    EXPECT_EQ(shape.flatness, wanted.flatness) << std::hexfloat << shape.flatness;
  };
  const double e = 0x1.f023551a28dp+0, f = 0x1.0681797ee1e8p+0;
  hold({Rule::uniform, 2.0, 0.25}, {0x1.23851eb851eb8p+1, e, f});
  hold({Rule::normal, 2.0, 0.5}, {0x1.5d0fb973220e6p+1, e, f});
  hold({Rule::lognormal, 2.0, 0.5}, {0x1.703a055d3cbf4p+1, e, f});
  hold(sieve, {0x1.1dd17c3ef459cp-1, e, f});
}

// The shadow of an ellipsoid along its longest axis, turned by an eighth, is as wide as it is high.
TEST(SieveOpening, IsTheNarrowestSquareThroughWhichTheBodyGoes) {
  const Shape shape{1.0, 2.0, 1.7};
  const Vec3 axes = shape.semi_axes();
  const auto square = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return 2.0 *
           std::max(std::hypot(axes[1] * c, axes[2] * s), std::hypot(axes[1] * s, axes[2] * c));
  };
  double narrowest = square(0.0);
  for (int k = 0; k <= 1000; ++k)
    narrowest = std::min(narrowest, square(0.5e-3 * std::numbers::pi * k));
  EXPECT_NEAR(dem::sieve_opening(shape, 3), narrowest, 1e-12);
}

TEST(BodyRatios, AreUniformAndIndependentOfEachOtherAndOfSize) {
  BodyRatios ratios;
  ratios.elongation = {1.0, 3.0};
  ratios.flatness = {1.0, 2.0};
  const auto shapes = dem::shapes_of({Rule::uniform, 1.0, 0.5}, ratios, 4000, 3);
  std::vector<double> r, e, f;
  for (const Shape& shape : shapes) {
    r.push_back((shape.mean_radius - 1.0) / 0.5);
    e.push_back(shape.elongation - 2.0);
    f.push_back(2.0 * shape.flatness - 3.0);
  }
  // Uniform on [-1, 1]: mean 0, variance 1/3; products of two have the mean 0.
  const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum / static_cast<double>(a.size());
  };
  for (const auto* one : {&r, &e, &f}) {
    EXPECT_NEAR(mean_of(*one), 0.0, 2e-3);
    EXPECT_NEAR(product(*one, *one), 1.0 / 3.0, 2e-3);
  }
  EXPECT_NEAR(product(r, e), 0.0, 2e-3);
  EXPECT_NEAR(product(r, f), 0.0, 2e-3);
  EXPECT_NEAR(product(e, f), 0.0, 2e-3);
}

}  // namespace
}  // namespace tangency::testing
