// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <tangency/dem/micromechanics/harmonics.hpp>

#include "fields.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using tangency::Mat3;
using tangency::Vec3;

SymmetricTensor4 random_symmetric(Random& random) {
  SymmetricTensor4 t;
  for (double& component : t.components) component = normal(random);
  return t;
}

TEST(Harmonics, ContractionsOfASymmetricTensorAreSumsOverItsComponents) {
  Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    const SymmetricTensor4 t = random_symmetric(random), other = random_symmetric(random);
    const Vec3 n = random_direction(random);
    double along = 0.0, all = 0.0;
    Vec3 vector = Vec3::Zero();
    Mat3 trace = Mat3::Zero();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) {
          trace(i, j) += t(i, j, k, k);
          for (int l = 0; l < 3; ++l) {
            along += t(i, j, k, l) * n[i] * n[j] * n[k] * n[l];
            vector[i] += t(i, j, k, l) * n[j] * n[k] * n[l];
            all += t(i, j, k, l) * other(l, i, k, j);
          }
        }
    EXPECT_NEAR(t.along(n), along, 1e-13);
    EXPECT_LT((t.vector_along(n) - vector).norm(), 1e-13);
    EXPECT_LT((t.trace() - trace).norm(), 1e-13);
    EXPECT_NEAR(t.contracted(other), all, 1e-12);
    EXPECT_NEAR(SymmetricTensor4::power(n).contracted(t), along, 1e-13);
  }
}

TEST(Harmonics, SymmetrisedIsTheMeanOverAllOrdersOfIndices) {
  Random random(12);
  const Vec3 v = random_direction(random), n = random_direction(random);
  std::array<double, 81> product{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          product[static_cast<std::size_t>(((i * 3 + j) * 3 + k) * 3 + l)] =
              v[i] * n[j] * n[k] * n[l];
  EXPECT_LT(distance(SymmetricTensor4::symmetrised(product), SymmetricTensor4::product(v, n)),
            1e-15);
  EXPECT_LT(distance(SymmetricTensor4::product(n, n), SymmetricTensor4::power(n)), 1e-15);
}

// dem/micromechanics/harmonics.hpp (1) (2)
TEST(Harmonics, HarmonicPartsAreProjectionsWithoutTrace) {
  Random random(13);
  for (int trial = 0; trial < 20; ++trial) {
    const SymmetricTensor4 t = random_symmetric(random), part = harmonic_part(t);
    EXPECT_LT(part.trace().norm(), 1e-14);
    EXPECT_LT(distance(harmonic_part(part), part), 1e-14);
    EXPECT_NEAR(part.contracted(t - part), 0.0, 1e-13);
    const Mat3 a = random_second(random, 1.0);
    EXPECT_LT((harmonic_part(a) - a).norm(), 1e-15);
    Mat3 rest = random_rotation(random);
    rest = (rest - rest.transpose()).eval() + 2.0 * Mat3::Identity();
    EXPECT_LT(harmonic_part(rest).norm(), 1e-15);
  }
}

// Another way to the published factors: their formula (2.62) with R' = R - isotropic parts.
TEST(Harmonics, PublishedFormOfTheFourthOrderTensorIsTheSame) {
  Random random(14);
  SymmetricTensor4 moment;
  for (int i = 0; i < 7; ++i)
    moment += 1.0 / 7.0 * SymmetricTensor4::power(random_direction(random));
  const Mat3 second = moment.trace() - Mat3::Identity() / 3.0;
  const auto delta = [](int i, int j) { return i == j ? 1.0 : 0.0; };
  std::array<double, 81> published{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) {
          const double isotropic =
              delta(i, j) * delta(k, l) + delta(i, k) * delta(j, l) + delta(i, l) * delta(j, k);
          const double mixed = delta(i, j) * second(k, l) + delta(i, k) * second(j, l) +
                               delta(i, l) * second(j, k) + delta(j, k) * second(i, l) +
                               delta(j, l) * second(i, k) + delta(k, l) * second(i, j);
          published[static_cast<std::size_t>(((i * 3 + j) * 3 + k) * 3 + l)] =
              moment(i, j, k, l) - isotropic / 15.0 - mixed / 7.0;
        }
  EXPECT_LT(distance(SymmetricTensor4::symmetrised(published), harmonic_part(moment)), 1e-15);
}

TEST(Harmonics, BasesAreOrthonormalAndWithoutTrace) {
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j) {
      EXPECT_NEAR((second_basis()[i] * second_basis()[j]).trace(), i == j ? 1.0 : 0.0, 1e-15);
      EXPECT_NEAR(second_basis()[i].trace(), 0.0, 1e-15);
    }
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j) {
      EXPECT_NEAR(fourth_basis()[i].contracted(fourth_basis()[j]), i == j ? 1.0 : 0.0, 1e-14);
      EXPECT_LT(fourth_basis()[i].trace().norm(), 1e-14);
    }
}

