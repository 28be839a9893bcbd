// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <tangency/dem/micromechanics/contact_statistics.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>
#include <tangency/dem/micromechanics/rotation_models.hpp>

#include "fields.hpp"
#include "planted_bodies.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using std::numbers::pi;
using tangency::Mat3;
using tangency::Vec3;

double p2(double square) { return 1.5 * square - 0.5; }
double p4(double square) { return (35.0 * square * square - 30.0 * square + 3.0) / 8.0; }

/// cos^2 gamma of the normal at beta.
double normal_square(const Spheroid& s, double beta) {
  const double x = std::cos(beta) / (s.along * s.along), y = std::sin(beta) / (s.across * s.across);
  return x * x / (x * x + y * y);
}

const std::vector<double> kRatios = {1e-4,  1e-3,       0.02, 0.3,        0.8,   0.83, 0.9,
                                     0.999, 1.0 - 1e-9, 1.0,  1.0 + 1e-9, 1.001, 1.1,  1.19,
                                     1.2,   1.0 / 0.7,  3.0,  20.0,       1e3,   1e4};

/// The integral of f from 0 to pi/2, by the angle t whose tangent is 1/q times that of f's: of
/// needles and disks all changes near one end, and by t it does not.
template <typename Function>
double spread_integral(double q, Function f) {
  return integral(
      [&](double t) {
        const double c = std::cos(t), s = std::sin(t);
        return f(std::atan2(q * s, c)) * q / (c * c + q * q * s * s);
      },
      0.0, 0.5 * pi);
}

/// Over beta. tan(gamma) is ratio^2 tan(beta), and tan(t) lies halfway.
template <typename Function>
double over_beta(double ratio, Function f) {
  return spread_integral(1.0 / ratio, f);
}

// dem/micromechanics/rotation_models.hpp (1)
TEST(PlaneRotation, ClosedFormsAreTheIntegrals) {
  for (const double ratio : kRatios) {
    const Spheroid s{ratio, 1.0};
    const auto mean = [&](auto weight) {
      return 2.0 / pi * over_beta(ratio, [&](double b) {
               return weight(b) * (2.0 * normal_square(s, b) - 1.0);
             });
    };
    const PlaneRotation found = plane_rotation(s);
    EXPECT_NEAR(found.c1, -mean([](double) { return 1.0; }), 1e-12) << ratio;
    EXPECT_NEAR(found.c2, -mean([](double b) { return std::cos(2.0 * b); }), 1e-12) << ratio;
  }
  EXPECT_NEAR(plane_rotation({1e4, 1.0}).c1, 1.0 - 2e-8, 1e-12);
  EXPECT_NEAR(plane_rotation({1e4, 1.0}).c2 / -2e-8, 1.0, 1e-7);
}

// dem/micromechanics/rotation_models.hpp (2)
TEST(PlaneRotation, AnisotropyOfTheArcIsItsQuadrature) {
  for (const double ratio :
       {1e-4, 0.3, 0.9, 1.0, 1.0 + 1e-9, 1.001, 1.1, 1.19, 1.2, 2.0, 10.0, 1e4}) {
    const Spheroid s{ratio, 1.0};
    const auto over_arc = [&](bool weighted) {
      return integral(
          [&](double t) {
            const double x = s.along * std::cos(t), y = s.across * std::sin(t);
            const double arc = std::hypot(s.along * std::sin(t), s.across * std::cos(t));
            return arc * (weighted ? (x - y) * (x + y) / (x * x + y * y) : 1.0);
          },
          0.0, 0.5 * pi);
    };
    EXPECT_NEAR(arc_law_anisotropy(s), 2.0 * over_arc(true) / over_arc(false), 1e-12) << ratio;
  }
  EXPECT_NEAR(arc_law_anisotropy({1.0 + 1e-7, 1.0}) / (0.5e-7), 1.0, 1e-6);
  const Spheroid s{2.0, 1.0};
  EXPECT_NEAR(integral([&](double b) { return arc_law_density(s, b); }, 0.0, 2.0 * pi), 1.0, 1e-12);
}

