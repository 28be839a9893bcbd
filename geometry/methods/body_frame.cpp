// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/body_frame.hpp>

#include <algorithm>

#include <tangency/geometry/power_of_two.hpp>

namespace tangency::methods {

using exact::DoubleDouble;

BodyFrame::BodyFrame(const Quaternion& orientation) noexcept
    : rotation_(exact::double_double_rotation(orientation)) {}

DoubleDoubleVector BodyFrame::to_body(const DoubleDoubleVector& v) const noexcept {
  return turned_back(rotation_, v);
}

DoubleDoubleVector BodyFrame::to_space(const DoubleDoubleVector& v) const noexcept {
  return {dot(rotation_[0], v), dot(rotation_[1], v), dot(rotation_[2], v)};
}

SeenFromCentre seen_from_centre(const Ellipsoid& body, const Vec3& point) noexcept {
  constexpr double kLeastAxis = 0x1p-200;
  constexpr int kBelowOverflow = 2;
  // The difference of two huge coordinates may overflow in the caller's unit.
  const int shift = (point - body.centre()).allFinite() ? 0 : kBelowOverflow;
  SeenFromCentre seen;
  int exponent = -1100;
  for (int i = 0; i < 3; ++i) {
    const DoubleDouble d = exact::two_sum(scaled_by_power(point[i], -shift),
                                          -scaled_by_power(body.centre()[i], -shift));
    seen.separation[static_cast<std::size_t>(i)] = d;
    exponent = std::max({exponent, exponent_of(d.high), exponent_of(body.semi_axes()[i]) - shift});
  }
  for (DoubleDouble& d : seen.separation) {
    d = {scaled_by_power(d.high, -exponent), scaled_by_power(d.low, -exponent)};
  }
  seen.exponent = exponent + shift;
  for (int i = 0; i < 3; ++i) {
    seen.semi_axes[i] = std::max(scaled_by_power(body.semi_axes()[i], -seen.exponent), kLeastAxis);
  }
  return seen;
}

}  // namespace tangency::methods
