// SPDX-License-Identifier: MIT
#include <tangency/geometry/containment.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <tangency/geometry/bodies/surface_projection.hpp>
#include <tangency/geometry/bodies/wall_form.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap/nesting.hpp>
#include <tangency/geometry/gap/proof.hpp>
#include <tangency/geometry/gap/search.hpp>
#include <tangency/geometry/gap/sign.hpp>
#include <tangency/geometry/normals/factored.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0 {
namespace {

using detail::AskedPair;
using detail::FactoredPair;
using detail::GapProof;
using detail::Nesting;
using detail::Pair;
using detail::Sought;
using exact::RationalSolid;

// Patches of the sphere: chosen, some 20 ms.
constexpr int kBudget = 20000;

struct Solved {
  GapProof proof;
  GapTier tier;
};

RationalSolid<3> solid_of(const MatrixEllipsoid& body) {
  return body.exact() != nullptr ? *body.exact() : exact::rational_solid(body.ellipsoid());
}

exact::MarginEnclosure margin_of(const AskedPair<Ellipsoid>& asked) {
  const auto [outer, inner] = asked.placed();
  return exact::margin(exact::rational_solid(inner), exact::rational_solid(outer));
}

/// |d| and above.
double distance_of(const Pair& pair) { return 1.75 * pair.d.cwiseAbs().maxCoeff(); }

/// n along d; A's first body axis where the centres coincide.
Solved solve_spheres(const Pair& pair) {
  const double ra = pair.a.semi_axes()[0], rb = pair.b.semi_axes()[0];
  const double largest = pair.d.cwiseAbs().maxCoeff();
  const Vec3 n =
      largest == 0.0 ? Vec3(pair.a.rotation().col(0)) : Vec3((pair.d / largest).normalized());
  const double distance = pair.d.stableNorm(), f = (distance - ra) + rb;
  // |d| errs by 7 u of itself (6 of the norm, one of d), the difference and the sum by u each, and
  // so do f - error and f + error.
  const double error = kUnitRoundoff * (10.01 * distance + 4.01 * (ra + rb));
  return {{f, f - error, f + error, true, n, ra * n, rb * n}, GapTier::fast};
}

/// A sphere inside: its centre's distance from A's surface and its radius.
Solved solve_sphere_inside(const Pair& pair) {
  const double radius = pair.b.largest_semi_axis();
  detail::DoubleDoubleVector separation;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<int>(i);
    separation[i] = detail::DoubleDouble(pair.d[k], pair.d_low[k]);
  }
  const detail::SeenFromCentre seen = detail::seen_from_centre(pair.a, separation);
  const detail::ClosestOnSurface found = detail::closest_on_surface(pair.a, seen);
  const detail::DoubleDouble distance = scaled_by_power(found.distance, seen.exponent);
  const double f = (distance + detail::DoubleDouble(radius)).high;
  const double error = 2.0 * kUnitRoundoff * std::abs(f) + 0x1p-80 * pair.size;
  return {{f, f - error, f + error, true, found.normal, found.arm, radius * found.normal},
          GapTier::factored};
}

/// What is proven at one normal, of all others nothing.
GapProof proof_at(const Pair& pair, const FactoredPair& factored) {
  GapProof best = detail::prove_gap_in_double_double(pair, factored.axis(0));
  for (int i = 1; i < 6; ++i) {
    const GapProof proof = detail::prove_gap_in_double_double(pair, factored.axis(i));
    if (proof.low > best.low) best = proof;
  }
  return best;
}

