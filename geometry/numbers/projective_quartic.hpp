// SPDX-License-Identifier: MIT
/// @file
/// Real roots of a quartic on the projective line, in float, double or long double: of the form
///     p(s, c) = a_0 c^4 + a_1 s c^3 + a_2 s^2 c^2 + a_3 s^3 c + a_4 s^4,
/// the polynomial in w = s/c with a root at w = infinity wherever a_4 = 0. With w = tan(t/2) that
/// is a curve's angle t, and nothing happens at t = pi.
///
/// Two charts cover the line, w in [-1, 1] and y = 1/w in [-1, 1]. In each, the roots of every
/// derivative in turn cut the interval into pieces on which the next is monotone; a sign counts
/// only where the value exceeds a bound of its rounding. docs/derivations/quartic-roots.md
///
/// Nothing here allocates or throws.
#pragma once

#include <array>
#include <cmath>

namespace tangency::inline v0::detail {

/// a_0, ..., a_4, finite.
template <class Real>
using QuarticCoefficients = std::array<Real, 5>;

/// s = 1 or c = 1, the other in [-1, 1]; on the line, w = s/c.
template <class Real>
struct ProjectiveRoot {
  Real s, c;
  /// p has its sign on either side of the root this far away in the coordinate that is not 1, or
  /// nearer: it may reach beyond [-1, 1]. Infinite where that was not found.
  Real error;
  bool crosses;  ///< p changes sign, proven; else p comes within its rounding of 0 and turns back

  /// 2 atan(w) in [-pi/2, 3 pi/2).
  Real angle() const noexcept { return 2 * std::atan2(s, c); }
};

/// By increasing angle().
template <class Real>
struct ProjectiveRoots {
  int count;
  std::array<ProjectiveRoot<Real>, 16> root;  ///< at most 4 of them cross
  bool vanishes;  ///< p is 0, or not to be told from it anywhere: count is 0
};

/// Instantiated for float, double and long double.
template <class Real>
ProjectiveRoots<Real> projective_roots(const QuarticCoefficients<Real>& a) noexcept;

extern template ProjectiveRoots<float> projective_roots(const QuarticCoefficients<float>&) noexcept;
extern template ProjectiveRoots<double> projective_roots(
    const QuarticCoefficients<double>&) noexcept;
extern template ProjectiveRoots<long double> projective_roots(
    const QuarticCoefficients<long double>&) noexcept;

}  // namespace tangency::inline v0::detail
