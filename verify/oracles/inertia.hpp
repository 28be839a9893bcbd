// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Exact integers for the oracles: doubles under a common power of two, and the inertia of a
/// symmetric integer matrix by congruence. Nothing here rounds and nothing has a tolerance.
#pragma once

#include <gmpxx.h>

#include <array>
#include <span>
#include <vector>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

/// The integers m with values[i] = m[i] 2^exponent, for the largest exponent that keeps all of them
/// integers. All zero: exponent 0.
struct ScaledIntegers {
  std::vector<mpz_class> m;
  int exponent = 0;
};

/// Throws std::invalid_argument if a value is not finite.
ScaledIntegers to_integers(std::span<const double> values);

/// A symmetric 4x4 matrix; smaller ones use the leading block.
using IntegerMatrix = std::array<std::array<mpz_class, 4>, 4>;

/// The matrix of the quadratic form in (x, y, z, 1), times a positive power of two.
IntegerMatrix discriminant_matrix(const RawQuadric& quadric);

/// Numbers of positive, negative and zero eigenvalues.
struct Inertia {
  int positive = 0;
  int negative = 0;
  int zero = 0;

  int rank() const { return positive + negative; }
  friend bool operator==(const Inertia&, const Inertia&) = default;
};

/// Inertia of the leading size x size block (size <= 4): symmetric elimination with diagonal
/// pivots; when every diagonal entry left is zero and m_ij is not, row and column j are first
/// added to i. Sylvester's law makes the signs of the pivots the inertia. Bareiss' division keeps
/// the entries minors of the (unimodularly transformed) matrix, so they do not grow beyond those.
Inertia inertia(IntegerMatrix m, int size);

/// The exact relation (relation.hpp, by the pencil alone) of two surfaces by their forms in (x, y,
/// z, 1), either sign of each. Throws std::invalid_argument unless both are real ellipsoids.
struct ExactRelation;
ExactRelation exact_relation_by_pencil(const IntegerMatrix& a, const IntegerMatrix& b);

}  // namespace tangency::inline v0::verify
