// SPDX-License-Identifier: MIT
#include <tangency/geometry/ellipse_containment.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/gap/nesting.hpp>
#include <tangency/geometry/gap/sign.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/plane/plane_gap.hpp>

namespace tangency::inline v0 {
namespace {

using detail::AskedPair;
using detail::Nesting;
using detail::PlanePair;
using detail::PlaneProof;
using detail::Sought;
using exact::RationalSolid;

struct Solved {
  PlaneProof proof;
  GapTier tier;
};

/// M = (a1^2 u u' + a2^2 v v') / |u|^2
RationalSolid<2> rational_solid(const Ellipse& e) {
  using exact::to_rational;
  const mpq_class x = to_rational(e.direction()[0]), y = to_rational(e.direction()[1]);
  const mpq_class a = to_rational(e.semi_axes()[0]), b = to_rational(e.semi_axes()[1]);
  const mpq_class square = x * x + y * y, aa = a * a / square, bb = b * b / square;
  const mpq_class mixed = (aa - bb) * x * y;
  RationalSolid<2> solid;
  solid.centre = {to_rational(e.centre()[0]), to_rational(e.centre()[1])};
  solid.shape[0] = {aa * x * x + bb * y * y, mixed};
  solid.shape[1] = {mixed, aa * y * y + bb * x * x};
  return solid;
}

RationalSolid<2> solid_of(const MatrixEllipse& body) {
  return body.exact() != nullptr ? *body.exact() : rational_solid(body.ellipse());
}

exact::MarginEnclosure margin_of(const AskedPair<Ellipse>& asked) {
  const auto [outer, inner] = asked.placed();
  return exact::margin(rational_solid(inner), rational_solid(outer));
}

/// |d| and above.
double distance_of(const PlanePair& pair) { return 1.5 * pair.d.cwiseAbs().maxCoeff(); }

Solved solve(const PlanePair& pair) {
  const Vec2 nowhere(std::numeric_limits<double>::quiet_NaN(), 0.0);
  const Vec2 start = pair.d == Vec2::Zero() ? nowhere : Vec2(pair.d.stableNormalized());
  Solved solved{detail::search_plane_gap(pair, start), GapTier::search};
  const double widest = detail::kWidestOk * kUnitRoundoff * pair.size;
  if (!solved.proof.global || solved.proof.high - solved.proof.low > widest) {
    detail::bound_all_normals(solved.proof, margin_of(pair.asked), pair, distance_of(pair));
  }
  return solved;
}

PlaneGap of_equal(const Ellipse& a) {
  const Vec2 n = a.axis(), arm = a.support_point(n);
  return {0.0, n, arm, arm, 0.0, GapStatus::ok, GapTier::exact};
}

/// f of B in A, of arms that are those of as_clearance().
PlaneGap found_gap(const AskedPair<Ellipse>& asked) {
  const auto [outer, inner] = asked.placed();
  const Nesting exact = detail::nesting(relation(outer, inner));
  if (exact.of_pair == Relation::equal) return of_equal(asked.a);
  const PlanePair pair(asked, Sought::clearance);
  Solved solved = solve(pair);
  const double most = distance_of(pair) + (1.0 + 0x1p-50) * pair.b.largest_semi_axis();
  PlaneGap gap = detail::finished_gap<PlaneGap>(solved, exact, pair, most);
  if (!pair.in_own_unit()) gap.arm_b = asked.b.support_point(gap.normal);
  return gap;
}

PlaneClearance found(const AskedPair<Ellipse>& asked) {
  const PlaneGap gap = found_gap(asked);
  return detail::as_clearance<PlaneClearance>(gap, gap.arm_b);
}

}  // namespace

PlaneClearance clearance(const Ellipse& inner, const Ellipse& outer) noexcept {
  return in_default_environment([&] { return found({outer, inner}); });
}

PlaneClearance clearance(const Ellipse& inner, const Ellipse& outer,
                         const Vec2& separation) noexcept {
  contract::require_finite("clearance", "separation", {separation[0], separation[1], 0.0});
  return in_default_environment([&] {
    const Vec2 d = -separation;
    return found({outer, inner, &d});
  });
}

PlaneClearance clearance(const MatrixEllipse& inner, const MatrixEllipse& outer) noexcept {
  return in_default_environment([&] {
    PlaneGap gap = found_gap({outer.ellipse(), inner.ellipse()});
    const double off = inner.rounding() + outer.rounding();
    if (off != 0.0 && std::isfinite(gap.gap)) {
      const Ellipse &a = outer.ellipse(), &b = inner.ellipse();
      const double most =
          2.0 * ((b.centre() - a.centre()).cwiseAbs().maxCoeff() + b.largest_semi_axis());
      // Of a clearance both bounds are proven, whatever the status.
      gap = detail::widened(gap, off, detail::nesting(relation(outer, inner)), most + off, true);
    }
    return detail::as_clearance<PlaneClearance>(gap, gap.arm_b);
  });
}

ContainmentMargin containment_margin(const Ellipse& inner, const Ellipse& outer) noexcept {
  return in_default_environment([&] {
    return detail::as_margin<ContainmentMargin>(margin_of({outer, inner}),
                                                [&] { return relation(outer, inner); });
  });
}

ContainmentMargin containment_margin(const Ellipse& inner, const Ellipse& outer,
                                     const Vec2& separation) noexcept {
  contract::require_finite("containment_margin", "separation", {separation[0], separation[1], 0.0});
  return containment_margin(inner.moved_to(Vec2::Zero()), outer.moved_to(separation));
}

ContainmentMargin containment_margin(const MatrixEllipse& inner,
                                     const MatrixEllipse& outer) noexcept {
  return in_default_environment([&] {
    return detail::as_margin<ContainmentMargin>(exact::margin(solid_of(inner), solid_of(outer)),
                                                [&] { return relation(outer, inner); });
  });
}

}  // namespace tangency::inline v0
