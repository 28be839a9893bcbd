// SPDX-License-Identifier: MIT
#include <tangency/dem/neighbours.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <tangency/dem/bodies.hpp>
#include <tangency/dem/contact/gap_filter.hpp>
#include <tangency/dem/parallel.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/near_pairs.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Bodies whose neighbours one thread searches at a time. Chosen: some 0.3 ms of work.
constexpr std::size_t kSearchBlock = 1024;

/// What rounding of positions and edges may take from a skin, in bounding spheres. Chosen: 2^12
/// times the rounding of a coordinate of one radius, and a ten-millionth of a skin.
constexpr double kRounding = 0x1p-40;

/// All pairs of images whose bounding spheres with their skins meet, in ascending order.
std::vector<NearPair> candidates(const Particles& particles, const Cell& cell,
                                 const std::vector<double>& reaches) {
  Lattice lattice{cell.edges};
  for (std::size_t k = 0; k < 3; ++k)
    lattice.periodic[k] = !cell.walled[k] && k < static_cast<std::size_t>(cell.dimensions);
  const NearPairSearch search(particles.position, reaches, lattice);
  const std::size_t blocks = (search.size() + kSearchBlock - 1) / kSearchBlock;
  std::vector<std::vector<NearPair>> parts(blocks);
  for_ranges(blocks, 2, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k)
      search.find(k * kSearchBlock, (k + 1) * kSearchBlock, parts[k]);
  });
  return sorted_pairs(parts, search.size());
}

/// Steps of a particle's present motion that its skin lasts at least. Chosen: in an assembly of
/// needles that vibrates a list lasted one step without, and costs as much as thirty.
constexpr double kLeastSteps = 10.0;

/// The thickest skin, in mean radii, that motion makes. Chosen: some five times as many pairs.
constexpr double kMostSkin = 0.5;

double skin_of(const Particles& particles, std::size_t i, double ratio, double dt) {
  const Vec3& axes = particles.semi_axes[i];
  const double radius = mean_radius_of(axes, particles.dimensions);
  const double spread = axes.maxCoeff() - axes.minCoeff();
  const double a_step =
      dt * (particles.velocity[i].norm() + spread * particles.angular_velocity[i].norm());
  return std::max(ratio * radius, std::min(kLeastSteps * a_step, kMostSkin * radius));
}

/// Bounds |F - I|, F the deformation since the edges had this inverse: how far the end of a vector
/// moves, in its lengths. |M|_2^2 <= |M|_1 |M|_inf, an equality for boxes.
double strain_since(const Mat3& inverse_edges, const Mat3& edges) {
  const Mat3 change = (edges * inverse_edges - Mat3::Identity()).cwiseAbs();
  return std::sqrt(change.colwise().sum().maxCoeff() * change.rowwise().sum().maxCoeff());
}

/// Bounds the angle of the turn from p to q, unit quaternions: 4 asin(D / 2) where they are D
/// apart, and asin x <= x + (pi / 2 - 1) x^3.
double turn_between(const Quaternion& p, const Quaternion& q) {
  constexpr double cubic = 0.2854;  // (pi / 2 - 1) / 2, rounded up
  const double sign = p.coeffs().dot(q.coeffs()) < 0.0 ? -1.0 : 1.0;  // q and -q are one turn
  const double squared = (p.coeffs() - sign * q.coeffs()).squaredNorm();
  return std::sqrt(squared) * (2.0 + cubic * squared);
}

}  // namespace

WallFace::WallFace(std::size_t k, const Vec3& x, const Cell& cell) {
  if (k >= kCellFaces) {
    const PlaneWall& plane = cell.planes[k - kCellFaces];
    normal = plane.normal;
    height = plane.height_of(x);
    return;
  }
  const int axis = static_cast<int>(k / 2);
  const bool far = k % 2 == 1;
  normal = (far ? -1.0 : 1.0) * Vec3::Unit(axis);
  height = far ? cell.edges(axis, axis) - x[axis] : x[axis];
}

