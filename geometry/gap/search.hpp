// SPDX-License-Identifier: MIT
/// @file
/// The global gap of deeply overlapping pairs: ascents from several normals, then a bounded branch
/// and bound over the sphere of normals that proves the best of them to be the greatest
/// (docs/derivations/gap-certificate.md, section 4).
#pragma once

#include <optional>

#include <tangency/geometry/gap/proof.hpp>
#include <tangency/geometry/normals/factored.hpp>

namespace tangency::inline v0::detail {

// What is searched is f(n) = n.d - h_A(n) - h_B(n), or that of a clearance, n.d - h_A(n) + h_B(n):
// docs/derivations/containment.md, section 4. Both calls take a FactoredPair of the same kind.

inline constexpr double kTieOfSize = 2 * kUnitRoundoff;    ///< chosen: the rounding of two values
inline constexpr double kPlaneError = 32 * kUnitRoundoff;  ///< (G) of the derivation, of the size

/// The best maximum found: `global` where the branch and bound finished. Ties go to the first in
/// this order: that from `first`, the axes of A, those of B, each pointing with d (along
/// its positive direction where d is normal to it), then what the branch and bound comes upon.
/// Nothing where no ascent ended at a maximum. Allocates nothing.
/// @param first   where the first ascent starts
/// @param budget  the largest number of patches of the sphere to look at
std::optional<GapProof> search_sphere(const Pair& pair, const FactoredPair& factored,
                                      const Vec3& first, int budget) noexcept;

/// The same for bodies of revolution about one axis through both centres (spheres included), whose
/// maxima may tie along a circle: the search is along one meridian. Nothing for other pairs, and
/// where it does not finish. Ties go to the axis, pointing with d, and then to the first equal axis
/// of A (of B, if A is a sphere).
std::optional<GapProof> search_meridian(const Pair& pair, const FactoredPair& factored) noexcept;

}  // namespace tangency::inline v0::detail
