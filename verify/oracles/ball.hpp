// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A number with a proven error: two doubles and a bound of how far the true value is from their
/// sum. Inner header of the oracles that prove in microseconds.
///
/// u = 2^-53. What an operation adds to the error, as a share of its result:
///
///  (1) sums: 3 u^2 + 13 u^3 (algorithm 6 of [JoldesMullerPopescu2017]);
///  (2) products: 8 u^2 and terms in u^3. The product of the low parts is left out (u^2), two
///      products of a low and a high part round by u^2 each, their sum by 2 u^2, and its sum with
///      the rounding of the product of the high parts, which is at most 3u, by 3 u^2;
///  (3) quotients and roots: what is measured. The result is put back into the equation that
///      defines it, by (1) and (2), and what is left over bounds its error.
///
/// A product that underflows loses less than kLeast. Where a divisor or a radicand may be 0 the
/// result is 0 with an infinite error; what is computed from it is infinite or no number, and no
/// comparison with it holds.
///
/// Assumes rounding to nearest and subnormal numbers, and that no value overflows.
#pragma once

#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tangency::inline v0::verify {

static_assert(FLT_EVAL_METHOD == 0, "sums and products of doubles are rounded to doubles");

class Ball {
 public:
  Ball() = default;
  /// Of a double, or of 64 binary digits and at least 2^-1000: exact. Of more digits, what two
  /// doubles do not hold is in the error.
  Ball(long double value, double error = 0)
      : high_(static_cast<double>(value)),
        low_(static_cast<double>(value - high_)),
        error_(error + lost(low_)) {}

  /// The middle, to the last bits of a long double.
  long double value() const { return static_cast<long double>(high_) + low_; }
  /// The middle exactly, without its error.
  Ball middle() const { return {high_, low_, 0, Parts()}; }
  /// Bounds of the true value.
  long double least() const { return value() - width(); }
  long double most() const { return value() + width(); }

  Ball operator-() const { return {-high_, -low_, error_, Parts()}; }

  friend Ball operator+(const Ball& a, const Ball& b) {
    const auto [s, s_low] = sum(a.high_, b.high_);
    const auto [t, t_low] = sum(a.low_, b.low_);
    const auto [v, v_low] = ordered_sum(s, s_low + t);
    const auto [high, low] = ordered_sum(v, v_low + t_low);
    return rounded(high, low, a.error_ + b.error_);
  }
  friend Ball operator-(const Ball& a, const Ball& b) { return a + (-b); }
  friend Ball operator*(const Ball& a, const Ball& b) {
    const double product = a.high_ * b.high_;
    const double rest = std::fma(a.high_, b.high_, -product);
    const auto [high, low] = ordered_sum(product, rest + (a.high_ * b.low_ + a.low_ * b.high_));
    const double error = std::abs(a.high_) * b.error_ + a.error_ * (std::abs(b.high_) + b.error_);
    return rounded(high, low, error);
  }
  /// Of b > 0.
  friend Ball operator/(const Ball& a, const Ball& b) {
    const double least = static_cast<double>(b.least()) * (1 - kUnit);
    if (!(least > 0)) return unknown();
    const double first = a.high_ / b.high_;
    const Ball left = a.middle() - Ball(first) * b.middle();
    const auto [high, low] = ordered_sum(first, left.high_ / b.high_);
    const Ball rest = a.middle() - Ball(high, low, 0, Parts()) * b.middle();
    const double error = (rest.reach() + a.error_ + std::abs(high) * kUp * b.error_) / least;
    return {high, low, error * kUp + kLeast, Parts()};
  }
  /// Of a > 0.
  friend Ball sqrt(const Ball& a) {
    if (!(a.least() > 0)) return unknown();
    const double first = std::sqrt(a.high_);
    const Ball left = a.middle() - Ball(first) * Ball(first);
    const auto [high, low] = ordered_sum(first, left.high_ / (2 * first));
    const Ball root(high, low, 0, Parts());
    // |sqrt(x) - s| = |x - s^2| / (sqrt(x) + s).
    const double error = ((a.middle() - root * root).reach() + a.error_) / high;
    return {high, low, error * kUp + kLeast, Parts()};
  }

 private:
  struct Parts {};
  struct Two {
    double high, low;
  };

  static constexpr double kUnit = 0x1p-53;
  static constexpr double kRounding = 0x1p-102;  // 16 u^2, for (1) and (2)
  static constexpr double kLeast = 0x1p-1000;
  // Covers the roundings of a bound, which are fewer than sixteen.
  static constexpr double kUp = 1 + 0x1p-48;

  Ball(double high, double low, double error, Parts) : high_(high), low_(low), error_(error) {}

  // Of a long double, beside the low part.
  static double lost(double low) {
    return std::numeric_limits<long double>::digits > 64 ? 2 * kUnit * std::abs(low) : 0;
  }
  static Ball unknown() { return {0, 0, std::numeric_limits<double>::infinity(), Parts()}; }
  static Ball rounded(double high, double low, double error) {
    return {high, low, (error + kRounding * std::abs(high)) * kUp + kLeast, Parts()};
  }
  static Two sum(double a, double b) {
    const double s = a + b, of_b = s - a;
    return {s, (a - (s - of_b)) + (b - of_b)};
  }
  // Of |a| >= |b|, or a = 0.
  static Two ordered_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }
  // A bound of the true value's size.
  double reach() const { return (std::abs(high_) * kUp + error_) * kUp; }
  // Of both ends: the error, and what value() and the ends round by.
  long double width() const {
    constexpr long double kRound = 4 * std::numeric_limits<long double>::epsilon();
    const long double v = std::abs(static_cast<long double>(high_));
    return error_ + kRound * (v + error_);
  }

  double high_ = 0, low_ = 0, error_ = 0;
};

using Ball3 = std::array<Ball, 3>;

inline Ball3 cross(const Ball3& a, const Ball3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Ball inner(const Ball3& a, const Ball3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace tangency::inline v0::verify