void NeighbourList::build(const Particles& particles, const Cell& cell, double skin_ratio,
                          double dt) {
  const std::size_t count = particles.size();
  Reference reference{cell.edges, std::vector<double>(count), std::vector<Vec3>(count),
                      particles.orientation, particles.semi_axes};
  for (const PlaneWall& plane : cell.planes) reference.planes.push_back(plane.offset);
  std::vector<double> reaches(count);
  for (std::size_t i = 0; i < count; ++i) {
    reference.reduced_position[i] = cell.reduced(particles.position[i]);
    reference.skin[i] = skin_of(particles, i, skin_ratio, dt);
    reaches[i] = particles.semi_axes[i].maxCoeff() + reference.skin[i];
  }
  const std::vector<NearPair> near = candidates(particles, cell, reaches);
  const std::vector<std::uint8_t> keep = within_skins(near, particles, cell, reference.skin);

  reference_ = std::move(reference);
  measure_skins();
  pairs_.clear();
  auto next = near.begin();
  for (std::size_t i = 0; i < count; ++i) {
    for (; next != near.end() && next->a == i; ++next)
      if (keep[static_cast<std::size_t>(next - near.begin())])
        pairs_.push_back(
            {static_cast<std::int32_t>(i), static_cast<std::int32_t>(next->b), next->image});
    if (cell.has_walls()) list_walls(particles, cell, i);
  }
  index_pairs();
}

void NeighbourList::list_walls(const Particles& particles, const Cell& cell, std::size_t i) {
  const Ellipsoid body = ellipsoid_of(particles, i);
  for (std::size_t k = 0; k < kCellFaces + cell.planes.size(); ++k) {
    if (k < kCellFaces && !cell.walled[k / 2]) continue;
    const WallFace wall(k, particles.position[i], cell);
    const double gap = wall.height - body.support(wall.normal);
    if (gap <= skins_[i].thickness)
      pairs_.push_back(
          {static_cast<std::int32_t>(i), static_cast<std::int32_t>(particles.size() + k), Image{}});
  }
}

bool NeighbourList::is_current(const Particles& particles, const Cell& cell) const {
  std::atomic<bool> current = true;
  for_ranges(particles.size(), kParallelThreshold, [&](std::size_t first, std::size_t last) {
    if (!(least_slack(particles, cell, first, last) > 0.0)) current = false;
  });
  return current;
}

double NeighbourList::least_slack(const Particles& particles, const Cell& cell, std::size_t first,
                                  std::size_t last) const {
  if (skins_.size() != particles.size() || reference_.planes.size() != cell.planes.size())
    return -std::numeric_limits<double>::infinity();
  const double strain = strain_since(inverse_edges_, cell.edges) + kRounding;
  double walls = 0.0;  // how far one has come
  for (std::size_t k = 0; k < cell.planes.size(); ++k)
    walls = std::max(walls, std::abs(cell.planes[k].offset - reference_.planes[k]));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < last; ++i) {
    const Skin& skin = skins_[i];
    const Vec3 affine = cell.edges * reference_.reduced_position[i];
    const double moved = (particles.position[i] - affine).norm();
    double turned = 0.0;
    if (skin.spread > 0.0)
      turned = skin.spread *
               std::min(1.0, turn_between(reference_.orientation[i], particles.orientation[i]));
    const double grown = (particles.semi_axes[i] - reference_.semi_axes[i]).maxCoeff();
    const double left =
        skin.thickness - walls - moved - turned - std::max(0.0, grown) - strain * skin.ball;
    if (!(left >= least)) least = left;  // what is no number stays
  }
  return least;
}

void NeighbourList::restore(Reference reference, std::vector<Pair> pairs) {
  reference_ = std::move(reference);
  pairs_ = std::move(pairs);
  measure_skins();
  index_pairs();
}

void NeighbourList::measure_skins() {
  inverse_edges_ = reference_.edges.inverse();
  skins_.resize(reference_.semi_axes.size());
  for (std::size_t i = 0; i < skins_.size(); ++i) {
    const Vec3& axes = reference_.semi_axes[i];
    const double thickness = reference_.skin[i];
    const double largest = axes.maxCoeff();
    skins_[i] = {thickness, largest + thickness, largest - axes.minCoeff()};
  }
}

void NeighbourList::index_pairs() {
  const std::size_t count = skins_.size();
  first_as_a_.assign(count + 1, 0);
  first_as_b_.assign(count + 1, 0);
  for (const Pair& pair : pairs_) {
    ++first_as_a_[static_cast<std::size_t>(pair.a) + 1];
    if (const auto b = static_cast<std::size_t>(pair.b); b < count) ++first_as_b_[b + 1];
  }
  for (std::size_t i = 0; i < count; ++i) {
    first_as_a_[i + 1] += first_as_a_[i];
    first_as_b_[i + 1] += first_as_b_[i];
  }
  as_b_.resize(first_as_b_.back());
  std::vector<std::uint32_t> next(first_as_b_.begin(), first_as_b_.end() - 1);
  for (std::uint32_t k = 0; k < pairs_.size(); ++k)
    if (const auto b = static_cast<std::size_t>(pairs_[k].b); b < count) as_b_[next[b]++] = k;
}

}  // namespace tangency::inline v0::dem
