// SPDX-License-Identifier: MIT
/// @file
/// A member of the pencil of two quadrics: pencil.hpp.
#pragma once

#include <array>
#include <cstddef>

#include <tangency/geometry/quadric_type.hpp>

namespace tangency::inline v0 {

/// Coefficients of the two characteristic polynomials of a quadric, whose signs tell its type.
enum class Invariant { t1, t2, t3, d1, d2, d3, d4 };

/// One root of some invariant, or the open interval between two neighbouring ones.
struct PencilMember {
  bool is_root;  ///< is it at a root of the discriminant, and not between two?
  /// A root: the nearest finite double. An interval: a double in it, or where it holds none, the
  /// largest (possibly -inf) below some point of it.
  double f;
  /// A root lies in [low, high]: equal, or neighbouring doubles. Distinct roots closer than that
  /// share an enclosure and come in their order. An interval: the low of its left root and the high
  /// of its right one, infinite at the two ends.
  double low, high;               ///< exact bounds of the parameter, each a double or infinite
  std::array<int, 7> signs;       ///< -1, 0 or 1, in the order of Invariant
  Classification classification;  ///< the type of that quadric

  /// -1, 0 or 1, exact.
  int sign(Invariant i) const noexcept { return signs[static_cast<std::size_t>(i)]; }
  /// Does it lie in f > 0, an interval at least in part?
  bool is_positive() const noexcept { return high > 0.0 && (!is_root || low >= 0.0); }
};

}  // namespace tangency::inline v0
