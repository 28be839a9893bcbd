// SPDX-License-Identifier: MIT
/// @file
/// Answers in double as floats: what is proven of the numbers stays proven of the rounded ones. In
/// the default environment. Internal.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tangency::inline v0::detail {

/// The nearest float, or the smallest of the same sign where that is 0 and the gap is not.
inline float to_float_gap(double gap) {
  const auto nearest = static_cast<float>(gap);
  const float smallest = std::numeric_limits<float>::denorm_min();
  return nearest != 0.0f || gap == 0.0 ? nearest : std::copysign(smallest, nearest);
}

/// The smallest float that is not below x >= 0.
inline float to_float_upwards(double x) {
  const auto nearest = static_cast<float>(x);
  const std::uint32_t up = static_cast<double>(nearest) < x ? 1 : 0;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + up);
}

/// The largest float that is not above x >= 0.
inline float to_float_downwards(double x) {
  const auto nearest = static_cast<float>(x);
  const std::uint32_t down = static_cast<double>(nearest) > x ? 1 : 0;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) - down);
}

/// How far to_float_gap(gap) may be from what `gap` is within `error` of. Three operations in
/// double lose at most 3 u of the sum, and nothing below double's normal range: 2^-50 covers them.
inline float to_float_error(double gap, double error) {
  const float rounded = to_float_gap(gap);
  if (std::isinf(rounded)) return std::numeric_limits<float>::infinity();
  const double lost = std::abs(gap - static_cast<double>(rounded));
  return to_float_upwards((error + lost) * (1.0 + 0x1p-50));
}

}  // namespace tangency::inline v0::detail
