// SPDX-License-Identifier: MIT
#include <tangency/geometry/primitives.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <tangency/geometry/bodies/surface_projection.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency {
namespace {

using detail::DoubleDouble;
using detail::DoubleDoubleVector;

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

struct SupportPoint {
  DoubleDouble support;
  DoubleDoubleVector point;
};

/// In the frame of the axes, for semi-axes of which the largest is in [1, 2).
SupportPoint support_point(const Vec3& semi_axes, const DoubleDoubleVector& normal) {
  DoubleDoubleVector axes, reach;
  for (std::size_t i = 0; i < 3; ++i) {
    axes[i] = std::max(semi_axes[static_cast<int>(i)], detail::kThinnestAxisSeen);
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
  const int exponent = high == Vec3::Zero() ? 0 : exponent_of(high);
  const DoubleDoubleVector d = scaled_by_power(seen.separation, -exponent);
  const DoubleDouble distance = detail::length(d);
  const Vec3 n =
      high == Vec3::Zero() ? Vec3(1, 0, 0) : detail::rounded(DoubleDouble(1.0) / distance * d);
  const DoubleDouble gap = scaled_by_power(distance, exponent) -
                           DoubleDouble(std::scalbn(a.radius, -seen.exponent)) -
                           DoubleDouble(std::scalbn(b.radius, -seen.exponent));
  const double size =
      high.norm() + std::scalbn(a.radius, -seen.exponent) + std::scalbn(b.radius, -seen.exponent);
  return global_gap(gap.high, size, seen.exponent, n, a.radius * n, -b.radius * n);
}

Gap between(const Ellipsoid& a, const Sphere& b) {
  assert(b.radius >= 0.0);
  const detail::SeenFromCentre seen = detail::seen_from_centre(a, b.centre);
  const auto [distance, n, arm] = detail::closest_on_surface(a, seen);
  const Vec3 arm_b = -b.radius * n;
  const double radius = std::scalbn(b.radius, -seen.exponent);
  // A radius that this unit cannot hold leaves the body's distance nothing to add to it.
  if (!(radius < 0x1p900)) return global_gap(-b.radius, b.radius, 0, n, arm, arm_b);
  const double size = detail::rounded(seen.separation).norm() + seen.semi_axes.maxCoeff() + radius;
  return global_gap((distance - DoubleDouble(radius)).high, size, seen.exponent, n, arm, arm_b);
}

WallGap between(const Ellipsoid& body, const Plane& wall) {
  assert(wall.normal.allFinite() && wall.normal != Vec3::Zero() && std::isfinite(wall.offset));
  // The normal's largest component in [1, 2); the support function in a unit of the body's own,
  // which may be much smaller than that of the centre.
  const int turn = exponent_of(wall.normal), own = exponent_of(body.semi_axes());
  const int unit = std::max({exponent_of(body.centre()), own, exponent_of(wall.offset) - turn});
  const DoubleDoubleVector n = detail::exactly(scaled_by_power(wall.normal, -turn));
  const DoubleDoubleVector normal = -(DoubleDouble(1.0) / detail::length(n) * n);
  const DoubleDouble above =
      detail::dot(n, detail::exactly(scaled_by_power(body.centre(), -unit))) -
      DoubleDouble(std::scalbn(wall.offset, -turn - unit));

  const detail::DoubleDoubleMatrix r = detail::double_double_rotation(body.orientation());
  const SupportPoint reach =
      support_point(scaled_by_power(body.semi_axes(), -own), turned_back(r, normal));
  const DoubleDouble gap = above / detail::length(n) - scaled_by_power(reach.support, own - unit);
  const DoubleDoubleVector arm = turned(r, reach.point);
  DoubleDoubleVector across;
  for (std::size_t i = 0; i < 3; ++i)
    across[i] = scaled_by_power(arm[i], own - unit) + gap * normal[i];
  return {std::scalbn(gap.high, unit), detail::rounded(normal),
          scaled_by_power(detail::rounded(arm), own),
          scaled_by_power(detail::rounded(across), unit)};
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
