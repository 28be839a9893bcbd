// SPDX-License-Identifier: MIT
/// @file
/// The tests of overlap_filter at one normal and one point, in double-double: for pairs too close
/// to a touch, or too extreme, for double. Error bounds: docs/derivations/relation-filter.md,
/// section 4.
#pragma once

#include <tangency/geometry/methods/overlap_filter.hpp>

namespace tangency::methods {

/// Are the solids apart, or do their interiors meet, as the normal `n` (largest component in [1,
/// 2)) tells? c_B - c_A = d + d_low exactly. Requires the default floating-point environment and as
/// OverlapFilter.
Filtered filter_overlap_in_double_double(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                                         const Vec3& d_low, const Vec3& n) noexcept;

}  // namespace tangency::methods
