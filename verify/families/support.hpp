// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the families draw and place with, in long double.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::families {

using Real = long double;
static_assert(std::numeric_limits<Real>::digits >= 64,
              "the truth needs more digits than the kernel");
using Vector = std::array<Real, 3>;

inline Real dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Not std::uniform_real_distribution, whose values differ between standard libraries.
inline Real uniform(std::mt19937_64& random, Real low, Real high) {
  return low + (high - low) * (static_cast<Real>(random() >> 11) * 0x1p-53L);
}

/// Uniform over rotations: a point of the ball, by rejection, of any length.
inline std::array<double, 4> draw_orientation(std::mt19937_64& random) {
  for (;;) {
    std::array<double, 4> q;
    double norm2 = 0;
    for (double& c : q) c = static_cast<double>(uniform(random, -1, 1)), norm2 += c * c;
    if (norm2 > 0.01 && norm2 <= 1) return q;
  }
}

/// Uniform over the unit sphere.
inline Vector draw_direction(std::mt19937_64& random) {
  Vector n;
  Real norm2;
  do {
    for (Real& c : n) c = uniform(random, -1, 1);
    norm2 = dot(n, n);
  } while (norm2 > 1 || norm2 < 0.01L);
  for (Real& c : n) c /= std::sqrt(norm2);
  return n;
}

/// The body axes of the stored quaternion, in space.
inline std::array<Vector, 3> axes_of(const verify::RawEllipsoid& e) {
  const Real w = e.orientation[0], x = e.orientation[1], y = e.orientation[2], z = e.orientation[3];
  const Real s = 2 / (w * w + x * x + y * y + z * z);
  return {{{1 - s * (y * y + z * z), s * (x * y + w * z), s * (z * x - w * y)},
           {s * (x * y - w * z), 1 - s * (z * z + x * x), s * (y * z + w * x)},
           {s * (z * x + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}}};
}

/// Support point M n / h(n) of the stored doubles, from the centre.
inline Vector support_point(const verify::RawEllipsoid& e, const Vector& n) {
  const std::array<Vector, 3> columns = axes_of(e);
  Vector scaled;
  for (std::size_t k = 0; k < 3; ++k) scaled[k] = e.semi_axes[k] * dot(columns[k], n);
  const Real h = std::sqrt(dot(scaled, scaled));
  Vector point{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      point[i] += columns[k][i] * (e.semi_axes[k] * scaled[k] / h);
    }
  }
  return point;
}

}  // namespace tangency::families
