// SPDX-License-Identifier: MIT
/// @file
/// One-sided tests in double of how two solids lie: each either proves its answer or says that it
/// cannot. Error bounds: docs/derivations/relation-filter.md, whose names for them stand at each.
#pragma once

#include <tangency/geometry/normals/perram_wertheim.hpp>

namespace tangency::inline v0::detail {

enum class Filtered { apart, interiors_meet, unknown };

/// Are the solids apart, or do their interiors meet? Allocates nothing.
class OverlapFilter {
 public:
  /// @param d  fl(c_B - c_A); centres are not used otherwise
  /// Requires moderate() bodies and |d_i| <= 2^60; the bodies must outlive the filter.
  OverlapFilter(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept;

  Filtered answer() const noexcept { return answer_; }
  /// The normal at which the search stopped, from A to B, its largest component in [1, 2); a
  /// coordinate axis where the centres coincide or nearly so.
  Vec3 normal() const noexcept { return settled_ ? normal_ : scaled_normal(); }

 private:
  Vec3 scaled_normal() const noexcept;
  /// For what the polynomials cannot tell.
  void settle(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept;

  PerramWertheimForm form_;
  double l_;
  Filtered answer_ = Filtered::unknown;
  bool settled_ = false;
  Vec3 normal_;
};

/// True only where some point of A is outside B. Tried are the axes of both bodies and a normal
/// from A to B, each the way that leads away from B. Requires as OverlapFilter.
bool proves_sticking_out(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                         const Vec3& normal) noexcept;

/// True only where A is inside the interior of B. Requires as OverlapFilter.
bool proves_inside(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept;

// The tests of overlap_filter at one normal and one point, in double-double: for pairs too close
// to a touch, or too extreme, for double. Error bounds: docs/derivations/relation-filter.md,
// section 4.

/// Are the solids apart, or do their interiors meet, as the normal `n` (largest component in [1,
/// 2)) tells? c_B - c_A = d + d_low exactly. Requires the default floating-point environment and as
/// OverlapFilter.
Filtered filter_overlap_in_double_double(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                                         const Vec3& d_low, const Vec3& n) noexcept;

}  // namespace tangency::inline v0::detail
