// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/classify_coefficients.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <tangency/geometry/bodies/exact_quadric_type.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0::filter {
namespace {

constexpr int kBias = 1023;
constexpr int kMantissaBits = 52;
constexpr int kRange = 200;  // at most (1022 - 3 * 52) / 4: the derivation, section 2

Estimate difference_of_products(double a, double b, double c, double d) noexcept {
  const double ab = a * b;
  const double cd = c * d;
  return {ab - cd, std::fabs(ab) + std::fabs(cd)};
}

Estimate operator*(const Estimate& x, const Estimate& y) noexcept {
  return {x.value * y.value, x.magnitude * y.magnitude};
}

Estimate operator*(double x, const Estimate& y) noexcept {
  return {x * y.value, std::fabs(x) * y.magnitude};
}

Estimate operator+(const Estimate& x, const Estimate& y) noexcept {
  return {x.value + y.value, x.magnitude + y.magnitude};
}

Estimate operator-(const Estimate& x, const Estimate& y) noexcept {
  return {x.value - y.value, x.magnitude + y.magnitude};
}

/// The sign of the true value, or 0 for *uncertain*.
int certain_sign(const Estimate& x, double factor) noexcept {
  const double bound = factor * x.magnitude;
  return x.value > bound ? 1 : x.value < -bound ? -1 : 0;
}

/// Is the regular Q_s definite? Sylvester: if and only if A T3 > 0 and the leading minor of order 2
/// is > 0.
std::optional<bool> is_definite(double a, int t3_sign, const Estimate& minor2) noexcept {
  if (a == 0.0 || (a > 0.0) != (t3_sign > 0)) return false;
  const int sign = certain_sign(minor2, kMinor2Factor);
  if (sign == 0) return std::nullopt;
  return sign > 0;
}

}  // namespace

std::optional<QuadricCoefficients> in_range(const QuadricCoefficients& coefficients) noexcept {
  int lowest = 2 * kBias + 1;
  int highest = 0;
  for (const double c : coefficients) {
    const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(c) << 1;
    if (magnitude == 0) continue;
    const auto exponent = static_cast<int>(magnitude >> (kMantissaBits + 1));
    lowest = std::min(lowest, exponent);
    highest = std::max(highest, exponent);
  }
  if (lowest == 0 || highest - lowest > 2 * kRange) return std::nullopt;
  if (lowest >= kBias - kRange && highest <= kBias + kRange) return coefficients;

  const int shift = kBias - (lowest + highest) / 2;
  QuadricCoefficients scaled = coefficients;
  for (double& c : scaled) {
    const auto bits = std::bit_cast<std::uint64_t>(c);
    if (bits << 1 == 0) continue;
    c = std::bit_cast<double>(bits + (static_cast<std::uint64_t>(shift) << kMantissaBits));
  }
  return scaled;
}

// Laplace's expansion of Q by its rows 1, 2 and rows 3, 4; T3 shares the minors of rows 1, 2.
Determinants determinants(const QuadricCoefficients& coefficients) noexcept {
  const auto& [a, b, c, d, e, f, g, h, j, k] = coefficients;
  const Estimate upper01 = difference_of_products(a, b, d, d);
  const Estimate upper02 = difference_of_products(a, e, d, f);
  const Estimate upper03 = difference_of_products(a, h, d, g);
  const Estimate upper12 = difference_of_products(d, e, b, f);
  const Estimate upper13 = difference_of_products(d, h, b, g);
  const Estimate upper23 = difference_of_products(f, h, e, g);  // also lower01
  const Estimate lower02 = difference_of_products(f, j, c, g);
  const Estimate lower03 = difference_of_products(f, k, j, g);
  const Estimate lower12 = difference_of_products(e, j, c, h);
  const Estimate lower13 = difference_of_products(e, k, j, h);
  const Estimate lower23 = difference_of_products(c, k, j, j);

  const Estimate t3 = (f * upper12 - e * upper02) + c * upper01;
  const Estimate plus =
      (upper01 * lower23 + upper23 * upper23) + (upper03 * lower12 + upper12 * lower03);
  const Estimate minus = upper02 * lower13 + upper13 * lower02;
  return {upper01, t3, plus - minus};
}

std::optional<QuadricType> regular_type(const QuadricCoefficients& coefficients) noexcept {
  const auto scaled = in_range(coefficients);
  if (!scaled) return std::nullopt;
  const Determinants computed = determinants(*scaled);
  const int d4 = certain_sign(computed.d4, kD4Factor);
  const int t3 = certain_sign(computed.t3, kT3Factor);
  if (d4 == 0 || t3 == 0) return std::nullopt;
  const auto definite = is_definite((*scaled)[0], t3, computed.minor2);
  if (!definite) return std::nullopt;
  if (*definite) {
    return d4 < 0 ? QuadricType::real_ellipsoid : QuadricType::imaginary_ellipsoid;
  }
  return d4 > 0 ? QuadricType::hyperboloid_one_sheet : QuadricType::hyperboloid_two_sheets;
}

}  // namespace tangency::inline v0::filter

namespace tangency::inline v0::detail {

Classification classify_coefficients(const QuadricCoefficients& coefficients) noexcept {
  if (const auto type = filter::regular_type(coefficients)) return {*type, 4, 3, Tier::filter};
  return exact::classify_form(
      exact::quadric_form(coefficients, exact::common_exponent(coefficients)));
}

}  // namespace tangency::inline v0::detail
