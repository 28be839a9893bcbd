// SPDX-License-Identifier: MIT
/// @file
/// Rows for the lanes from whole ellipsoids. In the default floating-point environment. Internal.
#pragma once

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

}  // namespace tangency::inline v0::detail
