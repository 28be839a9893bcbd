// SPDX-License-Identifier: MIT
#include <tangency/dem/narrow_phase.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <tangency/dem/parallel.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/primitives.hpp>

namespace tangency::dem {
namespace {

constexpr double kApart = std::numeric_limits<double>::infinity();

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

Vec3 in_space(const Vec2& v) { return {v[0], v[1], 0.0}; }

Ellipse ellipse_of(const Particles& particles, std::size_t i) {
  const Quaternion& q = particles.orientation[i];  // (cos, 0, 0, sin) of half the angle
  const Vec2 direction(q.w() * q.w() - q.z() * q.z(), 2.0 * q.w() * q.z());
  return Ellipse(Vec2::Zero(), particles.semi_axes[i].head<2>(), direction);
}

/// Spheres that touch concentrically have no normal: that of geometry/primitives.hpp.
void find_spheres(double a, double b, Touch& touch) {
  const double distance = touch.branch.norm();
  touch.gap = distance - (a + b);
  touch.normal = distance > 0.0 ? Vec3(touch.branch / distance) : Vec3::UnitX();
  touch.arm = (a + 0.5 * touch.gap) * touch.normal;
}

/// Are two bodies apart because their bounding spheres are? The normal is then forgotten.
template <class Body>
bool spheres_apart(const Body& a, const Body& b, Touch& touch) {
  const double reach = a.largest_semi_axis() + b.largest_semi_axis();
  touch.gap = kApart;
  touch.normal.setZero();
  return touch.branch.squaredNorm() >= reach * reach;
}

void find_ellipses(const Ellipse& a, const Ellipse& b, const Vec2& last_normal, Branch branch,
                   Touch& touch) {
  if (spheres_apart(a, b, touch)) return;
  const Vec2 d = touch.branch.head<2>();
  if (!last_normal.isZero(0.0)) {
    // For any unit n, n.d - h_a - h_b is at most the gap: while the plane across the last normal
    // parts the bodies nothing else is asked. The normal is kept as a start for next time.
    touch.normal = in_space(last_normal);
    if (last_normal.dot(d) - a.support(last_normal) - b.support(last_normal) > 0.0) return;
  }
  const PlaneGap gap = branch == Branch::global || last_normal.isZero(0.0)
                           ? signed_gap(a, b, d)
                           : follow_gap(a, b, d, last_normal);
  touch.gap = gap.gap;
  touch.normal = in_space(gap.normal);
  touch.arm = 0.5 * (in_space(gap.arm_a) + touch.branch + in_space(gap.arm_b));
}

/// The pairs of a block that geometry is asked about, side by side as it wants them.
struct Questions {
  std::array<IndexedPair, Bodies::block> pairs;
  std::array<Vec3, Bodies::block> separations, normals, arms_a, arms_b;
  std::array<double, Bodies::block> gaps;
  std::array<std::uint32_t, Bodies::block> place;  ///< in the block
  std::size_t count = 0;

  void add(const Pair& pair, const Touch& touch, const Vec3& last_normal, std::size_t k) {
    pairs[count] = {static_cast<std::uint32_t>(pair.a), static_cast<std::uint32_t>(pair.b)};
    separations[count] = touch.branch;
    normals[count] = last_normal;
    place[count++] = static_cast<std::uint32_t>(k);
  }
  template <class T>
  std::span<T> first(std::array<T, Bodies::block>& column) {
    return {column.data(), count};
  }
  PairList list() { return {first(pairs), first(separations)}; }
  GapColumns columns() {
    GapColumns columns;
    columns.gap = first(gaps);
    columns.normal = first(normals);
    columns.arm_a = first(arms_a);
    columns.arm_b = first(arms_b);
    return columns;
  }
  void answer(std::span<Touch> touches) const {
    for (std::size_t k = 0; k < count; ++k) {
      Touch& touch = touches[place[k]];
      touch.gap = gaps[k];
      touch.normal = normals[k];
      touch.arm = 0.5 * (arms_a[k] + touch.branch + arms_b[k]);
    }
  }
};

}  // namespace

void Bodies::refresh(const Particles& particles) {
  const std::size_t count = particles.size();
  const bool round = std::all_of(particles.semi_axes.begin(), particles.semi_axes.end(),
                                 [](const Vec3& axes) { return axes == Vec3::Constant(axes[0]); });
  kind_ = particles.dimensions == 2 ? Kind::ellipses : round ? Kind::spheres : Kind::ellipsoids;
  const bool first = ellipsoids_.size() != count;
  if (kind_ == Kind::spheres) radii_.resize(count);
  if (kind_ == Kind::ellipses) ellipses_.resize(count, Ellipse(Vec2::Zero(), Vec2::Ones()));
  if (kind_ == Kind::ellipsoids && first)
    ellipsoids_.resize(count, Ellipsoid(Vec3::Zero(), Vec3::Ones()));
  if (kind_ == Kind::ellipsoids && (first || !array_)) array_.emplace(ellipsoids_);
#pragma omp parallel for schedule(static) if (count >= kWorthSharing)
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& axes = particles.semi_axes[i];
    if (kind_ == Kind::spheres) {
      radii_[i] = axes[0];
    } else if (kind_ == Kind::ellipses) {
      ellipses_[i] = ellipse_of(particles, i);
    } else {
      ellipsoids_[i] = Ellipsoid(Vec3::Zero(), axes, particles.orientation[i]);
      array_->refresh(i);
    }
  }
}

