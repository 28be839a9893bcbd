// SPDX-License-Identifier: MIT
/// @file
/// From a proof to an answer, in space and in the plane alike: the exact sign, the error, the
/// caller's unit.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0::detail {

/// u L; chosen: what is proven no better is not called ok.
inline constexpr double kWidestOk = 100.0;

/// Where the proof leaves the sign open, the exact relation decides. No gap is above |d|.
/// @param exact     tells overlaps(tier), which raises the tier where it has to, and relation()
/// @param distance  |d| or more
template <class Proof, class Exact>
void settle_sign(Proof& proof, GapTier& tier, const Exact& exact, double distance) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  if (proof.low > 0.0 || (proof.global && proof.high < 0.0)) return;
  if (proof.high >= 0.0) tier = GapTier::exact;
  if (exact.overlaps(tier)) {
    proof.high = std::min(proof.high, 0.0);
    proof.low = std::min(proof.low, -kLeast);
    if (proof.gap >= 0.0) proof.gap = std::min(0.5 * proof.low, -kLeast);
  } else if (exact.relation() == Relation::external_touch) {
    // Of a branch that is not known to be the global one the value 0 is not, nor that its normal
    // is that of the touch: it stays `local`, and the error tells how far below 0 it is.
    proof.low = proof.global ? 0.0 : std::min(proof.low, 0.0);
    proof.gap = proof.high = 0.0;
  } else {
    // What is known of a branch below 0 says nothing about bodies that are apart.
    if (!proof.global) proof.high = distance;
    proof.high = std::max(proof.high, kLeast);
    // f(n) <= 0 is nearer to the truth than `high`, which the curvature may bound loosely.
    if (proof.gap <= 0.0) proof.gap = std::max(0.5 * std::min(proof.high, -proof.low), kLeast);
    proof.low = 0.0;
  }
}

/// The gap of bodies that are off by `off` altogether, with the sign of the true ones' relation: a
/// gap changes no faster than support functions do.
/// @param exact, distance  of the true bodies, as for settle_sign()
/// @param global           is gap + gap_error, too, proven of the gap, not of a branch alone?
template <class AnyGap, class Exact>
AnyGap widened(AnyGap gap, double off, const Exact& exact, double distance, bool global) {
  struct {
    double gap, low, high;
    bool global;
  } proof{};
  if (off == 0.0 && std::abs(gap.gap) > gap.gap_error) return gap;  // whose sign is proven
  // What gap - error and gap + error round, with it.
  const double rounding = 2.0 * kUnitRoundoff * std::abs(gap.gap);
  const double error = (gap.gap_error + off + rounding) * (1.0 + 0x1p-50);
  proof = {gap.gap, gap.gap - error, gap.gap + error, global};
  settle_sign(proof, gap.tier, exact, distance);
  gap.gap = proof.gap;
  gap.gap_error = std::max(proof.high - proof.gap, proof.gap - proof.low) * (1.0 + 0x1p-50);
  return gap;
}

/// The same of a gap, of which `local` bounds a branch alone.
template <class AnyGap, class Exact>
AnyGap widened(const AnyGap& gap, double off, const Exact& exact, double distance) {
  return widened(gap, off, exact, distance, gap.status == GapStatus::ok);
}

/// value 2^exponent; the sign is that of the number before it was scaled, whatever underflows.
inline double scaled_gap(double value, int exponent) {
  if (exponent == 0) return value;
  const double result = std::scalbn(value, exponent);
  if (result != 0.0 || value == 0.0) return result;
  return std::copysign(std::numeric_limits<double>::denorm_min(), value);
}

/// @param solved    a proof and its tier
/// @param exact     as for settle_sign()
/// @param pair      a UnitPair with its `size`: what was solved
/// @param distance  |d| or more
template <class AnyGap, class Solved, class Exact, class Pair>
AnyGap finished_gap(Solved& solved, const Exact& exact, const Pair& pair, double distance) {
  auto& proof = solved.proof;
  proof.high = std::min(proof.high, distance);
  settle_sign(proof, solved.tier, exact, distance);
  const double error = std::max(proof.high - proof.gap, proof.gap - proof.low) * (1.0 + 0x1p-50);
  const bool narrow = error <= kWidestOk * kUnitRoundoff * pair.size;
  const GapStatus status = proof.global && narrow ? GapStatus::ok : GapStatus::local;
  if (pair.in_own_unit())
    return {proof.gap, proof.normal, proof.arm_a, proof.arm_b, error, status, solved.tier};
  // In the caller's unit both numbers may be subnormal, and so rounded.
  constexpr double kSubnormal = 4.0 * std::numeric_limits<double>::denorm_min();
  return {scaled_gap(proof.gap, pair.exponent),
          proof.normal,
          pair.asked.a.support_point(proof.normal),
          -pair.asked.b.support_point(proof.normal),
          error == 0.0 ? 0.0 : std::scalbn(error, pair.exponent) + kSubnormal,
          status,
          solved.tier};
}

}  // namespace tangency::inline v0::detail
