// SPDX-License-Identifier: MIT
#include <tangency/geometry/ellipse_gap.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/gap/sign.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/plane/plane_gap.hpp>

namespace tangency::inline v0 {
namespace {

using detail::PlanePair;
using detail::PlaneProof;

struct Solved {
  PlaneProof proof;
  GapTier tier;
};

/// What the exact relation tells of the bodies as the caller gave them.
struct Exact {
  const detail::AskedPair<Ellipse>& asked;

  Relation relation() const {
    const auto [a, b] = asked.placed();
    return tangency::relation(a, b).relation;
  }
  bool overlaps(GapTier&) const {
    const auto [a, b] = asked.placed();
    return tangency::overlaps(a, b);
  }
};

/// What the exact relation tells of bodies given by matrices.
struct ExactMatrices {
  const MatrixEllipse& a;
  const MatrixEllipse& b;

  Relation relation() const { return tangency::relation(a, b).relation; }
  bool overlaps(GapTier&) const {
    const Relation found = relation();
    return found != Relation::separate && found != Relation::external_touch;
  }
};

Solved solve(const PlanePair& pair) {
  Solved solved;
  Vec2 normal(std::numeric_limits<double>::quiet_NaN(), 0.0);
  solved.tier = GapTier::fast;
  if (pair.d != Vec2::Zero()) {
    normal = detail::perram_wertheim_normal(pair);
    Vec2 settled = normal;
    if (detail::settle_plane_gap(pair, settled, solved.proof)) return solved;
  }
  solved.proof = detail::search_plane_gap(pair, normal);
  const bool at_once = solved.proof.low > -(pair.a.least_radius() + pair.b.least_radius());
  solved.tier = at_once ? GapTier::factored : GapTier::search;
  return solved;
}

Solved follow(const PlanePair& pair, const Vec2& start) {
  Solved solved;
  solved.tier = GapTier::fast;
  Vec2 normal = start;
  if (detail::settle_plane_gap(pair, normal, solved.proof)) return solved;
  solved.proof = detail::climb_plane_gap(pair, start);
  solved.tier = GapTier::factored;
  // Flat bodies apart have false maxima with gap < 0: no branch that a contact can be on.
  if (solved.proof.global || solved.proof.low >= 0.0) return solved;
  return Exact{pair.asked}.overlaps(solved.tier) ? solved : solve(pair);
}

PlaneGap finished(Solved solved, const PlanePair& pair) {
  const double distance = 1.5 * pair.d.cwiseAbs().maxCoeff();  // |d| and above
  return detail::finished_gap<PlaneGap>(solved, Exact{pair.asked}, pair, distance);
}

}  // namespace

PlaneGap signed_gap(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept {
  return in_default_environment([&] {
    assert(separation.allFinite());
    const PlanePair pair({a, b, &separation});
    return finished(solve(pair), pair);
  });
}

PlaneGap signed_gap(const Ellipse& a, const Ellipse& b) noexcept {
  return in_default_environment([&] {
    const PlanePair pair({a, b});
    return finished(solve(pair), pair);
  });
}

PlaneGap signed_gap(const MatrixEllipse& a, const MatrixEllipse& b) noexcept {
  const PlaneGap gap = signed_gap(a.ellipse(), b.ellipse());
  const double off = a.rounding() + b.rounding();
  if (off == 0.0 || !std::isfinite(gap.gap)) return gap;
  return in_default_environment([&] {
    const Vec2 d = b.ellipse().centre() - a.ellipse().centre();
    return detail::widened(gap, off, ExactMatrices{a, b}, 2.0 * d.cwiseAbs().maxCoeff() + off);
  });
}

PlaneGap follow_gap(const Ellipse& a, const Ellipse& b, const Vec2& separation,
                    const Vec2& previous_normal) noexcept {
  return in_default_environment([&] {
    assert(separation.allFinite() && previous_normal != Vec2::Zero());
    const PlanePair pair({a, b, &separation});
    return finished(follow(pair, previous_normal.normalized()), pair);
  });
}

}  // namespace tangency::inline v0
