// SPDX-License-Identifier: MIT
/// @file
/// Numbers of about 106 bits as unevaluated sums of two doubles [Dekker1971, HidaLiBailey2001].
///
/// Valid in the default floating-point environment only (rounding to nearest, no flushing), which
/// in_default_environment() provides, and while nothing overflows or underflows. Relative errors
/// there: sum and difference of numbers of one sign 3 u^2, product 7 u^2, quotient 15 u^2, root 15
/// u^2 [JoldesMullerPopescu2017]; all are below kDoubleDoubleEpsilon.
#pragma once

#include <cmath>

#include <tangency/geometry/floating_point.hpp>

namespace tangency::exact {

/// An upper bound of the relative error of one operation on numbers of one sign; and, for sums of
/// both signs, relative to the sum of the absolute values.
inline constexpr double kDoubleDoubleEpsilon = 0x1p-102;

struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : high(value) {}  // NOLINT: exact, so implicit
  constexpr DoubleDouble(double h, double l) : high(h), low(l) {}

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

}  // namespace tangency::exact
