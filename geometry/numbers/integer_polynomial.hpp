// SPDX-License-Identifier: MIT
/// @file
/// Polynomials with exact integer coefficients, and their real roots. Internal (GMP).
///
/// (1) sign_at(x) of p q is the product of the signs of p and q at x.
/// (2) gcd(p r, q r) is r's primitive part where p and q have no common root.
/// (3) square_free_part(p) has the roots of p, each once.
/// (4) SturmSequence(p).roots_between(a, b) + roots_between(b, c) = roots_between(a, c).
/// (5) discriminant_sign(p) = 0 if and only if p has a multiple root, real or complex.
/// (6) coprime(p, q) if and only if gcd(p, q) is constant.
#pragma once

#include <gmpxx.h>

#include <cstddef>
#include <span>
#include <vector>

namespace tangency::inline v0::exact {

/// c[0] + c[1] x + ... + c[n] x^n with c[n] != 0, or zero.
class IntegerPolynomial {
 public:
  /// Zero.
  IntegerPolynomial() = default;
  /// @param coefficients  from the constant upwards; zeros at the end are dropped
  explicit IntegerPolynomial(std::vector<mpz_class> coefficients);

  /// -1 for zero.
  int degree() const noexcept { return static_cast<int>(coefficients_.size()) - 1; }
  bool is_zero() const noexcept { return coefficients_.empty(); }
  std::span<const mpz_class> coefficients() const noexcept { return coefficients_; }
  /// Requires a polynomial that is not zero.
  const mpz_class& leading() const noexcept { return coefficients_.back(); }

  int sign_at(const mpq_class& x) const;
  /// Sign of p(x) for all large enough x.
  int sign_at_plus_infinity() const noexcept;
  int sign_at_minus_infinity() const noexcept;

  IntegerPolynomial derivative() const;
  /// Divided by the greatest common divisor of the coefficients, which is > 0: signs are kept.
  IntegerPolynomial primitive_part() const;
  /// p(-x)
  IntegerPolynomial reflected() const;

  IntegerPolynomial operator-() const;
  IntegerPolynomial& operator+=(const IntegerPolynomial& other);
  IntegerPolynomial& operator-=(const IntegerPolynomial& other);
  friend IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b);
  bool operator==(const IntegerPolynomial& other) const = default;

 private:
  void trim();

  std::vector<mpz_class> coefficients_;
};

/// A positive multiple of the remainder of a divided by b. Requires b != 0.
IntegerPolynomial positive_pseudo_remainder(IntegerPolynomial a, const IntegerPolynomial& b);

/// Primitive, with a leading coefficient > 0; zero where both are zero.
IntegerPolynomial gcd(IntegerPolynomial a, IntegerPolynomial b);

/// Have they no common root, real or complex? Requires two that are not zero. Quick where the
/// answer is yes.
bool coprime(const IntegerPolynomial& a, const IntegerPolynomial& b);

/// a / b. Requires that b != 0 divides a in integers (by Gauss' lemma enough: b is primitive and
/// divides a over the rationals).
IntegerPolynomial exact_quotient(const IntegerPolynomial& a, const IntegerPolynomial& b);

/// Primitive, a leading coefficient of p's sign; zero for zero.
IntegerPolynomial square_free_part(const IntegerPolynomial& p);

/// Changes of sign from coefficient to coefficient, zeros skipped: by Descartes' rule the number of
/// positive roots, each as often as its multiplicity, where all roots are real.
int sign_changes(const IntegerPolynomial& p) noexcept;

/// Sign of the discriminant, lc^(2n-2) times the product of the squared differences of the roots,
/// in closed form. Requires degree 1 (sign +1) to 4.
int discriminant_sign(const IntegerPolynomial& p);

/// Counts distinct real roots, whatever their multiplicity, in intervals whose ends may be roots.
class SturmSequence {
 public:
  /// Requires p != 0.
  explicit SturmSequence(const IntegerPolynomial& p);

  /// The square-free part of p: changes its sign at every root.
  const IntegerPolynomial& square_free() const noexcept { return sequence_.front(); }

  int roots() const;
  /// In low < x <= high. Requires low <= high.
  int roots_between(const mpq_class& low, const mpq_class& high) const;
  /// In x > low.
  int roots_above(const mpq_class& low) const;

 private:
  std::vector<IntegerPolynomial> sequence_;
};

}  // namespace tangency::inline v0::exact
