// SPDX-License-Identifier: MIT
/// @file
/// How great a gap is at most, by points of the bodies: docs/derivations/gap-certificate.md, (D).
/// Where a normal lies across a flat face or a thin edge, its rounding alone moves the support
/// points by as much as the face is wide, and what is proven at the normal is no better than that;
/// the distance from a point to a body does not feel it.
#pragma once

#include <tangency/geometry/gap/proof.hpp>

namespace tangency::inline v0::detail {

/// Lowers `high`, at any depth, and `gap` to it: first by the support points of the proof, then by
/// the points of the bodies that are nearest to those, in turn. In double-double, without a
/// normal; each point costs some microseconds. Assumes rounding to nearest. Allocates nothing.
/// @param enough  of high - low, a length in the unit of the pair: no more points are tried
/// @param proof   of the gap, `global`: `high` bounds it before and after
void bound_by_points(const Pair& pair, double enough, GapProof& proof) noexcept;

}  // namespace tangency::inline v0::detail
