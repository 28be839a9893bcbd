// SPDX-License-Identifier: MIT
/// @file
/// Numbers of about 106 bits as unevaluated sums of two doubles [Dekker1971, HidaLiBailey2001].
///
/// Valid in the default floating-point environment only (rounding to nearest, no flushing), which
/// in_default_environment() provides, and while nothing overflows or underflows. Relative errors
/// there: sum and difference of numbers of one sign 3 u^2, product 7 u^2, quotient 15 u^2, root 15
/// u^2 [JoldesMullerPopescu2017]; all are below kDoubleDoubleEpsilon.
#pragma once

#include <algorithm>
#include <cmath>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/numbers/vector3.hpp>
#include <tangency/geometry/power_of_two.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::detail {

/// An upper bound of the relative error of one operation on numbers of one sign; and, for sums of
/// both signs, relative to the sum of the absolute values.
inline constexpr double kDoubleDoubleEpsilon = 0x1p-102;

struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : high(value) {}  // NOLINT: exact, so implicit
  constexpr DoubleDouble(double h, double l) : high(h), low(l) {}

  explicit constexpr operator double() const noexcept { return high; }
  DoubleDouble operator-() const noexcept { return {-high, -low}; }
};

/// a + b exactly. Requires |a| >= |b| or a = 0.
inline DoubleDouble quick_two_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b exactly.
inline DoubleDouble two_sum(double a, double b) noexcept {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// a * b exactly, without a fused multiply-add: halves of 26 and 27 bits [Dekker1971].
inline DoubleDouble two_product(double a, double b) noexcept {
  constexpr double kSplitter = 0x1p27 + 1.0;
  const double product = a * b;
  const double ca = kSplitter * a, cb = kSplitter * b;
  const double ah = ca - (ca - a), bh = cb - (cb - b);
  const double al = a - ah, bl = b - bh;
  return {product, ((ah * bh - product) + ah * bl + al * bh) + al * bl};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) noexcept {
  const DoubleDouble high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
  const DoubleDouble sum = quick_two_sum(high.high, high.low + low.high);
  return quick_two_sum(sum.high, sum.low + low.low);
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) noexcept {
  return a + -b;
}
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) noexcept {
  const DoubleDouble product = two_product(a.high, b.high);
  return quick_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) noexcept {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - b * DoubleDouble(first);
  const double second = rest.high / b.high;
  const DoubleDouble rest2 = rest - b * DoubleDouble(second);
  return quick_two_sum(first, second) + DoubleDouble(rest2.high / b.high);
}
inline DoubleDouble abs(const DoubleDouble& a) noexcept { return a.high < 0.0 ? -a : a; }

/// Requires a >= 0.
inline DoubleDouble sqrt(const DoubleDouble& a) noexcept {
  if (a.high <= 0.0) return {};
  const double root = std::sqrt(a.high);
  const DoubleDouble rest = a - two_product(root, root);
  return quick_two_sum(root, rest.high / (2.0 * root));
}

/// Times 2^power.
inline DoubleDouble scaled_by_power(const DoubleDouble& a, int power) noexcept {
  return {scaled_by_power(a.high, power), scaled_by_power(a.low, power)};
}

// Vectors and rotations of space in double-double.

using DoubleDoubleVector = Vector3<DoubleDouble>;
using DoubleDoubleMatrix = Matrix3<DoubleDouble>;

/// R(q/|q|), each entry within 20 units of kDoubleDoubleEpsilon, and vectors v turned by it, and
/// back, within 25 of them times |v|_1 (docs/derivations/relation-filter.md, section 4).
DoubleDoubleMatrix double_double_rotation(const Quaternion& q) noexcept;

/// |a_1| + |a_2| + |a_3|
inline double sum_of_absolutes(const DoubleDoubleVector& v) noexcept {
  return std::abs(v[0].high) + std::abs(v[1].high) + std::abs(v[2].high);
}

inline DoubleDoubleVector exactly(const Vec3& v) noexcept { return {v[0], v[1], v[2]}; }
inline Vec3 rounded(const DoubleDoubleVector& v) noexcept {
  return {v[0].high, v[1].high, v[2].high};
}

// Vectors of the plane in double-double.

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
  return normalised(exactly(scaled_by_power(direction, -exponent_of(direction))));
}

}  // namespace tangency::inline v0::detail
