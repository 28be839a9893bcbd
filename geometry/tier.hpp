// SPDX-License-Identifier: MIT
/// @file
/// Which tier gave an answer, and what is known of it.
#pragma once

#include <string_view>

namespace tangency::inline v0 {

/// Which tier of a predicate gave an answer. Both give the same one: the filter answers only where
/// a proven error bound leaves no doubt, everything else goes to exact arithmetic.
enum class Tier { filter, exact };

/// "filter" or "exact", as the file formats write it.
constexpr std::string_view to_string(Tier tier) noexcept {
  return tier == Tier::filter ? "filter" : "exact";
}

// ---- gap.hpp

/// What is proven of a gap.
enum class GapStatus {
  ok,     ///< the global answer, proven, with a gap_error of at most 100 u L
  local,  ///< a stationary answer; that no shorter penetration exists is not proven
  /// Above Accuracy::cutoff, which alone asks for it. `gap` is a proven lower bound of the true
  /// gap, gap_error infinite, the rest 0.
  beyond,
};

/// Which method gave the answer, the cheapest first.
enum class GapTier {
  fast,         ///< Newton's method with shape matrices, proven in double
  safeguarded,  ///< ascent with backtracking on factors, proven in double
  factored,     ///< the same from a start by orthogonal factors, proven in double-double
  search,       ///< several ascents and the branch and bound over all normals
  exact,        ///< any of these, and the exact relation decided the sign
};

/// An upper bound of gap_error over u L for bodies of aspect ratios to 100, u = 2^-53, L = |d| +
/// largest semi-axis of A + that of B.
inline constexpr double kOrdinaryGapErrorBound = 16.0;

// ---- trace_contact.hpp: how far the published scheme of curves came

/// Whether the scheme of curves has an answer.
enum class TraceStatus {
  ok,
  not_overlapping,   ///< the exact relation is not `overlap`: apart, touching, nested or equal
  concentric,        ///< no direction from centre to centre, no cone
  no_arc,            ///< no curve of the search has an arc in B: too shallow, or B holds the poles
  several_arcs,      ///< the first curve that meets B has more than one arc in it
  no_tangent_plane,  ///< the corners span half of A or more
  no_overlap_on_the_line,  ///< the shortest P_i Q_j is not from A's last point to B's first
};

/// As docs/trace.md writes it: "ok", "not_overlapping", ...
const char* to_string(TraceStatus status) noexcept;

/// Which cone the first limits came from. Published: the one through the circle where the bounding
/// spheres meet, if they do, with a half-angle below 90 degrees; used first where it exists. The
/// common part of the two balls may stick out of it or fill it (nested balls): its own cone is
/// tried next. The whole sphere of directions where A's centre is in B's bounding ball.
enum class TraceCone { published, common_part, whole };

}  // namespace tangency::inline v0
