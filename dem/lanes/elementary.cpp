// SPDX-License-Identifier: MIT
#include <tangency/dem/lanes/elementary.hpp>

#include <cmath>
#include <numbers>

#include <tangency/dem/lanes/particle_lanes.hpp>
#include <tangency/geometry/numbers/double_double.hpp>

namespace tangency::inline v0::dem {

double logarithm(double x) {
  if (!(x > 0.0) || std::isinf(x)) return std::log(x);
  // x = m 2^k with m in [sqrt(1/2), sqrt(2)]; frexp and ldexp are exact.
  int k = 0;
  double m = std::frexp(x, &k);
  if (m < 0.5 * std::numbers::sqrt2) {
    m *= 2.0;
    --k;
  }
  // log m = 2 artanh(s); |s| < 0.172 and the first term left out, s^25 / 25, is below 2^-67.
  const double s = (m - 1.0) / (m + 1.0), z = s * s;
  double sum = 0.0;
  for (int n = 23; n > 1; n -= 2) sum = (sum + 1.0 / n) * z;
  const double log_m = 2.0 * (s + s * sum);
  // log 2 in two parts, the first of 32 bits: its product with k is exact.
  constexpr double kHigh = 0x1.62e42fee00000p-1, kLow = 0x1.a39ef35793c76p-33;
  return k * kHigh + (log_m + k * kLow);
}

double exponential(double x) {
  // x = k log 2 + r with |r| < 0.35; the high part of log 2 has 32 bits, so that k times it is
  // exact.
  constexpr double kHigh = 0x1.62e42fee00000p-1, kLow = 0x1.a39ef35793c76p-33;
  const double k = std::nearbyint(x / std::numbers::ln2);
  const double r = (x - k * kHigh) - k * kLow;
  // The first term left out, r^15 / 15!, is below 2^-62.
  double sum = 0.0;
  for (int n = 14; n > 1; --n) sum = (sum + 1.0) * r / n;
  return std::ldexp(1.0 + (r + sum * r), static_cast<int>(k));
}

double cube_root(double x) {
  if (x == 0.0 || !std::isfinite(x)) return x;
  // Of a in [1/8, 1), times 2^k. Newton's method doubles the correct bits of a straight line's 4.
  int exponent = 0;
  double a = std::frexp(std::abs(x), &exponent);
  int k = (exponent + 3000) / 3 - 1000;
  a = std::ldexp(a, exponent - 3 * k);
  if (a >= 1.0) {
    a *= 0.125;
    ++k;
  }
  double y = 0.45 + 0.57 * a;
  for (int step = 0; step < 4; ++step) y -= (y - a / (y * y)) / 3.0;
  // The last step in double-double: the sum is within 2^-100 of the root.
  using detail::DoubleDouble;
  const DoubleDouble square = detail::two_product(y, y);
  const DoubleDouble rest = DoubleDouble(a) - square * DoubleDouble(y);
  const double root = y + rest.high / (3.0 * y * y);
  return std::copysign(std::ldexp(root, k), x);
}

CosineSine cosine_sine(double angle) {
  CosineSine found;
  detail::cosine_sine_lanes(&angle, &found.cosine, &found.sine, 1);
  return found;
}

}  // namespace tangency::inline v0::dem
