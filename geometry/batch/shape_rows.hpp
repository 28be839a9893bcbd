// SPDX-License-Identifier: MIT
/// @file
/// Rows of bodies for the first tier of the gap, from those for the next one, and for the lanes in
/// float. The instruction set is chosen when the program runs. Internal.
#pragma once

#include <cstddef>

#include <tangency/geometry/batch/lane_block.hpp>

namespace tangency::inline v0::detail {

/// M = S S' of the stored factors S, each entry rounded as (N) of docs/derivations/gap-batch.md
/// says; NaN of a body that is not moderate(). A body of an aspect ratio above 45 has a row that no
/// lane of the first tier settles. Each row depends on its body alone, and on whether the
/// instruction set has fused multiply-adds. Assumes rounding to nearest.
void fill_shape_rows(const LaneBody* bodies, std::size_t count, ShapeRow* to) noexcept;

/// The same bodies in float: to nearest, but for the least radius, which is rounded down, and the
/// reach, which is rounded up. Assumes rounding to nearest.
/// @param rows  what fill_shape_rows() made of the bodies
void fill_float_rows(const LaneBody* bodies, const ShapeRow* rows, std::size_t count,
                     FloatRow* to) noexcept;

}  // namespace tangency::inline v0::detail
