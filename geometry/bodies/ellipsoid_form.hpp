// SPDX-License-Identifier: MIT
/// @file
/// The quadric of an ellipsoid in exact integers. Internal (GMP).
///
/// With the quaternion as it is stored, not normalised, R = R~ / |q|^2 and R~ is a polynomial in
/// q. Hence (a1 a2 a3)^2 |q|^4 times the discriminant matrix of
///
///     (x - c)' R diag(1/a^2) R' (x - c) - 1
///
/// is a polynomial in the ten stored doubles: an integer matrix in a unit of length 2^exponent.
///
/// (1) form / denominator is that discriminant matrix, negative inside, -1 at the centre.
/// (2) The form of every ellipsoid has inertia (3, 1), its sub-form (3, 0).
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0::exact {

using EllipsoidForm = SolidForm<4>;

/// |q|^2 R: rows and columns of equal length, not symmetric.
struct ScaledRotation {
  IntegerForm<3> matrix;
  mpz_class squared_length;  ///< |q|^2
};
ScaledRotation scaled_rotation(const Quaternion& q);

/// The largest e for which centre and semi-axes are integer multiples of 2^e.
int length_exponent(const Ellipsoid& e) noexcept;

/// In coordinates x / 2^exponent. For a question about a pair take the smaller of the two length
/// exponents for both: the answer does not depend on the unit of length.
/// Requires exponent <= length_exponent(e).
EllipsoidForm ellipsoid_form(const Ellipsoid& e, int exponent);

/// In the coordinates x themselves: for what does depend on the unit, such as D2 and D3.
EllipsoidForm ellipsoid_form(const Ellipsoid& e);

}  // namespace tangency::inline v0::exact
