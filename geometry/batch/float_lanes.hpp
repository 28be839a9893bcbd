// SPDX-License-Identifier: MIT
/// @file
/// The lanes in float, twice as many: they answer what float can prove of a block, and say what it
/// cannot. The instruction set is chosen when the program runs. Internal.
#pragma once

#include <cstdint>

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/batch/lane_block.hpp>

namespace tangency::inline v0::detail {

/// As gap_lanes(), within the tolerance of the block or what single precision can do. Reads floats,
/// pairs, count, separations and normals, and bodies where arms are wanted; of followed normals it
/// proves the global gap alone. Assumes rounding to nearest.
std::uint64_t float_gap_lanes(LaneBlock& block) noexcept;

/// Bit i: the gap of pair i is proven to be at least least[i], above the cutoff. Reads floats,
/// pairs, count, separations and normals. Assumes rounding to nearest.
/// @param cutoff  at least 0
/// @param least  kPairs numbers
std::uint64_t far_lanes(const LaneBlock& block, double cutoff, double* least) noexcept;

/// As overlap_lanes(). Reads floats, pairs, count and separations of the block. In any rounding
/// mode, subnormal numbers kept.
LaneOverlaps float_overlap_lanes(const LaneBlock& block) noexcept;

}  // namespace tangency::inline v0::detail
