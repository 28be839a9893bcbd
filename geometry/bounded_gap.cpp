// SPDX-License-Identifier: MIT
#include <tangency/geometry/bounded_gap.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tangency/geometry/gap/error_bounds.hpp>
#include <tangency/geometry/gap/inner_ellipsoid.hpp>
#include <tangency/geometry/gap/proof.hpp>
#include <tangency/geometry/gap/sign.hpp>
#include <tangency/geometry/normals/perram_wertheim.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0 {
namespace {

using detail::GapProof;
using detail::InnerEllipsoid;
using detail::Pair;

/// (N) of docs/derivations/bounded-gap.md, of the size: of a value at any normal.
constexpr double kValueError = 32 * kUnitRoundoff;
constexpr int kClimbSteps = 6;      // chosen: 3 to 5 are common
constexpr double kLongest = 0.5;    // rad of a step; chosen
constexpr double kShort = 0x1p-28;  // of |step|^2; chosen: the next would be below rounding
constexpr double kUpwards = 0.5;    // of |f|; chosen

/// The best normal so far, and what bounds the gap from above.
struct Found {
  GapProof best;  ///< its `low` by (N), its `high` of all normals
  bool any = false;

  /// The value at a normal, and where it leaves the gap.
  void look(const Pair& pair, const Vec3& normal) {
    GapProof at;
    detail::prove_gap(pair, normal, at);
    at.low = at.gap - kValueError * pair.size;
    const double high = any ? std::min(best.high, at.high) : at.high;
    if (!any || at.gap > best.gap) best = at;
    best.high = high;
    any = true;
  }
};

/// Is what is known enough for `ok`?
bool narrow(const Pair& pair, const GapProof& proof) {
  const double most = detail::kWidestOk * kUnitRoundoff * pair.size;
  return std::max(proof.high - proof.gap, proof.gap - proof.low) * (1.0 + 0x1p-50) <= most;
}

/// A normal to begin with: that of the Perram-Wertheim function, nearly, or along d.
Vec3 first_normal(const Pair& pair) {
  const double reach = pair.d.cwiseAbs().maxCoeff();
  if (!(reach > 0.0)) return pair.a.rotation().col(0);
  if (pair.a.moderate() && pair.b.moderate() && reach >= detail::kSmallestModerate) {
    const detail::PerramWertheimForm form(pair.a, pair.b, pair.d);
    const Vec3 along = form.normal_direction(form.maximise(detail::kPerramWertheimSteps));
    // Of flat and long bodies its square, or all of it, may underflow.
    if (along.allFinite() && !along.isZero(0.0))
      return scaled_by_power(along, -exponent_of(along)).normalized();
  }
  return (pair.d / reach).normalized();
}

/// f, for choosing where to begin.
double rough_value(const Pair& pair, const Vec3& n) {
  return n.dot(pair.d) - std::sqrt(std::max(pair.a.shape().form(n), 0.0)) -
         std::sqrt(std::max(pair.b.shape().form(n), 0.0));
}

/// Of that normal and the body axes, each pointing with d, the one of the greatest value: out of a
/// flat body the shortest way is mostly along its least axis.
Vec3 best_start(const Pair& pair, const Vec3& normal) {
  Vec3 best = normal;
  double most = rough_value(pair, normal);
  for (const Ellipsoid* body : {&pair.a, &pair.b}) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis = body->rotation().col(k);
      const Vec3 n = axis.dot(pair.d) < 0.0 ? Vec3(-axis) : axis;
      const double value = rough_value(pair, n);
      if (value > most) best = n, most = value;
    }
  }
  return best;
}

/// Newton's method for f on the sphere, so many steps at most. Where it ends is judged by its
/// value.
Vec3 climbed(const Pair& pair, Vec3 n) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  const Symmetric3 &ma = pair.a.shape(), &mb = pair.b.shape();
  for (int i = 0; i < kClimbSteps; ++i) {
    const Vec3 man = ma * n, mbn = mb * n;
    const double wa = 1.0 / std::sqrt(std::max(n.dot(man), kLeast));
    const double wb = 1.0 / std::sqrt(std::max(n.dot(mbn), kLeast));
    const Vec3 xa = wa * man, xb = wb * mbn, rest = pair.d - xa - xb;
    const double f = n.dot(rest);
    const Vec3 r = rest - f * n;
    // H = Hess (h_A + h_B) = (M - x x') / h of both; H n = 0. With K = H + f (I - n n') + L n n'
    // the step is K^-1 r, as r is normal to n.
    const Symmetric3 h = ma * wa + mb * wb + square(xa) * -wa + square(xb) * -wb;
    const auto step = [&](double bend, bool& definite) -> Vec3 {
      Symmetric3 k = h + square(n) * (pair.size - bend);
      k.xx += bend, k.yy += bend, k.zz += bend;
      const Symmetric3 adj = adjugate(k);
      const double determinant = k.xx * adj.xx + k.xy * adj.xy + k.zx * adj.zx;
      definite = determinant > 0.0 && k.trace() > pair.size;
      return (adj * r) * (1.0 / determinant);
    };
    bool definite = false;
    Vec3 move = step(f, definite);
    // Where f is not concave: a step that leads up, since H + |f| is positive definite.
    if (!definite) move = step(kUpwards * std::abs(f), definite);
    double length2 = move.squaredNorm();
    if (!(length2 < kLongest * kLongest)) {
      move *= kLongest / std::sqrt(length2);
      length2 = kLongest * kLongest;
    }
    n = (n + move) * (1.0 / std::sqrt(1.0 + length2));
    if (length2 <= kShort) break;
  }
  return n.normalized();
}

