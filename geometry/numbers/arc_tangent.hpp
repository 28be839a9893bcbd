// SPDX-License-Identifier: MIT
/// @file
/// The angle of a vector of the upper half plane, with a proven error and without libm, whose last
/// bits differ from machine to machine. Internal.
///
/// (1) Within kAngleError u of itself of the true angle, u = 2^-53:
///     docs/derivations/common-volume.md, section 6.
#pragma once

namespace tangency::inline v0::detail {

/// Of the angle, over u.
inline constexpr double kAngleError = 10.0;

/// pi, rounded: 0.351 u of itself below it, u = 2^-53.
inline constexpr double kPi = 0x1.921fb54442d18p+1;

/// In [0, pi], of the vector (cosine, sine), of any length but 0; rad. Assumes rounding to nearest.
/// @param sine    finite, >= 0
/// @param cosine  finite; neither the larger of the two nor its sum of both overflows
double angle_of(double sine, double cosine) noexcept;

}  // namespace tangency::inline v0::detail
