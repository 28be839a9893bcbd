// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: the signed gap between two proven bounds, and the relation where these prove it, in
/// microseconds. It answers for most pairs and says nothing of the others: those are for
/// relation.hpp and gap.hpp, which are a hundred to ten thousand times slower.
///
/// Newton's ascent in long double (newton_ascent.hpp) finds a normal n, which is a guess. All that
/// is said of it is evaluated once more in two doubles with an error bound beside every number
/// (ball.hpp). f, h, rho as in
/// gap.hpp; r is the gradient of f on the sphere at n, F = f(n) + rho.
///
///  (1) gap >= f(n), for every n.
///  (2) If F > 0: gap <= f(n) + |r|^2 / (2 F). For rho is at most the sum of the radii of curvature
///      of any two normal sections, so F'' + F <= 0 along every great circle from n, and F(t) <=
///      F cos t + |r| sin t <= sqrt(F^2 + |r|^2) for 0 <= t <= pi.
///  (3) In (2) the maximiser is unique and within 2 |r| / F of n, by the same inequality.
///  (4) separate, if a gap > 0 is proven. The interiors meet, if a gap < 0 is proven or a point
///      inside both is known.
///  (5) A is not in B, if h_A(m) - h_B(m) > m.d for some m; overlap, if the interiors meet and
///      neither is in the other.
///  (6) deeper pairs: gap <= -t, if a ball of radius t about d lies in an ellipsoid that lies in
///      the difference of both bodies (inner_ellipsoid.hpp).
///
/// Identity: lower <= gap <= upper, and `relation` is that of exact_relation(), for all bodies.
/// Assumes rounding to nearest.
#pragma once

#include <array>
#include <optional>

#include <tangency/verify/oracles/plain_bodies.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

struct GapBracket {
  long double lower, upper;  ///< of the global gap, in the unit of length; infinite where unproven
  std::array<double, 3> normal;  ///< unit to rounding, from A to B, where `lower` is reached
  long double least_excess, most_excess;  ///< of gap - claimed gap, to the last bits of either
  double normal_error;               ///< by (3), without the rounding of `normal`; infinite without
  double size;                       ///< L = |d| + both largest semi-axes, rounded
  std::optional<Relation> relation;  ///< separate or overlap, where it is proven
};

/// What somebody says the gap is. The normal is one more start of an ascent, and with it (6) is
/// tried; nothing is taken on trust.
struct ClaimedGap {
  double gap = 0;
  std::optional<std::array<double, 3>> normal{};
};

/// Throws std::invalid_argument unless both are ellipsoids: finite, semi-axes > 0, orientation !=
/// 0.
GapBracket gap_bracket(const RawEllipsoid& a, const RawEllipsoid& b,
                       const ClaimedGap& claimed = {});

}  // namespace tangency::inline v0::verify
