// SPDX-License-Identifier: MIT
/// @file
/// What the closed forms of spheroids share. Internal.
///
/// ratio = across/along, kappa = 1 - ratio^2: below 1, 0 of a sphere, negative of flat bodies.
#pragma once

#include <cmath>

namespace tangency::inline v0::micromechanics {

/// Chosen: closed forms in powers of 1/x, x = kappa or another number that is 0 of a sphere, lose
/// up to 1/x^3 of rounding. Below this size of x series in powers of x stand for them.
inline constexpr double kSeries = 0.3;

inline double kappa_of(double ratio) { return (1.0 - ratio) * (1.0 + ratio); }

/// The integral of sqrt(1 - kappa t^2) from 0 to `height`: the area of a zone of the surface from
/// the equator to along times `height`, over 2 pi along across.
/// @param across_squared  1 - height^2
inline double zone(double ratio, double height, double across_squared) {
  const double kappa = kappa_of(ratio);
  const double root = std::sqrt(across_squared + ratio * ratio * height * height);
  double turned = height;  // the integral of 1/sqrt(1 - kappa t^2)
  if (kappa > 0.0)
    turned = std::atan2(std::sqrt(kappa) * height, root) / std::sqrt(kappa);
  else if (kappa < 0.0)
    turned = std::asinh(std::sqrt(-kappa) * height) / std::sqrt(-kappa);
  return 0.5 * (height * root + turned);
}
/// To the end of the axis.
inline double half_zone(double ratio) { return zone(ratio, 1.0, 0.0); }

/// The sum of term(0), term(1), ... of a series whose terms fall at least as fast as powers of 1/2,
/// but for the first few.
template <typename Term>
double series(Term term) {
  constexpr int kMostTerms = 80;  // derived: 2^-80 is below rounding, times any factor of the terms
  double sum = 0.0;
  for (int n = 0; n < kMostTerms; ++n) sum += term(n);
  return sum;
}

}  // namespace tangency::inline v0::micromechanics
