// SPDX-License-Identifier: MIT
/// @file
/// The maximiser of the Perram-Wertheim function, to a precision that is proven: the point where
/// the level functions of two bodies agree and their normals oppose. Contact by that function and
/// by the midpoint of potentials have it in common.
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

#include <optional>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/wide_float.hpp>

namespace tangency::inline v0::detail {

/// Relative errors below the first are squared by a factor below the second, and more.
inline constexpr double kSmallError = 0x1p-10, kSlack = 1.0625;

/// What the search asks of an arithmetic beyond its operators. exponent(v) is e with
/// 2^e <= |v| < 2^(e+1), for 0 less than for any other number; product(a, b) is exact.
template <class T>
struct Arithmetic;

template <>
struct Arithmetic<DoubleDouble> {
  using Rough = double;  ///< for bounds and steps
  static constexpr double kEpsilon = kDoubleDoubleEpsilon;
  static constexpr double kSettled = 0x1p-75;  ///< of a step in log l: leaves 2^-60 room enough
  static Rough rough(const DoubleDouble& v) noexcept { return v.high; }
  static int exponent(const DoubleDouble& v) noexcept { return exponent_of(v.high); }
  static DoubleDouble product(double a, double b) noexcept { return two_product(a, b); }
  static DoubleDoubleMatrix rotation(const Quaternion& q) noexcept {
    return double_double_rotation(q);
  }
};

template <>
struct Arithmetic<WideFloat> {
  using Rough = WideFloat;  ///< beyond the range of doubles and in any rounding mode
  static constexpr double kEpsilon = kWideEpsilon;
  static constexpr double kSettled = 0x1p-300;
  static Rough rough(const WideFloat& v) noexcept { return v; }
  static int exponent(const WideFloat& v) noexcept {
    constexpr int kOfZero = -1'000'000;  // less than of any other number that doubles lead to
    return v.is_zero() ? kOfZero : static_cast<int>(v.exponent());
  }
  static WideFloat product(double a, double b) noexcept { return WideFloat(a) * WideFloat(b); }
  static WideMatrix rotation(const Quaternion& q) noexcept { return wide_rotation(q); }
};

template <class T>
using Rough = typename Arithmetic<T>::Rough;

/// A body by its factors and its shape matrix.
template <class T>
struct PreciseShape {
  explicit PreciseShape(const Ellipsoid& body) noexcept;

  Vector3<T> stretched(const Vector3<T>& v) const noexcept;  ///< A' v
  Vector3<T> spread(const Vector3<T>& y) const noexcept;     ///< A y
  /// A^-1 v
  Vector3<T> in_ball(const Vector3<T>& v) const noexcept;

  const Ellipsoid& body;
  Matrix3<T> rotation;
  T xx, yy, zz, yz, zx, xy;  ///< of M
};

/// A vector in units of 2^exponent: its largest component in [1, 2).
template <class T>
struct Direction {
  Vector3<T> vector;
  int exponent;
};

/// Requires v != 0.
template <class T>
Direction<T> direction(const Vector3<T>& v) noexcept;

/// v in units of 2^exponent, and how far it and what follows from it may be off.
template <class T>
struct PerramWertheimPoint {
  T ratio;         ///< l
  Vector3<T> v;    ///< towards B
  Vector3<T> y_a;  ///< A' v, in the ball of A the point of equal levels
  Vector3<T> y_b;  ///< l B' v, in the ball of B its opposite
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
std::optional<PerramWertheimPoint<T>> find_perram_wertheim_point(const PreciseShape<T>& a,
                                                                 const PreciseShape<T>& b,
                                                                 const Direction<T>& d,
                                                                 double& ratio) noexcept;

}  // namespace tangency::inline v0::detail
