// SPDX-License-Identifier: MIT
/// @file
/// The pencil Q_A + f Q_B of two quadrics, member by member, exact for the stored doubles: the
/// published test for overlap [Ouadfel1998, section 4.2] laid open, as published and corrected. To
/// decide about two ellipsoids use relation(); this room is for seeing why.
///
/// The invariants of a member are polynomials in f: T1, T2, T3, the sums of the principal minors of
/// order 1, 2, 3 of the sub-discriminant, and D1 to D4, those of the discriminant. Between
/// neighbouring roots of all of them no sign changes, so the type does not; at a root it may.
///
/// (1) Members alternate: an open interval, a root, an interval, ..., an interval; f ascends.
/// (2) The signs of a member and its type agree: by Descartes' rule they give both inertias.
/// (3) The types on f > 0 of (A, B) are those of (B, A) in reverse order.
#pragma once

#include <span>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/pencil_member.hpp>
#include <tangency/geometry/quadric.hpp>

namespace tangency::inline v0 {

/// All members from f = -inf to +inf, at most 33: seven invariants have at most 16 roots.
std::vector<PencilMember> pencil_members(const Quadric& a, const Quadric& b);

/// The quadrics are the exact ones of the solids, (x - c)' R diag(1/a^2) R' (x - c) - 1, not the
/// rounded ones of Quadric::from_ellipsoid().
std::vector<PencilMember> pencil_members(const Ellipsoid& a, const Ellipsoid& b);

/// The published scan: looks at one member in every interval, over all f, and takes the pair as
/// overlapping unless it is empty (the three "INVALID" types). Kept to be compared with: right for
/// *surfaces* up to an exact touch, wrong for solids one inside the other. docs/classification.md.
bool published_scan_finds_overlap(std::span<const PencilMember> members) noexcept;

/// What the members say about two solid ellipsoids.
enum class PencilVerdict {
  overlap,   ///< the interiors meet
  touch,     ///< common points, but disjoint interiors
  separate,  ///< no common point
};

/// The corrected scan: members with f > 0 only. Separate where one is positive definite, a touch
/// where the best is semidefinite, else overlap.
/// Requires the members of two real ellipsoids, each negative inside.
PencilVerdict scan_solids(std::span<const PencilMember> members) noexcept;

}  // namespace tangency::inline v0
