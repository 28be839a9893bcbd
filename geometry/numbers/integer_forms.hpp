// SPDX-License-Identifier: MIT
/// @file
/// Symmetric matrices of exact integers, and the exact reading of doubles into them. Internal: the
/// public headers never include it, so that GMP stays out of them.
///
/// Doubles are taken apart by their bits and no floating-point operation is done on them, so every
/// answer here is the same in each rounding mode and when subnormals are flushed or read as zero.
///
/// (1) inertia(S' F S) = inertia(F) for every regular S (Sylvester's law).
/// (2) inertia(F) = inertia_from_signs(signs of characteristic_coefficients(F)) (Descartes' rule,
///     exact because the roots of a symmetric matrix are real).
/// (3) determinant(F) = characteristic_coefficients(F)[N].
/// (4) to_integer(v, e) 2^e = v for every e up to common_exponent({v}).
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tangency::inline v0::exact {

/// mantissa 2^exponent, the mantissa odd or (with exponent 0) zero.
struct Dyadic {
  std::int64_t mantissa;
  int exponent;
};

/// The value of a finite double, subnormals included whatever the processor does with them.
Dyadic decode(double value) noexcept;

/// The largest e for which every value is an integer multiple of 2^e; 0 where all are zero.
int common_exponent(std::span<const double> values) noexcept;

/// value, whatever the size of a long.
mpz_class to_integer(std::int64_t value);

/// value / 2^exponent. Requires that this is an integer: exponent <= common_exponent({value}).
mpz_class to_integer(double value, int exponent);

/// value as a rational number, exactly.
mpq_class to_rational(double value);

/// Of |value|; 1 for 0.
inline long bit_length(const mpz_class& value) {
  return static_cast<long>(mpz_sizeinbase(value.get_mpz_t(), 2));
}

/// Divides all by the largest power of two that they have in common.
void strip_powers_of_two(std::span<mpz_class> values);

/// A symmetric N x N matrix, both triangles filled; N is 2, 3 or 4 (conics need 3, quadrics 4).
template <std::size_t N>
using IntegerForm = std::array<std::array<mpz_class, N>, N>;

/// The form of a solid over a denominator, negative inside and -1 at its centre.
template <std::size_t N>
struct SolidForm {
  IntegerForm<N> form;
  mpz_class denominator;  ///< > 0
};

/// Numbers of positive, negative and zero eigenvalues.
struct Inertia {
  int positive = 0;
  int negative = 0;
  int zero = 0;

  int rank() const noexcept { return positive + negative; }
  Inertia negated() const noexcept { return {negative, positive, zero}; }
  bool operator==(const Inertia&) const = default;
};

/// Exact, by fraction-free symmetric elimination: a diagonal pivot where one is not zero, else the
/// sum of two rows (and columns) makes one [Bareiss1968].
template <std::size_t N>
Inertia inertia(const IntegerForm<N>& form);

template <std::size_t N>
mpz_class determinant(const IntegerForm<N>& form);

/// e_0 = 1, e_1 = trace, ..., e_N = determinant: e_k is the sum of the principal minors of order k,
/// det(F - t I) = sum over k of e_k (-t)^(N-k). For the sub-discriminant of a quadric these are
/// T1-3, for its discriminant D1-4.
template <std::size_t N>
std::array<mpz_class, N + 1> characteristic_coefficients(const IntegerForm<N>& form);

/// Inertia of a real symmetric matrix from the signs of its e_0 (which is +1) to e_N.
Inertia inertia_from_signs(std::span<const int> signs) noexcept;

/// The upper-left block.
IntegerForm<3> sub_form(const IntegerForm<4>& form);

/// weight_a A + weight_b B
template <std::size_t N>
IntegerForm<N> combine(const mpz_class& weight_a, const IntegerForm<N>& a,
                       const mpz_class& weight_b, const IntegerForm<N>& b);

/// The discriminant matrix of A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx + 2G x + 2H y + 2J z +
/// K divided by 2^exponent. Requires exponent <= common_exponent(coefficients).
/// @param coefficients  A B C D E F G H J K, finite
IntegerForm<4> quadric_form(std::span<const double, 10> coefficients, int exponent);

}  // namespace tangency::inline v0::exact
