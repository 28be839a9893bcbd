// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using testing::Pair;

using Definition = OtherGap (*)(const Ellipsoid&, const Ellipsoid&) noexcept;

constexpr double kU = kUnitRoundoff;
constexpr double kAspect = 100;

double size_of(const Pair& p) {
  return (p.b.centre() - p.a.centre()).norm() + p.a.largest_semi_axis() + p.b.largest_semi_axis();
}

/// Of what is computed here in doubles from an answer.
double rounding(const Pair& p) { return 16 * kU * size_of(p); }

/// The same for a body that was moved or turned: its doubles are other ones.
double moving(const Pair& p) {
  return rounding(p) + 16 * kU * (p.a.centre().norm() + p.b.centre().norm());
}

/// How far rounding of the bodies may turn a normal of the Perram-Wertheim function: by the
/// condition of the sum of the shape matrices.
double turning(const Pair& p) {
  const double aspect_a = p.a.largest_semi_axis() / p.a.smallest_semi_axis();
  const double aspect_b = p.b.largest_semi_axis() / p.b.smallest_semi_axis();
  const double aspect = std::max(aspect_a, aspect_b), d = (p.b.centre() - p.a.centre()).norm();
  return 64 * aspect * aspect * moving(p) / d;
}

/// Cosine between the normal and the surface's outer normal at a witness point, both in the
/// coordinates that make the body the unit ball: 0 where the line along the normal grazes it.
double leaving(const Ellipsoid& e, const Vec3& normal, const Vec3& arm) {
  const Vec3 point = (e.rotation().transpose() * arm).cwiseQuotient(e.semi_axes());
  return point.dot((e.rotation().transpose() * normal).cwiseQuotient(e.semi_axes()).normalized());
}

/// Does the line of a midpoint answer nearly miss a body, so that its points are ill-determined?
bool grazing(const Pair& p, const OtherGap& g) {
  constexpr double kGrazing = 1e-3;  // chosen
  return g.status == OtherGapStatus::ok &&
         std::min(leaving(p.a, g.normal, g.arm_a), -leaving(p.b, g.normal, g.arm_b)) < kGrazing;
}

RC_GTEST_PROP(OtherGapsProperty, TangentPlanesAreApartByTheGapAndTouchAtTheWitnessPoints, ()) {
  const Pair p = *testing::pair(kAspect);
  const OtherGap g = perram_wertheim_gap(p.a, p.b);
  const Vec3 d = p.b.centre() - p.a.centre();
  if (d == Vec3::Zero()) RC_SUCCEED("concentric");
  RC_ASSERT(g.status == OtherGapStatus::ok);
  const double planes = g.normal.dot(d) - p.a.support(g.normal) - p.b.support(g.normal);
  RC_ASSERT(std::abs(g.gap - planes) <= rounding(p));
  RC_ASSERT(std::abs(g.normal.dot(d + g.arm_b - g.arm_a) - g.gap) <= rounding(p));
  RC_ASSERT((g.arm_a - p.a.support_point(g.normal)).norm() <= kAspect * rounding(p));
  RC_ASSERT((g.arm_b + p.b.support_point(g.normal)).norm() <= kAspect * rounding(p));
}

RC_GTEST_PROP(OtherGapsProperty, MidpointPotentialPointsLieOnBothSurfacesAlongTheNormal, ()) {
  const Pair p = *testing::pair(kAspect);
  const OtherGap g = midpoint_potential_gap(p.a, p.b);
  if (g.status != OtherGapStatus::ok) RC_SUCCEED("not applicable");
  const Vec3 d = p.b.centre() - p.a.centre();
  RC_ASSERT((d + g.arm_b - g.arm_a - g.gap * g.normal).norm() <= rounding(p));
  const auto on_surface = [&](const Ellipsoid& e, const Vec3& arm) {
    const double level = e.moved_to(Vec3::Zero()).level(arm);
    return std::abs(level - 1) <= 64 * kU * e.largest_semi_axis() / e.smallest_semi_axis();
  };
  RC_ASSERT(on_surface(p.a, g.arm_a));
  RC_ASSERT(on_surface(p.b, g.arm_b));
  // The last point in A, the first in B.
  RC_ASSERT(leaving(p.a, g.normal, g.arm_a) >= -1e-6);
  RC_ASSERT(leaving(p.b, g.normal, g.arm_b) <= 1e-6);
}

// geometry/other_gaps.hpp (1)
RC_GTEST_PROP(OtherGapsProperty, ExchangeReversesTheNormalAndExchangesThePoints, ()) {
  const Pair p = *testing::pair(kAspect);
  for (const Definition find :
       {Definition{perram_wertheim_gap}, Definition{midpoint_potential_gap}}) {
    const OtherGap ab = find(p.a, p.b), ba = find(p.b, p.a);
    const bool on_a_line = find == Definition{midpoint_potential_gap};
    if (on_a_line && (grazing(p, ab) || grazing({p.b, p.a}, ba))) continue;
    RC_ASSERT(ab.status == ba.status);
    if (ab.status != OtherGapStatus::ok) continue;
    RC_ASSERT(std::abs(ab.gap - ba.gap) <= 4 * kU * size_of(p));
    RC_ASSERT((ab.normal + ba.normal).norm() <= 4 * kU);
    RC_ASSERT((ab.arm_a - ba.arm_b).norm() <= 4 * kU * size_of(p));
    RC_ASSERT((ab.arm_b - ba.arm_a).norm() <= 4 * kU * size_of(p));
  }
}

