// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <tangency/dem/micromechanics/sphere_partition.hpp>

#include "fields.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using std::numbers::pi;
using tangency::Vec3;

struct Spread {
  double least, most, mean, variation, sum;
};

Spread spread_of(const SpherePartition& partition) {
  Spread s{1e300, 0.0, 0.0, 0.0, 0.0};
  for (std::size_t g = 0; g < partition.size(); ++g) {
    s.least = std::min(s.least, partition.area(g));
    s.most = std::max(s.most, partition.area(g));
    s.sum += partition.area(g);
  }
  s.mean = s.sum / static_cast<double>(partition.size());
  double squares = 0.0;
  for (std::size_t g = 0; g < partition.size(); ++g)
    squares += std::pow(partition.area(g) / s.mean - 1.0, 2);
  s.variation = std::sqrt(squares / static_cast<double>(partition.size()));
  return s;
}

std::vector<SpherePartition> partitions() {
  std::vector<SpherePartition> all;
  for (int n = 1; n <= 12; ++n) all.push_back(SpherePartition::near_uniform(n));
  all.push_back(SpherePartition::near_uniform(40));
  all.push_back(SpherePartition::polar(18, 36));
  all.push_back(SpherePartition::polar(7, 10, Vec3(1.0, -2.0, 0.5)));
  all.push_back(SpherePartition::polar(1, 36));
  return all;
}

// dem/micromechanics/sphere_partition.hpp (1)
TEST(SpherePartition, AreasAddUpToTheSphere) {
  for (const SpherePartition& partition : partitions())
    EXPECT_NEAR(spread_of(partition).sum, 4.0 * pi, 1e-12) << partition.size();
}

// Directions along edges, diagonals and axes among random ones: what is drawn ends on borders.
std::vector<Vec3> hostile_directions() {
  std::vector<Vec3> all;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (x != 0 || y != 0 || z != 0) all.emplace_back(Vec3(x, y, z).normalized());
  for (int i = 1; i < 4; ++i)
    for (const double off : {-1e-16, 0.0, 1e-16}) {
      const double edge = std::tan(pi * i / 16.0) + off;
      for (const double other : {0.0, -0.0, edge, 0.1})
        for (const double side : {1.0, -1.0}) {
          all.emplace_back(side, edge, other);
          all.emplace_back(other, side, -edge);
          all.emplace_back(edge, other, side);
        }
    }
  Random random(21);
  for (int i = 0; i < 500; ++i) all.push_back(random_direction(random));
  return all;
}

// dem/micromechanics/sphere_partition.hpp (2)
TEST(SpherePartition, OppositeDirectionsAreOfOppositeClasses) {
  for (const SpherePartition& partition : partitions())
    for (const Vec3& n : hostile_directions()) {
      const std::size_t g = partition.class_of(n);
      ASSERT_LT(g, partition.size());
      ASSERT_EQ(partition.class_of(-n), partition.opposite(g)) << n.transpose();
      ASSERT_EQ(partition.opposite(partition.opposite(g)), g);
    }
}

// dem/micromechanics/sphere_partition.hpp (3)
TEST(SpherePartition, TheMiddleOfAClassIsInIt) {
  for (const SpherePartition& partition : partitions())
    for (std::size_t g = 0; g < partition.size(); ++g) {
      ASSERT_EQ(partition.class_of(partition.direction(g)), g);
      ASSERT_NEAR(partition.direction(g).norm(), 1.0, 1e-15);
      ASSERT_EQ(partition.direction(partition.opposite(g)), -partition.direction(g));
    }
}

TEST(SpherePartition, DirectionsAreAtTheMiddleOfTheirClassesByAngles) {
  for (const double angle : {1.0, 3.0, 5.0, 7.0}) {
    const double u = angle * pi / 32.0;
    const Vec3 n = Vec3(1.0, std::tan(u), -std::tan(pi / 32.0)).normalized();
    const SpherePartition cube = SpherePartition::near_uniform(4);
    EXPECT_LT((cube.direction(cube.class_of(n)) - n).norm(), 1e-15);
    const double beta = angle * pi / 18.0, alpha = 5.0 * pi / 4.0;
    const Vec3 m(std::sin(beta) * std::cos(alpha), std::sin(beta) * std::sin(alpha),
                 std::cos(beta));
    const SpherePartition rings = SpherePartition::polar(9, 4);
    EXPECT_LT((rings.direction(rings.class_of(m)) - m).norm(), 1e-15);
  }
}

TEST(SpherePartition, EdgesBelongToTheOuterClassAndTiesToTheFirstAxis) {
  const SpherePartition partition = SpherePartition::near_uniform(4);
  for (int i = 1; i < 4; ++i) {
    const double edge = std::tan(0.25 * pi * i / 4);
    const auto at = [&](double tangent) { return partition.class_of(Vec3(1.0, tangent, 0.1)); };
    EXPECT_EQ(at(edge), at(edge + 1e-9));
    EXPECT_NE(at(edge), at(std::nextafter(edge, 0.0)));
  }
  const std::size_t tie = partition.class_of(Vec3(1.0, 1.0, 0.3));
  EXPECT_EQ(tie, partition.class_of(Vec3(1.0, 1.0 - 1e-9, 0.3)));
  EXPECT_NE(tie, partition.class_of(Vec3(1.0 - 1e-9, 1.0, 0.3)));
}

