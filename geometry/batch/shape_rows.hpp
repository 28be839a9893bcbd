// SPDX-License-Identifier: MIT
/// @file
/// Rows of bodies for the first tier of the gap, from those for the next one. The instruction set
/// is chosen when the program runs; what is written does not depend on it. Internal.
#pragma once

#include <cstddef>

#include <tangency/geometry/batch/lane_block.hpp>

namespace tangency::inline v0::detail {

/// M = S S' of the stored factors S, each entry rounded as (N) of docs/derivations/gap-batch.md
/// says. A body of an aspect ratio above 45 has a row that no lane of the first tier settles. Each
/// row depends on its body alone. Assumes rounding to nearest.
void fill_shape_rows(const LaneBody* bodies, std::size_t count, ShapeRow* to) noexcept;

}  // namespace tangency::inline v0::detail
