// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <tangency/dem/micromechanics/direction_integrals.hpp>

#include "fields.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using tangency::Mat3;
using tangency::Vec3;

// dem/micromechanics/direction_integrals.hpp (1)
TEST(DirectionIntegrals, PairingSumsFollowTheirRecursion) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<int> indices(2 * static_cast<std::size_t>(uniform(random, 1.0, 6.0)));
    for (int& index : indices) index = static_cast<int>(uniform(random, 1.0, 4.0));
    double sum = 0.0;
    for (std::size_t k = 1; k < indices.size(); ++k) {
      if (indices[k] != indices[0]) continue;
      std::vector<int> rest(indices.begin() + 1, indices.end());
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k) - 1);
      sum += pairing_sum(rest);
    }
    EXPECT_EQ(pairing_sum(indices), sum);
  }
}

// Erratum 13: the tensors are those of appendix C, with these prefactors and numbers of terms.
TEST(DirectionIntegrals, PairingSumsOverTheirPrefactorAreAveragesOverTheSphere) {
  EXPECT_EQ(pairing_sum(std::vector<int>(2, 1)), 1.0);
  EXPECT_EQ(pairing_sum(std::vector<int>(4, 1)), 3.0);
  EXPECT_EQ(pairing_sum(std::vector<int>(6, 1)), 15.0);
  EXPECT_EQ(pairing_sum(std::vector<int>(8, 1)), 105.0);
  EXPECT_NEAR(pairing_sum(std::vector<int>{0, 2, 0, 0, 2, 0}) / 105.0, sphere_average(4, 0, 2),
              1e-16);
  EXPECT_EQ(pairing_sum({}), 1.0);
  EXPECT_EQ(pairing_sum(std::vector<int>{0, 1}), 0.0);
}

TEST(DirectionIntegrals, AveragesOfPowersAreThoseOfQuadrature) {
  for (int p = 0; p <= 8; ++p)
    for (int q = 0; q <= 8; ++q) {
      const auto powers = [&](const Vec3& n, int r) {
        return std::pow(n[0], p) * std::pow(n[1], q) * std::pow(n[2], r);
      };
      for (int r = 0; r <= 8; ++r)
        EXPECT_NEAR(sphere_average(p, q, r),
                    mean_over(sphere_points(), [&](const Vec3& n) { return powers(n, r); }), 1e-14)
            << p << q << r;
      EXPECT_NEAR(circle_average(p, q),
                  mean_over(circle_points(), [&](const Vec3& n) { return powers(n, 0); }), 1e-14);
    }
}

// dem/micromechanics/direction_integrals.hpp (2)
TEST(DirectionIntegrals, HigherAveragesAddUpToThoseOfLowerOrder) {
  for (int p = 0; p <= 400; p += 40)
    for (int q = 0; q <= 60; q += 12)
      for (int r = 0; r <= 6; r += 2) {
        const double lower = sphere_average(p, q, r);
        EXPECT_NEAR((sphere_average(p + 2, q, r) + sphere_average(p, q + 2, r) +
                     sphere_average(p, q, r + 2)) /
                        lower,
                    1.0, 1e-12);
        EXPECT_NEAR((circle_average(p + 2, q) + circle_average(p, q + 2)) / circle_average(p, q),
                    1.0, 1e-12);
      }
  EXPECT_THROW(sphere_average(2, -2, 0), std::invalid_argument);
  EXPECT_THROW(circle_average(-1, 0), std::invalid_argument);
}

TEST(DirectionIntegrals, AveragesWithTensorsAreThoseOfQuadrature) {
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 a = random_second(random, 1.0), b = random_second(random, 1.0),
               c = random_second(random, 1.0);
    const auto along = [](const Mat3& x, const Vec3& n) { return n.dot(x * n); };
    const auto mean = [&](auto factor) {
      return mean_over(sphere_points(),
                       [&](const Vec3& n) { return Mat3(factor(n) * n * n.transpose()); });
    };
    const Mat3 of_one = mean([&](const Vec3& n) { return along(a, n); });
    const Mat3 of_two = mean([&](const Vec3& n) { return along(a, n) * along(b, n); });
    const Mat3 of_three =
        mean([&](const Vec3& n) { return along(a, n) * along(b, n) * along(c, n); });
    EXPECT_LT((average_with(a) - of_one).norm(), 1e-14);
    EXPECT_LT((average_with(a, b) - of_two).norm(), 1e-14);
    EXPECT_LT((average_with(a, b, c) - of_three).norm(), 1e-14);
  }
}

}  // namespace
