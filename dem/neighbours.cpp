// SPDX-License-Identifier: MIT
#include <tangency/dem/neighbours.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace tangency::dem {
namespace {

/// Most boxes along an edge: bounds the memory of a cell that is large and nearly empty.
constexpr std::int32_t kMostBoxes = 128;

/// The cell cut into equal boxes, and which particles (wrapped into the cell) each holds.
class Boxes {
 public:
  Boxes(const Particles& particles, const Cell& cell, double reach) {
    count_.fill(1);
    around_.fill(0);
    const Vec3 heights = cell.heights();
    for (std::size_t k = 0; k < static_cast<std::size_t>(cell.dimensions); ++k) {
      const double height = heights[static_cast<int>(k)];
      count_[k] = static_cast<std::int32_t>(std::clamp(height / reach, 1.0, double{kMostBoxes}));
      around_[k] = static_cast<std::int32_t>(std::ceil(reach * count_[k] / height));
    }
    walled_ = cell.walled;
    home_.resize(particles.size());
    place_.resize(particles.size());
    members_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                    static_cast<std::size_t>(count_[2]));
    for (std::size_t i = 0; i < particles.size(); ++i) locate(i, particles.position[i], cell);
  }

  /// Calls f(j, image) for every image of every particle in the boxes around i's. The image is
  /// the one that takes j, as stored, next to i, as stored.
  template <class F>
  void for_each_around(std::size_t i, F&& f) const {
    Image at;
    for (at[0] = -around_[0]; at[0] <= around_[0]; ++at[0])
      for (at[1] = -around_[1]; at[1] <= around_[1]; ++at[1])
        for (at[2] = -around_[2]; at[2] <= around_[2]; ++at[2]) visit(i, at, f);
  }

 private:
  void locate(std::size_t i, const Vec3& x, const Cell& cell) {
    home_[i] = cell.image_of(x);
    const Vec3 reduced = cell.reduced(x);
    for (std::size_t k = 0; k < 3; ++k) {
      // Beyond a wall counts as next to it.
      const double within = std::clamp(reduced[static_cast<int>(k)] - home_[i][k], 0.0, 1.0);
      place_[i][k] = std::min(static_cast<std::int32_t>(within * count_[k]), count_[k] - 1);
    }
    members_[index(place_[i])].push_back(i);
  }

  std::size_t index(const Image& place) const {
    return static_cast<std::size_t>((place[0] * count_[1] + place[1]) * count_[2] + place[2]);
  }

  template <class F>
  void visit(std::size_t i, const Image& offset, F&& f) const {
    Image place, wraps;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t unwrapped = place_[i][k] + offset[k];
      if (walled_[k] && (unwrapped < 0 || unwrapped >= count_[k])) return;
      wraps[k] = unwrapped / count_[k] - (unwrapped % count_[k] < 0 ? 1 : 0);
      place[k] = unwrapped - wraps[k] * count_[k];
    }
    for (const std::size_t j : members_[index(place)]) {
      Image image;
      for (std::size_t k = 0; k < 3; ++k) image[k] = wraps[k] + home_[i][k] - home_[j][k];
      f(j, image);
    }
  }

  Image count_, around_;
  std::array<bool, 3> walled_;
  std::vector<Image> home_, place_;
  std::vector<std::vector<std::size_t>> members_;
};

double largest_radius_of(const Particles& particles) {
  double largest = 0.0;
  for (const Vec3& axes : particles.semi_axes) largest = std::max(largest, axes.maxCoeff());
  return largest;
}

}  // namespace

void NeighbourList::build(const Particles& particles, const Cell& cell, double skin) {
  reference_ = {cell.edges, skin, largest_radius_of(particles), {}};
  for (const Vec3& x : particles.position) reference_.reduced_position.push_back(cell.reduced(x));

  pairs_.clear();
  const Boxes boxes(particles, cell, 2.0 * reference_.largest_radius + skin);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double radius = particles.semi_axes[i].maxCoeff() + skin;
    const auto first = static_cast<std::ptrdiff_t>(pairs_.size());
    boxes.for_each_around(i, [&](std::size_t j, const Image& image) {
      if (j < i || (j == i && image <= Image{0, 0, 0})) return;
      const Pair pair{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), image};
      const double reach = radius + particles.semi_axes[j].maxCoeff();
      if (branch_vector(pair, particles, cell).squaredNorm() < reach * reach)
        pairs_.push_back(pair);
    });
    for (std::size_t k = 0; k < 6; ++k)
      if (cell.walled[k / 2] && Wall(k).height_of(particles.position[i], cell) < radius)
        pairs_.push_back({static_cast<std::int32_t>(i),
                          static_cast<std::int32_t>(particles.size() + k), Image{}});
    std::sort(pairs_.begin() + first, pairs_.end());
  }
  index_incidences(particles.size());
}

bool NeighbourList::is_current(const Particles& particles, const Cell& cell) const {
  if (reference_.reduced_position.size() != particles.size()) return false;
  double moved = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3 affine = cell.edges * reference_.reduced_position[i];
    moved = std::max(moved, (particles.position[i] - affine).squaredNorm());
  }
  // An unlisted pair was at least r_a + r_b + skin apart. Its distance is now at least `shrunk`
  // times that, less what both centres moved; r_a + r_b is at most twice the largest radius. From a
  // wall, which moves with the cell, it was r_a + skin.
  const double shrunk = std::min(1.0, cell.least_stretch_since(reference_.edges));
  const double spheres_then = 2.0 * reference_.largest_radius;
  const double grown =
      2.0 * std::max(0.0, largest_radius_of(particles) - reference_.largest_radius);
  return 2.0 * std::sqrt(moved) + grown < shrunk * reference_.skin - (1.0 - shrunk) * spheres_then;
}

void NeighbourList::restore(Reference reference, std::vector<Pair> pairs) {
  reference_ = std::move(reference);
  pairs_ = std::move(pairs);
  index_incidences(reference_.reduced_position.size());
}

void NeighbourList::index_incidences(std::size_t particles) {
  first_.assign(particles + 1, 0);
  for (const Pair& pair : pairs_) {
    ++first_[static_cast<std::size_t>(pair.a) + 1];
    if (const auto b = static_cast<std::size_t>(pair.b); b < particles) ++first_[b + 1];
  }
  for (std::size_t i = 0; i < particles; ++i) first_[i + 1] += first_[i];
  incidences_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t k = 0; k < pairs_.size(); ++k) {
    incidences_[next[static_cast<std::size_t>(pairs_[k].a)]++] = {k, false};
    if (const auto b = static_cast<std::size_t>(pairs_[k].b); b < particles)
      incidences_[next[b]++] = {k, true};
  }
}

}  // namespace tangency::dem
