// SPDX-License-Identifier: MIT
/// @file
/// What is known of a gap, and how it was found: gap.hpp.
#pragma once

namespace tangency {

enum class GapStatus {
  ok,     ///< the global answer, proven, with a gap_error of at most 100 u L
  local,  ///< a stationary answer; that no shorter penetration exists is not proven
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

}  // namespace tangency
