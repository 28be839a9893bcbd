// SPDX-License-Identifier: MIT
#include <tangency/geometry/closest_point.hpp>

#include <cassert>
#include <cmath>

#include <tangency/geometry/bodies/surface_projection.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency {
namespace {

ClosestPoint projected(const Ellipsoid& body, const Vec3& point) {
  assert(point.allFinite());
  const detail::SeenFromCentre seen = detail::seen_from_centre(body, point);
  const detail::ClosestOnSurface found = detail::closest_on_surface(body, seen);
  return {std::scalbn(found.distance.high, seen.exponent), found.normal, found.arm};
}

}  // namespace

ClosestPoint closest_point(const Ellipsoid& body, const Vec3& point) noexcept {
  return in_default_environment([&] { return projected(body, point); });
}

}  // namespace tangency
