// SPDX-License-Identifier: MIT
/// @file
/// What an exact question about a pair of ellipsoids is asked of: its characteristic quartic and
/// the cubic of its shapes, in exact integers. Internal (GMP).
///
/// P(l) = c det(l Q_A + Q_B) with c > 0 and Q < 0 inside. With the Perram-Wertheim form, by block
/// elimination,  det M_A det M_B det(l Q_A + Q_B) = l N(l) - (1 + l) D(l),  which needs only 3 x 3
/// matrices and the difference of the centres: numbers half as long as the determinant's.
///
/// (1) P(0) < 0 and the leading coefficient is < 0.
/// (2) P has at least two negative roots, counted with multiplicity [WangWangKim2001].
/// (3) The solids are apart <=> P has two distinct positive roots; they touch from outside <=> one
///     (double) positive root; their interiors meet <=> none [WangWangKim2001].
/// (4) ExactPair(b, a) is ExactPair(a, b).exchanged().
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/numbers/integer_polynomial.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::exact {

/// The exponent of the unit in which the edges that the image counts are integers; at most
/// `otherwise`.
int length_exponent(const Mat3& edges, const LatticeImage& image, int otherwise) noexcept;

enum class Position { apart, touching, interiors_meet };

/// Is one solid ellipsoid inside another, with or without touching its boundary?
enum class Containment { none, touching, interior };

class ExactPair {
 public:
  ExactPair(const Ellipsoid& a, const Ellipsoid& b);
  /// Of A, and B moved by edges * image without rounding.
  ExactPair(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges, const LatticeImage& image);
  /// Of solids by their forms, in the same coordinates; the denominators take part, so that equal
  /// solids are seen.
  ExactPair(const SolidForm<4>& a, const SolidForm<4>& b);

  /// Identity (3).
  Position position() const;

  /// Are A and B the same point set?
  bool equal() const;

  /// Does B contain A? Requires that the interiors meet and that the two are not equal.
  ///
  /// S-lemma, Q < 0 inside: A is in the interior of B <=> some t > 0 makes t Q_A - Q_B positive
  /// definite; A is in B, touching its boundary <=> semidefinite for some t > 0, never definite.
  /// With P(l) and D(l) as above, R(t) = P(-t) and C(t) = -D(-t), which up to a factor > 0 are the
  /// determinants of t Q_A - Q_B and of its block t M_A^-1 - M_B^-1, only the largest roots r of R
  /// and m of C matter:
  ///
  ///   r > m: interior where r is a simple root of R, touching where it is a double one;
  ///   r = m: touching where it is of higher multiplicity in R than in C, else none;
  ///   r < m, or R with complex roots: none.
  ///
  /// docs/derivations/relation-filter.md, section 5.
  Containment containment() const;

  /// Of (B, A).
  ExactPair exchanged() const;

  // Each up to a factor > 0.
  const IntegerPolynomial& quartic() const noexcept { return quartic_; }  ///< P(l), of degree 4
  /// D(l) = det(M_A + l M_B), of degree 3
  const IntegerPolynomial& shapes() const noexcept { return shapes_; }

 private:
  ExactPair(IntegerPolynomial quartic, IntegerPolynomial shapes);

  IntegerPolynomial quartic_, shapes_;
};

}  // namespace tangency::inline v0::exact
