// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/overlap_filter_double_double.hpp>

#include <cmath>

#include <tangency/geometry/exact/double_double_body.hpp>

namespace tangency::methods {
namespace {

using exact::DoubleDouble;
using Vector = exact::DoubleDoubleVector;
using Side = exact::DoubleDoubleSide;

constexpr double kDirection = 64 * exact::kDoubleDoubleEpsilon;  // E5 of the derivation
constexpr double kTurned = 64 * exact::kDoubleDoubleEpsilon;     // E6

/// Level < 1 proven at p from the centre, each component of p known to within `error`.
bool inside(const Side& s, const Vector& p, double error) {
  const DoubleDouble turned(kTurned * exact::sum_of_absolutes(p) + 2.0 * error);
  const Vector body = exact::turned_back(s.rotation, p);
  DoubleDouble level;
  for (std::size_t k = 0; k < 3; ++k) {
    const DoubleDouble ratio = (abs(body[k]) + turned) / s.axis(k);
    level = level + ratio * ratio;
  }
  return (DoubleDouble(1.0) - level).high > 32 * exact::kDoubleDoubleEpsilon;
}

}  // namespace

Filtered filter_overlap_in_double_double(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                                         const Vec3& d_low, const Vec3& n) noexcept {
  const Vector normal = {n[0], n[1], n[2]};
  const Vector between = {DoubleDouble(d[0], d_low[0]), {d[1], d_low[1]}, {d[2], d_low[2]}};
  const Side sa(a, normal), sb(b, normal);
  const DoubleDouble gap = dot(between, normal) - sa.support - sb.support;
  const double size =
      exact::sum_of_absolutes(between) + a.largest_semi_axis() + b.largest_semi_axis();
  if (gap.high > kDirection * n.cwiseAbs().sum() * size) return Filtered::apart;

  // A point of the lens, between the witness points of the normal.
  const Vector from_a = sa.support_point(), from_b = sb.support_point();
  Vector point, beyond;
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = DoubleDouble(0.5) * (from_a[i] + (between[i] - from_b[i]));
    beyond[i] = point[i] - between[i];
  }
  const double error = 2.0 * exact::kDoubleDoubleEpsilon *
                       (exact::sum_of_absolutes(between) + exact::sum_of_absolutes(point));
  const bool meet = inside(sa, point, 0.0) && inside(sb, beyond, error);
  return meet ? Filtered::interiors_meet : Filtered::unknown;
}

}  // namespace tangency::methods
