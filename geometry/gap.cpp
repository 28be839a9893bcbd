// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include <tangency/geometry/methods/gap_factored.hpp>
#include <tangency/geometry/methods/gap_newton.hpp>
#include <tangency/geometry/methods/scaled_pair.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency {
namespace {

using methods::FactoredPair;
using methods::GapAt;
using methods::Stationary;

constexpr double kUnitRoundoff = 0x1p-53;
constexpr double kRounding = 16.0 * kUnitRoundoff;  // twice the error of a value, per size of pair
constexpr double kLargest = 0x1p60, kSmallest = 0x1p-60;  // Ellipsoid::moderate()

double size_of(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) {
  return d.norm() + a.largest_semi_axis() + b.largest_semi_axis();
}

/// The least radius of curvature of a body's surface.
double least_radius(const Ellipsoid& body) {
  const double smallest = body.smallest_semi_axis();
  return smallest * (smallest / body.largest_semi_axis());
}

bool is_sphere(const Ellipsoid& body) {
  const Vec3& a = body.semi_axes();
  return a[0] == a[1] && a[1] == a[2];
}

/// Value and points at a normal. A stationary normal with gap > -rho is the global answer: a ball
/// of radius rho rolls inside A + (-B), so that no other normal reaches as far (docs/guide.md).
Gap stationary_answer(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& normal) {
  const GapAt at = methods::gap_at(a, b, d, normal);
  const double rho = least_radius(a) + least_radius(b);
  const bool light = at.gap - kRounding * size_of(a, b, d) > -rho;
  return {at.gap, normal, at.arm_a, at.arm_b, light ? GapStatus::ok : GapStatus::local};
}

/// Two spheres: n along d; A's first body axis where the centres coincide.
Gap sphere_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) {
  // Divided first: squares of a tiny d would be nothing.
  const Vec3 n = d == Vec3::Zero() ? Vec3(a.rotation().col(0))
                                   : Vec3((d / d.cwiseAbs().maxCoeff()).normalized());
  const double ra = a.semi_axes()[0], rb = b.semi_axes()[0];
  return {d.stableNorm() - ra - rb, n, ra * n, -rb * n, GapStatus::ok};
}

/// The best of the ascents from the Perram-Wertheim normal and from the six axes.
Gap search(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) {
  const FactoredPair pair(a, b, d);
  Gap best{-std::numeric_limits<double>::infinity(), a.rotation().col(0), Vec3::Zero(),
           Vec3::Zero(), GapStatus::not_converged};
  // A later start replaces an earlier one by more than rounding only: ties go to the first.
  const auto consider = [&](const Vec3& start) {
    const Stationary found = pair.climb(start);
    if (!found.accepted) return;
    const Gap answer = stationary_answer(a, b, d, found.normal);
    if (answer.gap > best.gap + kRounding * pair.size()) best = answer;
  };
  if (d != Vec3::Zero()) consider(pair.perram_wertheim_normal());
  for (int i = 0; i < 6 && best.status != GapStatus::ok; ++i) consider(pair.axis(i));
  return best;
}

/// The most by which the global gap can exceed that of an answer with gap > -rho: the ball of
/// radius rho that touches the boundary of A + (-B) at the witness point, seen from the origin.
double shortfall(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Gap& gap) {
  const double reach = gap.gap + least_radius(a) + least_radius(b);
  const Vec3 tangential = d + gap.arm_b - gap.arm_a - gap.gap * gap.normal;
  const double r2 = tangential.squaredNorm();
  return r2 / (std::sqrt(reach * reach + r2) + reach);
}

/// The fast path's answer where it is proven: its squares of semi-axes hide the short axes of
/// extreme shapes, where it may take a normal for stationary that is not.
std::optional<Gap> proven(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                          const Stationary& found) {
  if (!found.accepted) return std::nullopt;
  const Gap gap = stationary_answer(a, b, d, found.normal);
  if (gap.status != GapStatus::ok) return std::nullopt;
  if (!(shortfall(a, b, d, gap) <= 2.0 * kUnitRoundoff * size_of(a, b, d))) return std::nullopt;
  return gap;
}

/// Calls solve(a, b, d) with the pair in units of a power of two, and takes the answer back.
template <class Solve>
Gap in_unit_of(const methods::ScaledPair& pair, const Ellipsoid& a, const Ellipsoid& b,
               const Solve& solve) {
  Gap gap = solve(pair.a, pair.b, pair.d);
  gap.gap = std::scalbn(gap.gap, pair.exponent);
  gap.arm_a = a.support_point(gap.normal);
  gap.arm_b = -b.support_point(gap.normal);
  return gap;
}

/// Calls solve(a, b, d) with the pair itself or, where its size could overflow or underflow on the
/// way, in units of a power of two.
template <class Solve>
Gap in_range(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Solve& solve) {
  const double largest =
      std::max({d.cwiseAbs().maxCoeff(), a.largest_semi_axis(), b.largest_semi_axis()});
  if (largest <= kLargest && largest >= kSmallest) return solve(a, b, d);
  return in_unit_of(methods::scaled_pair(a, b, d), a, b, solve);
}

Gap search_globally(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) {
  if (is_sphere(a) && is_sphere(b)) return sphere_gap(a, b, d);
  if (a.moderate() && b.moderate() && d.cwiseAbs().maxCoeff() >= kSmallest) {
    if (const auto gap = proven(a, b, d, methods::newton(a, b, d))) return *gap;
  }
  return search(a, b, d);
}

/// The stationary answer that an ascent from `start` leads to.
Gap follow(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& start) {
  if (is_sphere(a) && is_sphere(b)) return sphere_gap(a, b, d);
  if (a.moderate() && b.moderate()) {
    if (const auto gap = proven(a, b, d, methods::newton_from(a, b, d, start))) return *gap;
  }
  const Stationary found = FactoredPair(a, b, d).climb(start);
  Gap gap = stationary_answer(a, b, d, found.normal);
  if (!found.accepted) gap.status = GapStatus::not_converged;
  // Flat bodies apart have false maxima with gap < 0: no branch that a contact can be on.
  const bool in_doubt = gap.status != GapStatus::ok && gap.gap < 0.0;
  if (in_doubt && !overlaps(a.moved_to(Vec3::Zero()), b.moved_to(d)))
    return search_globally(a, b, d);
  return gap;
}

}  // namespace

Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept {
  assert(separation.allFinite());
  return in_range(a, b, separation, search_globally);
}

Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  const Vec3 d = b.centre() - a.centre();
  if (d.allFinite()) return in_range(a, b, d, search_globally);
  return in_unit_of(methods::scaled_pair(a, b), a, b, search_globally);
}

Gap follow_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
               const Vec3& previous_normal) noexcept {
  assert(separation.allFinite() && previous_normal != Vec3::Zero());
  const Vec3 start = previous_normal.normalized();
  return in_range(a, b, separation, [&](const Ellipsoid& pa, const Ellipsoid& pb, const Vec3& d) {
    return follow(pa, pb, d, start);
  });
}

}  // namespace tangency
