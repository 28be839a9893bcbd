// SPDX-License-Identifier: MIT
#include <tangency/dem/samples/placed_balls.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <tangency/dem/lanes/elementary.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Boxes for each ball that will come: bounds the memory of a nearly empty cell. Chosen.
constexpr double kMostBoxesABall = 8.0;

}  // namespace

PlacedBalls::PlacedBalls(const Vec3& edges, std::span<const double> radii, int dimensions)
    : edges_(edges), dimensions_(dimensions) {
  std::map<int, std::size_t, std::greater<>> balls;  // by power
  for (const double radius : radii) ++balls[std::ilogb(radius)];
  for (const auto& [power, number] : balls) {
    Grid& grid = grids_.emplace_back(Grid{power});
    for (const double radius : radii)
      if (std::ilogb(radius) == power) grid.largest = std::max(grid.largest, radius);
    // A box is as long as the largest ball, or longer where there would be too many of them.
    const double boxes = kMostBoxesABall * static_cast<double>(number);
    const double most = dimensions == 2 ? std::sqrt(boxes) : cube_root(boxes);
    for (int k = 0; k < dimensions; ++k)
      grid.count[k] =
          static_cast<std::int64_t>(std::clamp(edges[k] / (2.0 * grid.largest), 1.0, most));
    grid.first.assign(static_cast<std::size_t>(grid.count.prod()), -1);
  }
  balls_.reserve(radii.size());
}

PlacedBalls::Grid& PlacedBalls::grid_of(double radius) {
  const int power = std::ilogb(radius);
  return *std::find_if(grids_.begin(), grids_.end(),
                       [&](const Grid& g) { return g.power == power; });
}

void PlacedBalls::add(const Vec3& x, double radius) {
  Grid& grid = grid_of(radius);
  const Sites at = box_of(grid, x).min(grid.count - 1).max(0);
  const auto box =
      static_cast<std::size_t>((at[0] * grid.count[1] + at[1]) * grid.count[2] + at[2]);
  const auto number = static_cast<std::int32_t>(balls_.size());
  balls_.push_back({x, radius, grid.first[box]});
  grid.first[box] = number;
  grid.used = true;
}

}  // namespace tangency::inline v0::dem
