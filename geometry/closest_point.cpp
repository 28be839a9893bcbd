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
  const detail::BodyFrame frame(body.orientation());
  const detail::SurfaceProjection found =
      detail::project_on_surface(seen.semi_axes, frame.to_body(seen.separation));
  const Vec3 arm = detail::rounded(frame.to_space(found.point));
  const auto in_unit = [&](double x) { return std::scalbn(x, seen.exponent); };
  return {in_unit(found.distance.high), detail::rounded(frame.to_space(found.normal)),
          arm.unaryExpr(in_unit)};
}

}  // namespace

ClosestPoint closest_point(const Ellipsoid& body, const Vec3& point) noexcept {
  return in_default_environment([&] { return projected(body, point); });
}

}  // namespace tangency
