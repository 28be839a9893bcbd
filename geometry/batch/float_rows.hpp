// SPDX-License-Identifier: MIT
/// @file
/// A body as the lanes in float read it: one line of cache. Internal.
#pragma once

#include <algorithm>
#include <cmath>

namespace tangency::inline v0::detail {

/// The floats are rounded to nearest, but for least_radius and widest:
/// docs/derivations/gap-batch.md, section 5.
struct alignas(64) FloatRow {
  double centre[3];
  float largest;       ///< semi-axis; NaN where the body is not moderate(): no lane then settles
  float least_radius;  ///< of curvature, rounded down
  float shape[6];      ///< xx yy zz yz zx xy of M, the support function being sqrt(n'Mn)
  float widest;        ///< the largest sum of |M_ij| over a row, rounded up
  float unused;
};
static_assert(sizeof(FloatRow) == 64 && alignof(FloatRow) == 64);

// What float and the sums of an interface may do to a bound: 2^-21 of itself, chosen.
inline constexpr double kBelowFloat = 1.0 - 0x1p-21, kAboveFloat = 1.0 + 0x1p-21;

/// The floats of a row.
/// @param largest  NaN where the body is not moderate()
/// @param shape    xx yy zz yz zx xy of M
inline void fill_floats(FloatRow& lane, double largest, double least_radius, const double* shape) {
  const double yz = std::abs(shape[3]), zx = std::abs(shape[4]), xy = std::abs(shape[5]);
  const double widest = std::max({shape[0] + xy + zx, shape[1] + yz + xy, shape[2] + yz + zx});
  lane.largest = static_cast<float>(largest);
  lane.least_radius = static_cast<float>(kBelowFloat * least_radius);
  std::transform(shape, shape + 6, lane.shape, [](double m) { return static_cast<float>(m); });
  lane.widest = static_cast<float>(kAboveFloat * widest);
}

}  // namespace tangency::inline v0::detail
