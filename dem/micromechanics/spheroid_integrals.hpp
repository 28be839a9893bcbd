// SPDX-License-Identifier: MIT
/// @file
/// What the closed forms of spheroids share. Internal.
///
/// ratio = across/along, kappa = 1 - ratio^2: below 1, 0 of a sphere, negative of flat bodies.
#pragma once

namespace tangency::micromechanics {

double kappa_of(double ratio);

/// The integral of sqrt(1 - kappa t^2) from 0 to `height`: the area of a zone of the surface from
/// the equator to along times `height`, over 2 pi along across.
/// @param across_squared  1 - height^2
double zone(double ratio, double height, double across_squared);
/// To the end of the axis.
double half_zone(double ratio);

/// The sum of term(0), term(1), ... of a series whose terms fall at least as fast as powers of 1/2,
/// but for the first few.
template <typename Term>
double series(Term term) {
  constexpr int kMostTerms = 80;  // derived: 2^-80 is below rounding, times any factor of the terms
  double sum = 0.0;
  for (int n = 0; n < kMostTerms; ++n) sum += term(n);
  return sum;
}

}  // namespace tangency::micromechanics
