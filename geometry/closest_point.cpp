// SPDX-License-Identifier: MIT
#include <tangency/geometry/closest_point.hpp>

#include <cassert>
#include <cmath>

#include <tangency/geometry/floating_point_environment.hpp>
#include <tangency/geometry/methods/surface_projection.hpp>

namespace tangency {
namespace {

ClosestPoint projected(const Ellipsoid& body, const Vec3& point) {
  assert(point.allFinite());
  const methods::SeenFromCentre seen = methods::seen_from_centre(body, point);
  const methods::BodyFrame frame(body.orientation());
  const methods::SurfaceProjection found =
      methods::project_on_surface(seen.semi_axes, frame.to_body(seen.separation));
  const Vec3 arm = exact::rounded(frame.to_space(found.point));
  const auto in_unit = [&](double x) { return std::scalbn(x, seen.exponent); };
  return {in_unit(found.distance.high), exact::rounded(frame.to_space(found.normal)),
          arm.unaryExpr(in_unit)};
}

}  // namespace

ClosestPoint closest_point(const Ellipsoid& body, const Vec3& point) noexcept {
  return in_default_environment([&] { return projected(body, point); });
}

}  // namespace tangency
