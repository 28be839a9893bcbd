// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include <tangency/geometry/bodies/surface_projection.hpp>
#include <tangency/geometry/gap/error_bounds.hpp>
#include <tangency/geometry/gap/point_bound.hpp>
#include <tangency/geometry/gap/proof.hpp>
#include <tangency/geometry/gap/search.hpp>
#include <tangency/geometry/gap/sign.hpp>
#include <tangency/geometry/normals/factored.hpp>
#include <tangency/geometry/normals/newton.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0 {
namespace {

using detail::FactoredPair;
using detail::GapProof;
using detail::kOrdinaryError;
using detail::NearlyStationary;
using detail::Pair;
using detail::Stationary;

// Patches of the sphere: chosen, a hundred times what pairs of aspect 5 need.
constexpr int kBudget = 20000;
constexpr int kLastSteps = 2;  // measured: a second one is that of one pair in five to thirty

struct Solved {
  GapProof proof;
  GapTier tier;
};

/// What the exact relation tells of the bodies as the caller gave them.
struct Exact {
  const detail::AskedPair<Ellipsoid>& asked;

  Relation relation() const {
    const auto& [a, b, separation] = asked;
    return (separation != nullptr ? tangency::relation(a, b, *separation)
                                  : tangency::relation(a, b))
        .relation;
  }
  /// Sets the tier to `exact` where that is what it took.
  bool overlaps(GapTier& tier) const {
    const auto& [a, b, separation] = asked;
    const OverlapAnswer answer =
        separation != nullptr ? overlap_answer(a, b, *separation) : overlap_answer(a, b);
    if (answer.tier == Tier::exact) tier = GapTier::exact;
    return answer.overlaps;
  }
};

/// Two spheres: n along d; A's first body axis where the centres coincide.
Solved solve_spheres(const Pair& pair) {
  const double ra = pair.a.semi_axes()[0], rb = pair.b.semi_axes()[0];
  // Divided first: squares of a tiny d would be nothing.
  const double largest = pair.d.cwiseAbs().maxCoeff();
  const Vec3 n =
      largest == 0.0 ? Vec3(pair.a.rotation().col(0)) : Vec3((pair.d / largest).normalized());
  const double distance = pair.d.stableNorm(), gap = (distance - ra) - rb;
  // |d| errs by 7 u of itself (6 of the norm, one of d), the differences by at most u each, and
  // so do gap - error and gap + error.
  const double error = kUnitRoundoff * (10.01 * distance + 3.01 * (ra + rb));
  return {{gap, gap - error, gap + error, true, n, ra * n, -rb * n}, GapTier::fast};
}

/// A sphere and another body: the sphere's centre projected on the body's surface, which is global
/// at every depth (primitives.hpp, identity (2)).
Solved solve_with_sphere(const Pair& pair) {
  const bool sphere_is_a = pair.a.is_sphere();
  const Ellipsoid &body = sphere_is_a ? pair.b : pair.a, &sphere = sphere_is_a ? pair.a : pair.b;
  const double radius = sphere.largest_semi_axis();
  detail::DoubleDoubleVector separation;  // of the sphere's centre from the body's
  for (int i = 0; i < 3; ++i) {
    const detail::DoubleDouble d(pair.d[i], pair.d_low[i]);
    separation[static_cast<std::size_t>(i)] = sphere_is_a ? -d : d;
  }
  const detail::SeenFromCentre seen = detail::seen_from_centre(body, separation);
  const detail::ClosestOnSurface found = detail::closest_on_surface(body, seen);
  const detail::DoubleDouble distance = scaled_by_power(found.distance, seen.exponent);
  const double gap = (distance - detail::DoubleDouble(radius)).high;
  const double error = 2.0 * kUnitRoundoff * std::abs(gap) + 0x1p-80 * pair.size;
  const Vec3 n = sphere_is_a ? Vec3(-found.normal) : found.normal;
  const Vec3 arm_a = sphere_is_a ? Vec3(radius * n) : found.arm;
  const Vec3 arm_b = sphere_is_a ? found.arm : Vec3(-radius * n);
  return {{gap, gap - error, gap + error, true, n, arm_a, arm_b}, GapTier::factored};
}

/// Proven to be the maximum but for rounding, which leaves no doubt about the sign?
bool settled(const Pair& pair, const GapProof& proof) {
  if (!proof.global || !(proof.low > 0.0 || proof.high < 0.0)) return false;
  const double unit = kUnitRoundoff * pair.size, above = proof.high - proof.gap;
  return above <= kOrdinaryError * pair.size && above - (proof.gap - proof.low) <= unit;
}

std::optional<Solved> search(const Pair& pair, const FactoredPair& factored, const Vec3& first) {
  if (const auto proof = detail::search_meridian(pair, factored))
    return Solved{*proof, GapTier::search};
  if (const auto proof = detail::search_sphere(pair, factored, first, kBudget))
    return Solved{*proof, GapTier::search};
  return std::nullopt;
}

bool has_sphere(const Pair& pair) { return pair.a.is_sphere() || pair.b.is_sphere(); }

/// In double-double at the maximum that an ascent found.
GapProof prove_precisely(const Pair& pair, const Vec3& normal) {
  GapProof proof = detail::prove_gap_in_double_double(pair, normal);
  if (proof.global && proof.high - proof.low > kOrdinaryError * pair.size)
    detail::bound_by_points(pair, kOrdinaryError * pair.size, proof);
  return proof;
}

/// Does the value of a branch come so near to an upper bound of all that it is the global one?
bool reaches(const Pair& pair, const GapProof& proof, double high) {
  return high - proof.low <= kOrdinaryError * pair.size;
}

/// The ascents of the search, which keep its order of ties, bounded by the projection in place of
/// the branch and bound.
Solved search_with_sphere(const Pair& pair, const FactoredPair& factored, const Vec3& first) {
  const Solved projected = solve_with_sphere(pair);
  const double high = projected.proof.high;
  std::optional<GapProof> found = detail::search_sphere(pair, factored, first, 0);
  // Where rounding the normal to doubles costs more than that, the distance is the better answer.
  if (!found || !(found->low >= projected.proof.low)) return projected;
  found->high = found->global ? std::min(found->high, high) : high;
  found->gap = std::min(found->gap, found->high);
  found->global = true;
  return {*found, GapTier::factored};
}

/// What is not settled in double.
Solved solve_hard(const Pair& pair) {
  const FactoredPair factored(pair.a, pair.b, pair.d);
  const bool concentric = pair.d == Vec3::Zero();
  const Vec3 start = concentric ? factored.axis(0) : factored.perram_wertheim_normal();
  const Stationary found = factored.climb(start);
  const Vec3 normal = found.normal.allFinite() ? found.normal : start;
  const GapProof proof = prove_precisely(pair, normal);
  const double enough = kOrdinaryError * pair.size;
  if (proof.global && proof.high - proof.low <= enough) return {proof, GapTier::factored};
  // Deep, or so flat a maximum that the curvature at it bounds little.
  if (has_sphere(pair)) return search_with_sphere(pair, factored, start);
  const std::optional<Solved> searched = search(pair, factored, start);
  if (!searched) return {proof, GapTier::factored};
  const GapProof& other = searched->proof;
  const bool narrower = other.high - other.low < proof.high - proof.low;
  const bool further = other.low >= proof.low;
  if (other.global ? !proof.global || narrower : further) return *searched;
  return {proof, GapTier::factored};
}

/// Newton's method from a unit normal: what its last step proves and, if that is not enough, on to
/// where no step gains. False where it does not settle the pair; `normal` is where it stopped.
/// Inlined: a call costs the fast path 1 %, measured in instructions.
[[gnu::always_inline]] inline bool settles(const Pair& pair, const Vec3& start, GapProof& proof,
                                           Vec3& normal) {
  NearlyStationary near = detail::newton_near(pair.a, pair.b, pair.d, start);
  normal = near.normal;
  if (!near.accepted) return false;
  for (int step = 0; step < kLastSteps; ++step) {
    if (detail::prove_gap_and_step(pair, near, proof) && settled(pair, proof)) return true;
    normal = near.normal = proof.normal;
  }
  const Stationary late = detail::newton_from(pair.a, pair.b, pair.d, normal);
  normal = late.normal;
  if (!late.accepted) return false;
  detail::prove_gap(pair, normal, proof);
  return settled(pair, proof);
}

Solved solve(const Pair& pair) {
  if (pair.a.is_sphere() && pair.b.is_sphere()) return solve_spheres(pair);
  const double reach = pair.d.cwiseAbs().maxCoeff();
  if (!pair.a.moderate() || !pair.b.moderate() || reach < detail::kSmallestModerate) {
    return solve_hard(pair);
  }
  Solved solved;
  Vec3 normal;
  solved.tier = GapTier::fast;
  const Vec3 start = detail::newton_start(pair.a, pair.b, pair.d);
  if (settles(pair, start, solved.proof, normal)) return solved;
  if (!normal.allFinite()) return solve_hard(pair);
  const Stationary found = FactoredPair(pair.a, pair.b, pair.d).climb(normal);
  if (!found.accepted) return solve_hard(pair);
  detail::prove_gap(pair, found.normal, solved.proof);
  if (!settled(pair, solved.proof)) return solve_hard(pair);
  solved.tier = GapTier::safeguarded;
  return solved;
}

/// The branch that the ascent from `start` leads to.
Solved follow(const Pair& pair, const Vec3& start) {
  if (pair.a.is_sphere() && pair.b.is_sphere()) return solve_spheres(pair);
  Solved solved;
  Vec3 normal;
  if (pair.a.moderate() && pair.b.moderate()) {
    solved.tier = GapTier::fast;
    if (settles(pair, start, solved.proof, normal)) return solved;
  }
  const Stationary found = FactoredPair(pair.a, pair.b, pair.d).climb(start);
  if (!found.accepted) return solve(pair);
  GapProof proof = prove_precisely(pair, found.normal);
  if (!proof.global && has_sphere(pair)) {
    const double high = solve_with_sphere(pair).proof.high;
    proof.global = reaches(pair, proof, high);
    if (proof.global) proof.high = high;
  }
  // Flat bodies apart have false maxima with gap < 0: no branch that a contact can be on.
  solved.tier = GapTier::factored;
  if (!proof.global && proof.low < 0.0 && !Exact{pair.asked}.overlaps(solved.tier)) {
    Solved global = solve(pair);
    global.tier = std::max(global.tier, solved.tier);
    return global;
  }
  solved.proof = proof;
  return solved;
}

Gap finished(Solved&& solved, const Pair& pair) {
  // sqrt(3) times the largest component, and more than enough for rounding: |d| and above.
  const double distance = 1.75 * pair.d.cwiseAbs().maxCoeff();
  return detail::finished_gap<Gap>(solved, Exact{pair.asked}, pair, distance);
}

/// What the exact relation tells of bodies given by matrices.
struct ExactMatrices {
  const MatrixEllipsoid& a;
  const MatrixEllipsoid& b;
  const Vec3* separation = nullptr;  ///< in place of the centres, if it is given