// geometry/other_gaps.hpp (2)
RC_GTEST_PROP(OtherGapsProperty, ScalingByAPowerOfTwoScalesThem, ()) {
  const Pair p = *testing::pair(kAspect);
  const int power = *rc::gen::inRange(-900, 900);
  const double s = std::exp2(power);
  const auto scaled = [&](const Ellipsoid& e) {
    return Ellipsoid(s * e.centre(), s * e.semi_axes(), e.orientation());
  };
  // Within moderate sizes the search starts from the polynomials, beyond them it does not.
  const OtherGap small = perram_wertheim_gap(p.a, p.b);
  const OtherGap large = perram_wertheim_gap(scaled(p.a), scaled(p.b));
  RC_ASSERT(small.status == large.status);
  RC_ASSERT(std::abs(large.gap / s - small.gap) <= 2 * kU * std::abs(small.gap));
  RC_ASSERT((large.normal - small.normal).norm() <= 2 * kU);
  RC_ASSERT((large.arm_a / s - small.arm_a).norm() <= 2 * kU * small.arm_a.norm());
}

// geometry/other_gaps.hpp (2)
RC_GTEST_PROP(OtherGapsProperty, CommonMotionCarriesNormalAndPointsAlong, ()) {
  constexpr double kRound = 10;  // aspect
  const Pair p = *testing::pair(kRound);
  const Eigen::Quaterniond q = (*testing::orientation()).normalized();
  const Vec3 shift = *testing::direction();
  const auto moved = [&](const Ellipsoid& e) {
    return Ellipsoid(q * e.centre() + shift, e.semi_axes(), q * e.orientation().normalized());
  };
  const Pair there{moved(p.a), moved(p.b)};
  const double turn = turning(p) + turning(there), moves = moving(p) + moving(there);
  if (p.a.centre() == p.b.centre() || !(turn < 1e-3)) RC_SUCCEED("not comparable");
  for (const Definition find :
       {Definition{perram_wertheim_gap}, Definition{midpoint_potential_gap}}) {
    const bool on_a_line = find == Definition{midpoint_potential_gap};
    const OtherGap before = find(p.a, p.b), after = find(there.a, there.b);
    if (on_a_line && (grazing(p, before) || grazing(there, after))) continue;
    RC_ASSERT(before.status == after.status);
    if (before.status != OtherGapStatus::ok) continue;
    // A support point turns with the normal, at most a_max^2 / a_min as far. The line through the
    // point of equal levels shifts and turns, and where it leaves a body by the inverse cosine
    // more.
    double points = moves + turn * kRound * size_of(p);
    if (on_a_line) {
      points *= kRound / std::min(leaving(p.a, before.normal, before.arm_a),
                                  -leaving(p.b, before.normal, before.arm_b));
    }
    RC_ASSERT((after.normal - q * before.normal).norm() <= turn);
    RC_ASSERT(std::abs(after.gap - before.gap) <= 2 * points);
    RC_ASSERT((after.arm_a - q * before.arm_a).norm() <= points);
    RC_ASSERT((after.arm_b - q * before.arm_b).norm() <= points);
  }
}

// geometry/other_gaps.hpp (3)
RC_GTEST_PROP(OtherGapsProperty, TheirSignIsThatOfTheExactRelation, ()) {
  const Pair p = *testing::pair(kAspect);
  const bool meet = overlaps(p.a, p.b);
  for (const OtherGap& g : {perram_wertheim_gap(p.a, p.b), midpoint_potential_gap(p.a, p.b)}) {
    if (g.status != OtherGapStatus::ok || std::abs(g.gap) < 2 * kU * size_of(p)) continue;
    RC_ASSERT((g.gap < 0) == meet);
  }
}

RC_GTEST_PROP(OtherGapsProperty, PerramWertheimIsNeverAboveTheSignedGap, ()) {
  const Pair p = *testing::pair(kAspect);
  const OtherGap g = perram_wertheim_gap(p.a, p.b);
  if (g.status != OtherGapStatus::ok) RC_SUCCEED("concentric");
  const Gap best = signed_gap(p.a, p.b);
  if (best.status != GapStatus::ok) RC_SUCCEED("not proven");
  RC_ASSERT(g.gap <= best.gap + best.gap_error + 2 * kU * size_of(p));
}

// geometry/other_gaps.hpp (4)
RC_GTEST_PROP(OtherGapsProperty, OfSpheresAreTheSignedGap, ()) {
  const Pair drawn = *testing::pair(kAspect);
  const auto sphere = [](const Ellipsoid& e) {
    return Ellipsoid(e.centre(), Vec3::Constant(e.semi_axes()[0]), e.orientation());
  };
  const Pair p{sphere(drawn.a), sphere(drawn.b)};
  const Gap exact = signed_gap(p.a, p.b);
  for (const OtherGap& g : {perram_wertheim_gap(p.a, p.b), midpoint_potential_gap(p.a, p.b)}) {
    if (g.status != OtherGapStatus::ok) continue;
    // At a touch the signed gap is 0 by the exact relation.
    const double rounded = kU * std::abs(exact.gap) + 0x1p-90 * size_of(p);
    RC_ASSERT(std::abs(g.gap - exact.gap) <= exact.gap_error + rounded);
    RC_ASSERT((g.normal - exact.normal).norm() <= 8 * kU);
  }
}

}  // namespace
}  // namespace tangency
