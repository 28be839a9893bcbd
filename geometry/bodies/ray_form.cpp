// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/ray_form.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tangency/geometry/bodies/ellipsoid_form.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0::exact {
namespace {

int common_exponent_of(const Vec3& v) {
  const std::array<double, 3> components{v.x(), v.y(), v.z()};
  return common_exponent(components);
}

mpz_class shifted(const mpz_class& value, long by) {
  return by >= 0 ? mpz_class(value << static_cast<mp_bitcnt_t>(by))
                 : mpz_class(value >> static_cast<mp_bitcnt_t>(-by));
}

/// numerator / denominator / 2^exponent
detail::DoubleDouble quotient(const mpz_class& numerator, const mpz_class& denominator,
                              long exponent) {
  constexpr long kBits = 120;
  if (numerator == 0) return {};
  const long shift = kBits + bit_length(denominator) - bit_length(numerator);
  mpz_class digits =
      shifted(numerator, std::max(0L, shift)) / shifted(denominator, std::max(0L, -shift));
  const double high = digits.get_d();
  digits -= mpz_class(high);
  const int power = static_cast<int>(std::clamp(-shift - exponent, -5000L, 5000L));
  return detail::quick_two_sum(std::scalbn(high, power), std::scalbn(digits.get_d(), power));
}

int common_unit(const Ellipsoid& body, const Vec3& origin) {
  return std::min(length_exponent(body), common_exponent_of(origin));
}

/// The form in coordinates x / 2^exponent, times a power of four. Requires exponent <= 0.
IntegerForm<4> in_unit(IntegerForm<4> form, int exponent) {
  const auto finer = static_cast<mp_bitcnt_t>(-exponent);
  for (std::size_t i = 0; i < 3; ++i) form[i][3] <<= finer, form[3][i] <<= finer;
  form[3][3] <<= 2 * finer;
  return form;
}

/// Of unit length, from integers of any size.
Vec3 unit_vector(const std::array<mpz_class, 3>& v) {
  long longest = 0;
  for (const mpz_class& x : v) longest = std::max(longest, bit_length(x));
  constexpr long kBits = 500;  // products of components are in range
  const auto component = [&](const mpz_class& x) { return shifted(x, kBits - longest).get_d(); };
  return Vec3(component(v[0]), component(v[1]), component(v[2])).stableNormalized();
}

}  // namespace

RayForm::RayForm(const Ellipsoid& body, const Vec3& origin, const Vec3& direction)
    : RayForm(common_unit(body, origin), body, origin, direction) {}

RayForm::RayForm(int exponent, const Ellipsoid& body, const Vec3& origin, const Vec3& direction)
    : RayForm(ellipsoid_form(body, exponent).form, exponent, body, origin, direction) {}

RayForm::RayForm(const RationalSolid<3>& body, const Ellipsoid& rounded, const Vec3& origin,
                 const Vec3& direction)
    : RayForm(in_unit(integer_form(body).form, std::min(0, common_exponent_of(origin))),
              std::min(0, common_exponent_of(origin)), rounded, origin, direction) {}

RayForm::RayForm(IntegerForm<4> form, int exponent, const Ellipsoid& body, const Vec3& origin,
                 const Vec3& direction)
    : form_(std::move(form)) {
  const int of_direction = common_exponent_of(direction);
  unit_ = of_direction - exponent;
  int largest = exponent,
      least = body.semi_axes().unaryExpr([](double x) { return exponent_of(x); }).minCoeff();
  for (int i = 0; i < 3; ++i) {
    origin_[static_cast<std::size_t>(i)] = to_integer(origin[i], exponent);
    direction_[static_cast<std::size_t>(i)] = to_integer(direction[i], of_direction);
    largest = std::max({largest, exponent_of(origin[i]), exponent_of(body.centre()[i]),
                        exponent_of(body.semi_axes()[i])});
  }
  // The normal's components, which are those of x - c over squares of semi-axes, need that many.
  bits_ = static_cast<mp_bitcnt_t>(128 + 2 * (largest - least));
  const auto row = [&](std::size_t i, const IntegerVector& x, int last) {
    return mpz_class(form_[i][0] * x[0] + form_[i][1] * x[1] + form_[i][2] * x[2] +
                     form_[i][3] * last);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_class of_origin = row(i, origin_, 1);
    c0_ += origin_[i] * of_origin;
    c1_ += direction_[i] * of_origin;
    c2_ += direction_[i] * row(i, direction_, 0);
  }
  c0_ += row(3, origin_, 1);
  discriminant_ = c1_ * c1_ - c0_ * c2_;
}

int RayForm::level_sign(double t) const {
  const auto [mantissa, exponent] = decode(t);
  const mpz_class m = to_integer(mantissa);
  const long shift = exponent + unit_;
  const long up = std::max(0L, shift), down = std::max(0L, -shift);
  return sgn(mpz_class(shifted(c0_, 2 * down) + 2 * m * shifted(c1_, up + down) +
                       m * m * shifted(c2_, 2 * up)));
}

int RayForm::slope_sign(double t) const {
  const auto [mantissa, exponent] = decode(t);
  const mpz_class m = to_integer(mantissa);
  const long shift = exponent + unit_;
  return sgn(mpz_class(shifted(c1_, std::max(0L, -shift)) + m * shifted(c2_, std::max(0L, shift))));
}

RayForm::Hit RayForm::hit(int side, int exponent) const {
  const mpz_class numerator =
      (-c1_ << bits_) + side * sqrt(mpz_class(discriminant_ << (2 * bits_)));
  const mpz_class denominator = c2_ << bits_;
  IntegerVector point, gradient;
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = origin_[i] * denominator + direction_[i] * numerator;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    gradient[i] = form_[i][3] * denominator;
    for (std::size_t k = 0; k < 3; ++k) gradient[i] += form_[i][k] * point[k];
  }
  return {quotient(numerator, denominator, long{exponent} + unit_), unit_vector(gradient)};
}

}  // namespace tangency::inline v0::exact
