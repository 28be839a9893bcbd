// SPDX-License-Identifier: MIT
#include <tangency/geometry/closest_point.hpp>

#include <cassert>
#include <cmath>

#include <tangency/geometry/bodies/surface_projection.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {
namespace {

ClosestPoint projected(const Ellipsoid& body, const Vec3& point) {
  assert(point.allFinite());
  const detail::SeenFromCentre seen = detail::seen_from_centre(body, point);
  const detail::ClosestOnSurface found = detail::closest_on_surface(body, seen);
  const double distance = found.distance.high;
  return {std::scalbn(distance, seen.exponent), found.normal, found.arm,
          detail::error_of_distance(distance, detail::size_of(seen), seen.exponent), GapStatus::ok};
}

/// @param placed  body.ellipsoid(), about its centre or another
ClosestPoint projected_on(const MatrixEllipsoid& body, const Ellipsoid& placed, const Vec3& point) {
  ClosestPoint found = projected(placed, point);
  // No support function is off by more, and so no distance.
  found.distance_error = (found.distance_error + body.rounding()) * (1.0 + 0x1p-50);
  return found;
}

}  // namespace

ClosestPoint closest_point(const Ellipsoid& body, const Vec3& point) noexcept {
  return in_default_environment([&] { return projected(body, point); });
}

ClosestPoint closest_point(const MatrixEllipsoid& body, const Vec3& point) noexcept {
  return in_default_environment([&] { return projected_on(body, body.ellipsoid(), point); });
}

ClosestPoint closest_point_from_centre(const Ellipsoid& body, const Vec3& separation) noexcept {
  return closest_point(body.moved_to(Vec3::Zero()), separation);
}

ClosestPoint closest_point_from_centre(const MatrixEllipsoid& body,
                                       const Vec3& separation) noexcept {
  return in_default_environment(
      [&] { return projected_on(body, body.ellipsoid().moved_to(Vec3::Zero()), separation); });
}

}  // namespace tangency::inline v0
