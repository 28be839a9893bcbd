// SPDX-License-Identifier: MIT
/// @file
/// A pair in units of a power of two, for what would overflow or underflow in the caller's unit.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::detail {

/// A and B about their own centres, and d = c_B - c_A, in units of 2^exponent: the largest of them
/// in [1, 4). Scaling is exact but for lengths below 2^-1022 in the new unit, and for semi-axes
/// below 2^-300, which become that: for the gap less than its rounding in double-double.
struct ScaledPair {
  Ellipsoid a, b;
  Vec3 d;
  Vec3 d_low;  ///< c_B - c_A = d + d_low, in the default environment exactly but for 2^-1074
  int exponent;
};

/// The rounding error of d = c_B - c_A: what d lacks, exactly in the default environment.
Vec3 separation_error(const Vec3& centre_a, const Vec3& centre_b, const Vec3& d) noexcept;

ScaledPair scaled_pair(const Ellipsoid& a, const Ellipsoid& b) noexcept;
/// The same for a given d (its components in the caller's unit, finite).
ScaledPair scaled_pair(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept;

/// May the polynomials of the Perram-Wertheim form be used as they are?
inline bool moderate(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept {
  return a.moderate() && b.moderate() && d.cwiseAbs().maxCoeff() <= 0x1p60;
}

}  // namespace tangency::detail