TEST(Harmonics, ProjectionsOfTheModelsGiveTheirTensorsBack) {
  Random random(15);
  for (int trial = 0; trial < 10; ++trial) {
    const Planted planted = random_planted(random, true);
    const ScalarHarmonics& f = planted.force;
    const TangentialHarmonics& t = planted.tangential_force;
    const Mat3 fn = mean_over(sphere_points(),
                              [&](const Vec3& n) { return Mat3(f.value(n) * n * n.transpose()); });
    const Mat3 ft =
        mean_over(sphere_points(), [&](const Vec3& n) { return Mat3(t.value(n) * n.transpose()); });
    const auto fn4 = mean_over(
        sphere_points(), [&](const Vec3& n) { return f.value(n) * SymmetricTensor4::power(n); });
    const auto ft4 = mean_over(
        sphere_points(), [&](const Vec3& n) { return SymmetricTensor4::product(t.value(n), n); });
    EXPECT_NEAR(fn.trace(), f.mean, 1e-13);
    EXPECT_LT((7.5 / f.mean * harmonic_part(fn) - f.second).norm(), 1e-12);
    EXPECT_LT(distance(315.0 / 8.0 / f.mean * harmonic_part(fn4), f.fourth), 1e-12);
    EXPECT_LT((5.0 / t.mean * ft - t.second).norm(), 1e-12);
    EXPECT_LT(distance(31.5 / t.mean * harmonic_part(ft4), t.fourth), 1e-12);
  }
}

TEST(Harmonics, TangentialFieldIsTheGradientOnTheSphere) {
  Random random(16);
  for (int trial = 0; trial < 20; ++trial) {
    const TangentialHarmonics t = random_planted(random, true).tangential_force;
    const Vec3 n = random_direction(random);
    const Vec3 u = n.cross(random_direction(random)).normalized();
    const auto potential = [&](double s) {
      const Vec3 m = std::cos(s) * n + std::sin(s) * u;
      return t.mean * (m.dot(t.second * m) / 2.0 + t.fourth.along(m) / 4.0);
    };
    const double h = 1e-4;
    EXPECT_NEAR(t.value(n).dot(u), (potential(h) - potential(-h)) / (2.0 * h), 1e-6);
    EXPECT_NEAR(t.value(n).dot(n), 0.0, 1e-14);
    EXPECT_LT((t.value(-n) + t.value(n)).norm(), 1e-14);
  }
}

TEST(Harmonics, RadialComponentIsTheMeanOverTurnsAboutTheAxis) {
  Random random(17);
  for (int trial = 0; trial < 20; ++trial) {
    const TangentialHarmonics t = random_planted(random, true).tangential_force;
    const Mat3 frame = random_rotation(random);
    const double beta = uniform(random, 0.0, std::numbers::pi);
    const double mean = mean_over(circle_points(), [&](const Vec3& turn) {
      const Vec3 r = frame.col(1) * turn[0] + frame.col(2) * turn[1];
      return t.value(std::cos(beta) * frame.col(0) + std::sin(beta) * r).dot(r);
    });
    EXPECT_NEAR(t.radial(beta, frame.col(0)), mean, 1e-13);
  }
}

TEST(Harmonics, LargestRadialComponentOfOrderTwoIsAt35DegreesToTheAxis) {
  TangentialHarmonics t;
  t.mean = 1.0;
  t.second = axisymmetric(Vec3::UnitX(), 0.3);
  const double beta = std::atan(std::sqrt(0.5)), largest = t.radial(beta, Vec3::UnitX());
  EXPECT_NEAR(beta * 180.0 / std::numbers::pi, 35.264, 1e-3);
  EXPECT_NEAR(std::abs(largest), t.second(0, 0) / std::sqrt(3.0), 1e-15);
  for (const double off : {-0.01, 0.01})
    EXPECT_LT(std::abs(t.radial(beta + off, Vec3::UnitX())), std::abs(largest));
}

TEST(Harmonics, RotatedTensorsHaveTheSameValuesInRotatedDirections) {
  Random random(18);
  const SymmetricTensor4 b = random_fourth(random, 1.0);
  const Mat3 rotation = random_rotation(random);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 n = random_direction(random);
    EXPECT_NEAR(b.rotated(rotation).along(rotation * n), b.along(n), 1e-14);
  }
}

// dem/micromechanics/harmonics.hpp (3)
TEST(Legendre, PolynomialsAreHarmonicPartsOfPowersOfADirection) {
  Random random(49);
  for (int i = 0; i < 20; ++i) {
    const Vec3 n = random_direction(random), u = random_direction(random);
    const double square = n.dot(u) * n.dot(u);
    EXPECT_NEAR(u.dot(harmonic_part(Mat3(n * n.transpose())) * u), 2.0 / 3.0 * legendre2(square),
                1e-14);
    EXPECT_NEAR(harmonic_part(SymmetricTensor4::power(n)).along(u),
                8.0 / 35.0 * legendre4(square, square * square), 1e-14);
  }
}

}  // namespace
