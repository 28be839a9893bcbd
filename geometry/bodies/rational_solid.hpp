// SPDX-License-Identifier: MIT
/// @file
/// A solid { x : (x - c)' M^-1 (x - c) <= 1 } with a rational centre c and shape matrix M, in space
/// or in the plane: what bodies given by matrices mean exactly. Internal (GMP).
///
/// (1) form / denominator of integer_form() is the discriminant matrix of (x - c)' M^-1 (x - c) -
/// 1,
///     negative inside, -1 at the centre.
/// (2) With E the solid of nearest_solid() about its own centre, (1 - relative) E lies in the true
///     solid and that in (1 + relative) E; no support function is off by more than `absolute`, the
///     distance of the centres included.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>

#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0::exact {

template <std::size_t N>
using RationalMatrix = std::array<std::array<mpq_class, N>, N>;
template <std::size_t N>
using RationalVector = std::array<mpq_class, N>;

template <std::size_t N>
struct RationalSolid {
  RationalVector<N> centre;
  RationalMatrix<N> shape;  ///< symmetric and positive definite
};

/// Of a symmetric matrix: are all leading minors > 0?
template <std::size_t N>
bool is_positive_definite(const RationalMatrix<N>& matrix);

/// Requires a determinant other than 0.
template <std::size_t N>
RationalMatrix<N> inverse(const RationalMatrix<N>& matrix);

/// The smallest eigenvalue of a symmetric matrix, rounded: for messages.
template <std::size_t N>
double smallest_eigenvalue(const RationalMatrix<N>& matrix);

template <std::size_t N>
SolidForm<N + 1> integer_form(const RationalSolid<N>& solid);

/// By doubles. `relative` and `absolute` are rounded up; infinite or 0 where a number of the solid
/// is beyond the range of doubles.
template <std::size_t N>
struct NearestSolid {
  std::array<double, N> centre;
  std::array<double, N> semi_axes;
  /// Of body axes in space: a quaternion (w, x, y, z) of about unit length, or in the plane the
  /// first axis, of about unit length too.
  std::array<double, N == 3 ? 4 : 2> orientation;
  double relative;  ///< of lengths
  double absolute;  ///< length
};
template <std::size_t N>
NearestSolid<N> nearest_solid(const RationalSolid<N>& solid);

}  // namespace tangency::inline v0::exact
