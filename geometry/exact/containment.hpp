// SPDX-License-Identifier: MIT
/// @file
/// Is one solid ellipsoid inside another, with or without touching its boundary? Exact. Internal.
///
/// S-lemma, Q < 0 inside: A is in the interior of B <=> some t > 0 makes t Q_A - Q_B positive
/// definite; A is in B, touching its boundary <=> semidefinite for some t > 0, never definite (and
/// the two not proportional). With P(l) = det(l Q_A + Q_B) and R(t) = P(-t) = det(t Q_A - Q_B):
/// a definite member makes all roots of R real, and lies between the two largest distinct positive
/// ones, since of t Q_A - Q_B's four eigenvalues exactly one is negative for large t and it is the
/// one that the largest root lets through; a semidefinite member that is never definite is the
/// largest root itself (docs/derivations/relation-filter.md, section 5).
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/exact/integer_polynomial.hpp>

namespace tangency::exact {

enum class Containment { none, touching, interior };

/// Does B contain A? Requires two bodies that are not equal, and their quartic pair_quartic(a, b).
Containment containment(const Ellipsoid& a, const Ellipsoid& b, const IntegerPolynomial& quartic);

/// Are they the same point set?
bool equal(const Ellipsoid& a, const Ellipsoid& b);

}  // namespace tangency::exact
