// SPDX-License-Identifier: MIT
/// @file
/// One-sided tests in double of how two solids lie: each either proves its answer or says that it
/// cannot. Error bounds: docs/derivations/relation-filter.md, whose names for them stand at each.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::methods {

enum class Filtered { apart, interiors_meet, unknown };

/// An answer, and the normal at which the search stopped, from A to B, of any length.
struct FilteredAt {
  Filtered answer;
  Vec3 normal;
};

/// Are the solids apart, or do their interiors meet? d = fl(c_B - c_A), centres not used otherwise.
/// Requires moderate() bodies and |d_i| <= 2^60.
Filtered filter_overlap(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept;
/// The same, with the normal.
FilteredAt filter_overlap_with_normal(const Ellipsoid& a, const Ellipsoid& b,
                                      const Vec3& d) noexcept;

/// True only where some point of A is outside B. Tried are the axes of both bodies and a normal from A
/// to B, each the way that leads away from B. Requires as filter_overlap().
bool proves_sticking_out(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                         const Vec3& normal) noexcept;

/// True only where A is inside the interior of B. Requires as filter_overlap().
bool proves_inside(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept;

}  // namespace tangency::methods