  RelationAnswer answer() const {
    return separation != nullptr ? tangency::relation(a, b, *separation) : tangency::relation(a, b);
  }
  Relation relation() const { return answer().relation; }
  bool overlaps(GapTier& tier) const {
    const RelationAnswer answer = this->answer();
    if (answer.tier == Tier::exact) tier = GapTier::exact;
    return answer.relation != Relation::separate && answer.relation != Relation::external_touch;
  }
};

/// @param gap  that of the bodies by semi-axes, whose centres are d apart
Gap of_matrices(const Gap& gap, const ExactMatrices& exact, const Vec3& d) {
  const double off = exact.a.rounding() + exact.b.rounding();
  if (off == 0.0 || !std::isfinite(gap.gap)) return gap;
  return in_default_environment(
      [&] { return detail::widened(gap, off, exact, 2.0 * d.cwiseAbs().maxCoeff() + off); });
}

/// Is the pair that is solved the one that was asked about? Scaling changes a d that underflows and
/// the thinnest axes.
bool as_asked(const Pair& pair) {
  if (pair.in_own_unit()) return true;
  const auto& [a, b, separation] = pair.asked;
  const double thinnest = std::min(a.smallest_semi_axis(), b.smallest_semi_axis());
  return pair.d.cwiseAbs().maxCoeff() > 0x1p-900 &&
         std::scalbn(thinnest, -pair.exponent) >= detail::kThinnestAxis;
}

ContactBounds bounds(const Pair& pair, const Gap& gap) {
  const auto& [a, b, separation] = pair.asked;
  const ContactBounds nothing{2.0, 2.0 * a.largest_semi_axis(), 2.0 * b.largest_semi_axis()};
  if (gap.status != GapStatus::ok || !as_asked(pair) || pair.d == Vec3::Zero()) return nothing;
  detail::ContactShift shift{0.0, 0.0, 0.0};
  if (!a.is_sphere() || !b.is_sphere()) shift = detail::bound_shift(pair, gap.normal);
  // (P) of the derivation: the stored numbers' own rounding beside the shift.
  const auto bound = [&](double shifted, const Ellipsoid& body) {
    const double axis = body.largest_semi_axis(), h = body.support(gap.normal);
    const double rounding = kUnitRoundoff * (10.0 * axis * (axis / h) + 17.0 * axis) +
                            8.0 * std::numeric_limits<double>::denorm_min();
    return std::min(2.0 * axis, std::scalbn(shifted, pair.exponent) + rounding);
  };
  return {std::min(2.0, shift.turn + 8.0 * kUnitRoundoff), bound(shift.shift_a, a),
          bound(shift.shift_b, b)};
}

}  // namespace

Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept {
  contract::require_finite("signed_gap", "separation", separation);
  return in_default_environment([&] {
    const Pair pair({a, b, &separation});
    return finished(solve(pair), pair);
  });
}

Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] {
    const Pair pair({a, b});
    return finished(solve(pair), pair);
  });
}

Gap signed_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b) noexcept {
  const Gap gap = signed_gap(a.ellipsoid(), b.ellipsoid());
  return of_matrices(gap, {a, b}, b.ellipsoid().centre() - a.ellipsoid().centre());
}

Gap signed_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b,
               const Vec3& separation) noexcept {
  const Gap gap = signed_gap(a.ellipsoid(), b.ellipsoid(), separation);
  return of_matrices(gap, {a, b, &separation}, separation);
}

Gap follow_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
               const Vec3& previous_normal) noexcept {
  contract::require_finite("follow_gap", "separation", separation);
  return in_default_environment([&] {
    assert(previous_normal != Vec3::Zero());
    const Pair pair({a, b, &separation});
    return finished(follow(pair, detail::renormalised(previous_normal)), pair);
  });
}

ContactBounds contact_bounds(const Ellipsoid& a, const Ellipsoid& b, const Gap& gap) noexcept {
  return in_default_environment([&] { return bounds(Pair({a, b}), gap); });
}

ContactBounds contact_bounds(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
                             const Gap& gap) noexcept {
  contract::require_finite("contact_bounds", "separation", separation);
  return in_default_environment([&] { return bounds(Pair({a, b, &separation}), gap); });
}

}  // namespace tangency::inline v0
