// SPDX-License-Identifier: MIT
#include <tangency/dem/contact/narrow_phase.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <tangency/dem/bodies.hpp>
#include <tangency/dem/lanes/contact_lanes.hpp>
#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/trace_contact.hpp>

namespace tangency::inline v0::dem {
namespace {

/// The gap of a pair that is known to be apart without it.
constexpr double kFarApart = std::numeric_limits<double>::infinity();

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

Vec3 in_space(const Vec2& v) { return {v[0], v[1], 0.0}; }

/// Are two bodies apart because their bounding circles are?
bool circles_apart(const Ellipse& a, const Ellipse& b, const Vec3& branch) {
  const double reach = a.largest_semi_axis() + b.largest_semi_axis();
  return branch.squaredNorm() >= reach * reach;
}

void measure_ellipses(const Ellipse& a, const Ellipse& b, const Vec2& last_normal, Branch branch,
                      BlockGeometry& block, std::size_t k) {
  block.gap[k] = kFarApart;
  block.normal[k].setZero();
  if (circles_apart(a, b, block.branch[k])) return;
  const Vec2 d = block.branch[k].head<2>();
  if (!last_normal.isZero(0.0)) {
    // For any unit n, n.d - h_a - h_b is at most the gap: while the plane across the last normal
    // parts the bodies nothing else is asked. The normal is kept as a start for next time.
    block.normal[k] = in_space(last_normal);
    if (last_normal.dot(d) - a.support(last_normal) - b.support(last_normal) > 0.0) return;
  }
  const PlaneGap gap = branch == Branch::global || last_normal.isZero(0.0)
                           ? signed_gap(a, b, d)
                           : follow_gap(a, b, d, last_normal);
  block.gap[k] = gap.gap;
  block.normal[k] = in_space(gap.normal);
  block.arm[k] = 0.5 * (in_space(gap.arm_a) + block.branch[k] + in_space(gap.arm_b));
}

}  // namespace

void NarrowPhase::aim(const Particles& particles) {
  kind_ = particles.dimensions == 2 ? Kind::ellipses
          : are_round(particles)    ? Kind::spheres
                                    : Kind::ellipsoids;
  if (kind_ == Kind::spheres) radii_.resize(particles.size());
  if (kind_ == Kind::ellipses)
    ellipses_.resize(particles.size(), Ellipse(Vec2::Zero(), Vec2::Ones()));
  if (kind_ == Kind::ellipsoids)
    bodies_.look_at(particles.semi_axes, particles.orientation, Questions::in_double);
}

void NarrowPhase::refresh(const Particles& particles, std::size_t first, std::size_t last) {
  if (kind_ == Kind::ellipsoids) return bodies_.refresh(first, last);
  for (std::size_t i = first; i < last; ++i) {
    if (kind_ == Kind::spheres)
      radii_[i] = particles.semi_axes[i][0];
    else
      ellipses_[i] = ellipse_of(particles, i);
  }
}

MeasuredPairs NarrowPhase::measure(std::span<const Pair> pairs, const Particles& particles,
                                   const Cell& cell, std::span<const Vec3> normals, Branch branch,
                                   BlockGeometry& block) const {
  const std::size_t count = pairs.size();
  bool walls = false;
  for (std::size_t k = 0; k < count; ++k) {
    const Pair& pair = pairs[k];
    block.pairs[k] = {static_cast<std::uint32_t>(pair.a), static_cast<std::uint32_t>(pair.b)};
    if (at(pair.b) < particles.size()) {
      block.branch[k] = branch_vector(pair, particles, cell);
      continue;
    }
    // Stands in for the wall, which measure_wall() asks for afterwards: the body and its like, far
    // apart.
    walls = true;
    block.pairs[k].b = block.pairs[k].a;
    block.branch[k] = 4.0 * particles.semi_axes[at(pair.a)].maxCoeff() * Vec3::UnitX();
  }
  MeasuredPairs measured = measure(count, normals, branch, Accuracy::standard(), block);
  if (kind_ == Kind::ellipsoids && branch == Branch::trace)
    measured.unanswered = trace(count, particles, block);
  if (!walls) return measured;
  for (std::size_t k = 0; k < count; ++k)
    if (const std::size_t b = at(pairs[k].b); b >= particles.size()) {
      measure_wall(k, b - particles.size(), particles, cell, block);
      block.pairs[k].b = static_cast<std::uint32_t>(b);
    }
  return measured;
}

MeasuredPairs NarrowPhase::measure(std::size_t count, std::span<const Vec3> normals, Branch branch,
                                   const Accuracy& accuracy, BlockGeometry& block) const {
  for (std::size_t k = count; k < kPairBlock; ++k) {
    block.pairs[k] = {0, 0};
    block.gap[k] = kFarApart;
    block.branch[k] = block.normal[k] = block.arm[k] = Vec3::Zero();
  }
  MeasuredPairs measured;
  if (kind_ == Kind::spheres) measure_spheres(count, block);
  if (kind_ == Kind::ellipsoids)
    measured.slow = measure_ellipsoids(count, normals, branch, accuracy, block);
  if (kind_ == Kind::ellipses)
    for (std::size_t k = 0; k < count; ++k)
      measure_ellipses(ellipses_[block.pairs[k].a], ellipses_[block.pairs[k].b],
                       normals[k].head<2>(), branch, block, k);
  return measured;
}

void NarrowPhase::measure_spheres(std::size_t count, BlockGeometry& block) const {
  BlockGeometry::Column<double> radius_a{}, radius_b{};
  for (std::size_t k = 0; k < count; ++k) {
    radius_a[k] = radii_[block.pairs[k].a];
    radius_b[k] = radii_[block.pairs[k].b];
  }
  sphere_lanes(count, radius_a.data(), radius_b.data(), block.branch[0].data(), block.gap.data(),
               block.normal[0].data(), block.arm[0].data());
}

std::int64_t NarrowPhase::measure_ellipsoids(std::size_t count, std::span<const Vec3> normals,
                                             Branch branch, const Accuracy& accuracy,
                                             BlockGeometry& block) const {
  BlockGeometry::Column<Vec3> arm_b;
  BlockGeometry::Column<GapTier> tier;
  const auto first = [&](auto& column) { return std::span(column.data(), count); };
  const PairList list{first(block.pairs), first(block.branch)};
  GapColumns columns;
  columns.gap = first(block.gap);
  columns.normal = first(block.normal);
  columns.arm_a = first(block.arm);
  columns.arm_b = first(arm_b);
  columns.tier = first(tier);
  if (branch == Branch::global)
    signed_gaps(bodies_, list, columns, accuracy);
  else
    follow_gaps(bodies_, list, normals, columns, accuracy);
  for (std::size_t k = 0; k < count; ++k)
    block.arm[k] = 0.5 * (block.arm[k] + block.branch[k] + arm_b[k]);
  return static_cast<std::int64_t>(count) -
         std::count(columns.tier.begin(), columns.tier.end(), GapTier::fast);
}

/// Puts the published scheme's answer in the place of the certified one where it has one.
std::int64_t NarrowPhase::trace(std::size_t count, const Particles& particles,
                                BlockGeometry& block) const {
  std::int64_t unanswered = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (!(block.gap[k] < 0.0)) continue;
    const std::size_t a = block.pairs[k].a, b = block.pairs[k].b;
    const bool in_order = particles.id[a] <= particles.id[b];
    const Vec3 separation = in_order ? block.branch[k] : Vec3(-block.branch[k]);
    const TraceContact found =
        trace_contact(bodies_[in_order ? a : b], bodies_[in_order ? b : a], separation);
    if (found.status != TraceStatus::ok) {
      ++unanswered;
      continue;
    }
    block.gap[k] = found.gap;
    block.normal[k] = in_order ? found.normal : Vec3(-found.normal);
    block.arm[k] =
        in_order ? found.contact_vector_a(separation) : found.contact_vector_b(separation);
  }
  return unanswered;
}

