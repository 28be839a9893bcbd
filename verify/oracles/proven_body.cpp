// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/proven_body.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace tangency::inline v0::verify {
namespace {

// |q|^2 R(q) by columns, in any arithmetic that the entries of q are given in.
template <class T>
std::array<std::array<T, 3>, 3> turned_axes(const T& w, const T& x, const T& y, const T& z) {
  const T ww = w * w, xx = x * x, yy = y * y, zz = z * z, two = 2.0L;
  return {{{ww + xx - yy - zz, two * (x * y + w * z), two * (x * z - w * y)},
           {two * (x * y - w * z), ww - xx + yy - zz, two * (y * z + w * x)},
           {two * (x * z + w * y), two * (y * z - w * x), ww - xx - yy + zz}}};
}

// A power of two, so that the largest entry of q is about 1: exact.
int exponent_of(const RawEllipsoid& body) {
  double most = 0;
  for (const double v : body.orientation) most = std::max(most, std::abs(v));
  const bool finite = std::ranges::all_of(body.centre, [](double v) { return std::isfinite(v); });
  const bool is_body =
      std::ranges::all_of(body.semi_axes, [](double v) { return v > 0 && std::isfinite(v); });
  if (!finite || !is_body || !(most > 0) || !std::isfinite(most)) {
    throw std::invalid_argument("oracle: not an ellipsoid");
  }
  return std::ilogb(most);
}

// The unit axes, R(q/|q|) by columns. What underflows of q is lost in the error of a Ball.
template <class T>
std::array<std::array<T, 3>, 3> unit_axes(const RawEllipsoid& body) {
  const int exponent = exponent_of(body);
  std::array<T, 4> q;
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = std::ldexp(static_cast<long double>(body.orientation[i]), -exponent);
  }
  auto axes = turned_axes(q[0], q[1], q[2], q[3]);
  const T per = T(1.0L) / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (auto& axis : axes) {
    for (T& v : axis) v = per * v;
  }
  return axes;
}

}  // namespace

Ball in_unit(double length, int unit) {
  const double scaled = std::ldexp(length, -unit);
  // What is rounded below the normal range.
  constexpr double kLost = std::numeric_limits<double>::denorm_min();
  return {scaled, std::abs(scaled) < std::numeric_limits<double>::min() && length != 0 ? kLost : 0};
}

Shape<long double> guessed_shape(const RawEllipsoid& body) {
  return {{body.semi_axes[0], body.semi_axes[1], body.semi_axes[2]}, unit_axes<long double>(body)};
}

ProvenBody::ProvenBody(const RawEllipsoid& body, int unit) : axes_(unit_axes<Ball>(body)) {
  for (std::size_t k = 0; k < 3; ++k) lengths_[k] = in_unit(body.semi_axes[k], unit);
  const auto [least, most] = std::ranges::minmax(body.semi_axes);
  radius_ = in_unit(least, unit) * in_unit(least, unit) / in_unit(most, unit);
}

Ball3 ProvenBody::stretched(const Ball3& n) const {
  Ball3 along;
  for (std::size_t k = 0; k < 3; ++k) along[k] = lengths_[k] * inner(axes_[k], n);
  return along;
}

std::array<Ball3, 3> ProvenBody::rows() const {
  std::array<Ball3, 3> all = axes_;
  for (std::size_t k = 0; k < 3; ++k) {
    for (Ball& v : all[k]) v = lengths_[k] * v;
  }
  return all;
}

Ball ProvenBody::support(const Ball3& n) const {
  const Ball3 along = stretched(n);
  return sqrt(inner(along, along));
}

Ball ProvenBody::support_from(const Ball3& n, Ball3& w) const {
  const Ball3 along = stretched(n);
  const Ball h = sqrt(inner(along, along)), per = Ball(1) / h;
  for (std::size_t k = 0; k < 3; ++k) {
    const Ball share = along[k] * lengths_[k] * per;
    for (std::size_t i = 0; i < 3; ++i) w[i] = w[i] - share * axes_[k][i];
  }
  return h;
}

bool ProvenBody::holds(const Ball3& x) const {
  Ball sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const Ball along = inner(axes_[k], x) / lengths_[k];
    sum = sum + along * along;
  }
  return sum.most() < 1;
}

}  // namespace tangency::inline v0::verify
