// SPDX-License-Identifier: MIT
/// @file
/// The peaks of a shear test, from rows of its history.
///
/// Signs are those of observe.hpp: axial strain is positive in compression, volumetric strain in
/// dilation.
#pragma once

#include <optional>
#include <span>

namespace tangency::inline v0::dem {

/// What a row of a history says of a shear test. Strains count from the start of its stage.
struct ShearRow {
  double axial_strain, volumetric_strain;  ///< where the peak is
  double friction_angle_deg;               ///< at the peak
};

/// The peaks of a shear.
struct ShearPeaks {
  double friction_angle_deg;  ///< largest mobilised friction angle
  double strain_at_friction;  ///< mean axial strain of the rows that it was taken from
  double dilation_rate;       ///< d volumetric strain / d axial strain
  double strain_at_dilation;  ///< mean axial strain of the rows that it was taken from
};

/// Axial strain over which peaks are taken. Chosen: published peaks are some 0.05 wide, and the
/// jumps of a thousand particles' volume some 0.001; a single row's angle is up to 2 degrees above
/// its neighbours'.
inline constexpr double kPeakWindow = 0.01;

/// The largest mean friction angle of rows that lie within kPeakWindow, and the largest slope of a
/// least-squares line through their volumetric strains, the unstrained start among them, which has
/// a volume and no angle. Where rows are further apart three neighbours are taken.
///
/// (1) Volumetric strains that lie on a line have its slope, and equal angles are the peak.
/// (2) Windows reach over the full width, except that of rows whose strain is less than it in all.
/// @param rows  of one stage, in their order
/// @return  nothing without a row
std::optional<ShearPeaks> shear_peaks(std::span<const ShearRow> rows);

}  // namespace tangency::inline v0::dem
