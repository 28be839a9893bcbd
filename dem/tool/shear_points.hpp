// SPDX-License-Identifier: MIT
/// @file
/// Four points of a shear test by rule, from rows of its history: A, its start; B, where it begins
/// to yield; C, its peak of friction; D, where its volume begins to stay constant. The published
/// study shows pictures at such points [Ouadfel1998, section 5.4.6] and gives no rule; these are
/// ours.
///
/// Derivatives are slopes of least-squares lines through rows within a width of axial strain, or
/// through three neighbours where rows are further apart (strain_windows.hpp): no point is known
/// better than to the distance of rows. A point is the row that is nearest to the mean strain of
/// the rows which told it.
///
/// Signs are those of observe.hpp: axial strain is positive in compression, volumetric strain in
/// dilation.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace tangency::inline v0::dem {

/// What a row of a history says. Strains count from the start of the stage.
struct ShearPointRow {
  double axial_strain, volumetric_strain;  ///< where the point is
  double friction_angle_deg;               ///< at the point
  double stress_ratio;  ///< q / p of observe.hpp [Ouadfel1998, eq. 6.23]; 0 where p is not > 0
};

/// Widths of axial strain and thresholds. Chosen with the rules: an assembly of a thousand yields
/// over some 0.01, and its volume wanders by 0.001.
inline constexpr double kYieldWindow = 0.002;
/// the share of the steepest rise at which an assembly yields
inline constexpr double kYieldShare = 0.2;
inline constexpr double kConstantVolumeWindow = 0.05;  ///< axial strain
inline constexpr double kConstantVolumeRate = 0.02;    ///< d volumetric strain / d axial strain

/// Indices of rows.
struct ShearPoints {
  std::size_t a, b, c, d;  ///< the rows of the points A, B, C and D
  bool d_is_last_row;      ///< the volume was nowhere constant after C
};

/// A is the first row. C is the row nearest to the strain at the peak friction angle of
/// shear_peaks() of the rows after A. B is in the first window, after that of the steepest rise of
/// the stress ratio before C, whose rise is at most kYieldShare of it; where there is none, C. D is
/// in the first window of rows from C on that is as wide as kConstantVolumeWindow and in which the
/// volumetric strain changes by less than kConstantVolumeRate per axial strain; where there is
/// none, the last row.
///
/// (2) a <= b <= c <= d.
/// @param rows  of one stage, in their order, the first that of its start
/// @return  nothing for fewer than two rows
std::optional<ShearPoints> shear_points(std::span<const ShearPointRow> rows);

}  // namespace tangency::inline v0::dem