TEST(PlaneRotation, TableOfTheSpecificationIsFound) {
  const std::array<std::array<double, 3>, 8> table{{{1.1, 0.0478, 0.0713},
                                                    {1.25, 0.1133, 0.1656},
                                                    {1.0 / 0.7, 0.18524, 0.2605},
                                                    {2.0, 0.38987, 0.4752},
                                                    {3.0, 0.67720, 0.6781},
                                                    {5.0, 1.0477, 0.8456},
                                                    {10.0, 1.4518, 0.9517},
                                                    {100.0, 1.9380, 0.9994}}};
  for (const auto& [ratio, a_l, factor] : table) {
    const double found = arc_law_anisotropy({ratio, 1.0});
    EXPECT_NEAR(found, a_l, 6e-5);
    EXPECT_NEAR(plane_rotation({ratio, 1.0}).factor(found), factor, 6e-5);
  }
}

// Erratum 3: the published text compares its two ways to a_l as if they were two methods.
// dem/micromechanics/rotation_models.hpp (3)
TEST(RotationModelsErrata, TheTwoPublishedWaysToTheLocalAnisotropyAreOne) {
  for (const double ratio : {1.1, 1.0 / 0.7, 3.0, 10.0})
    for (const int points : {3, 7, 36, 360}) {
      const Spheroid s{ratio, 1.0};
      EXPECT_NEAR(arc_law_anisotropy_by_integral(s, points),
                  arc_law_anisotropy_by_least_squares(s, points), 1e-12);
    }
  EXPECT_NEAR(arc_law_anisotropy_by_integral({1.0 / 0.7, 1.0}, 360),
              arc_law_anisotropy({1.0 / 0.7, 1.0}), 1e-12);
  EXPECT_THROW(arc_law_anisotropy_by_integral({2.0, 1.0}, 2), std::invalid_argument);
}

// dem/micromechanics/rotation_models.hpp (4)
TEST(SpaceRotation, ClosedFormsAreTheIntegrals) {
  for (const double ratio : kRatios) {
    const Spheroid s{ratio, 1.0};
    const auto mean = [&](auto f) {
      return over_beta(ratio, [&](double b) { return std::sin(b) * f(b, normal_square(s, b)); });
    };
    const auto local = [](double b) { return p2(std::cos(b) * std::cos(b)); };
    const SpaceRotation found = space_rotation(s);
    EXPECT_NEAR(found.c1, mean([](double, double g) { return p2(g); }), 1e-12) << ratio;
    EXPECT_NEAR(found.c2, mean([&](double b, double g) { return local(b) * p2(g); }), 1e-12);
    EXPECT_NEAR(found.d1, mean([](double, double g) { return p4(g); }), 1e-12) << ratio;
    EXPECT_NEAR(found.d2, mean([&](double b, double g) { return local(b) * p4(g); }), 1e-12);
  }
}

TEST(SpaceRotation, NeedlesDisksAndSpheresHaveTheirLimits) {
  const SpaceRotation needle = space_rotation({1e4, 1.0}), disk = space_rotation({1.0, 1e4});
  const double k = 1e-8;
  EXPECT_NEAR(needle.c1, -0.5, 1e-12);
  EXPECT_NEAR(needle.c2, 0.0, 1e-12);
  EXPECT_NEAR(needle.d1, 0.375, 1e-12);
  EXPECT_NEAR(needle.d2, 0.0, 1e-12);
  EXPECT_NEAR(disk.c1, 1.0 - 0.75 * pi * k, 1e-12);
  EXPECT_NEAR(disk.d1, 1.0 - 1.40625 * pi * k, 1e-12);
  for (const double a1 : {-1.0, 0.0, 0.75, 2.0}) {
    EXPECT_NEAR(needle.factors(a1).second, -0.5, 1e-12);
    EXPECT_NEAR(disk.factors(a1).second, 1.0, 1e-7);
    EXPECT_NEAR(disk.factors(a1).fourth, 1.0, 1e-7);
    EXPECT_NEAR(space_rotation({3.0, 3.0}).factors(a1).second, a1 / 5.0, 1e-14);
    EXPECT_NEAR(space_rotation({3.0, 3.0}).factors(a1).fourth, 0.0, 1e-14);
  }
  EXPECT_NEAR(rotation_by_area({1e4, 1.0}).second, -0.5, 1e-7);
  EXPECT_NEAR(rotation_by_area({1.0, 1e4}).second, 1.0, 1e-6);
  EXPECT_NEAR(rotation_by_area({1.0, 1e4}).fourth, 1.0, 1e-6);
}

