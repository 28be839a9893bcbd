// SPDX-License-Identifier: MIT
/// @file
/// A pair of ellipses in units of a power of two: scaled_pair.hpp, in the plane.
#pragma once

#include <tangency/geometry/ellipse.hpp>

namespace tangency::detail {

/// A and B about their own centres, and d = c_B - c_A, in units of 2^exponent: the largest of them
/// in [1, 4). Scaling is exact but for lengths below 2^-1022 in the new unit, and for semi-axes
/// below 2^-300, which become that.
struct ScaledPlanePair {
  Ellipse a, b;
  Vec2 d;
  Vec2 d_low;  ///< c_B - c_A = d + d_low, in the default environment exactly but for 2^-1074
  int exponent;
};

/// The rounding error of d = c_B - c_A: what d lacks, exactly in the default environment.
Vec2 separation_error(const Vec2& centre_a, const Vec2& centre_b, const Vec2& d) noexcept;

ScaledPlanePair scaled_plane_pair(const Ellipse& a, const Ellipse& b) noexcept;
/// The same for a given d (its components in the caller's unit, finite).
ScaledPlanePair scaled_plane_pair(const Ellipse& a, const Ellipse& b, const Vec2& d) noexcept;

}  // namespace tangency::detail
