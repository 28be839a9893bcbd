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
#include <tangency/geometry/plane/scaled_plane_pair.hpp>

namespace tangency {
namespace {

using detail::PlanePair;
using detail::PlaneProof;

constexpr double kLargest = 0x1p60, kSmallest = 0x1p-60, kThinnest = 0x1p-300;  // PlanePair

struct Solved {
  PlaneProof proof;
  GapTier tier;
};

/// The bodies as the caller gave them, for the exact relation.
struct Asked {
  const Ellipse& a;
  const Ellipse& b;
  const Vec2* separation;  ///< null: that of the centres

  Relation relation() const {
    if (separation == nullptr) return tangency::relation(a, b).relation;
    return tangency::relation(a.moved_to(Vec2::Zero()), b.moved_to(*separation)).relation;
  }
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

Solved follow(const PlanePair& pair, const Vec2& start, const Asked& asked) {
  Solved solved;
  solved.tier = GapTier::fast;
  Vec2 normal = start;
  if (detail::settle_plane_gap(pair, normal, solved.proof)) return solved;
  solved.proof = detail::climb_plane_gap(pair, start);
  solved.tier = GapTier::factored;
  // Flat bodies apart have false maxima with gap < 0: no branch that a contact can be on.
  if (solved.proof.global || solved.proof.low >= 0.0) return solved;
  return asked.overlaps(solved.tier) ? solved : solve(pair);
}

PlaneGap finish(Solved& solved, const Asked& asked, const PlanePair& pair, bool in_own_unit,
                int exponent) {
  const double distance = 1.5 * pair.d.cwiseAbs().maxCoeff();  // |d| and above
  return detail::finished_gap<PlaneGap>(solved, asked, pair, distance, in_own_unit, exponent);
}

double size_of(const Ellipse& a, const Ellipse& b, const Vec2& d) {
  return std::sqrt(d.squaredNorm()) + a.largest_semi_axis() + b.largest_semi_axis();
}

/// Is the pair in its own unit what PlanePair asks for?
bool in_range(const Ellipse& a, const Ellipse& b, const Vec2& d) {
  const double reach = d.cwiseAbs().maxCoeff();
  const double largest = std::max({reach, a.largest_semi_axis(), b.largest_semi_axis()});
  if (!(largest <= kLargest && largest >= kSmallest)) return false;
  return std::min(a.smallest_semi_axis(), b.smallest_semi_axis()) >= kThinnest;
}

template <class Solve>
PlaneGap answer(const Asked& asked, const Solve& solve_pair) {
  const Ellipse &a = asked.a, &b = asked.b;
  const Vec2 d = asked.separation != nullptr ? *asked.separation : Vec2(b.centre() - a.centre());
  if (in_range(a, b, d)) {
    const Vec2 low = asked.separation != nullptr
                         ? Vec2(Vec2::Zero())
                         : detail::separation_error(a.centre(), b.centre(), d);
    const PlanePair pair{a, b, d, low, size_of(a, b, d)};
    Solved solved = solve_pair(pair);
    return finish(solved, asked, pair, true, 0);
  }
  const detail::ScaledPlanePair s = asked.separation != nullptr ? detail::scaled_plane_pair(a, b, d)
                                                                : detail::scaled_plane_pair(a, b);
  const PlanePair pair{s.a, s.b, s.d, s.d_low, size_of(s.a, s.b, s.d)};
  Solved solved = solve_pair(pair);
  return finish(solved, asked, pair, false, s.exponent);
}

}  // namespace

PlaneGap signed_gap(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept {
  return in_default_environment([&] {
    assert(separation.allFinite());
    return answer({a, b, &separation}, solve);
  });
}

PlaneGap signed_gap(const Ellipse& a, const Ellipse& b) noexcept {
  return in_default_environment([&] { return answer({a, b, nullptr}, solve); });
}

PlaneGap follow_gap(const Ellipse& a, const Ellipse& b, const Vec2& separation,
                    const Vec2& previous_normal) noexcept {
  return in_default_environment([&] {
    assert(separation.allFinite() && previous_normal != Vec2::Zero());
    const Vec2 start = previous_normal.normalized();
    const Asked asked{a, b, &separation};
    return answer(asked, [&](const PlanePair& pair) { return follow(pair, start, asked); });
  });
}

}  // namespace tangency
