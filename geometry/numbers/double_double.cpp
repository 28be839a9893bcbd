// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/double_double.hpp>

#include <algorithm>
#include <cmath>

#include <tangency/geometry/numbers/power_of_two.hpp>

namespace tangency::detail {

DoubleDoubleMatrix double_double_rotation(const Quaternion& q) noexcept {
  // A power of two brings the largest component to [1, 2), so that squares stay in range.
  const int exponent =
      std::max({exponent_of(q.w()), exponent_of(q.x()), exponent_of(q.y()), exponent_of(q.z())});
  const double w = scaled_by_power(q.w(), -exponent), x = scaled_by_power(q.x(), -exponent);
  const double y = scaled_by_power(q.y(), -exponent), z = scaled_by_power(q.z(), -exponent);
  const DoubleDouble ww = two_product(w, w), xx = two_product(x, x);
  const DoubleDouble yy = two_product(y, y), zz = two_product(z, z);
  const DoubleDouble wx = two_product(w, x), wy = two_product(w, y), wz = two_product(w, z);
  const DoubleDouble xy = two_product(x, y), yz = two_product(y, z), zx = two_product(z, x);
  const DoubleDouble s = DoubleDouble(1.0) / (ww + xx + (yy + zz)), t = s + s;
  return {{{s * (ww + xx - (yy + zz)), t * (xy - wz), t * (zx + wy)},
           {t * (xy + wz), s * (ww + yy - (xx + zz)), t * (yz - wx)},
           {t * (zx - wy), t * (yz + wx), s * (ww + zz - (xx + yy))}}};
}

DoubleDoubleVector turned_back(const DoubleDoubleMatrix& r, const DoubleDoubleVector& v) noexcept {
  DoubleDoubleVector result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = r[0][k] * v[0] + r[1][k] * v[1] + r[2][k] * v[2];
  }
  return result;
}

DoubleDouble dot(const DoubleDoubleVector& a, const DoubleDoubleVector& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double sum_of_absolutes(const DoubleDoubleVector& v) noexcept {
  return std::abs(v[0].high) + std::abs(v[1].high) + std::abs(v[2].high);
}

}  // namespace tangency::detail
