// SPDX-License-Identifier: MIT
/// @file
/// The lanes in float, twice as many: they answer what float can prove of a block, and say what it
/// cannot. The instruction set is chosen when the program runs. Internal.
#pragma once

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/batch/lane_block.hpp>

namespace tangency::inline v0::detail {

/// As overlap_lanes(). Reads floats, pairs, count and separations of the block. In any rounding
/// mode.
LaneOverlaps float_overlap_lanes(const LaneBlock& block) noexcept;

}  // namespace tangency::inline v0::detail