void NarrowPhase::measure_wall(std::size_t k, std::size_t wall, const Particles& particles,
                               const Cell& cell, BlockGeometry& block) const {
  const std::size_t i = block.pairs[k].a;
  const auto [normal, height] = WallFace(wall, particles.position[i], cell);
  block.gap[k] = kFarApart;
  block.branch[k] = block.normal[k] = block.arm[k] = Vec3::Zero();
  if (height >= particles.semi_axes[i].maxCoeff()) return;
  // Seen from the particle's centre the wall is the half-space normal . x <= -height.
  const WallGap found = signed_gap(ellipsoid_of(particles, i), Plane{normal, -height});
  block.gap[k] = found.gap;
  block.normal[k] = found.normal;
  block.arm[k] = 0.5 * (found.arm_body + found.arm_wall);
  block.branch[k] = found.arm_wall;
}

std::span<const tangency::detail::LaneBody> NarrowPhase::rows() const {
  if (kind_ != Kind::ellipsoids) return {};
  return {bodies_.lanes(), bodies_.size()};
}

PrincipalCurvatures NarrowPhase::relative_curvature(const IndexedPair& pair,
                                                    const Vec3& normal) const {
  const std::size_t a = pair.a, b = pair.b;
  if (kind_ == Kind::spheres) {
    const double other = b < radii_.size() ? 1.0 / radii_[b] : 0.0;
    const double curvature = 1.0 / radii_[a] + other;
    return {{curvature, curvature}, {Vec3::Zero(), Vec3::Zero()}};
  }
  if (b >= bodies_.size()) return surface_curvature(bodies_[a], normal);
  return contact_curvature(bodies_[a], bodies_[b], normal).relative;
}

}  // namespace tangency::inline v0::dem