void Bodies::find(std::span<const Pair> pairs, const Particles& particles, const Cell& cell,
                  std::span<const Vec3> normals, Branch branch, std::span<Touch> touches) const {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Pair& pair = pairs[k];
    const std::size_t a = at(pair.a), b = at(pair.b);
    if (b >= particles.size()) {
      touches[k] = touch_wall(a, Wall(b - particles.size()), particles, cell);
      continue;
    }
    touches[k].branch = branch_vector(pair, particles, cell);
    if (kind_ == Kind::spheres)
      find_spheres(radii_[a], radii_[b], touches[k]);
    else if (kind_ == Kind::ellipses)
      find_ellipses(ellipses_[a], ellipses_[b], normals[k].head<2>(), branch, touches[k]);
  }
  if (kind_ == Kind::ellipsoids) find_ellipsoids(pairs, normals, branch, touches);
}

void Bodies::find_ellipsoids(std::span<const Pair> pairs, std::span<const Vec3> normals,
                             Branch branch, std::span<Touch> touches) const {
  Questions followed, fresh;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t a = at(pairs[k].a), b = at(pairs[k].b);
    if (b >= ellipsoids_.size()) continue;  // a wall
    if (spheres_apart(ellipsoids_[a], ellipsoids_[b], touches[k])) continue;
    const bool asked_afresh = branch == Branch::global || normals[k].isZero(0.0);
    (asked_afresh ? fresh : followed).add(pairs[k], touches[k], normals[k], k);
  }
  if (followed.count > 0)
    follow_gaps(*array_, followed.list(), followed.first(followed.normals), followed.columns());
  if (fresh.count > 0) signed_gaps(*array_, fresh.list(), fresh.columns());
  followed.answer(touches);
  fresh.answer(touches);
}

Touch Bodies::touch_wall(std::size_t i, const Wall& wall, const Particles& particles,
                         const Cell& cell) const {
  const double height = wall.height_of(particles.position[i], cell);
  const Vec3& axes = particles.semi_axes[i];
  Touch touch{Vec3::Zero(), kApart, Vec3::Zero(), Vec3::Zero()};
  if (height >= axes.maxCoeff()) return touch;
  // Seen from the particle's centre the wall is the half-space normal . x <= -height.
  const Plane seen{wall.normal(), -height};
  const WallGap found =
      kind_ == Kind::ellipsoids
          ? signed_gap(ellipsoids_[i], seen)
          : signed_gap(Ellipsoid(Vec3::Zero(), axes, particles.orientation[i]), seen);
  touch.gap = found.gap;
  touch.normal = found.normal;
  touch.arm = 0.5 * (found.arm_body + found.arm_wall);
  touch.branch = found.arm_wall;
  return touch;
}

PrincipalCurvatures Bodies::relative_curvature(const Pair& pair, const Vec3& normal) const {
  const std::size_t a = at(pair.a), b = at(pair.b);
  if (kind_ == Kind::spheres) {
    const double other = b < radii_.size() ? 1.0 / radii_[b] : 0.0;
    const double curvature = 1.0 / radii_[a] + other;
    return {{curvature, curvature}, {Vec3::Zero(), Vec3::Zero()}};
  }
  if (b >= ellipsoids_.size()) return surface_curvature(ellipsoids_[a], normal);
  return contact_curvature(ellipsoids_[a], ellipsoids_[b], normal).relative;
}

}  // namespace tangency::dem
