// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/double_double_body.hpp>

#include <algorithm>
#include <cstddef>

#include <tangency/geometry/numbers/power_of_two.hpp>

namespace tangency::detail {

DoubleDoubleSide::DoubleDoubleSide(const Ellipsoid& body, const DoubleDoubleVector& normal) noexcept
    : rotation(double_double_rotation(body.orientation())),
      semi_axes(&body.semi_axes()),
      stretched(turned_back(rotation, normal)) {
  for (std::size_t k = 0; k < 3; ++k) stretched[k] = axis(k) * stretched[k];
  support = sqrt(dot(stretched, stretched));
}

DoubleDoubleVector DoubleDoubleSide::support_point() const noexcept {
  DoubleDoubleVector body, point;
  for (std::size_t k = 0; k < 3; ++k) body[k] = axis(k) * stretched[k] / support;
  for (std::size_t i = 0; i < 3; ++i) point[i] = dot(rotation[i], body);
  return point;
}

BodyFrame::BodyFrame(const Quaternion& orientation) noexcept
    : rotation_(double_double_rotation(orientation)) {}

DoubleDoubleVector BodyFrame::to_body(const DoubleDoubleVector& v) const noexcept {
  return turned_back(rotation_, v);
}

DoubleDoubleVector BodyFrame::to_space(const DoubleDoubleVector& v) const noexcept {
  return {dot(rotation_[0], v), dot(rotation_[1], v), dot(rotation_[2], v)};
}

namespace {

/// @param separation  in units of 2^shift
SeenFromCentre in_own_unit(const Ellipsoid& body, const DoubleDoubleVector& separation, int shift) {
  constexpr double kLeastAxis = 0x1p-200;
  SeenFromCentre seen;
  int exponent = -1100;
  for (int i = 0; i < 3; ++i) {
    exponent = std::max({exponent, exponent_of(separation[static_cast<std::size_t>(i)].high),
                         exponent_of(body.semi_axes()[i]) - shift});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble& d = separation[i];
    seen.separation[i] = {scaled_by_power(d.high, -exponent), scaled_by_power(d.low, -exponent)};
  }
  seen.exponent = exponent + shift;
  for (int i = 0; i < 3; ++i) {
    seen.semi_axes[i] = std::max(scaled_by_power(body.semi_axes()[i], -seen.exponent), kLeastAxis);
  }
  return seen;
}

}  // namespace

SeenFromCentre seen_from_centre(const Ellipsoid& body, const Vec3& point) noexcept {
  constexpr int kBelowOverflow = 2;
  // The difference of two huge coordinates may overflow in the caller's unit.
  const int shift = (point - body.centre()).allFinite() ? 0 : kBelowOverflow;
  DoubleDoubleVector separation;
  for (int i = 0; i < 3; ++i) {
    separation[static_cast<std::size_t>(i)] =
        two_sum(scaled_by_power(point[i], -shift), -scaled_by_power(body.centre()[i], -shift));
  }
  return in_own_unit(body, separation, shift);
}

SeenFromCentre seen_from_centre(const Ellipsoid& body,
                                const DoubleDoubleVector& separation) noexcept {
  return in_own_unit(body, separation, 0);
}

}  // namespace tangency::detail