TEST(SpherePartition, ClassesGetDirectionsInProportionToTheirAreas) {
  Random random(22);
  constexpr int count = 200000;
  for (const auto& partition :
       {SpherePartition::near_uniform(3), SpherePartition::polar(6, 8, Vec3(1.0, 2.0, 3.0))}) {
    std::vector<double> seen(partition.size(), 0.0);
    for (int i = 0; i < count; ++i) seen[partition.class_of(random_direction(random))] += 1.0;
    double chi_squared = 0.0;
    for (std::size_t g = 0; g < seen.size(); ++g) {
      const double expected = count * partition.area(g) / (4.0 * pi);
      chi_squared += (seen[g] - expected) * (seen[g] - expected) / expected;
    }
    const auto freedom = static_cast<double>(partition.size() - 1);
    EXPECT_NEAR(chi_squared, freedom, 4.0 * std::sqrt(2.0 * freedom));
  }
}

TEST(SpherePartition, SymmetriesOfTheCubeTakeClassesToClasses) {
  Random random(23);
  const SpherePartition partition = SpherePartition::near_uniform(4);
  std::array<int, 3> axes = {0, 1, 2};
  do
    for (int signs = 0; signs < 8; ++signs) {
      std::map<std::size_t, std::size_t> image;
      for (int i = 0; i < 2000; ++i) {
        const Vec3 n = random_direction(random);
        Vec3 m;
        for (int k = 0; k < 3; ++k)
          m[k] = n[axes[static_cast<std::size_t>(k)]] * ((signs >> k & 1) != 0 ? -1.0 : 1.0);
        const std::size_t g = partition.class_of(n), there = partition.class_of(m);
        const auto [at, first] = image.emplace(g, there);
        ASSERT_TRUE(first || at->second == there);
        ASSERT_NEAR(partition.area(g), partition.area(there), 1e-15);
      }
    }
  while (std::next_permutation(axes.begin(), axes.end()));
}

TEST(SpherePartition, PublishedPolarPartitionIsUneven) {
  const Spread s = spread_of(SpherePartition::polar(18, 36));
  EXPECT_EQ(SpherePartition::polar(18, 36).size(), 648U);
  EXPECT_NEAR(s.most / s.least, 11.43, 0.005);
  EXPECT_NEAR(s.least / s.mean, 0.137, 0.0005);
  EXPECT_NEAR(s.most / s.mean, 1.563, 0.0005);
  EXPECT_NEAR(s.variation, 0.480, 0.0005);
}

// Erratum 1: the published text calls N = 3 and 4 the most uniform.
TEST(SpherePartitionErrata, UniformityFallsWithNAndOneIsExact) {
  const std::array<double, 6> ratio = {1.0, 1.199, 1.252, 1.278, 1.304, 1.322};
  const std::array<double, 6> variation = {0.0, 0.0723, 0.0819, 0.0853, 0.0868, 0.0877};
  for (int n = 1; n <= 6; ++n) {
    const Spread s = spread_of(SpherePartition::near_uniform(n));
    EXPECT_NEAR(s.most / s.least, ratio[static_cast<std::size_t>(n - 1)], 0.0006) << n;
    EXPECT_NEAR(s.variation, variation[static_cast<std::size_t>(n - 1)], 0.00006) << n;
  }
  double before = 0.0, ratio_before = 0.0;
  for (int n = 1; n <= 12; ++n) {
    const Spread s = spread_of(SpherePartition::near_uniform(n));
    EXPECT_GT(s.most / s.least, ratio_before);
    EXPECT_LT(s.most / s.least, std::sqrt(2.0));
    EXPECT_GT(s.variation, n == 1 ? -1.0 : before);
    before = s.variation;
    ratio_before = s.most / s.least;
  }
  EXPECT_LT(spread_of(SpherePartition::near_uniform(1)).variation, 1e-14);
  const Spread four = spread_of(SpherePartition::near_uniform(4));
  EXPECT_NEAR(four.least / four.mean, 0.9104, 0.00005);
  EXPECT_NEAR(four.most / four.mean, 1.1633, 0.00005);
}

TEST(SpherePartition, WrongNumbersAreRefused) {
  EXPECT_THROW(SpherePartition::near_uniform(0), std::invalid_argument);
  EXPECT_THROW(SpherePartition::near_uniform(1001), std::invalid_argument);
  EXPECT_THROW(SpherePartition::polar(0, 4), std::invalid_argument);
  EXPECT_THROW(SpherePartition::polar(4, 5), std::invalid_argument);
  EXPECT_THROW(SpherePartition::polar(4, 4, Vec3::Zero()), std::invalid_argument);
  EXPECT_THROW(
      SpherePartition::polar(4, 4, Vec3::Constant(std::numeric_limits<double>::infinity())),
      std::invalid_argument);
}

}  // namespace
