// SPDX-License-Identifier: MIT
/// @file
/// How two solid ellipsoids lie to each other, as point sets: exact for the stored doubles, with no
/// tolerance anywhere.
///
/// A filter in double answers where a proven error bound leaves no doubt
/// (docs/derivations/relation-filter.md: valid in all four rounding modes and where subnormal
/// numbers are flushed or read as zero); everything else goes to exact integers. The answers hold
/// for every ellipsoid that can be constructed.
///
/// (1) relation(b, a) is relation(a, b) with a_in_b and b_in_a, and the inner body, exchanged.
/// (2) overlaps(a, b) if and only if the relation is neither separate nor external_touch.
/// (3) Scaling both bodies by a power of two, permuting and reflecting coordinates, and all that
///     leaves the two solids as they are (see Ellipsoid) leave the answer.
/// (4) Growing a body never turns overlaps() off.
/// (5) overlaps(a, b) if and only if the true signed gap is < 0.
/// (6) Where overlaps_by_filter(a, b) answers, it is overlaps(a, b).
/// (7) A separation d in place of the centres leaves the answer to bodies whose centres are d apart
///     exactly: a about the origin and b about d.
/// (8) Of a body and a periodic image, relation(a, b, edges, image) is that of A and of B moved by
///     edges * image without rounding, though the image's centre is in general no triple of
///     doubles. With the image 0 it is relation(a, b).
/// (9) relation(b, a, edges, -image) is relation(a, b, edges, image) with the bodies exchanged.
///
/// The exact tier takes 15 us and a few kB for ordinary numbers; for numbers over the whole range
/// of doubles 20 ms at most (measured, docs/decisions/0009-broken-contracts-end-the-process.md). It
/// allocates, and where memory ends ends the process. A caller who can neither wait nor allocate
/// asks overlaps_by_filter().
#pragma once

#include <optional>
#include <string_view>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/tier.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// How two solids lie, as sets of points.
enum class Relation {
  separate,        ///< no common point
  external_touch,  ///< common points, interiors disjoint
  overlap,         ///< every other pair, whether or not the surfaces are also tangent somewhere
  internal_touch,  ///< one inside the other, not equal, boundaries meeting
  a_in_b,          ///< A inside the interior of B
  b_in_a,
  equal,
};

/// As the file formats write it: "separate", "external_touch", ...
std::string_view to_string(Relation relation) noexcept;

/// Which body lies within the other.
enum class Inner { none, a, b };

/// How two solids lie, and what decided it.
struct RelationAnswer {
  Relation relation;  ///< exact
  Inner inner;        ///< the body inside, for internal_touch; else none
  Tier tier;          ///< what decided it
};

/// The exact tier allocates; the filter does not.
RelationAnswer relation(const Ellipsoid& a, const Ellipsoid& b) noexcept;
/// The same with the separation d = c_B - c_A given, in place of the centres: for periodic images.
/// Exact for d as it is given.
/// @param a,b  the bodies, in this order
/// @param separation  finite, here and below: else the process ends with one line on standard error
RelationAnswer relation(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept;

/// Whether two solids share a point, and what decided it.
struct OverlapAnswer {
  bool overlaps;  ///< exact
  Tier tier;      ///< what decided it
};

/// Do the interiors meet, and which tier knew. The exact tier allocates; the filter does not.
OverlapAnswer overlap_answer(const Ellipsoid& a, const Ellipsoid& b) noexcept;
/// @overload
OverlapAnswer overlap_answer(const Ellipsoid& a, const Ellipsoid& b,
                             const Vec3& separation) noexcept;

/// Do the interiors meet?
inline bool overlaps(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return overlap_answer(a, b).overlaps;
}
/// @overload
inline bool overlaps(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept {
  return overlap_answer(a, b, separation).overlaps;
}

/// Of bodies given by matrices: exact for the numbers as they were given, not for rounded axes.
/// Takes some 50 us where the filter leaves a doubt, and allocates.
RelationAnswer relation(const MatrixEllipsoid& a, const MatrixEllipsoid& b) noexcept;
/// @overload
RelationAnswer relation(const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                        const Vec3& separation) noexcept;

/// Of A and an image of B, identities (8) and (9). Where the separation of the two is a vector of
/// doubles at the price of the pair alone, else some 15 us, of bodies by matrices 50 us; allocates
/// then.
/// @param a,b  the bodies, in this order
/// @param image  the image of b
/// @param edges  columns; finite. Those that the image does not count are not read
RelationAnswer relation(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
                        const LatticeImage& image) noexcept;
/// @overload
RelationAnswer relation(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const Mat3& edges,
                        const LatticeImage& image) noexcept;

/// The same by the filter alone: nothing where only the exact tier would know, at a touch or some
/// 1e-30 of the size from one, and for shapes or scales that are extreme. In bounded time (at most
/// a few us), and allocates nothing.
std::optional<bool> overlaps_by_filter(const Ellipsoid& a, const Ellipsoid& b) noexcept;
/// @overload
std::optional<bool> overlaps_by_filter(const Ellipsoid& a, const Ellipsoid& b,
                                       const Vec3& separation) noexcept;

}  // namespace tangency::inline v0
