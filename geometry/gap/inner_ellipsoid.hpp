// SPDX-License-Identifier: MIT
/// @file
/// How deep two overlapping ellipsoids are at least: an ellipsoid inside A + B, and how far d is
/// inside that. An upper bound of the gap that takes no search; docs/derivations/bounded-gap.md.
#pragma once

#include <limits>

#include <tangency/geometry/gap/cap.hpp>
#include <tangency/geometry/symmetric3.hpp>

namespace tangency::inline v0::detail {

/// The ellipsoid { T y : |y| <= 1 } with T = S_A + S_B O', S = R diag(a) of a body and O
/// orthogonal: its support function |T'n| is nowhere above h_A + h_B. O is the one that makes them
/// equal at a given normal and, of those, the trace of T T' greatest.
class InnerEllipsoid {
 public:
  /// Assumes rounding to nearest.
  /// @param normal  unit, any
  InnerEllipsoid(const Pair& pair, const Vec3& normal) noexcept;

  /// What is proven for one multiplier m of the surface's equation.
  struct Bound {
    double high;  ///< no gap is above it; infinite where nothing is proven
    Vec3 normal;  ///< where the ellipsoid's surface is nearest to d, as m has it; not 0
  };
  Bound at(double multiplier) const noexcept;
  /// For the best multiplier, nearly: the depth is concave in it.
  Bound best() const noexcept;
  /// That of a depth at the normal, if the surface there is the nearest of all.
  double multiplier(double depth) const noexcept { return depth * support_; }

  static constexpr double kUnproven = std::numeric_limits<double>::infinity();

 private:
  struct Best {
    double multiplier, least;  ///< and the least semi-axis squared, which it is below
    double below;              ///< of that: how far below it rounding leaves no doubt, nearly
  };
  Best best_multiplier() const noexcept;

  Vec3 d_;
  Symmetric3 shape_;  ///< T T', less (I) of the derivation times the unit matrix
  double support_;    ///< h_A + h_B at the normal
  double size_;       ///< of the pair
};

}  // namespace tangency::inline v0::detail
