// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/near_tie.hpp>

#include <algorithm>

#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

// The largest radius of curvature.
Real flattest(const Shape<Real>& body) {
  const auto [least, most] = std::ranges::minmax(body.semi_axes);
  return most * most / least;
}

}  // namespace

bool is_normal_within_rounding(const EllipsoidPair& pair, const std::array<double, 3>& normal,
                               const Real& gap) {
  if (normal == std::array<double, 3>{}) return false;
  const Separation<Real> bodies = separation(real(pair.a), real(pair.b));
  const Real3 along = ascent::normalised(Real3{normal[0], normal[1], normal[2]});
  const ascent::Value<Real> at = ascent::value(bodies, along);
  const Real size = ascent::extent(bodies), unit = Real(0x1p-53);
  const Real radii = flattest(bodies.a) + flattest(bodies.b);
  return gap - at.f <= 16 * unit * size && at.residual <= 12 * unit * (size + radii);
}

}  // namespace tangency::inline v0::verify
