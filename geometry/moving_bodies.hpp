// SPDX-License-Identifier: MIT
/// @file
/// Bodies that turn at every step of a simulator, for the batch calls of gap_batch.hpp: shapes and
/// orientations stay in the caller's columns, and no Ellipsoid is made unless a single call needs
/// one. A refresh costs a tenth of what the constructor of Ellipsoid and BodyArray::refresh() do.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/large_pages.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency {

namespace detail {
struct LaneBody;
}  // namespace detail

/// The bodies Ellipsoid(Vec3::Zero(), semi_axes[i], orientations[i]): all centred at the origin, so
/// that a question about a pair gives its separation. Lengths in any one unit; an orientation turns
/// body coordinates into space coordinates, and means R(q/|q|) exactly whatever its length is.
///
/// Keeps the spans: the columns have to outlive it and stay in place. What the batch reads of them
/// is what they were at the last refresh(), 128 bytes a body; every body has to be refreshed after
/// it was changed and before it is asked about. One that was moved from is empty, and so is a copy,
/// whose owner has columns of his own to look_at().
class MovingBodies {
 public:
  MovingBodies() noexcept;
  /// Refreshes all of them.
  /// @param orientations  as many as semi_axes: else the process ends with one line on standard
  ///                      error, here and below
  MovingBodies(std::span<const Vec3> semi_axes, std::span<const Quaternion> orientations);
  ~MovingBodies();
  MovingBodies(const MovingBodies&) noexcept;
  MovingBodies& operator=(const MovingBodies&) noexcept;
  MovingBodies(MovingBodies&&) noexcept;
  MovingBodies& operator=(MovingBodies&&) noexcept;

  /// Other columns from now on, to be refreshed before anything is asked. Allocates only where
  /// there are more bodies than there ever were.
  void look_at(std::span<const Vec3> semi_axes, std::span<const Quaternion> orientations);

  /// To be called after bodies from `first` to before `last` were changed. Ranges that do not
  /// overlap may be refreshed by different threads; what is written does not depend on the ranges.
  /// @param last  not before first, and at most size()
  void refresh(std::size_t first, std::size_t last) noexcept;

  std::size_t size() const noexcept { return semi_axes_.size(); }
  /// The body as the columns have it now. i < size(), not checked.
  /// @throws InvalidEllipsoid
  Ellipsoid operator[](std::size_t i) const;

  const detail::LaneBody* lanes() const noexcept { return lanes_.data(); }

 private:
  std::span<const Vec3> semi_axes_;
  std::span<const Quaternion> orientations_;
  std::vector<detail::LaneBody, LargePages<detail::LaneBody>> lanes_;
};

}  // namespace tangency
