// SPDX-License-Identifier: MIT
/// @file
/// What normals prove about the gap of two ellipses: in double by the rolling ball, in
/// double-double by a branch and bound over the circle of normals. docs/derivations/ellipses.md.
/// Internal.
#pragma once

#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/ellipse.hpp>

namespace tangency::inline v0::detail {

/// A pair in a unit in which nothing overflows or underflows: the largest of semi-axes and d within
/// [2^-60, 2^62], no semi-axis below 2^-300.
struct PlanePair : UnitPair<Ellipse> {
  Vec2 d_low;   ///< c_B - c_A = d + d_low
  double size;  ///< L = |d| + largest semi-axis of A + that of B, rounded
  Sought sought;

  explicit PlanePair(const AskedPair<Ellipse>& pair, Sought wanted = Sought::gap) noexcept
      : PlanePair(pair, pair.d(), wanted) {}
  /// rho: f'' + f <= -rho along the circle of normals. Rounded down.
  double least_radius() const noexcept { return least_radius_of(a, b, sought); }

 private:
  PlanePair(const AskedPair<Ellipse>& pair, const Vec2& given, Sought wanted) noexcept
      : UnitPair(pair, given, moderate_size(pair.a, pair.b, given) && thick_enough(pair.a, pair.b)),
        d_low(rest_of_d()),
        size(d.norm() + a.largest_semi_axis() + b.largest_semi_axis()),
        sought(wanted) {}
};

/// An enclosure of the gap of the branch that a normal is on, with what was evaluated there.
struct PlaneProof {
  double gap;   ///< between low and high
  double low;   ///< never above the global gap
  double high;  ///< never below the local maximum near the normal
  bool global;  ///< is high never below the global gap either?
  Vec2 normal;
  Vec2 arm_a, arm_b;
};

/// A direction from which Newton's method finds ordinary contacts: that of the Perram-Wertheim form
/// after a few steps. Requires d != 0.
Vec2 perram_wertheim_normal(const PlanePair& pair) noexcept;

/// Newton's method in double from `normal`, until what is left is below rounding and proven to be
/// the global answer of a sign that is not in doubt. False where it is not: `normal` is then where
/// it stopped.
bool settle_plane_gap(const PlanePair& pair, Vec2& normal, PlaneProof& proof) noexcept;

/// The local maximum that the ascent from `start` leads to, in double-double.
PlaneProof climb_plane_gap(const PlanePair& pair, const Vec2& start) noexcept;

inline constexpr int kPlaneBudget = 4000;  // arcs; chosen: pairs of aspect 1e8 take up to 300

/// The global maximum, in double-double; `first` is where the first ascent starts. `global` unless
/// `budget` arcs were not enough.
PlaneProof search_plane_gap(const PlanePair& pair, const Vec2& first,
                            int budget = kPlaneBudget) noexcept;

}  // namespace tangency::inline v0::detail
