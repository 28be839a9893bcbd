// SPDX-License-Identifier: MIT
/// @file
/// The largest roots of polynomials all of whose roots are real and > 0, compared exactly without
/// isolating any root. Internal (GMP). docs/derivations/relation-filter.md, section 6.
///
/// (1) compare_largest_roots(f, g) is the sign of the largest root of f less that of g, however
///     close they are, and 0 only where they are the same number.
/// (2) multiplicity_of_largest_root(p^m) is m times that of p.
/// (3) largest_root_exceeds_one(p) if and only if p has a root > 1.
#pragma once

#include <tangency/geometry/numbers/integer_polynomial.hpp>

namespace tangency::inline v0::exact {

/// -1, 0 or 1 as f's is less, the same, greater. Requires two polynomials without multiple roots,
/// of degree >= 1, all of whose roots are real and > 0.
int compare_largest_roots(const IntegerPolynomial& f, const IntegerPolynomial& g);

/// Requires degree >= 1 and only roots that are real and > 0.
int multiplicity_of_largest_root(const IntegerPolynomial& p);

/// Requires a polynomial other than 0 all of whose roots are real.
bool largest_root_exceeds_one(const IntegerPolynomial& p);

}  // namespace tangency::inline v0::exact
