// SPDX-License-Identifier: MIT
/// @file
/// How two solid ellipses lie to each other, and in how many points their boundaries meet: exact
/// for the stored doubles, with no tolerance anywhere. The words are those of relation.hpp.
///
/// A filter in double with a running error bound answers where that leaves no doubt; everything
/// else goes to exact integers (docs/derivations/ellipses.md).
///
/// (1) relation(b, a) is relation(a, b) with a_in_b and b_in_a, and the inner body, exchanged.
/// (2) overlaps(a, b) if and only if the relation is neither separate nor external_touch.
/// (3) Scaling both by a power of two, exchanging and reflecting coordinates, and all that leaves
///     the two solids as they are (see Ellipse) leave the answer.
/// (4) Without a common point or with one inside the other's interior there are no crossings; an
///     external touch has one, an internal one 1 or 2, an overlap 2, 3 or 4.
#pragma once

#include <optional>

#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/matrix_ellipse.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0 {

/// How two ellipses lie, and what decided it.
struct EllipseRelation {
  Relation relation;  ///< exact
  Inner inner;        ///< the body inside, for internal_touch; else none
  /// Distinct real points that the two boundaries have in common: 0 to 4; nothing where they are
  /// equal.
  std::optional<int> crossings;
  Tier tier;  ///< what decided it
};

/// The exact tier allocates; the filter does not.
EllipseRelation relation(const Ellipse& a, const Ellipse& b) noexcept;
/// The same with the separation d = c_B - c_A given, in place of the centres: for periodic images.
/// Exact for d as it is given.
/// @param a,b  the bodies, in this order
/// @param separation  finite
EllipseRelation relation(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept;

/// Of ellipses given by matrices: exact for the numbers as they were given. Allocates.
EllipseRelation relation(const MatrixEllipse& a, const MatrixEllipse& b) noexcept;

/// Do the interiors meet?
bool overlaps(const Ellipse& a, const Ellipse& b) noexcept;
/// @overload
bool overlaps(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept;

}  // namespace tangency::inline v0
