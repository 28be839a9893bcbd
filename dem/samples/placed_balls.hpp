// SPDX-License-Identifier: MIT
/// @file
/// The bodies that were put into a periodic cell so far, as balls, and which of them a further one
/// may meet.
///
/// Balls lie in grids, one for each power of two of their radii: large and small ones together cost
/// what equal ones do. Lengths are in any one unit. Several threads may look at a time, none while
/// one adds.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

class PlacedBalls {
 public:
  /// @param edges  of the box, which is repeated along all of them
  /// @param radii  > 0, of all balls that will come: grids are made for them
  /// @param dimensions  2: all centres have z = 0, and there are no images along z
  PlacedBalls(const Vec3& edges, std::span<const double> radii, int dimensions);

  /// @param x  within the box
  /// @param radius  one of those given, or in no larger power of two
  void add(const Vec3& x, double radius);

  /// Balls so far; they have numbers from 0 in the order in which they came.
  std::size_t size() const { return balls_.size(); }

  /// Asks about each image of a ball that meets the ball about x, in an order that depends on what
  /// was added alone, until an answer is true.
  /// @param x       within the box
  /// @param radius  any
  /// @param ask     (number of the ball, where the image's centre is seen from x) -> bool
  /// @return was any answer true?
  template <class Ask>
  bool any_meets(const Vec3& x, double radius, Ask&& ask) const {
    for (const Grid& grid : grids_)
      if (grid.used && any_of(grid, x, radius, ask)) return true;
    return false;
  }

 private:
  using Sites = Eigen::Array<std::int64_t, 3, 1>;
  /// Boxes of balls whose radii have one power of two.
  struct Grid {
    int power;
    double largest = 0.0;               ///< radius
    Sites count = Sites::Ones();        ///< boxes along each edge
    bool used = false;                  ///< does it hold a ball?
    std::vector<std::int32_t> first{};  ///< of each box; -1: none
  };

  /// What is looked at together.
  struct Ball {
    Vec3 centre;
    double radius;
    std::int32_t next;  ///< in its box; -1: none
  };

  Grid& grid_of(double radius);
  Sites box_of(const Grid& grid, const Vec3& x) const {
    const Eigen::Array3d reduced = x.array() / edges_.array() * grid.count.cast<double>();
    return reduced.floor().cast<std::int64_t>();
  }

  template <class Ask>
  bool any_of(const Grid& grid, const Vec3& x, double radius, Ask& ask) const {
    const double reach = radius + grid.largest;
    Vec3 aside = Vec3::Zero();
    aside.head(dimensions_).setConstant(reach);
    const Sites low = box_of(grid, x - aside), high = box_of(grid, x + aside);
    Sites at;
    for (at[0] = low[0]; at[0] <= high[0]; ++at[0])
      for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
        for (at[2] = low[2]; at[2] <= high[2]; ++at[2])
          if (any_in(grid, at, x, radius, ask)) return true;
    return false;
  }

  /// In one box, which may be of another image of the cell.
  template <class Ask>
  bool any_in(const Grid& grid, const Sites& at, const Vec3& x, double radius, Ask& ask) const {
    Sites home = at, image = Sites::Zero();
    for (int k = 0; k < 3; ++k) {
      image[k] = at[k] / grid.count[k] - (at[k] % grid.count[k] < 0 ? 1 : 0);
      home[k] -= image[k] * grid.count[k];
    }
    const auto box =
        static_cast<std::size_t>((home[0] * grid.count[1] + home[1]) * grid.count[2] + home[2]);
    const Vec3 from = x - Vec3(edges_.array() * image.cast<double>());
    for (std::int32_t i = grid.first[box]; i >= 0;) {
      const auto number = static_cast<std::size_t>(i);
      const Ball& ball = balls_[number];
      const Vec3 d = ball.centre - from;
      const double together = radius + ball.radius;
      if (d.squaredNorm() < together * together && ask(number, d)) return true;
      i = ball.next;
    }
    return false;
  }

  Vec3 edges_;
  int dimensions_;
  std::vector<Grid> grids_;  ///< that of the largest balls first
  std::vector<Ball> balls_;
};

}  // namespace tangency::inline v0::dem
