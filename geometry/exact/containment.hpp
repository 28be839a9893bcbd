// SPDX-License-Identifier: MIT
/// @file
/// Is one solid ellipsoid inside another, with or without touching its boundary? Exact. Internal.
///
/// S-lemma, Q < 0 inside: A is in the interior of B <=> some t > 0 makes t Q_A - Q_B positive
/// definite; A is in B, touching its boundary <=> semidefinite for some t > 0, never definite (and
/// the two not proportional). With P(l) and D(l) of pair_quartic.hpp, R(t) = P(-t) and
/// C(t) = -D(-t), which up to a factor > 0 are the determinants of t Q_A - Q_B and of its block
/// t M_A^-1 - M_B^-1, only the largest roots r of R and m of C matter:
///
///   r > m: interior where r is a simple root of R, touching where it is a double one;
///   r = m: touching where it is of higher multiplicity in R than in C, else none;
///   r < m, or R with complex roots: none.
///
/// docs/derivations/relation-filter.md, section 5.
#pragma once

#include <tangency/geometry/exact/pair_quartic.hpp>

namespace tangency::exact {

enum class Containment { none, touching, interior };

/// Does B contain A? Requires the polynomials of (A, B), whose interiors meet and who are not
/// equal.
Containment containment(const PairPolynomials& pair);

/// Are A and B the same point set?
bool equal(const PairPolynomials& pair);

}  // namespace tangency::exact
