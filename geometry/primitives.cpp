// SPDX-License-Identifier: MIT
#include <tangency/geometry/primitives.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include <tangency/geometry/bodies/surface_projection.hpp>
#include <tangency/geometry/bodies/wall_form.hpp>
#include <tangency/geometry/gap/sign.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0 {
namespace {

using detail::DoubleDouble;
using detail::DoubleDoubleVector;

/// A gap that is rounded once, with L = size, in units of 2^exponent.
Gap global_gap(double gap, double size, int exponent, const Vec3& n, const Vec3& arm_a,
               const Vec3& arm_b) {
  return {std::scalbn(gap, exponent),
          n,
          arm_a,
          arm_b,
          detail::error_of_distance(gap, size, exponent),
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
  const double size = detail::size_of(seen) + radius;
  return global_gap((distance - DoubleDouble(radius)).high, size, seen.exponent, n, arm, arm_b);
}

/// Which sides of the plane are free.
enum class Free { outer, both };

/// How far the body reaches from a plane, in units of 2^exponent.
struct Reach {
  DoubleDouble height;        ///< of the centre above the plane
  bool reversed;              ///< is above where the plane's normal does not point?
  DoubleDoubleVector normal;  ///< unit, from the body to the plane
  SupportPoint support;       ///< towards it, in units of 2^own; the point in space
  int own, exponent;
  DoubleDouble gap;  ///< height - the support
  double size;       ///< of which 2^-80 bounds the error of double-double

  /// How far the body's other side is above the plane.
  DoubleDouble top() const { return height + scaled_by_power(support.support, own - exponent); }
};

Reach reach(const Ellipsoid& body, const Vec3& wall_normal, double offset, Free free) {
  assert(wall_normal.allFinite() && wall_normal != Vec3::Zero() && std::isfinite(offset));
  // The normal's largest component in [1, 2); the support function in a unit of the body's own,
  // which may be much smaller than that of the centre.
  const int turn = exponent_of(wall_normal), own = exponent_of(body.semi_axes());
  const int unit = std::max({exponent_of(body.centre()), own, exponent_of(offset) - turn});
  DoubleDoubleVector n = detail::exactly(scaled_by_power(wall_normal, -turn));
  const Vec3 centre = scaled_by_power(body.centre(), -unit);
  const double level = std::scalbn(offset, -turn - unit);
  DoubleDouble above = detail::dot(n, detail::exactly(centre)) - DoubleDouble(level);
  const bool reversed = free == Free::both && above.high < 0.0;
  if (reversed) n = -n, above = -above;

  const DoubleDouble length = detail::length(n);
  const DoubleDoubleVector normal = -(DoubleDouble(1.0) / length * n);
  const detail::DoubleDoubleMatrix r = detail::double_double_rotation(body.orientation());
  SupportPoint support =
      support_point(scaled_by_power(body.semi_axes(), -own), turned_back(r, normal));
  support.point = turned(r, support.point);
  const DoubleDouble height = above / length;
  const double axis = std::scalbn(body.largest_semi_axis(), -unit);
  const double far = centre.norm() + std::abs(level) / length.high;
  return {height,
          reversed,
          normal,
          support,
          own,
          unit,
          height - scaled_by_power(support.support, own - unit),
          std::abs(height.high) + axis + 0x1p-18 * far};
}

WallGap wall_gap(const Reach& reach) {
  const double gap = reach.gap.high;
  DoubleDoubleVector across;
  for (std::size_t i = 0; i < 3; ++i)
    across[i] = scaled_by_power(reach.support.point[i], reach.own - reach.exponent) +
                reach.gap * reach.normal[i];
  return {std::scalbn(gap, reach.exponent),
          detail::rounded(reach.normal),
          scaled_by_power(detail::rounded(reach.support.point), reach.own),
          scaled_by_power(detail::rounded(across), reach.exponent),
          detail::error_of_distance(gap, reach.size, reach.exponent),
          GapStatus::ok};
}

/// A wall of either kind, with what the exact signs and the double-double numbers mean for it.
struct AskedWall {
  Vec3 normal;
  double offset;
  Free free;

  explicit AskedWall(const Plane& wall)
      : normal(wall.normal), offset(wall.offset), free(Free::outer) {}
  explicit AskedWall(const Sheet& sheet)
      : normal(sheet.normal), offset(sheet.offset), free(Free::both) {}

  std::optional<Relation> filtered(const Reach& reach, double error) const {
    if (reach.gap.high > error) return Relation::separate;
    if (reach.gap.high >= -error) return std::nullopt;
    if (free == Free::both || reach.top().high > error) return Relation::overlap;
    return reach.top().high < -error ? std::optional(Relation::a_in_b) : std::nullopt;
  }
  Relation exact(const MatrixEllipsoid& body) const {
    const auto [centre, outside] = exact::wall_signs(
        body.exact() != nullptr ? *body.exact() : exact::rational_solid(body.ellipsoid()), normal,
        offset);
    if (outside < 0) return Relation::overlap;
    const bool inside = free == Free::outer && centre < 0;
    if (outside == 0) return inside ? Relation::internal_touch : Relation::external_touch;
    return inside ? Relation::a_in_b : Relation::separate;
  }
};

RelationAnswer relation_of(const MatrixEllipsoid& body, const AskedWall& wall, const Reach& reach) {
  // What is below 2^-1074 in the caller's unit counts there, and in this one is nothing.
  const double off = std::scalbn(body.rounding(), -reach.exponent);
  const double error = (0x1p-80 * reach.size + off) * (1.0 + 0x1p-50);
  const std::optional<Relation> filtered = wall.filtered(reach, error);
  const Relation found = filtered ? *filtered : wall.exact(body);
  return {found, found == Relation::internal_touch ? Inner::a : Inner::none,
          filtered ? Tier::filter : Tier::exact};
}

/// The exact relation, for detail::widened(), which asks for it where the sign is open.
struct KnownRelation {
  Relation known;

  Relation relation() const { return known; }
  bool overlaps(GapTier&) const {
    return known != Relation::separate && known != Relation::external_touch;
  }
};

WallGap signed_gap_of(const MatrixEllipsoid& body, const AskedWall& wall) {
  const Reach found = reach(body.ellipsoid(), wall.normal, wall.offset, wall.free);
  struct Tiered : WallGap {
    GapTier tier;
  };
  const Tiered gap{wall_gap(found), GapTier::fast};
  if (!std::isfinite(gap.gap)) return gap;
  const KnownRelation exact{relation_of(body, wall, found).relation};
  constexpr double kAnywhere = std::numeric_limits<double>::max();
  return detail::widened(gap, body.rounding(), exact, kAnywhere);
}

template <class Wall>
WallGap gap_to(const Ellipsoid& body, const Wall& wall) {
  const AskedWall asked(wall);
  return wall_gap(reach(body, asked.normal, asked.offset, asked.free));
}

/// A plane through a point that is seen from the centre: n . x = n . d as two doubles has no place
/// in a Plane, and so the body moves, by -d, and the plane goes through the origin.
template <class Wall>
WallGap gap_across(const Ellipsoid& body, const Wall& wall, const Vec3& separation) {
  return gap_to(body.moved_to(-separation), Wall{wall.normal, 0.0});
}

template <class Wall>
RelationAnswer relation_to(const MatrixEllipsoid& body, const Wall& wall) {
  const AskedWall asked(wall);
  return relation_of(body, asked, reach(body.ellipsoid(), asked.normal, asked.offset, asked.free));
}

}  // namespace

Gap signed_gap(const Sphere& a, const Sphere& b) noexcept {
  return in_default_environment([&] { return between(a, b); });
}

Gap signed_gap(const Ellipsoid& a, const Sphere& b) noexcept {
  return in_default_environment([&] { return between(a, b); });
}

Gap signed_gap(const MatrixEllipsoid& a, const Sphere& b) noexcept {
  return in_default_environment([&] {
    Gap gap = between(a.ellipsoid(), b);
    // No support function is off by more, and so no distance.
    gap.gap_error = (gap.gap_error + a.rounding()) * (1.0 + 0x1p-50);
    return gap;
  });
}

Gap signed_gap(const Sphere& a, const Ellipsoid& b) noexcept {
  const Gap gap = signed_gap(b, a);
  return {gap.gap, -gap.normal, gap.arm_b, gap.arm_a, gap.gap_error, gap.status, gap.tier};
}

Gap signed_gap(const Sphere& a, const Sphere& b, const Vec3& separation) noexcept {
  return signed_gap(Sphere{Vec3::Zero(), a.radius}, Sphere{separation, b.radius});
}
Gap signed_gap(const Ellipsoid& a, const Sphere& b, const Vec3& separation) noexcept {
  return signed_gap(a.moved_to(Vec3::Zero()), Sphere{separation, b.radius});
}
Gap signed_gap(const Sphere& a, const Ellipsoid& b, const Vec3& separation) noexcept {
  return signed_gap(Sphere{Vec3::Zero(), a.radius}, b.moved_to(separation));
}

WallGap signed_gap(const Ellipsoid& body, const Plane& wall) noexcept {
  return in_default_environment([&] { return gap_to(body, wall); });
}
WallGap signed_gap(const Ellipsoid& body, const Sheet& sheet) noexcept {
  return in_default_environment([&] { return gap_to(body, sheet); });
}

WallGap signed_gap(const Ellipsoid& body, const Plane& wall, const Vec3& separation) noexcept {
  return in_default_environment([&] { return gap_across(body, wall, separation); });
}
WallGap signed_gap(const Ellipsoid& body, const Sheet& sheet, const Vec3& separation) noexcept {
  return in_default_environment([&] { return gap_across(body, sheet, separation); });
}

WallGap signed_gap(const MatrixEllipsoid& body, const Plane& wall) noexcept {
  return in_default_environment([&] { return signed_gap_of(body, AskedWall(wall)); });
}
WallGap signed_gap(const MatrixEllipsoid& body, const Sheet& sheet) noexcept {
  return in_default_environment([&] { return signed_gap_of(body, AskedWall(sheet)); });
}

RelationAnswer relation(const MatrixEllipsoid& body, const Plane& wall) noexcept {
  return in_default_environment([&] { return relation_to(body, wall); });
}
RelationAnswer relation(const MatrixEllipsoid& body, const Sheet& sheet) noexcept {
  return in_default_environment([&] { return relation_to(body, sheet); });
}

}  // namespace tangency::inline v0
