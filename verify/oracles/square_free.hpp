// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Square-free parts of integer polynomials, for the relation oracle: Euclid's algorithm with
/// primitive remainders, which for degree 4 is far quicker than a general modular one.
#pragma once

#include <gmpxx.h>

#include <vector>

namespace tangency::inline v0::verify {

/// Coefficients from the constant upwards, the last one not 0. Empty: the zero polynomial.
using IntegerPolynomial = std::vector<mpz_class>;

/// Greatest common divisor, primitive with a positive leading coefficient. Requires p and q not
/// zero.
IntegerPolynomial greatest_common_divisor(IntegerPolynomial p, IntegerPolynomial q);

/// The two polynomials whose roots, all simple, are the distinct roots of p and its multiple roots.
struct DistinctRoots {
  IntegerPolynomial all;
  IntegerPolynomial multiple;  ///< of degree 0 if p is square-free
};

/// Requires p not zero.
DistinctRoots distinct_roots(const IntegerPolynomial& p);

}  // namespace tangency::inline v0::verify