/// The inner ellipsoid that touches A + B at the best normal: does it prove that to be the best of
/// all? If not, its own best normal is where to look next.
Vec3 enclose(const Pair& pair, Found& found) {
  const InnerEllipsoid inner(pair, found.best.normal);
  const InnerEllipsoid::Bound here = inner.at(inner.multiplier(-found.best.gap));
  found.best.high = std::min(found.best.high, here.high);
  if (narrow(pair, found.best)) return found.best.normal;
  const InnerEllipsoid::Bound there = inner.best();
  found.best.high = std::min(found.best.high, there.high);
  return there.normal.stableNormalized();
}

/// The best of two maxima at most.
void look_deep(const Pair& pair, Found& found) {
  const double first = found.best.gap;
  const Vec3 normal = enclose(pair, found);
  if (narrow(pair, found.best) || !(normal.squaredNorm() > 0.5)) return;
  const Vec3 end = climbed(pair, normal);
  if (!end.allFinite()) return;
  found.look(pair, end);
  if (found.best.gap > first) enclose(pair, found);
}

/// What needs no normal: h >= a_min, and whether the interiors meet where doubles tell.
void bound_roughly(const Pair& pair, GapProof& proof) {
  const double distance = pair.d.stableNorm();
  const double least = pair.a.smallest_semi_axis() + pair.b.smallest_semi_axis();
  proof.high = std::min(proof.high, distance - least + kValueError * pair.size);
  if (!(proof.high >= 0.0 && proof.low < 0.0)) return;
  const auto [a, b] = pair.asked.placed();
  const std::optional<bool> meet = overlaps_by_filter(a, b);
  if (!meet) return;
  if (*meet) {
    proof.high = 0.0;
    proof.gap = std::min(proof.gap, 0.0);
  } else {
    // Flat bodies apart have false maxima with a value < 0.
    proof.low = 0.0;
    proof.gap = std::max(proof.gap, 0.0);
    proof.high = std::max(proof.high, 0.0);
  }
}

BoundedGap finished(const Pair& pair, const GapProof& proof, GapTier tier) {
  const bool ok = narrow(pair, proof);
  double below = (proof.gap - proof.low) * (1.0 + 0x1p-50);
  double above = (proof.high - proof.gap) * (1.0 + 0x1p-50);
  if (ok) below = above = std::max({below, above, 0.0});
  const GapStatus status = ok ? GapStatus::ok : GapStatus::local;
  Gap gap{proof.gap, proof.normal, proof.arm_a, proof.arm_b, below, status, tier};
  if (!pair.in_own_unit()) {
    // In the caller's unit numbers may be subnormal, and so rounded.
    constexpr double kSubnormal = 4.0 * std::numeric_limits<double>::denorm_min();
    gap.gap = detail::scaled_gap(gap.gap, pair.exponent);
    gap.arm_a = pair.asked.a.support_point(gap.normal);
    gap.arm_b = -pair.asked.b.support_point(gap.normal);
    gap.gap_error = std::scalbn(below, pair.exponent) + kSubnormal;
    above = std::scalbn(above, pair.exponent) + kSubnormal;
  }
  return {gap, above};
}

BoundedGap bounded(const Pair& pair) {
  Found found;
  const Vec3 start = best_start(pair, first_normal(pair)), end = climbed(pair, start);
  found.look(pair, end.allFinite() ? end : start.normalized());
  // Hard shapes, no deeper than the ball of (B): they need more steps and no other bound.
  if (!narrow(pair, found.best) && found.best.global)
    found.look(pair, climbed(pair, found.best.normal));
  if (!narrow(pair, found.best)) {
    look_deep(pair, found);
    bound_roughly(pair, found.best);
    return finished(pair, found.best, GapTier::safeguarded);
  }
  return finished(pair, found.best, GapTier::fast);
}

/// The same of bodies whose support functions differ by as much as both are off.
BoundedGap of_matrices(BoundedGap gap, const MatrixEllipsoid& a, const MatrixEllipsoid& b) {
  return in_default_environment([&] {
    const double off = a.rounding() + b.rounding();
    if (off == 0.0) return gap;
    gap.gap_error = (gap.gap_error + off) * (1.0 + 0x1p-50);
    gap.above = (gap.above + off) * (1.0 + 0x1p-50);
    return gap;
  });
}

}  // namespace

BoundedGap bounded_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return bounded(Pair({a, b})); });
}

BoundedGap bounded_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept {
  contract::require_finite("bounded_gap", "separation", separation);
  return in_default_environment([&] { return bounded(Pair({a, b, &separation})); });
}

BoundedGap bounded_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b) noexcept {
  return of_matrices(bounded_gap(a.ellipsoid(), b.ellipsoid()), a, b);
}

BoundedGap bounded_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                       const Vec3& separation) noexcept {
  return of_matrices(bounded_gap(a.ellipsoid(), b.ellipsoid(), separation), a, b);
}

}  // namespace tangency::inline v0
