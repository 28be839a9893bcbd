// SPDX-License-Identifier: MIT
/// @file
/// A body as the lanes in float read it: one line of cache. Internal.
#pragma once

namespace tangency::inline v0::detail {

/// What shape_rows.hpp makes of a LaneBody and its ShapeRow: floats to nearest, but for
/// least_radius and widest. "Single precision" in docs/derivations/gap-batch.md.
struct alignas(64) FloatRow {
  double centre[3];
  float largest;       ///< semi-axis; NaN where the body is not moderate(), or thinner than
                       ///< kThinnestInLanes: no lane then settles
  float least_radius;  ///< of curvature, rounded down
  float shape[6];      ///< xx yy zz yz zx xy of M, the support function being sqrt(n'Mn)
  float widest;        ///< the largest sum of |M_ij| over a row, rounded up
  float unused;
};
static_assert(sizeof(FloatRow) == 64 && alignof(FloatRow) == 64);

}  // namespace tangency::inline v0::detail
