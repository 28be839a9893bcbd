// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// First derivatives of the gap in the oracle's digits, in the order of
/// geometry/gap_derivatives.hpp.
#pragma once

#include <array>
#include <cstddef>

#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency::testing {

using RealGradient = std::array<verify::Real, 18>;

struct RealPair {
  verify::RealEllipsoid a, b;
};

inline bool is_angle(int i) { return i % kOfBodyB / 3 == kRotation / 3; }

/// The pair with parameter i changed by a step. A turn of 2 atan(step / 2) is one of step +
/// O(step^3).
inline RealPair changed(RealPair pair, int i, const verify::Real& step) {
  verify::RealEllipsoid& body = i < kOfBodyB ? pair.a : pair.b;
  const auto k = static_cast<std::size_t>(i % 3);
  const int kind = i % kOfBodyB - i % 3;
  if (kind == kCentre) body.centre[k] += step;
  if (kind == kSemiAxes) body.semi_axes[k] += step;
  if (kind == kRotation) {
    // (1, v/2) times q
    const auto q = body.orientation;
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    const verify::Real half = step / 2;
    body.orientation[0] -= half * q[k + 1];
    body.orientation[k + 1] += half * q[0];
    body.orientation[l + 1] -= half * q[m + 1];
    body.orientation[m + 1] += half * q[l + 1];
  }
  return pair;
}

/// By the identities of gap_derivatives.hpp.
inline RealGradient gradient_of(const RealPair& pair, const verify::GapTruth& truth) {
  using verify::Real, verify::Real3;
  const verify::Separation<Real> shapes = separation(pair.a, pair.b);
  RealGradient g;
  const auto body = [&](const verify::Shape<Real>& shape, const Real3& arm, int sign,
                        std::size_t first) {
    const Real3& n = truth.normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      g[first + k] = sign * n[k];
      g[first + 3 + k] = sign * (arm[l] * n[m] - arm[m] * n[l]);
      Real along_n = 0, along_x = 0;  // a_k^2 (R'n)_k / h is (R'x)_k, x = -sign arm
      for (std::size_t j = 0; j < 3; ++j) {
        along_n += shape.axes[k][j] * n[j];
        along_x -= sign * shape.axes[k][j] * arm[j];
      }
      g[first + 6 + k] = -along_n * along_x / shape.semi_axes[k];
    }
  };
  body(shapes.a, truth.arm_a, -1, 0);
  body(shapes.b, truth.arm_b, 1, kOfBodyB);
  return g;
}

}  // namespace tangency::testing
