// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/pair.hpp>

#include <algorithm>

namespace tangency::inline v0::verify {

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

}  // namespace tangency::inline v0::verify
