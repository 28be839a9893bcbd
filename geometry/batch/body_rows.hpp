// SPDX-License-Identifier: MIT
/// @file
/// Rows for the lanes from whole ellipsoids. In the default floating-point environment. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::inline v0::detail {

inline double largest_if_moderate(const Ellipsoid& body) {
  return body.moderate() ? body.largest_semi_axis() : std::numeric_limits<double>::quiet_NaN();
}

/// The row of a body for the gap.
inline void fill(LaneBody& lane, const Ellipsoid& body) {
  const Mat3& rotation = body.rotation();
  for (int i = 0; i < 3; ++i) {
    lane.centre[i] = body.centre()[i];
    for (int k = 0; k < 3; ++k) lane.factor[3 * k + i] = body.semi_axes()[k] * rotation(i, k);
  }
  lane.largest = largest_if_moderate(body);
  lane.least_radius = (1.0 - 0x1p-40) * body.least_radius();
}

// The stored radius is below and the stored reach above the true ones by this much at least, so
// that sums and products of them are too. Chosen.
inline constexpr double kBelowFloat = 1.0 - 0x1p-21, kAboveFloat = 1.0 + 0x1p-21;

/// Rows for the lanes in float. In the default floating-point environment.
/// @param bodies  for their largest semi-axes, which a ShapeRow of a thin body does not have
inline void fill(FloatRow* to, const LaneBody* bodies, const ShapeRow* rows,
                 std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const ShapeRow& row = rows[i];
    const double largest = bodies[i].largest;
    std::copy_n(row.centre, 3, to[i].centre);
    to[i].largest = static_cast<float>(largest);
    // Others are out of the range of float.
    const double in_range = std::isnan(largest) ? 0.0 : 1.0;
    to[i].least_radius = static_cast<float>(in_range * kBelowFloat * row.least_radius);
    to[i].widest = static_cast<float>(in_range * kAboveFloat * row.reach);
    for (int k = 0; k < 6; ++k) to[i].shape[k] = static_cast<float>(in_range * row.shape[k]);
  }
}

}  // namespace tangency::inline v0::detail