// dem/micromechanics/rotation_models.hpp (5)
TEST(SpaceRotation, FactorsByAreaAreTheQuadratureOverTheSurface) {
  for (const double ratio : kRatios) {
    const Spheroid s{ratio, 1.0};
    const auto over = [&](auto f) {
      // By the eccentric angle from the equator; tan(gamma) is along/across over its tangent.
      return spread_integral(std::sqrt(ratio), [&](double t) {
        const double x = std::sin(t) / s.along, y = std::cos(t) / s.across;
        return std::hypot(x, y) * std::cos(t) * f(x * x / (x * x + y * y));
      });
    };
    const double area = over([](double) { return 1.0; });
    const RotationFactors found = rotation_by_area(s);
    EXPECT_NEAR(found.second, over(p2) / area, 1e-12) << ratio;
    EXPECT_NEAR(found.fourth, over(p4) / area, 1e-12) << ratio;
  }
}

TEST(SpaceRotation, TableOfTheSpecificationIsFound) {
  const std::array<std::array<double, 5>, 7> table{{{1.1, -0.07392, 0.18716, -0.0496, 0.0027},
                                                    {1.25, -0.16416, 0.16501, -0.1119, 0.0140},
                                                    {1.0 / 0.7, -0.24529, 0.13846, -0.1712, 0.0336},
                                                    {2.0, -0.38689, 0.07442, -0.2925, 0.1045},
                                                    {3.0, -0.46428, 0.02702, -0.3888, 0.1977},
                                                    {5.0, -0.49299, 0.00582, -0.4531, 0.2864},
                                                    {10.0, -0.49936, 0.00057, -0.4868, 0.3464}}};
  for (const auto& [ratio, c1, c2, second, fourth] : table) {
    const SpaceRotation found = space_rotation({ratio, 1.0});
    const RotationFactors area = rotation_by_area({ratio, 1.0});
    EXPECT_NEAR(found.c1, c1, 6e-6);
    EXPECT_NEAR(found.c2, c2, 6e-6);
    EXPECT_NEAR(area.second, second, 6e-5);
    EXPECT_NEAR(area.fourth, fourth, 6e-5);
  }
  const Spheroid s{1.0, 0.7};
  EXPECT_NEAR(space_rotation(s).factors(area_law_a1(s)).second, -0.1740, 6e-5);
}

// The addition theorem: normals at the angle gamma all round an axis.
TEST(SpaceRotation, NormalsAllRoundAnAxisHaveItsTensorsTimesTheFactors) {
  Random random(81);
  for (int i = 0; i < 20; ++i) {
    const Mat3 frame = random_rotation(random);
    const Vec3 u = frame.col(0);
    const double gamma = uniform(random, 0.0, pi), c = std::cos(gamma);
    Mat3 second = Mat3::Zero();
    SymmetricTensor4 fourth;
    constexpr int turns = 16;
    for (int turn = 0; turn < turns; ++turn) {
      const double angle = 2.0 * pi * turn / turns;
      const Vec3 n = c * u + std::sin(gamma) * (std::cos(angle) * Vec3(frame.col(1)) +
                                                std::sin(angle) * Vec3(frame.col(2)));
      second += n * n.transpose() / turns;
      fourth += 1.0 / turns * SymmetricTensor4::power(n);
    }
    const Mat3 axis = u * u.transpose();
    EXPECT_LT((harmonic_part(second) - p2(c * c) * harmonic_part(axis)).norm(), 1e-14);
    EXPECT_LT(
        distance(harmonic_part(fourth), p4(c * c) * harmonic_part(SymmetricTensor4::power(u))),
        1e-14);
  }
}

}  // namespace
