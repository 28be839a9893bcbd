// SPDX-License-Identifier: MIT
/// @file
/// The point where the level functions of two bodies agree and their normals oppose: what contact
/// by the Perram-Wertheim function and by the midpoint of potentials have in common.
///
/// With M = A A', A = R diag(a), the shape matrix of a body, l = s/(1-s) and
///     S(l) = M_A + l M_B,  v(l) = S^-1 d,
/// F(s) of [PerramWertheim1985] is greatest where the levels v' M_A v of A and l^2 v' M_B v of B
/// are equal; both are that greatest F there, the point is c_A + M_A v = c_B - l M_B v, and l is
/// h_A(v) / h_B(v).
///
/// T is the arithmetic: DoubleDouble, or WideFloat where that does not suffice. Why the errors are
/// what is said here: docs/derivations/other-gaps.md.
#pragma once

#include <array>
#include <optional>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/wide_float.hpp>

namespace tangency::detail {

/// Relative errors below the first are squared by a factor below the second, and more.
inline constexpr double kSmallError = 0x1p-10, kSlack = 1.0625;

/// What the search asks of an arithmetic beyond its operators.
template <class T>
struct Arithmetic;

template <>
struct Arithmetic<DoubleDouble> {
  using Rough = double;  ///< for bounds and steps
  static constexpr double kEpsilon = kDoubleDoubleEpsilon;
  static constexpr double kSettled = 0x1p-75;  ///< of a step in log l: leaves 2^-60 room enough
  static Rough rough(const DoubleDouble& v) noexcept { return v.high; }
};

template <>
struct Arithmetic<WideFloat> {
  using Rough = WideFloat;  ///< beyond the range of doubles and in any rounding mode
  static constexpr double kEpsilon = kWideEpsilon;
  static constexpr double kSettled = 0x1p-300;
  static Rough rough(const WideFloat& v) noexcept { return v; }
};

template <class T>
using Rough = typename Arithmetic<T>::Rough;

template <class T>
using VectorOf = std::array<T, 3>;

/// A body by its factors and its shape matrix.
template <class T>
struct ShapeIn {
  explicit ShapeIn(const Ellipsoid& body) noexcept;

  VectorOf<T> stretched(const VectorOf<T>& v) const noexcept;  ///< A' v
  VectorOf<T> spread(const VectorOf<T>& y) const noexcept;     ///< A y
  /// A^-1 v
  VectorOf<T> in_ball(const VectorOf<T>& v) const noexcept;

  const Ellipsoid& body;
  std::array<VectorOf<T>, 3> rotation;
  T xx, yy, zz, yz, zx, xy;  ///< of M
};

/// A vector in units of 2^exponent: its largest component in [1, 2).
template <class T>
struct Direction {
  VectorOf<T> vector;
  int exponent;
};

/// Requires v != 0.
template <class T>
Direction<T> direction(const VectorOf<T>& v) noexcept;

/// v in units of 2^exponent, and how far it and what follows from it may be off.
template <class T>
struct EqualLevel {
  T ratio;          ///< l
  VectorOf<T> v;    ///< towards B
  VectorOf<T> y_a;  ///< A' v, in the ball of A the point of equal levels
  VectorOf<T> y_b;  ///< l B' v, in the ball of B its opposite
  int exponent;
  Rough<T> turn;            ///< of v's error, over |v|
  Rough<T> off_a, off_b;    ///< of the errors of y_a and y_b, in their unit
  Rough<T> turn_a, turn_b;  ///< the same over |y_a| and |y_b|
};

/// By Newton's method on log l within the bracket [a_min/b_max, a_max/b_min] of h_A/h_B, from
/// `ratio` or, if that is 0, from what the polynomials of the Perram-Wertheim form give in double
/// where they may be used. `ratio` becomes the l that was found or reached.
///
/// In DoubleDouble: requires semi-axes within [2^-300, 2^61] and the default floating-point
/// environment.
/// @param d  c_B - c_A, with the exponent in the unit of the bodies
/// @return   nothing where rounding hides l or v
template <class T>
std::optional<EqualLevel<T>> find_equal_level(const ShapeIn<T>& a, const ShapeIn<T>& b,
                                              const Direction<T>& d, double& ratio) noexcept;

}  // namespace tangency::detail
