// SPDX-License-Identifier: MIT
/// @file
/// Doubles that carry a bound of their own error: for filters whose proof is that every operation
/// keeps the bound. Requires rounding to nearest and subnormals kept. Internal.
///
/// (1) |true - value| <= error after every operation, if it held for the operands.
/// (2) Where anything overflows, value or error is no number or infinite, and no sign is certain.
#pragma once

#include <cmath>

#include <tangency/geometry/floating_point.hpp>

namespace tangency::inline v0::detail {

struct Bounded {
  double value;
  double error = 0.0;

  constexpr Bounded(double v) : value(v) {}  // NOLINT: exact, so implicit
  constexpr Bounded(double v, double e) : value(v), error(e) {}

  bool positive() const noexcept { return value > error; }
  bool negative() const noexcept { return value < -error; }
  Bounded operator-() const noexcept { return {-value, error}; }
};

/// The rounding of value itself, and that of the sums and products that make the error: fewer than
/// eight, each within u; below 2^-1022 each operation rounds to 2^-1075.
inline Bounded rounded(double value, double propagated) noexcept {
  return {value, (propagated + kUnitRoundoff * std::abs(value)) * (1.0 + 0x1p-49) + 0x1p-1070};
}

inline Bounded operator+(const Bounded& a, const Bounded& b) noexcept {
  return rounded(a.value + b.value, a.error + b.error);
}
inline Bounded operator-(const Bounded& a, const Bounded& b) noexcept { return a + -b; }
inline Bounded operator*(const Bounded& a, const Bounded& b) noexcept {
  return rounded(a.value * b.value,
                 std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error);
}
inline Bounded square(const Bounded& a) noexcept { return a * a; }

}  // namespace tangency::inline v0::detail
