// SPDX-License-Identifier: MIT
/// @file
/// What clearances in space and in the plane have in common: f = n.d - h_A + h_B with the outer
/// body for A, the inner one for B, whose greatest value is minus the clearance. From the exact
/// relation to the sign, from the margin to a bound, and to the answer:
/// docs/derivations/containment.md.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/numbers/real_roots.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/relation/exact_margin.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0::detail {

/// Of B in A, as settle_sign() asks: f < 0 where B is in the interior of A, 0 where it touches A's
/// boundary from within.
struct Nesting {
  Relation of_pair;  ///< of (A, B)
  Inner inner;
  Tier tier;

  bool inside() const { return of_pair == Relation::b_in_a; }
  bool touching() const {
    return of_pair == Relation::equal || (of_pair == Relation::internal_touch && inner == Inner::b);
  }
  /// Of the margin from 1.
  int side() const { return inside() ? 1 : touching() ? 0 : -1; }

  bool overlaps(GapTier& solved) const {
    if (tier == Tier::exact) solved = GapTier::exact;
    return inside();
  }
  Relation relation() const { return touching() ? Relation::external_touch : Relation::separate; }
};

template <class Answer>
Nesting nesting(const Answer& of_pair) {
  return {of_pair.relation, of_pair.inner, of_pair.tier};
}

/// Where the enclosure leaves open on which side of 1 the margin is, the exact relation tells.
/// @param related  () gives the relation of (outer, inner), with its tier
template <class Result, class Related>
Result as_margin(const exact::MarginEnclosure& margin, const Related& related) {
  const int side = margin.leaves_one_open() ? nesting(related()).side() : margin.low > 1 ? 1 : -1;
  const exact::RoundedMargin rounded = exact::rounded(margin, side);
  return {rounded.value, rounded.error};
}

/// By identity (3) of containment.hpp an upper bound of f, from the margin of B in A.
/// @param pair      in the unit of f
/// @param distance  |d| or more, in that unit
template <class Pair>
double bound_by_margin(const exact::MarginEnclosure& margin, const Pair& pair, double distance) {
  // Axes below kThinnestAxis of the size were raised to it; the margin is of those that were asked
  // for.
  constexpr double kRaised = 0x1p-230, kNone = 0x1p-900;
  const double largest = pair.b.largest_semi_axis();
  const double smallest = std::scalbn(pair.asked.b.smallest_semi_axis(), -pair.exponent);
  if (margin.high == 0) return (distance + largest) * (1.0 + 0x1p-50);
  const double beyond = exact::double_below(mpq_class(margin.low - 1));
  const double axis = beyond <= 0.0 ? largest : smallest > kNone ? smallest : 0.0;
  const double bound = -beyond * axis;
  return bound + (std::abs(bound) * 0x1p-50 + kRaised);
}

/// `proof`, of which little or nothing is proven beyond its normal, bounded by the margin.
template <class Proof, class Pair>
void bound_all_normals(Proof& proof, const exact::MarginEnclosure& margin, const Pair& pair,
                       double distance) {
  const double high = proof.global ? proof.high : std::numeric_limits<double>::infinity();
  proof.high = std::max(std::min(bound_by_margin(margin, pair, distance), high), proof.low);
  proof.gap = std::min(proof.gap, proof.high);
  proof.global = true;
}

/// @param gap    f of B in A, as finished_gap() has it
/// @param arm_b  of the inner body, at gap.normal
template <class Result, class AnyGap, class Vector>
Result as_clearance(const AnyGap& gap, const Vector& arm_b) {
  // Not minus zero.
  return {0.0 - gap.gap, gap.normal, arm_b, gap.arm_a, gap.gap_error, gap.status, gap.tier};
}

}  // namespace tangency::inline v0::detail
