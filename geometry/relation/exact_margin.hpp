// SPDX-License-Identifier: MIT
/// @file
/// The largest factor by which one solid can be scaled about its own centre and still lie in
/// another, between rational bounds: docs/derivations/containment.md, section 1. Internal (GMP).
///
/// With A the outer and B the inner solid, e = c_B - c_A in the interior of A,
///
///     s^2 = max over v with v M_A >= M_B of  G(v) = 1/v - e' (v M_A - M_B)^-1 e,
///
/// whose maximum is bracketed by the signs of integer polynomials: no number is rounded.
///
/// (1) low <= s <= high, and high - low at most 2^-56 of s.
/// (2) Both are 0 if and only if e is not in the interior of A.
/// (3) rounded(e, side) is within its error of every number of the enclosure that is on that side.
#pragma once

#include <gmpxx.h>

#include <cstddef>

#include <tangency/geometry/bodies/rational_solid.hpp>

namespace tangency::inline v0::exact {

/// Of a number that is not negative.
struct MarginEnclosure {
  mpq_class low, high;

  /// Is it open whether the number is above, at or below 1?
  bool leaves_one_open() const { return low <= 1 && high >= 1; }
};

/// Allocates.
template <std::size_t N>
MarginEnclosure margin(const RationalSolid<N>& inner, const RationalSolid<N>& outer);

struct RoundedMargin {
  double value;
  double error;
};

/// @param side  of the true number: -1 below 1, 0 at 1, 1 above 1
RoundedMargin rounded(const MarginEnclosure& enclosure, int side);

}  // namespace tangency::inline v0::exact
