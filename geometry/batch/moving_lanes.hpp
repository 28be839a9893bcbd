// SPDX-License-Identifier: MIT
/// @file
/// Rows of bodies for the lanes from their semi-axes and orientations, several bodies at once. The
/// instruction set is chosen when the program runs. Internal.
#pragma once

#include <cstddef>

#include <tangency/geometry/batch/lane_block.hpp>

namespace tangency::inline v0::detail {

/// Where the rows of bodies go, as many of each kind.
struct RowsOfBodies {
  LaneBody* lanes;
  ShapeRow* shapes;
  FloatRow* floats;  ///< null: not wanted
};

/// The rows of bodies whose factors are right to kOfRotation; the others are to the bit what
/// shape_rows.hpp makes of those of the first kind. A body that is not moderate(), or no ellipsoid,
/// or whose |q|^2 is not within [2^-60, 2^60], has a row that no lane settles. Each row depends on
/// its body alone. Assumes rounding to nearest.
/// @param semi_axes     3 of each body
/// @param orientations  x y z w of each, of any length
/// @param centres       3 of each; null: all are at the origin
/// @param count         at least 1
void fill_moving_lanes(const double* semi_axes, const double* orientations, const double* centres,
                       std::size_t count, const RowsOfBodies& to) noexcept;

}  // namespace tangency::inline v0::detail
