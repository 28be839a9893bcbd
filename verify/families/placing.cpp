// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/placing.hpp>

#include <algorithm>
#include <cstddef>

#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::verify {

std::array<double, 3> triaxial_axes(Draw& draw, double shortest, double aspect) {
  std::array<double, 3> axes{shortest * aspect, shortest * draw.log_uniform(1, aspect), shortest};
  draw.shuffle(axes);
  return axes;
}

RawEllipsoid turned_body(Draw& draw, const std::array<double, 3>& axes) {
  return {{}, axes, draw.orientation()};
}

double least_axis(const RawEllipsoid& body) { return std::ranges::min(body.semi_axes); }
double most_axis(const RawEllipsoid& body) { return std::ranges::max(body.semi_axes); }

double least_axis(const EllipsoidPair& pair) {
  return std::min(least_axis(pair.a), least_axis(pair.b));
}

double least_radii(const EllipsoidPair& pair) {
  return least_axis(pair.a) * (least_axis(pair.a) / most_axis(pair.a)) +
         least_axis(pair.b) * (least_axis(pair.b) / most_axis(pair.b));
}

Real place_b(EllipsoidPair& pair, const Real3& n, const Real& gap, const Real& share) {
  const Separation<Real> shapes = separation(real(pair.a), real(pair.b));
  const Real3 reach = ascent::combined(ascent::support_point(shapes.a, n), Real(1),
                                       ascent::support_point(shapes.b, n), Real(0), n);
  Real left = -ascent::dot(reach, n);
  for (std::size_t i = 0; i < 3; ++i) {
    const Real from = pair.a.centre[i];
    pair.b.centre[i] = rounded(from + share * reach[i] + gap * n[i]);
    left += (pair.b.centre[i] - from) * n[i];
  }
  return left;
}

}  // namespace tangency::verify
