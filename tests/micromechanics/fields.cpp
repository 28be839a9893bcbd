// SPDX-License-Identifier: GPL-3.0-or-later
#include "fields.hpp"

#include <gsl/gsl_integration.h>

#include <cmath>

namespace tangency::testing {

using micromechanics::ScalarHarmonics;
using micromechanics::SymmetricTensor4;
using micromechanics::TangentialHarmonics;

double uniform(Random& random, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

double normal(Random& random) { return std::normal_distribution<double>()(random); }

Vec3 random_direction(Random& random) {
  Vec3 n;
  for (int i = 0; i < 3; ++i) n[i] = normal(random);
  return n.normalized();
}

Mat3 random_rotation(Random& random) {
  const Vec3 first = random_direction(random);
  const Vec3 second = first.cross(random_direction(random)).normalized();
  Mat3 rotation;
  rotation << first, second, first.cross(second);
  return rotation;
}

Mat3 random_second(Random& random, double modulus) {
  Mat3 a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a(i, j) = normal(random);
  a = (0.5 * (a + a.transpose())).eval();
  a.diagonal().array() -= a.trace() / 3.0;
  return modulus / a.norm() * a;
}

SymmetricTensor4 random_fourth(Random& random, double modulus) {
  SymmetricTensor4 b;
  for (double& component : b.components) component = normal(random);
  b = harmonic_part(b);
  return modulus / b.norm() * b;
}

Mat3 axisymmetric(const Vec3& axis, double size) {
  return size * std::sqrt(1.5) * (axis * axis.transpose() - Mat3::Identity() / 3.0);
}

const std::vector<std::pair<Vec3, double>>& sphere_points() {
  static const auto points = [] {
    constexpr std::size_t heights = 20, turns = 40;
    std::vector<std::pair<Vec3, double>> made;
    gsl_integration_glfixed_table* table = gsl_integration_glfixed_table_alloc(heights);
    for (std::size_t k = 0; k < heights; ++k) {
      double z = 0.0, weight = 0.0;
      gsl_integration_glfixed_point(-1.0, 1.0, k, &z, &weight, table);
      for (std::size_t turn = 0; turn < turns; ++turn) {
        const double alpha = 2.0 * std::numbers::pi * (static_cast<double>(turn) + 0.3) / turns;
        const double across = std::sqrt(1.0 - z * z);
        made.emplace_back(Vec3(across * std::cos(alpha), across * std::sin(alpha), z),
                          weight / (2.0 * turns));
      }
    }
    gsl_integration_glfixed_table_free(table);
    return made;
  }();
  return points;
}

const std::vector<std::pair<Vec3, double>>& circle_points() {
  static const auto points = [] {
    constexpr int count = 64;
    std::vector<std::pair<Vec3, double>> made;
    for (int i = 0; i < count; ++i) {
      const double theta = 2.0 * std::numbers::pi * (i + 0.3) / count;
      made.emplace_back(Vec3(std::cos(theta), std::sin(theta), 0.0), 1.0 / count);
    }
    return made;
  }();
  return points;
}

Planted random_planted(Random& random, bool with_fourth) {
  const auto tensors = [&](auto& model, double mean) {
    model.mean = mean;
    model.second = random_second(random, uniform(random, 0.1, 0.5));
    if (with_fourth) model.fourth = random_fourth(random, uniform(random, 0.1, 0.5));
  };
  Planted planted;
  tensors(planted.density, 0.25 / std::numbers::pi);
  tensors(planted.force, 3.0);
  tensors(planted.tangential_force, 3.0);
  tensors(planted.branch, 2.0);
  tensors(planted.tangential_branch, 2.0);
  return planted;
}

Packing draw(Random& random, const Planted& planted, std::size_t contacts, double noise) {
  const double largest =
      planted.density.mean * (1.0 + planted.density.second.norm() + planted.density.fourth.norm());
  const auto scattered = [&](const ScalarHarmonics& along, const TangentialHarmonics& across,
                             const Vec3& n) -> Vec3 {
    const double size = noise * along.mean;
    const Vec3 off(size * normal(random), size * normal(random), size * normal(random));
    return along.value(n) * n + across.value(n) + off;
  };
  Packing packing;
  packing.volume = static_cast<double>(contacts) / 3.0;
  packing.particles = static_cast<std::int64_t>(contacts);
  while (packing.normal.size() < contacts) {
    const Vec3 n = random_direction(random);
    if (uniform(random, 0.0, largest) > planted.density.value(n)) continue;
    packing.normal.push_back(n);
    packing.force.push_back(scattered(planted.force, planted.tangential_force, n));
    packing.branch.push_back(scattered(planted.branch, planted.tangential_branch, n));
    packing.arm.push_back(uniform(random, 0.4, 0.6) * packing.branch.back());
    const auto a = static_cast<std::int64_t>(packing.bodies.size());
    packing.bodies.push_back({a, (a + 7) % packing.particles});
  }
  return packing;
}

Packing exchanged(const Packing& packing) {
  Packing other = packing;
  for (std::size_t c = 0; c < other.normal.size(); c += 2) {
    other.arm[c] -= other.branch[c];
    other.normal[c] *= -1.0;
    other.branch[c] *= -1.0;
    other.force[c] *= -1.0;
    std::swap(other.bodies[c][0], other.bodies[c][1]);
  }
  return other;
}

Packing rotated(const Packing& packing, const Mat3& rotation) {
  Packing other = packing;
  for (auto* vectors : {&other.normal, &other.branch, &other.force, &other.arm})
    for (Vec3& v : *vectors) v = (rotation * v).eval();
  return other;
}

}  // namespace tangency::testing
