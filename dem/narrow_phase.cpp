// SPDX-License-Identifier: MIT
#include <tangency/dem/narrow_phase.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <tangency/dem/bodies.hpp>
#include <tangency/dem/parallel.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/primitives.hpp>

namespace tangency::dem {
namespace {

/// The gap of a pair that is known to be apart without it.
constexpr double kFarApart = std::numeric_limits<double>::infinity();

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

Vec3 in_space(const Vec2& v) { return {v[0], v[1], 0.0}; }

/// Spheres that touch concentrically have no normal: that of geometry/primitives.hpp.
void measure_spheres(double a, double b, PairGeometry& geometry) {
  const double distance = geometry.branch.norm();
  geometry.gap = distance - (a + b);
  geometry.normal = distance > 0.0 ? Vec3(geometry.branch / distance) : Vec3::UnitX();
  geometry.arm = (a + 0.5 * geometry.gap) * geometry.normal;
}

/// Are two bodies apart because their bounding spheres are? The normal is then forgotten.
template <class Body>
bool spheres_apart(const Body& a, const Body& b, PairGeometry& geometry) {
  const double reach = a.largest_semi_axis() + b.largest_semi_axis();
  geometry.gap = kFarApart;
  geometry.normal.setZero();
  return geometry.branch.squaredNorm() >= reach * reach;
}

void measure_ellipses(const Ellipse& a, const Ellipse& b, const Vec2& last_normal, Branch branch,
                      PairGeometry& geometry) {
  if (spheres_apart(a, b, geometry)) return;
  const Vec2 d = geometry.branch.head<2>();
  if (!last_normal.isZero(0.0)) {
    // For any unit n, n.d - h_a - h_b is at most the gap: while the plane across the last normal
    // parts the bodies nothing else is asked. The normal is kept as a start for next time.
    geometry.normal = in_space(last_normal);
    if (last_normal.dot(d) - a.support(last_normal) - b.support(last_normal) > 0.0) return;
  }
  const PlaneGap gap = branch == Branch::global || last_normal.isZero(0.0)
                           ? signed_gap(a, b, d)
                           : follow_gap(a, b, d, last_normal);
  geometry.gap = gap.gap;
  geometry.normal = in_space(gap.normal);
  geometry.arm = 0.5 * (in_space(gap.arm_a) + geometry.branch + in_space(gap.arm_b));
}

/// The pairs of a block that one call into geometry takes, in columns.
struct PairBatch {
  std::array<IndexedPair, NarrowPhase::kBlock> pairs;
  std::array<Vec3, NarrowPhase::kBlock> separations, normals, arms_a, arms_b;
  std::array<double, NarrowPhase::kBlock> gaps;
  std::array<std::uint32_t, NarrowPhase::kBlock> place;  ///< in the block
  std::size_t count = 0;

  void add(const Pair& pair, const PairGeometry& geometry, const Vec3& last_normal, std::size_t k) {
    pairs[count] = {static_cast<std::uint32_t>(pair.a), static_cast<std::uint32_t>(pair.b)};
    separations[count] = geometry.branch;
    normals[count] = last_normal;
    place[count++] = static_cast<std::uint32_t>(k);
  }
  template <class T>
  std::span<T> first(std::array<T, NarrowPhase::kBlock>& column) {
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
  void write_to(std::span<PairGeometry> geometries) const {
    for (std::size_t k = 0; k < count; ++k) {
      PairGeometry& geometry = geometries[place[k]];
      geometry.gap = gaps[k];
      geometry.normal = normals[k];
      geometry.arm = 0.5 * (arms_a[k] + geometry.branch + arms_b[k]);
    }
  }
};

}  // namespace

void NarrowPhase::refresh(const Particles& particles) {
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
#pragma omp parallel for schedule(static) if (count >= kParallelThreshold)
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

void NarrowPhase::measure(std::span<const Pair> pairs, const Particles& particles, const Cell& cell,
                          std::span<const Vec3> normals, Branch branch,
                          std::span<PairGeometry> geometries) const {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Pair& pair = pairs[k];
    const std::size_t a = at(pair.a), b = at(pair.b);
    if (b >= particles.size()) {
      geometries[k] = measure_wall(a, Wall(b - particles.size()), particles, cell);
      continue;
    }
    geometries[k].branch = branch_vector(pair, particles, cell);
    if (kind_ == Kind::spheres)
      measure_spheres(radii_[a], radii_[b], geometries[k]);
    else if (kind_ == Kind::ellipses)
      measure_ellipses(ellipses_[a], ellipses_[b], normals[k].head<2>(), branch, geometries[k]);
  }
  if (kind_ == Kind::ellipsoids) measure_ellipsoids(pairs, normals, branch, geometries);
}

void NarrowPhase::measure_ellipsoids(std::span<const Pair> pairs, std::span<const Vec3> normals,
                                     Branch branch, std::span<PairGeometry> geometries) const {
  PairBatch followed, fresh;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t a = at(pairs[k].a), b = at(pairs[k].b);
    if (b >= ellipsoids_.size()) continue;  // a wall
    if (spheres_apart(ellipsoids_[a], ellipsoids_[b], geometries[k])) continue;
    const bool asked_afresh = branch == Branch::global || normals[k].isZero(0.0);
    (asked_afresh ? fresh : followed).add(pairs[k], geometries[k], normals[k], k);
  }
  if (followed.count > 0)
    follow_gaps(*array_, followed.list(), followed.first(followed.normals), followed.columns());
  if (fresh.count > 0) signed_gaps(*array_, fresh.list(), fresh.columns());
  followed.write_to(geometries);
  fresh.write_to(geometries);
}

PairGeometry NarrowPhase::measure_wall(std::size_t i, const Wall& wall, const Particles& particles,
                                       const Cell& cell) const {
  const double height = wall.height_of(particles.position[i], cell);
  const Vec3& axes = particles.semi_axes[i];
  PairGeometry geometry{Vec3::Zero(), kFarApart, Vec3::Zero(), Vec3::Zero()};
  if (height >= axes.maxCoeff()) return geometry;
  // Seen from the particle's centre the wall is the half-space normal . x <= -height.
  const Plane seen{wall.normal(), -height};
  const WallGap found =
      kind_ == Kind::ellipsoids
          ? signed_gap(ellipsoids_[i], seen)
          : signed_gap(Ellipsoid(Vec3::Zero(), axes, particles.orientation[i]), seen);
  geometry.gap = found.gap;
  geometry.normal = found.normal;
  geometry.arm = 0.5 * (found.arm_body + found.arm_wall);
  geometry.branch = found.arm_wall;
  return geometry;
}

PrincipalCurvatures NarrowPhase::relative_curvature(const Pair& pair, const Vec3& normal) const {
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
