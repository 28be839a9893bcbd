// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/double_double.hpp>

#include <algorithm>

namespace tangency::inline v0::detail {

DoubleDoubleMatrix double_double_rotation(const Quaternion& q) noexcept {
  // A power of two brings the largest component to [1, 2), so that squares stay in range.
  const int exponent =
      std::max({exponent_of(q.w()), exponent_of(q.x()), exponent_of(q.y()), exponent_of(q.z())});
  const auto component = [&](double c) { return scaled_by_power(c, -exponent); };
  return rotation_matrix<DoubleDouble>(component(q.w()), component(q.x()), component(q.y()),
                                       component(q.z()),
                                       [](double a, double b) { return two_product(a, b); });
}

}  // namespace tangency::inline v0::detail
