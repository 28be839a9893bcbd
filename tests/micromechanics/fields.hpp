// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Random anisotropies, contacts that are drawn from them, and quadrature by GSL over the sphere
/// and the circle. Seeds are fixed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::testing {

using Random = std::mt19937_64;

double uniform(Random& random, double least, double most);
double normal(Random& random);
Vec3 random_direction(Random& random);
Mat3 random_rotation(Random& random);
/// Symmetric and traceless, of any axes, of the given modulus.
Mat3 random_second(Random& random, double modulus);
micromechanics::SymmetricTensor4 random_fourth(Random& random, double modulus);
inline double distance(const micromechanics::SymmetricTensor4& a,
                       const micromechanics::SymmetricTensor4& b) {
  return (a - b).norm();
}
/// size diag(2, -1, -1)/sqrt(6) about an axis: of modulus |size|.
Mat3 axisymmetric(const Vec3& axis, double size);

/// Points and weights that add up to 1, exact for polynomials of degree 39 in n.
const std::vector<std::pair<Vec3, double>>& sphere_points();
/// The same on the circle z = 0, of degree 63.
const std::vector<std::pair<Vec3, double>>& circle_points();

/// The mean of f over all directions.
template <typename Function>
auto mean_over(const std::vector<std::pair<Vec3, double>>& points, Function f) {
  auto sum = f(points.front().first);
  sum *= points.front().second;
  for (std::size_t i = 1; i < points.size(); ++i) {
    auto term = f(points[i].first);
    term *= points[i].second;
    sum += term;
  }
  return sum;
}

/// A packing's fields, to be planted and found again.
struct Planted {
  micromechanics::ScalarHarmonics density, force, branch;
  micromechanics::TangentialHarmonics tangential_force, tangential_branch;
};
/// Of any axes and both orders, or of order 2 alone.
Planted random_planted(Random& random, bool with_fourth);

/// Arrays of contacts that keep themselves.
struct Packing {
  std::vector<Vec3> normal, branch, force, arm;
  std::vector<std::array<std::int64_t, 2>> bodies;
  std::int64_t particles = 0;
  double volume = 1.0;
  int dimensions = 3;

  micromechanics::ContactArrays arrays() const {
    return {normal, branch, force, arm, bodies, particles, volume, dimensions};
  }
};
/// Normals drawn from the density; forces and branches as planted, each component with a scatter of
/// `noise` times the mean.
Packing draw(Random& random, const Planted& planted, std::size_t contacts, double noise);

/// With a and b of every other contact exchanged.
Packing exchanged(const Packing& packing);
Packing rotated(const Packing& packing, const Mat3& rotation);

}  // namespace tangency::testing
