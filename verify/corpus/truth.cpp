// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/corpus/truth.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <tangency/verify/corpus/coaxial.hpp>
#include <tangency/verify/oracles/gap.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

// A multiple of the oracles' error (gap.hpp: 1e-140 L; 1e-130 L for the normal).
const Real kNothing("1e-120");

// The gap with the sign that the relation asks for.
Real checked_gap(const Real& gap, Relation relation, const Real& size) {
  const bool nothing = abs(gap) <= kNothing * size;
  const bool apart = relation == Relation::separate;
  const bool touch = relation == Relation::external_touch;
  if (nothing != touch || (!touch && (gap > 0) != apart)) {
    throw std::logic_error("corpus: gap and exact relation contradict each other");
  }
  return touch ? Real(0) : gap;
}

// A unit vector at right angles to `axis`, the same for every sign of zeros.
Real3 beside(const Real3& axis) {
  return ascent::tangents(axis, ascent::most_normal_axis(axis))[0];
}

std::vector<TrueNormals> about_axis(const CoaxialGap& found) {
  if (found.every_normal) return {{TrueNormals::Set::all, found.axis, found.axis}};
  std::vector<TrueNormals> normals;
  const Real3 across = beside(found.axis);
  for (const Real& x : found.cosines) {
    const Real square = 1 - x * x;
    const bool pole = square < Real("1e-50");
    const Real sine = pole ? Real(0) : Real(sqrt(square));
    const Real along = pole ? Real(x > 0 ? 1 : -1) : x;
    normals.push_back({pole ? TrueNormals::Set::point : TrueNormals::Set::circle,
                       ascent::combined(Real3{}, along, found.axis, sine, across), found.axis});
  }
  return normals;
}

std::optional<PairTruth> truth_of(const ExactRelation& relation, const RealEllipsoid& a,
                                  const RealEllipsoid& b, std::size_t most_boxes = kMostGapBoxes) {
  PairTruth truth{relation, ascent::extent(separation(a, b)), 0, {}, {}};
  if (const auto coaxial = coaxial_gap(a, b)) {
    truth.gap = coaxial->gap;
    truth.normals = about_axis(*coaxial);
  } else {
    const std::vector<GapTruth> best = highest_gaps(a, b, 0, most_boxes);
    if (!best.front().global) return std::nullopt;
    truth.gap = best.front().gap;
    for (const GapTruth& one : best) {
      truth.normals.push_back({TrueNormals::Set::point, one.normal, {}});
    }
    std::ranges::sort(truth.normals, std::ranges::greater(), &TrueNormals::normal);
  }
  truth.gap = checked_gap(truth.gap, truth.relation.relation, truth.size);
  return truth;
}

std::optional<PairTruth> with_other_gaps(std::optional<PairTruth> truth, const RealEllipsoid& a,
                                         const RealEllipsoid& b) {
  if (truth) truth->perram_wertheim = perram_wertheim(a, b);
  return truth;
}

}  // namespace

std::optional<PairTruth> common_normal_truth(const EllipsoidPair& pair, std::size_t most_boxes) {
  return truth_of(exact_relation(pair.a, pair.b), real(pair.a), real(pair.b), most_boxes);
}

std::optional<PairTruth> pair_truth(const EllipsoidPair& pair) {
  return with_other_gaps(common_normal_truth(pair), real(pair.a), real(pair.b));
}

std::optional<PairTruth> pair_truth(const MatrixPair& pair) {
  const RealEllipsoid a = real(pair.a), b = real(pair.b);
  return with_other_gaps(truth_of(exact_relation(pair.a, pair.b), a, b), a, b);
}

EllipsePairTruth ellipse_truth(const EllipsePair& pair) {
  const EllipseTruth exact = exact_ellipse_relation(pair.a, pair.b);
  EllipsePairTruth truth{exact.relation, exact.crossings, 0, 0, 0, {}};
  Real square = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Real d = Real(pair.b.centre[i]) - pair.a.centre[i];
    square += d * d;
  }
  truth.size =
      sqrt(square) + std::ranges::max(pair.a.semi_axes) + std::ranges::max(pair.b.semi_axes);
  const auto area = [](const RawEllipse& e) {
    return Real(acos(Real(-1)) * e.semi_axes[0] * e.semi_axes[1]);
  };
  truth.smaller_area = std::min(area(pair.a), area(pair.b));
  truth.area = common_area(pair.a, pair.b);
  truth.gap = plane_gap_truth(pair.a, pair.b);
  Real& gap = truth.gap.gap;
  // The plane oracle's ascents end at 1e-40 of the size: tests/verify/ellipse_agreement.cpp.
  const bool nothing = abs(gap) <= Real("1e-39") * truth.size;
  if (exact.relation.relation == Relation::external_touch && nothing) gap = 0;
  gap = checked_gap(gap, exact.relation.relation, truth.size);
  return truth;
}

}  // namespace tangency::inline v0::verify
