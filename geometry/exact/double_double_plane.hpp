// SPDX-License-Identifier: MIT
/// @file
/// Vectors of the plane in double-double. Requirements as for double_double.hpp. Internal.
#pragma once

#include <algorithm>

#include <tangency/geometry/exact/double_double.hpp>
#include <tangency/geometry/power_of_two.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::exact {

struct DoubleDouble2 {
  DoubleDouble x, y;
};

inline DoubleDouble2 exactly(const Vec2& v) noexcept { return {v[0], v[1]}; }
inline Vec2 rounded(const DoubleDouble2& v) noexcept { return {v.x.high, v.y.high}; }

inline DoubleDouble2 operator+(const DoubleDouble2& a, const DoubleDouble2& b) noexcept {
  return {a.x + b.x, a.y + b.y};
}
inline DoubleDouble2 operator-(const DoubleDouble2& a, const DoubleDouble2& b) noexcept {
  return {a.x - b.x, a.y - b.y};
}
inline DoubleDouble2 operator-(const DoubleDouble2& a) noexcept { return {-a.x, -a.y}; }
inline DoubleDouble2 operator*(const DoubleDouble& s, const DoubleDouble2& v) noexcept {
  return {s * v.x, s * v.y};
}
inline DoubleDouble dot(const DoubleDouble2& a, const DoubleDouble2& b) noexcept {
  return a.x * b.x + a.y * b.y;
}
/// a_x b_y - a_y b_x: > 0 where b is less than a half turn ahead of a.
inline DoubleDouble cross(const DoubleDouble2& a, const DoubleDouble2& b) noexcept {
  return a.x * b.y - a.y * b.x;
}
/// A quarter turn ahead.
inline DoubleDouble2 quarter(const DoubleDouble2& v) noexcept { return {-v.y, v.x}; }
/// In the frame of a unit axis, and back.
inline DoubleDouble2 turned_back(const DoubleDouble2& axis, const DoubleDouble2& v) noexcept {
  return {dot(axis, v), cross(axis, v)};
}
inline DoubleDouble2 turned(const DoubleDouble2& axis, const DoubleDouble2& v) noexcept {
  return {axis.x * v.x - axis.y * v.y, axis.y * v.x + axis.x * v.y};
}
inline DoubleDouble length(const DoubleDouble2& v) noexcept { return sqrt(dot(v, v)); }
/// Requires a length whose square neither overflows nor underflows.
inline DoubleDouble2 normalised(const DoubleDouble2& v) noexcept {
  const DoubleDouble norm = length(v);
  return {v.x / norm, v.y / norm};
}

/// u/|u|, each component within 40 units of kDoubleDoubleEpsilon of itself (and 2^-1074).
/// @param direction  finite, not zero, of any length
inline DoubleDouble2 double_double_direction(const Vec2& direction) noexcept {
  const int exponent = std::max(exponent_of(direction[0]), exponent_of(direction[1]));
  return normalised(
      {scaled_by_power(direction[0], -exponent), scaled_by_power(direction[1], -exponent)});
}

}  // namespace tangency::exact
