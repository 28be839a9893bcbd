// SPDX-License-Identifier: MIT
/// @file
/// The point where the level functions of two bodies agree and their normals oppose: what contact
/// by the Perram-Wertheim function and by the midpoint of potentials have in common.
///
/// With M = A A', A = R diag(a), the shape matrix of a body, l = s/(1-s) and
///     v(l) = (M_A + l M_B)^-1 d,
/// F(s) of [PerramWertheim1985] is greatest where the levels v' M_A v of A and l^2 v' M_B v of B
/// are equal; both are that greatest F there, the point is c_A + M_A v = c_B - l M_B v, and l is
/// h_A(v) / h_B(v).
#pragma once

#include <optional>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/exact/double_double_vector.hpp>

namespace tangency::methods {

using exact::DoubleDouble;
using exact::DoubleDoubleVector;

/// A body by its factors and its shape matrix in double-double.
struct DoubleDoubleShape {
  explicit DoubleDoubleShape(const Ellipsoid& body) noexcept;

  DoubleDoubleVector stretched(const DoubleDoubleVector& v) const noexcept;  ///< A' v
  DoubleDoubleVector spread(const DoubleDoubleVector& y) const noexcept;     ///< A y
  /// |diag(1/a) R' v|^2
  DoubleDouble inverse_form(const DoubleDoubleVector& v) const noexcept;

  const Ellipsoid& body;
  exact::DoubleDoubleMatrix rotation;
  DoubleDouble xx, yy, zz, yz, zx, xy;  ///< of M
};

/// A vector in units of 2^exponent: its largest component in [1, 2).
struct Direction {
  DoubleDoubleVector vector;
  int exponent;
};

/// Requires v != 0.
Direction direction(const DoubleDoubleVector& v) noexcept;

struct EqualLevel {
  DoubleDouble ratio;         ///< l
  DoubleDoubleVector normal;  ///< v / |v|, from A to B
  DoubleDouble level;         ///< F; 0 where that underflows
  DoubleDouble slope;         ///< |v|; 0 where that underflows
  DoubleDoubleVector from_a;  ///< the point from c_A: M_A v
  DoubleDoubleVector from_b;  ///< and from c_B: -l M_B v
};

/// By Newton's method on log l within the bracket [a_min/b_max, a_max/b_min] of h_A/h_B, in double
/// where the polynomials of the Perram-Wertheim form allow and then in double-double until l is
/// settled. Relative error of l and of every vector about 1e16 times 2^-102 where the aspect ratios
/// of both bodies are 1e8, by the condition of the sum of the shapes, and much less below; that of
/// the level is of second order in it. Requires semi-axes within [2^-300, 2^61] and the default
/// floating-point environment.
/// @param d  c_B - c_A, with the exponent in the unit of the bodies
/// @return   nothing where the sum of the shapes is not positive definite to double-double's eyes,
///           or a number leaves the range of doubles: aspect ratios beyond 1e12
std::optional<EqualLevel> find_equal_level(const DoubleDoubleShape& a, const DoubleDoubleShape& b,
                                           const Direction& d) noexcept;

}  // namespace tangency::methods
