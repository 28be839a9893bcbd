// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/ellipsoid_form.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tangency::inline v0::exact {
namespace {

using IntegerVector = std::array<mpz_class, 3>;

IntegerVector to_integers(const Vec3& v, int exponent) {
  return {to_integer(v.x(), exponent), to_integer(v.y(), exponent), to_integer(v.z(), exponent)};
}

/// matrix diag(weights) matrix'
IntegerForm<3> weighted_square(const IntegerForm<3>& matrix, const IntegerVector& weights) {
  IntegerForm<3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) result[i][j] += matrix[i][k] * weights[k] * matrix[j][k];
      if (j != i) result[j][i] = result[i][j];
    }
  }
  return result;
}

/// The form of (x - c)' block (x - c) - constant.
IntegerForm<4> centred_form(const IntegerForm<3>& block, const IntegerVector& centre,
                            const mpz_class& constant) {
  IntegerForm<4> form;
  form[3][3] = -constant;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      form[i][j] = block[i][j];
      form[i][3] -= block[i][j] * centre[j];
    }
    form[3][i] = form[i][3];
    form[3][3] -= form[i][3] * centre[i];
  }
  return form;
}

}  // namespace

ScaledRotation scaled_rotation(const Quaternion& q) {
  const std::array<double, 4> stored{q.w(), q.x(), q.y(), q.z()};
  const int exponent = common_exponent(stored);
  const mpz_class w = to_integer(stored[0], exponent);
  const mpz_class x = to_integer(stored[1], exponent);
  const mpz_class y = to_integer(stored[2], exponent);
  const mpz_class z = to_integer(stored[3], exponent);
  const mpz_class ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  const mpz_class wx = 2 * w * x, wy = 2 * w * y, wz = 2 * w * z;
  const mpz_class xy = 2 * x * y, yz = 2 * y * z, zx = 2 * z * x;
  ScaledRotation result;
  result.matrix[0] = {ww + xx - yy - zz, xy - wz, zx + wy};
  result.matrix[1] = {xy + wz, ww - xx + yy - zz, yz - wx};
  result.matrix[2] = {zx - wy, yz + wx, ww - xx - yy + zz};
  result.squared_length = ww + xx + yy + zz;
  return result;
}

int length_exponent(const Ellipsoid& e) noexcept {
  const Vec3& c = e.centre();
  const Vec3& a = e.semi_axes();
  const std::array<double, 6> lengths{c.x(), c.y(), c.z(), a.x(), a.y(), a.z()};
  return common_exponent(lengths);
}

EllipsoidForm ellipsoid_form(const Ellipsoid& e, int exponent) {
  const ScaledRotation rotation = scaled_rotation(e.orientation());
  IntegerVector square = to_integers(e.semi_axes(), exponent);
  for (mpz_class& s : square) s *= s;
  const IntegerVector weights{square[1] * square[2], square[2] * square[0], square[0] * square[1]};

  EllipsoidForm result;
  result.denominator = weights[0] * square[0] * rotation.squared_length * rotation.squared_length;
  result.form = centred_form(weighted_square(rotation.matrix, weights),
                             to_integers(e.centre(), exponent), result.denominator);
  return result;
}

// With x = 2^e X the form in x has its block divided by 4^e and its column by 2^e; the common
// factor 4^e (for e > 0) keeps it in integers.
EllipsoidForm ellipsoid_form(const Ellipsoid& e) {
  const int exponent = length_exponent(e);
  EllipsoidForm result = ellipsoid_form(e, exponent);
  const auto shift = static_cast<mp_bitcnt_t>(std::abs(exponent));
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const auto lines =
          static_cast<mp_bitcnt_t>(exponent > 0 ? (i == 3) + (j == 3) : (i != 3) + (j != 3));
      result.form[i][j] <<= shift * lines;
    }
  }
  if (exponent > 0) result.denominator <<= 2 * shift;
  return result;
}

}  // namespace tangency::inline v0::exact
