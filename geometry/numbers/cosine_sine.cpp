// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/cosine_sine.hpp>

#include <gmpxx.h>

#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0::detail {
namespace {

// Below it cos t > 1 - 2^-55 and |sin t - t| < 2^-56 |t|: they round to 1 and to t.
constexpr double kTiny = 0x1p-27;
constexpr double kLargestReduced = 0x1p20;  // k below 2^20 times a part of 32 bits is exact
// pi/2 = the sum of these but for 2^-123.
constexpr std::array<double, 3> kHalfPi{0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};

/// Cosine and sine of an angle k pi/2 further, from those of the angle.
template <class T>
std::array<T, 2> quarters_on(const T& cosine, const T& sine, unsigned k) {
  switch (k & 3U) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

/// The double nearest to value, if all numbers within the error of it have the same.
std::optional<double> nearest(const DoubleDouble& value, double error) {
  const double below = value.high + (value.low - error), above = value.high + (value.low + error);
  if (below != above) return std::nullopt;
  return below;
}

/// sum of (-1)^k r^(2k+first) / (2k+first)!, for |r| < 0.8: the first term left out, r^28/28!, is
/// below 2^-106.
DoubleDouble series(const DoubleDouble& r, int first) {
  const DoubleDouble square = r * r;
  DoubleDouble sum(1.0);
  for (int n = 26 + first; n > first; n -= 2) {
    sum = DoubleDouble(1.0) - square * sum / DoubleDouble(n * (n - 1.0));
  }
  return first == 0 ? sum : r * sum;
}

std::optional<CosineSine> in_double_double(double angle) {
  if (std::abs(angle) > kLargestReduced) return std::nullopt;
  const double k = std::nearbyint(angle / kHalfPi[0]);
  DoubleDouble r = two_sum(angle, -k * kHalfPi[0]);
  r = r + DoubleDouble(-k * kHalfPi[1]) + two_product(-k, kHalfPi[2]);
  const auto turned =
      quarters_on(series(r, 0), series(r, 1), static_cast<unsigned>(static_cast<int>(k)));
  // r is within |k| 2^-122 + 2^-101 |r| + 2^-114; the series within 2^-96 of their sums.
  const double reduction = std::abs(k) * 0x1p-121 + 0x1p-113;
  const auto error = [&](const DoubleDouble& v) { return 0x1p-95 * std::abs(v.high) + reduction; };
  const auto cosine = nearest(turned[0], error(turned[0]));
  const auto sine = nearest(turned[1], error(turned[1]));
  if (!cosine || !sine) return std::nullopt;
  return CosineSine{*cosine, *sine};
}

/// 2^bits atan(1/x), within `bits` units.
mpz_class inverse_tangent(unsigned long x, mp_bitcnt_t bits) {
  mpz_class power = (mpz_class(1) << bits) / x, sum = power;
  for (unsigned long n = 3; power != 0; n += 2) {
    power /= x * x;
    if (n % 4 == 3) {
      sum -= power / n;
    } else {
      sum += power / n;
    }
  }
  return sum;
}

/// 2^bits pi/2, within 16 bits units [Machin's formula].
mpz_class half_pi(mp_bitcnt_t bits) {
  return 2 * (4 * inverse_tangent(5, bits) - inverse_tangent(239, bits));
}

/// 2^bits times the sum of (-1)^k r^(2k+first) / (2k+first)! of r / 2^bits, within `bits` units.
mpz_class integer_series(const mpz_class& r, unsigned long first, mp_bitcnt_t bits) {
  const mpz_class square = (r * r) >> bits;
  mpz_class term = first == 0 ? mpz_class(mpz_class(1) << bits) : r, sum = term;
  // NOLINTNEXTLINE(misc-redundant-expression): 0 is not -1
  for (unsigned long n = first + 1; term != 0 && term != -1; n += 2) {
    term = -((term * square) >> bits) / (n * (n + 1));
    sum += term;
  }
  return sum;
}

/// value 2^-bits to the nearest double; ties, which interval() never meets on both sides, either
/// way. Requires a result that is a normal number.
double to_nearest(const mpz_class& value, mp_bitcnt_t bits) {
  const mpz_class magnitude = abs(value);
  const auto size = mpz_sizeinbase(magnitude.get_mpz_t(), 2);
  if (size <= 53) return std::ldexp(value.get_d(), -static_cast<int>(bits));
  const mpz_class halves = magnitude >> (size - 54), mantissa = (halves + 1) >> 1;
  const int exponent = static_cast<int>(size) - 53 - static_cast<int>(bits);
  return std::copysign(std::ldexp(mantissa.get_d(), exponent), static_cast<double>(sgn(value)));
}

std::optional<double> nearest(const mpz_class& value, const mpz_class& error, mp_bitcnt_t bits) {
  const double below = to_nearest(value - error, bits), above = to_nearest(value + error, bits);
  if (below != above) return std::nullopt;
  return below;
}

/// With `bits` bits behind the point.
std::optional<CosineSine> in_integers(double angle, mp_bitcnt_t bits) {
  const exact::Dyadic dyadic = exact::decode(angle);
  mpz_class scaled = exact::to_integer(dyadic.mantissa);
  const long shift = static_cast<long>(bits) + dyadic.exponent;
  if (shift >= 0) {
    scaled <<= static_cast<mp_bitcnt_t>(shift);
  } else {
    scaled >>= static_cast<mp_bitcnt_t>(-shift);
  }
  const mpz_class half = half_pi(bits), quarter = half / 2;
  mpz_class k, r;
  mpz_fdiv_q(k.get_mpz_t(), mpz_class(scaled + quarter).get_mpz_t(), half.get_mpz_t());
  r = scaled - k * half;
  const auto quarters = static_cast<unsigned>(mpz_fdiv_ui(k.get_mpz_t(), 4));
  const auto turned =
      quarters_on<mpz_class>(integer_series(r, 0, bits), integer_series(r, 1, bits), quarters);
  const mpz_class error = (abs(k) + 4) * mpz_class(32 * static_cast<unsigned long>(bits));
  const auto cosine = nearest(turned[0], error, bits), sine = nearest(turned[1], error, bits);
  if (!cosine || !sine) return std::nullopt;
  return CosineSine{*cosine, *sine};
}

}  // namespace

CosineSine rounded_cosine_sine_in_integers(double angle) {
  assert(std::isfinite(angle));
  if (std::abs(angle) < kTiny) return {1.0, angle};
  // Both are irrational for every other angle, so that some precision tells how they round.
  for (mp_bitcnt_t bits = 256;; bits *= 2) {
    if (const auto found = in_integers(angle, bits)) return *found;
  }
}

CosineSine rounded_cosine_sine(double angle) {
  assert(std::isfinite(angle));
  if (std::abs(angle) < kTiny) return {1.0, angle};
  if (const auto found = in_double_double(angle)) return *found;
  return rounded_cosine_sine_in_integers(angle);
}

}  // namespace tangency::inline v0::detail
