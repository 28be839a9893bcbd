// SPDX-License-Identifier: MIT
/// @file
/// The rounding of what is evaluated at a normal in double, in space and in the plane alike:
/// docs/derivations/gap-certificate.md, section 2, whose names stand at each. Assumes rounding to
/// nearest.
#pragma once

#include <cmath>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0::detail {

/// Of L: the error of an ordinary answer, beyond which another method is tried.
inline constexpr double kOrdinaryError = kOrdinaryGapErrorBound * kUnitRoundoff;

/// Of a/h: (V) and (R) hold up to it, where terms of second order are below 2^-6 u a.
inline constexpr double kThinnestAlongNormal = 0x1p42;
/// Of |gap| in (V), over u: 5 of sums and product, 1 of gap -+ (V), 3.65 of the normal's length,
/// by the series of normals/newton.hpp; 3.5 where Eigen normalises it.
inline constexpr double kOfGap = 9.71, kOfGapNormalised = 9.61;
/// Of max |d - x_A| in (V), over u: 1.75 derived, the rest covers the tangential part.
inline constexpr double kOfReach = 2.02;

/// (V): of gap = n.rest, rest = (d - x_A) - x_B + d_low.
/// @param axes      a_A + a_B, the largest semi-axes
/// @param supports  h_A + h_B
/// @param reach     max |d - x_A|
/// @param of_gap    kOfGap or kOfGapNormalised
inline double value_error(double axes, double supports, double reach, double gap,
                          double of_gap) noexcept {
  return kUnitRoundoff *
         (6.71 * axes + 5.51 * supports + kOfReach * reach + of_gap * std::abs(gap));
}

/// (R): of the rest across the normal. Derived are 7.1 and 13.2.
/// @param radii  a_A^2 / h_A + a_B^2 / h_B
inline double rest_error(double radii, double axes, double gap) noexcept {
  return kUnitRoundoff * (8.0 * radii + 32.0 * (axes + std::abs(gap)));
}

/// (B): |r|^2 with the rounding of r, whose part 4u|r| is in the 1.01.
inline double reach_squared(double rest_squared, double rest_error) noexcept {
  return 1.01 * (rest_squared + rest_error * rest_error);
}

}  // namespace tangency::inline v0::detail
