// SPDX-License-Identifier: MIT
/// @file
/// Of pairs whose bounding spheres come near: which are neighbours, and their answers. Internal:
/// what is promised stands in neighbours.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <tangency/geometry/body_array.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/neighbour_columns.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::detail {

/// Ellipsoids as their owner has them, with rows for the lanes.
class NearEllipsoids {
 public:
  explicit NearEllipsoids(std::span<const Ellipsoid> bodies) : batch_(bodies) {}

  std::size_t size() const { return batch_.size(); }
  const Vec3& centre(std::size_t i) const { return batch_[i].centre(); }
  double largest_semi_axis(std::size_t i) const { return batch_[i].largest_semi_axis(); }
  const Ellipsoid& operator[](std::size_t i) const { return batch_[i]; }
  const BodyArray& batch() const { return batch_; }

 private:
  BodyArray batch_;
};

class NearMovingBodies {
 public:
  /// @throws std::invalid_argument  they have no centres
  explicit NearMovingBodies(const MovingBodies& bodies);

  std::size_t size() const { return batch_.size(); }
  const Vec3& centre(std::size_t i) const { return batch_.centres()[i]; }
  /// @throws std::invalid_argument  the body is no ellipsoid
  double largest_semi_axis(std::size_t i) const;
  Ellipsoid operator[](std::size_t i) const { return batch_[i]; }
  const MovingBodies& batch() const { return batch_; }

 private:
  const MovingBodies& batch_;
};

/// Appends the neighbours among the candidates to `found`, in no order, with the columns that are
/// asked for. In the default floating-point environment.
void answer_candidates(const NearEllipsoids& bodies, const NeighbourQuestion& question,
                       std::span<const NearPair> candidates, Neighbours& found);
void answer_candidates(const NearMovingBodies& bodies, const NeighbourQuestion& question,
                       std::span<const NearPair> candidates, Neighbours& found);

/// use(pointer to member) of every column.
template <class Use>
void for_each_column(const Use& use) {
  use(&Neighbours::pairs);
  use(&Neighbours::overlaps);
  use(&Neighbours::gap);
  use(&Neighbours::gap_error);
  use(&Neighbours::status);
  use(&Neighbours::normal);
  use(&Neighbours::arm_a);
  use(&Neighbours::arm_b);
  use(&Neighbours::separation);
}

}  // namespace tangency::inline v0::detail
