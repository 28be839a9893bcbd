// SPDX-License-Identifier: MIT
/// @file
/// Doubles by their bits: exponent, zero test and scaling that read subnormal numbers as they are
/// even where the caller's floating-point environment reads them as zero (DAZ). And the powers of
/// two at which a pair is scaled, or left to another tier.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <tangency/geometry/floating_point.hpp>

namespace tangency::inline v0 {

/// Is the value 0 or -0?
inline bool is_zero(double value) noexcept {
  return (std::bit_cast<std::uint64_t>(value) << 1) == 0;
}

/// e with 2^e <= |value| < 2^(e+1); for 0 less than for any other number. Requires a finite value.
inline int exponent_of(double value) noexcept {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(value) & ~(std::uint64_t{1} << 63);
  if (bits == 0) return -1100;
  const int biased = static_cast<int>(bits >> 52);
  return biased != 0 ? biased - 1023 : static_cast<int>(std::bit_width(bits)) - 1 - 1074;
}

/// value * 2^power, rounded (or flushed to 0, if that is the environment) below 2^-1022.
/// Requires a finite value and a result in range.
inline double scaled_by_power(double value, int power) noexcept {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(value) & ~(std::uint64_t{1} << 63);
  if (bits >> 52 != 0 || bits == 0) {
    // The factor itself is a normal double: a product rounds as scalbn does, and is no call.
    if (power > -1023 && power < 1024) {
      return value * std::bit_cast<double>(static_cast<std::uint64_t>(power + 1023) << 52);
    }
    return std::scalbn(value, power);
  }
  const double magnitude = std::scalbn(static_cast<double>(bits), power - 1074);
  return std::signbit(value) ? -magnitude : magnitude;
}

/// Of Eigen's.
template <class T>
concept FixedVector = requires {
  T::SizeAtCompileTime;
};

/// The same of a vector: the largest exponent of its components, and each one scaled.
template <FixedVector Vector>
int exponent_of(const Vector& v) noexcept {
  return v.unaryExpr([](double x) { return exponent_of(x); }).maxCoeff();
}
/// Each component of a vector, scaled.
template <FixedVector Vector>
Vector scaled_by_power(const Vector& v, int power) noexcept {
  return v.unaryExpr([power](double x) { return scaled_by_power(x, power); });
}

namespace detail {
using tangency::scaled_by_power;  // beside the overloads for its own arithmetics

// Between which lengths an arithmetic neither overflows nor underflows.

/// Of semi-axes and components of d in the caller's unit of length. Chosen: a^10 d^2, the largest
/// product of the coefficients of the Perram-Wertheim form, stays below 2^1023
/// (Ellipsoid::moderate()).
inline constexpr double kLargestModerate = 0x1p60, kSmallestModerate = 0x1p-60;

/// Of the size of a pair, which is 1 or more: a semi-axis below it is taken for it. Chosen: squares
/// of it are normal numbers, and what the change makes of a gap is below the rounding of
/// double-double.
inline constexpr double kThinnestAxis = 0x1p-300;
/// The same where a body is seen from a point (seen_from_centre()): quotients of two semi-axes are
/// squared in double-double.
inline constexpr double kThinnestAxisSeen = 0x1p-200;
/// A component of a vector that counts for 0: a product of two would underflow.
inline constexpr double kLeastComponent = 0x1p-300;

}  // namespace detail

}  // namespace tangency::inline v0
