// SPDX-License-Identifier: MIT
/// @file
/// The real roots of a real quartic, in double, each with an error that is proven.
///
/// (1) An error encloses: p changes sign within `error` of a root that `crosses`.
/// (2) From every sign change of p, all along to a root or else to another sign change,
///     |p(x)| <= 32 u sum |a_k x^k|, u = 2^-53: two roots that rounding cannot keep apart are one
///     that does not cross, or none, and no other is missed.
/// (3) Multiplying p by a power of two changes nothing; p(-x) has the negated roots. Bit for bit.
/// (4) p(2^k x) has the roots and errors times 2^-k, bit for bit while these are normal doubles.
#pragma once

#include <array>

#include <tangency/geometry/floating_point.hpp>

namespace tangency::inline v0 {

/// A real root of a quartic.
struct QuarticRoot {
  double x;      ///< nearest known value
  double error;  ///< >= 0; infinite where not even 1/x is known
  /// Does p change sign? Otherwise p comes within its rounding of 0 at x and turns back: a double
  /// root, or two close ones, or a near miss.
  bool crosses;
};

/// The real roots of a quartic.
struct QuarticRoots {
  int count;                         ///< at most 4 cross
  std::array<QuarticRoot, 16> root;  ///< by increasing x; those beyond count are zero
  bool vanishes;  ///< every coefficient is 0: every number is a root, and count is 0
  int beyond;     ///< how many more lie beyond the greatest double, on either side
};

/// Of p(x) = a[0] + a[1] x + a[2] x^2 + a[3] x^3 + a[4] x^4, any of them 0.
///
/// For coefficients of any exponents, subnormal ones included. The errors are a few units in the
/// last place of a root that is far from the others, and as wide as rounding of p makes a root that
/// is not: about u sum |a_k x^k| / |p'(x)| where that is small, its square root at a double one. A
/// root 0 has the error 0; one below the least normal double is rounded to a multiple of 2^-1074,
/// which its error has in it. In any floating-point environment. Does not allocate.
/// docs/derivations/quartic-roots.md
/// @param a  finite (asserted)
QuarticRoots quartic_roots(const std::array<double, 5>& a) noexcept;

}  // namespace tangency::inline v0
