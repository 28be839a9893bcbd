// SPDX-License-Identifier: MIT
#include <tangency/dem/samples/batches.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <tangency/dem/lanes/elementary.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Those that `how` says, or of the cube (square) of which `volume` is the share `fraction`.
Vec3 edges_around(const Placement& how, double volume, double fraction) {
  if (how.cell_size) return *how.cell_size;
  Vec3 edges = Vec3::Ones();
  edges.head(how.dimensions)
      .setConstant(how.dimensions == 2 ? std::sqrt(volume / fraction)
                                       : cube_root(volume / fraction));
  return edges;
}

void require_longer_edges(const Vec3& edges, double largest, double clearance, int dimensions) {
  if (edges.head(dimensions).minCoeff() > 2.0 * largest * (1.0 + clearance)) return;
  std::ostringstream room;
  room << "an edge of it is shorter than the largest particle, " << 2.0 * largest;
  throw DoesNotFit(room.str());
}

}  // namespace

std::array<double, 2> Batch::radius_range() const {
  std::array<double, 2> range{shape.mean_radius, shape.mean_radius};
  if (!shapes.empty()) range = {shapes.front().mean_radius, shapes.front().mean_radius};
  for (const Shape& one : shapes)
    range = {std::min(range[0], one.mean_radius), std::max(range[1], one.mean_radius)};
  return range;
}

double Batch::least_volume(int dimensions) const {
  Shape least = shape;
  if (!shapes.empty()) least.mean_radius = radius_range()[0];
  return volume_of(least.semi_axes(dimensions), dimensions);
}

std::vector<Coming> coming_particles(const std::vector<Batch>& batches, int dimensions) {
  std::vector<Coming> all;
  for (std::size_t k = 0; k < batches.size(); ++k)
    for (std::size_t i = 0; i < batches[k].count; ++i)
      all.push_back({k, i, batches[k].shape_of(i).semi_axes(dimensions)});
  return all;
}

void sort_largest_first(std::vector<Coming>& all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Coming& a, const Coming& b) { return a.radius() > b.radius(); });
}

Vec3 edges_with_room(const std::vector<Batch>& batches, const Placement& how,
                     const Filling& filling) {
  double volume = 0.0, largest = 0.0;
  for (const Coming& one : coming_particles(batches, how.dimensions)) {
    volume += filling.volume(one, how.dimensions);
    largest = std::max(largest, one.radius());
  }
  const Vec3 edges = edges_around(how, volume, filling.fraction);
  const double filled = volume / edges.prod();
  if (!(filled <= filling.most * (1.0 + filling.clearance))) {
    std::ostringstream room;
    room << filling.what << " would fill " << filled << " of it, more than " << filling.most;
    throw DoesNotFit(room.str());
  }
  require_longer_edges(edges, largest, filling.clearance, how.dimensions);
  return edges;
}

std::vector<double> bounding_radii(const std::vector<Coming>& all, double clearance) {
  std::vector<double> radii;
  for (const Coming& one : all) radii.push_back(Vec3(one.axes * (1.0 + clearance)).maxCoeff());
  return radii;
}

}  // namespace tangency::inline v0::dem
