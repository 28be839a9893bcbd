// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/real_ellipsoid.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace tangency::inline v0::verify {
namespace {

void require_ellipsoid(const RealEllipsoid& body) {
  const auto finite = [](const Real& v) { return boost::multiprecision::isfinite(v); };
  const auto zero = [](const Real& v) { return v == 0; };
  if (!std::ranges::all_of(body.centre, finite) || !std::ranges::all_of(body.semi_axes, finite) ||
      !std::ranges::all_of(body.orientation, finite)) {
    throw std::invalid_argument("oracle: a number of the ellipsoid is not finite");
  }
  if (!std::ranges::all_of(body.semi_axes, [](const Real& v) { return v > 0; })) {
    throw std::invalid_argument("oracle: a semi-axis is not positive");
  }
  if (std::ranges::all_of(body.orientation, zero)) {
    throw std::invalid_argument("oracle: the orientation is zero");
  }
}

Shape<Real> shape(const RealEllipsoid& body) {
  const auto& [w, x, y, z] = body.orientation;
  const Real n = w * w + x * x + y * y + z * z;
  Shape<Real> result{body.semi_axes,
                     {{{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
                       {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
                       {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}}}};
  for (Real3& axis : result.axes) {
    for (Real& v : axis) v /= n;
  }
  return result;
}

}  // namespace

RealEllipsoid real(const RawEllipsoid& body) {
  RealEllipsoid result;
  std::ranges::copy(body.centre, result.centre.begin());
  std::ranges::copy(body.semi_axes, result.semi_axes.begin());
  std::ranges::copy(body.orientation, result.orientation.begin());
  require_ellipsoid(result);
  return result;
}

Separation<Real> separation(const RealEllipsoid& a, const RealEllipsoid& b) {
  require_ellipsoid(a);
  require_ellipsoid(b);
  Separation<Real> result{{}, shape(a), shape(b)};
  for (std::size_t i = 0; i < 3; ++i) result.d[i] = b.centre[i] - a.centre[i];
  return result;
}

}  // namespace tangency::inline v0::verify
