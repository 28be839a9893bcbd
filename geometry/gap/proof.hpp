// SPDX-License-Identifier: MIT
/// @file
/// What a normal proves about the gap of a pair: docs/derivations/gap-certificate.md, whose names
/// for the bounds stand at each.
///
/// For a unit n the value f(n) = n.d - h_A(n) - h_B(n) is never above the gap (for a clearance,
/// f(n) = n.d - h_A(n) + h_B(n) never above minus that: containment.md, in double-double alone).
/// How much the gap may be above it follows from the tangential rest r = d - x_A(n) - x_B(n) - f n
/// and the curvatures.
#pragma once

#include <limits>

#include <tangency/geometry/gap/cap.hpp>
#include <tangency/geometry/normals/newton.hpp>

namespace tangency::inline v0::detail {

/// An enclosure of the gap of the branch that a normal is on, with what was evaluated there.
struct GapProof {
  double gap;   ///< between low and high
  double low;   ///< never above the value of f at a normal, and so never above the global gap
  double high;  ///< never below the local maximum of f near n; infinite where none is proven
  bool global;  ///< is high never below the global gap either?
  Vec3 normal;
  Vec3 arm_a;  ///< x_A(n), from A's centre
  Vec3 arm_b;  ///< -x_B(n), from B's centre; x_B(n) for a clearance

  static constexpr double kUnproven = std::numeric_limits<double>::infinity();
};

/// How far what was evaluated at a normal can be from the branch's maximum.
struct ContactShift {
  double turn;     ///< rad, between the normals
  double shift_a;  ///< between the support points of A
  double shift_b;
};

/// Of a gap. In double, by the ball of radius rho that rolls inside A + (-B). `global` where f >
/// -rho is proven; else high is infinite. Assumes rounding to nearest. Allocates nothing.
/// @param normal  unit, as Eigen normalises it
/// @param proof   what is proven; filled in place, which the fast path is measurably quicker for
void prove_gap(const Pair& pair, const Vec3& normal, GapProof& proof) noexcept;

/// The same at the normal that Newton's method came near with; normal and arms are those after the
/// step that was left. False where that is no last one, and they are nothing to rely on.
bool prove_gap_and_step(const Pair& pair, const NearlyStationary& near, GapProof& proof) noexcept;

/// What prove_gap_in_double_double() knows besides: the cap in which `high` bounds f.
struct CapProof : GapProof {
  Cap cap;
};

/// In double-double, by the curvatures at the normal, which is first moved towards the stationary
/// one nearby as far as doubles can tell. Assumes rounding to nearest. Allocates nothing.
/// @param cap_width  the largest width of the cap, as for cap_around(); the widest cap makes the
///                   least of the curvatures
CapProof prove_gap_in_double_double(const Pair& pair, const Vec3& normal,
                                    double cap_width = 1.0 / 16) noexcept;

/// Of a gap, and without moving the normal: the distance to the maximum.
ContactShift bound_shift(const Pair& pair, const Vec3& normal) noexcept;

}  // namespace tangency::inline v0::detail
