// SPDX-License-Identifier: MIT
/// @file
/// Where the boundaries of two solid ellipses meet, the area that the solids have in common, and
/// the contact of the published plane scheme, which is built on the chord between two crossings.
///
/// How many points there are, and of which multiplicity, is exact (ellipse_relation.hpp); where
/// they are follows from one quartic in the tangent of the half angle, turned away from its
/// singularity, in double-double. Two crossings closer than about 1e-15 of the size come out as
/// one point twice; the places of bodies that differ by hardly more than rounding are uncertain as
/// 2^-100 over that difference. In any floating-point environment. Allocates only
/// where the relation needs exact integers.
///
/// (1) Exchanging the bodies leaves every number but for what it exchanges: the arms, the sign of
///     the normal.
/// (2) A crossing lies on both boundaries; multiplicities add up to at most 4.
/// (3) 0 <= common_area <= the smaller of the two areas, which it is where one holds the other.
/// (4) The chord's line through the contact point along the normal leaves A in arm_a and B in
///     arm_b: depth is the thickness of the common region along it.
#pragma once

#include <array>

#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/matrix_ellipse.hpp>

namespace tangency::inline v0 {

/// A common point of two boundaries.
struct Crossing {
  Vec2 arm_a = Vec2::Zero();  ///< from the centre of A
  Vec2 arm_b = Vec2::Zero();  ///< from the centre of B
  int multiplicity = 0;       ///< 1 where they cross, 2 to 4 where they touch
};

/// The common points of two boundaries.
struct Crossings {
  int count;   ///< distinct points; 0 where the boundaries are equal
  bool equal;  ///< are the ellipses the same set, with every point of the boundary common?
  /// In the order of (x, y) from the centre of A, and from the centre of B alike; those that are
  /// no crossings, from `count` on, have multiplicity 0.
  std::array<Crossing, 4> at;
};

/// @overload
Crossings crossings(const Ellipse& a, const Ellipse& b) noexcept;
/// With d = c_B - c_A given, in place of the centres, here and below: for periodic images.
Crossings crossings(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept;
/// Of ellipses given by matrices: count and multiplicities are exact for their numbers as they were
/// given, and the places those of MatrixEllipse::ellipse() of each. Allocates.
Crossings crossings(const MatrixEllipse& a, const MatrixEllipse& b) noexcept;

/// Area of the common region, with a relative error of 1e-13 where bodies of aspect ratios to 1000
/// overlap by 1e-16 of their size and more. Infinite above the range of doubles; below it rounded
/// to a subnormal or to 0, for bodies that overlap too.
double common_area(const Ellipse& a, const Ellipse& b) noexcept;
/// @overload
double common_area(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept;

/// Whether the plane scheme has an answer.
enum class ChordStatus {
  ok,
  not_applicable,  ///< the boundaries do not cross in exactly two points
};

/// The contact of the published plane scheme.
struct ChordContact {
  ChordStatus status;  ///< the numbers are those of a contact where it is `ok`
  double depth;        ///< along the normal through the chord's midpoint, > 0
  Vec2 normal;  ///< unit, perpendicular to the chord, to the side where A's boundary is inside B
  Vec2 arm_a;   ///< where that line leaves A, from the centre of A
  Vec2 arm_b;   ///< where it leaves B the other way, from the centre of B
  Vec2 point;   ///< half-way between the two: the contact point, from the centre of A
};

/// Not applicable, too, where the boundaries touch in two points without crossing.
ChordContact chord_contact(const Ellipse& a, const Ellipse& b) noexcept;
/// @overload
ChordContact chord_contact(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept;

}  // namespace tangency::inline v0
