// SPDX-License-Identifier: MIT
#include <tangency/geometry/ellipse_closest_point.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

#include <tangency/geometry/bodies/surface_projection.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0 {
namespace {

using detail::DoubleDouble2;

/// An ellipse and a point seen from its centre, in units of 2^exponent: as SeenFromCentre in space.
struct Seen {
  Vec2 semi_axes;
  DoubleDouble2 separation;
  int exponent;
};

Seen seen_from_centre(const Ellipse& body, const Vec2& point) {
  constexpr int kBelowOverflow = 2;
  // The difference of two huge coordinates may overflow in the caller's unit.
  const int shift = (point - body.centre()).allFinite() ? 0 : kBelowOverflow;
  const Vec2 to = scaled_by_power(point, -shift), from = scaled_by_power(body.centre(), -shift);
  const DoubleDouble2 d{detail::two_sum(to[0], -from[0]), detail::two_sum(to[1], -from[1])};
  const int exponent =
      std::max(exponent_of(detail::rounded(d)), exponent_of(body.semi_axes()) - shift);
  const Vec2 axes = scaled_by_power(body.semi_axes(), -(exponent + shift));
  return {axes.cwiseMax(detail::kThinnestAxisSeen),
          {scaled_by_power(d.x, -exponent), scaled_by_power(d.y, -exponent)},
          exponent + shift};
}

/// The ellipse is the plane section of an ellipsoid whose third axis is the longer of the two; to a
/// point in that plane no other point of the ellipsoid is closer.
PlaneClosestPoint projected(const Ellipse& body, const Vec2& point) {
  assert(point.allFinite());
  const Seen seen = seen_from_centre(body, point);
  const DoubleDouble2 axis = detail::double_double_direction(body.direction());
  const DoubleDouble2 y = detail::turned_back(axis, seen.separation);
  const detail::SurfaceProjection found = detail::project_on_surface(
      {seen.semi_axes[0], seen.semi_axes[1], seen.semi_axes.maxCoeff()}, {y.x, y.y, {}});
  const auto in_space = [&](const detail::DoubleDoubleVector& v) {
    return detail::rounded(detail::turned(axis, DoubleDouble2{v[0], v[1]}));
  };
  const double distance = found.distance.high;
  const double size = detail::rounded(seen.separation).norm() + seen.semi_axes.maxCoeff();
  return {std::scalbn(distance, seen.exponent), in_space(found.normal),
          scaled_by_power(in_space(found.point), seen.exponent),
          detail::error_of_distance(distance, size, seen.exponent), GapStatus::ok};
}

}  // namespace

PlaneClosestPoint closest_point(const Ellipse& body, const Vec2& point) noexcept {
  return in_default_environment([&] { return projected(body, point); });
}

PlaneClosestPoint closest_point(const MatrixEllipse& body, const Vec2& point) noexcept {
  return in_default_environment([&] {
    PlaneClosestPoint found = projected(body.ellipse(), point);
    // No support function is off by more, and so no distance.
    found.distance_error = (found.distance_error + body.rounding()) * (1.0 + 0x1p-50);
    return found;
  });
}

PlaneClosestPoint closest_point_from_centre(const Ellipse& body, const Vec2& separation) noexcept {
  return closest_point(body.moved_to(Vec2::Zero()), separation);
}

}  // namespace tangency::inline v0