Solved solve(const Pair& pair) {
  if (pair.a.is_sphere() && pair.b.is_sphere()) return solve_spheres(pair);
  if (pair.b.is_sphere()) return solve_sphere_inside(pair);
  const FactoredPair factored(pair.a, pair.b, pair.d, true);
  if (const auto proof = detail::search_meridian(pair, factored)) return {*proof, GapTier::search};
  const Vec3 start = pair.d == Vec3::Zero() ? factored.axis(0) : Vec3(pair.d.stableNormalized());
  const auto searched = detail::search_sphere(pair, factored, start, kBudget);
  Solved solved{searched ? *searched : proof_at(pair, factored), GapTier::search};
  const double widest = detail::kWidestOk * kUnitRoundoff * pair.size;
  if (!solved.proof.global || solved.proof.high - solved.proof.low > widest) {
    detail::bound_all_normals(solved.proof, margin_of(pair.asked), pair, distance_of(pair));
  }
  return solved;
}

Gap of_equal(const Ellipsoid& a) {
  const Vec3 n = a.rotation().col(0), arm = a.support_point(n);
  return {0.0, n, arm, arm, 0.0, GapStatus::ok, GapTier::exact};
}

/// f of B in A, of arms that are those of as_clearance().
Gap found_gap(const AskedPair<Ellipsoid>& asked) {
  const auto [outer, inner] = asked.placed();
  const Nesting exact = detail::nesting(relation(outer, inner));
  if (exact.of_pair == Relation::equal) return of_equal(asked.a);
  const Pair pair(asked, Sought::clearance);
  Solved solved = solve(pair);
  const double most = distance_of(pair) + (1.0 + 0x1p-50) * pair.b.largest_semi_axis();
  Gap gap = detail::finished_gap<Gap>(solved, exact, pair, most);
  if (!pair.in_own_unit()) gap.arm_b = asked.b.support_point(gap.normal);
  return gap;
}

Clearance found(const AskedPair<Ellipsoid>& asked) {
  const Gap gap = found_gap(asked);
  return detail::as_clearance<Clearance>(gap, gap.arm_b);
}

}  // namespace

Clearance clearance(const Ellipsoid& inner, const Ellipsoid& outer) noexcept {
  return in_default_environment([&] { return found({outer, inner}); });
}

Clearance clearance(const Ellipsoid& inner, const Ellipsoid& outer,
                    const Vec3& separation) noexcept {
  contract::require_finite("clearance", "separation", separation);
  return in_default_environment([&] {
    const Vec3 d = -separation;
    return found({outer, inner, &d});
  });
}

Clearance clearance(const MatrixEllipsoid& inner, const MatrixEllipsoid& outer) noexcept {
  return in_default_environment([&] {
    Gap gap = found_gap({outer.ellipsoid(), inner.ellipsoid()});
    const double off = inner.rounding() + outer.rounding();
    if (off != 0.0 && std::isfinite(gap.gap)) {
      const Ellipsoid &a = outer.ellipsoid(), &b = inner.ellipsoid();
      const double most =
          2.0 * ((b.centre() - a.centre()).cwiseAbs().maxCoeff() + b.largest_semi_axis());
      // Of a clearance both bounds are proven, whatever the status.
      gap = detail::widened(gap, off, detail::nesting(relation(outer, inner)), most + off, true);
    }
    return detail::as_clearance<Clearance>(gap, gap.arm_b);
  });
}

ContainmentMargin containment_margin(const Ellipsoid& inner, const Ellipsoid& outer) noexcept {
  return in_default_environment([&] {
    return detail::as_margin<ContainmentMargin>(margin_of({outer, inner}),
                                                [&] { return relation(outer, inner); });
  });
}

ContainmentMargin containment_margin(const Ellipsoid& inner, const Ellipsoid& outer,
                                     const Vec3& separation) noexcept {
  contract::require_finite("containment_margin", "separation", separation);
  return containment_margin(inner.moved_to(Vec3::Zero()), outer.moved_to(separation));
}

ContainmentMargin containment_margin(const MatrixEllipsoid& inner,
                                     const MatrixEllipsoid& outer) noexcept {
  return in_default_environment([&] {
    return detail::as_margin<ContainmentMargin>(exact::margin(solid_of(inner), solid_of(outer)),
                                                [&] { return relation(outer, inner); });
  });
}

}  // namespace tangency::inline v0
