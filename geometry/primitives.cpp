// SPDX-License-Identifier: MIT
#include <tangency/geometry/primitives.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <tangency/geometry/bodies/surface_projection.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/numbers/power_of_two.hpp>

namespace tangency {
namespace {

using detail::DoubleDouble;
using detail::DoubleDoubleVector;

Vec3 scaled(const Vec3& v, int power) {
  return v.unaryExpr([=](double x) { return std::scalbn(x, power); });
}

/// A gap that is rounded once, with L = size, in units of 2^exponent.
Gap global_gap(double gap, double size, int exponent, const Vec3& n, const Vec3& arm_a,
               const Vec3& arm_b) {
  // As the header promises; scaling rounds what becomes subnormal, of gap and error.
  const double error = 2.0 * kUnitRoundoff * std::abs(gap) + 0x1p-80 * size;
  constexpr double kSubnormal = 2.0 * std::numeric_limits<double>::denorm_min();
  return {std::scalbn(gap, exponent),
          n,
          arm_a,
          arm_b,
          std::scalbn(error, exponent) + kSubnormal,
          GapStatus::ok,
          GapTier::fast};
}

/// As an ellipsoid to look at a point from. A radius of 0 would be none: it is added afterwards.
Ellipsoid around(const Sphere& sphere, double radius) {
  return {sphere.centre, Vec3::Constant(radius)};
}

DoubleDouble scaled(const DoubleDouble& x, int power) {
  return {std::scalbn(x.high, power), std::scalbn(x.low, power)};
}

int exponent_of_all(const Vec3& v) {
  return std::max({exponent_of(v[0]), exponent_of(v[1]), exponent_of(v[2])});
}

struct SupportPoint {
  DoubleDouble support;
  DoubleDoubleVector point;
};

/// In the frame of the axes, for semi-axes of which the largest is in [1, 2).
SupportPoint support_point(const Vec3& semi_axes, const DoubleDoubleVector& normal) {
  constexpr double kLeastAxis = 0x1p-200;
  DoubleDoubleVector axes, reach;
  for (std::size_t i = 0; i < 3; ++i) {
    axes[i] = std::max(semi_axes[static_cast<int>(i)], kLeastAxis);
    reach[i] = axes[i] * normal[i];
  }
  SupportPoint found{detail::length(reach), {}};
  for (std::size_t i = 0; i < 3; ++i) found.point[i] = axes[i] * reach[i] / found.support;
  return found;
}

Gap between(const Sphere& a, const Sphere& b) {
  assert(a.radius >= 0.0 && b.radius >= 0.0);
  constexpr double kLeast = 0x1p-1074;
  const double larger = std::max({a.radius, b.radius, kLeast});
  const detail::SeenFromCentre seen = detail::seen_from_centre(around(a, larger), b.centre);
  // The direction is formed in a unit of its own: squares of a tiny d would be nothing.
  const Vec3 high = detail::rounded(seen.separation);
  const int exponent = high == Vec3::Zero() ? 0 : exponent_of_all(high);
  DoubleDoubleVector d;
  for (std::size_t i = 0; i < 3; ++i) d[i] = scaled(seen.separation[i], -exponent);
  const DoubleDouble distance = detail::length(d);
  const Vec3 n =
      high == Vec3::Zero() ? Vec3(1, 0, 0) : detail::rounded(DoubleDouble(1.0) / distance * d);
  const DoubleDouble gap = scaled(distance, exponent) -
                           DoubleDouble(std::scalbn(a.radius, -seen.exponent)) -
                           DoubleDouble(std::scalbn(b.radius, -seen.exponent));
  const double size =
      high.norm() + std::scalbn(a.radius, -seen.exponent) + std::scalbn(b.radius, -seen.exponent);
  return global_gap(gap.high, size, seen.exponent, n, a.radius * n, -b.radius * n);
}

Gap between(const Ellipsoid& a, const Sphere& b) {
  assert(b.radius >= 0.0);
  const detail::SeenFromCentre seen = detail::seen_from_centre(a, b.centre);
  const detail::BodyFrame frame(a.orientation());
  const detail::SurfaceProjection found =
      detail::project_on_surface(seen.semi_axes, frame.to_body(seen.separation));
  const Vec3 n = detail::rounded(frame.to_space(found.normal));
  const Vec3 arm = scaled(detail::rounded(frame.to_space(found.point)), seen.exponent);
  const Vec3 arm_b = -b.radius * n;
  const double radius = std::scalbn(b.radius, -seen.exponent);
  // A radius that this unit cannot hold leaves the body's distance nothing to add to it.
  if (!(radius < 0x1p900)) return global_gap(-b.radius, b.radius, 0, n, arm, arm_b);
  const double size = detail::rounded(seen.separation).norm() + seen.semi_axes.maxCoeff() + radius;
  return global_gap((found.distance - DoubleDouble(radius)).high, size, seen.exponent, n, arm,
                    arm_b);
}

WallGap between(const Ellipsoid& body, const Plane& wall) {
  assert(wall.normal.allFinite() && wall.normal != Vec3::Zero() && std::isfinite(wall.offset));
  // The normal's largest component in [1, 2); the support function in a unit of the body's own,
  // which may be much smaller than that of the centre.
  const int turn = exponent_of_all(wall.normal), own = exponent_of_all(body.semi_axes());
  const int unit = std::max({exponent_of_all(body.centre()), own, exponent_of(wall.offset) - turn});
  const DoubleDoubleVector n = detail::exactly(scaled(wall.normal, -turn));
  const DoubleDoubleVector normal = -(DoubleDouble(1.0) / detail::length(n) * n);
  const DoubleDouble above = detail::dot(n, detail::exactly(scaled(body.centre(), -unit))) -
                             DoubleDouble(std::scalbn(wall.offset, -turn - unit));

  const detail::BodyFrame frame(body.orientation());
  const SupportPoint reach = support_point(scaled(body.semi_axes(), -own), frame.to_body(normal));
  const DoubleDouble gap = above / detail::length(n) - scaled(reach.support, own - unit);
  const DoubleDoubleVector arm = frame.to_space(reach.point);
  DoubleDoubleVector across;
  for (std::size_t i = 0; i < 3; ++i) across[i] = scaled(arm[i], own - unit) + gap * normal[i];
  return {std::scalbn(gap.high, unit), detail::rounded(normal), scaled(detail::rounded(arm), own),
          scaled(detail::rounded(across), unit)};
}

}  // namespace

Gap signed_gap(const Sphere& a, const Sphere& b) noexcept {
  return in_default_environment([&] { return between(a, b); });
}

Gap signed_gap(const Ellipsoid& a, const Sphere& b) noexcept {
  return in_default_environment([&] { return between(a, b); });
}

Gap signed_gap(const Sphere& a, const Ellipsoid& b) noexcept {
  const Gap gap = signed_gap(b, a);
  return {gap.gap, -gap.normal, gap.arm_b, gap.arm_a, gap.gap_error, gap.status, gap.tier};
}

WallGap signed_gap(const Ellipsoid& body, const Plane& wall) noexcept {
  return in_default_environment([&] { return between(body, wall); });
}

}  // namespace tangency
