// SPDX-License-Identifier: MIT
/// @file
/// Rows of bodies for the first tier of the gap from their semi-axes and orientations, several
/// bodies at once. The instruction set is chosen when the program runs. Internal.
#pragma once

#include <cstddef>

#include <tangency/geometry/batch/lane_block.hpp>

namespace tangency::inline v0::detail {

/// The rows of bodies centred at the origin, whose matrices are rounded once: (N) of
/// docs/derivations/gap-batch.md. A body that is not moderate(), or no ellipsoid, or whose |q|^2 is
/// not within [2^-60, 2^60], has a row that no lane settles. Each row depends on its body alone.
/// Assumes rounding to nearest.
/// @param semi_axes     3 of each body
/// @param orientations  x y z w of each, of any length
void fill_shape_rows(const double* semi_axes, const double* orientations, std::size_t count,
                     ShapeRow* to) noexcept;

}  // namespace tangency::inline v0::detail
