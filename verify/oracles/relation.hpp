// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: how two ellipsoids lie to each other, proven for the stored doubles.
///
/// Q_A and Q_B are the 4x4 integer matrices of the forms that are negative inside, E(f) = Q_A + f
/// Q_B for real f ("members"). Both have inertia (3,1); E(f) has a positive definite 3x3 block for
/// f > 0. What is used, and so proven, each time by exact inertia (symmetric elimination on
/// integers):
///
///  (1) E(f) > 0 for some f > 0  <=>  separate: no common point.
///  (2) E(f) > 0 for some f < 0  <=>  A in the interior of B (with t = -1/f: t Q_A - Q_B > 0).
///  (3) E(f) < 0 for some f < 0  <=>  B in the interior of A.
///  (4) no definite member, but one that is zero: equal; one that is semidefinite and not zero:
///      they touch: from outside (f > 0), A inside B (f < 0, E >= 0), B inside A (f < 0, E <= 0).
///  (5) none of these: overlap.
///      (1) to (5): the S-lemma for two quadratic forms, strict and not, with f homogenised; the
///      limits E -> Q_A, E -> Q_B are indefinite, so only finite f != 0 counts.
///  (6) The inertia is constant between neighbouring real roots of p(f) = det E(f), so one rational
///      f in each gap finds every definite member; outside all roots it is that of -Q_B or Q_B.
///  (7) A semidefinite E(f0), when no member is definite, has f0 as a multiple root: if f0 were
///      simple its kernel would be a line x with x'Q_B x != 0, and E definite on one side of f0.
///  (8) A multiple root f0 of p is rational, and E(f0) is tested as it is, or p = c m(f)^2 with m
///      quadratic and irreducible over the rationals. Then both roots have the same corank
///      (Galois); E(f) has 3 negative squares before and 1 after both and corank 1 changes none at
///      a double root, so the corank is 2 at both; the pencil is diagonal there and the kernel of
///      the root where nothing changes has one rising and one falling eigenvalue, which leaves at
///      it one negative less and one positive less than beside it: E(f0) is semidefinite there (>=
///      0 if it is the later root, <= 0 if the earlier one) and indefinite at the other root.
///  (9) Of concentric bodies x'S_A x < L_A and x'S_B x < L_B about their centre, A is in the
///      interior of B if and only if D = L_B S_A - L_A S_B > 0, B in that of A if D < 0, and they
///      are equal if D = 0; if D is semidefinite the boundaries meet along its kernel, as in (4);
///      if it is indefinite each is beyond the other somewhere. No member is sought.
///
/// Generic pairs are settled sooner by a witness that is guessed in floating point
/// (witness_guess.hpp) and verified exactly: a definite member for (1) to (3); for overlap one
/// point inside both and, each way, a point of one body outside the other. A guess that fails
/// proves nothing and costs only time.
///
/// Identities, of every function here: swapping the bodies swaps a_in_b and b_in_a, and which body
/// is inside, and changes nothing else; so does a common exact motion or change of units change
/// nothing.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

enum class Relation {
  separate,        ///< no common point
  external_touch,  ///< common points, disjoint interiors
  overlap,         ///< every other pair, whether or not the surfaces also touch somewhere
  internal_touch,  ///< one inside the other, not equal, boundaries meeting
  a_in_b,          ///< A inside the interior of B
  b_in_a,
  equal
};

/// The name in the file formats, which is the enumerator's.
constexpr std::string_view name(Relation relation) {
  constexpr std::array<std::string_view, 7> kNames{
      "separate", "external_touch", "overlap", "internal_touch", "a_in_b", "b_in_a", "equal"};
  return kNames.at(static_cast<std::size_t>(relation));
}

enum class Inner { none, a, b };

/// `inner` says which body is inside for internal_touch and is none otherwise.
struct ExactRelation {
  Relation relation;
  Inner inner = Inner::none;
  friend bool operator==(const ExactRelation&, const ExactRelation&) = default;
};

/// Throws std::invalid_argument unless both are ellipsoids: finite, semi-axes > 0, orientation !=
/// 0.
ExactRelation exact_relation(const RawEllipsoid& a, const RawEllipsoid& b);

/// The interiors meet: the relation is neither separate nor external_touch. Throws as above.
bool exact_overlaps(const RawEllipsoid& a, const RawEllipsoid& b);

/// The same answer by (6) to (8) alone, without (9) and guessed witnesses: slower, and there so
/// that the two ways can be held against each other.
ExactRelation exact_relation_by_pencil(const RawEllipsoid& a, const RawEllipsoid& b);

/// The same for two surfaces given by coefficients, either sign of each. Throws
/// std::invalid_argument unless both are real ellipsoids.
ExactRelation exact_relation_by_pencil(const RawQuadric& a, const RawQuadric& b);

}  // namespace tangency::inline v0::verify
