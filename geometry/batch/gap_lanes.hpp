// SPDX-License-Identifier: MIT
/// @file
/// The fast path of the gap for several pairs at once, one pair in each lane of a vector register:
/// what gap_batch.hpp is made of. The instruction set is chosen when the program runs.
///
/// Every lane holds what it computed against the certificate of docs/derivations/gap-batch.md; a
/// lane that does not prove its answer says so, and nothing else of it may be used.
#pragma once

#include <cstdint>

#include <tangency/geometry/batch/lane_block.hpp>

namespace tangency::inline v0::detail {

/// Bit i of the result: pair i is settled, with its proof. Assumes rounding to nearest.
std::uint64_t gap_lanes(LaneBlock& block) noexcept;

/// The same by a start and steps in float, one evaluation in double and a last step in float:
/// section 5 of the derivation. Reads rows in place of bodies, and bodies where arms are wanted; of
/// followed normals it proves the global gap alone. What it leaves open is for gap_lanes().
std::uint64_t mixed_gap_lanes(LaneBlock& block) noexcept;

/// Bit i: is pair i proven either way, and do its interiors meet?
struct LaneOverlaps {
  std::uint64_t decided, meet;
  /// Of float_overlap_lanes(): was most of the block open after the first proof?
  bool mostly_open = false;
};

/// Reads bodies, pairs, count and separations of the block. In any rounding mode.
LaneOverlaps overlap_lanes(const LaneBlock& block) noexcept;

}  // namespace tangency::inline v0::detail
