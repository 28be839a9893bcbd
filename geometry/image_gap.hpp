// SPDX-License-Identifier: MIT
/// @file
/// The signed gap of a body and of a periodic image of another or of itself: of A and of B moved by
/// edges * image (lattice.hpp), meant without rounding, though c_B + edges * image is in general no
/// triple of doubles. Conventions and promises are those of gap.hpp; relation() of the same pair is
/// in relation.hpp.
///
/// (1) The gap is within gap_error of the true one where `ok`, and has the sign of relation(a, b,
///     edges, image): 0 for a touch.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// What the separation is rounded by goes into gap_error. Allocates only where the exact relation
/// decides the sign.
/// @param a,b  the bodies, in this order
/// @param image  the image of b
/// @param edges  columns; finite. Those that the image does not count are not read
Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
               const LatticeImage& image) noexcept;
/// @overload
Gap signed_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const Mat3& edges,
               const LatticeImage& image) noexcept;

/// The answer for the true pair from one for bodies that are altogether `off` further away: by
/// separation() of lattice.hpp and by MatrixEllipsoid::rounding().
/// @param rounded  the gap at the rounded separation
/// @param a,b  the bodies, in this order
/// @param edges  columns: the edge vectors of the cell
/// @param image  the image of b
/// @param off  length, >= 0
Gap widened_gap(const Gap& rounded, double off, const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                const Mat3& edges, const LatticeImage& image) noexcept;

}  // namespace tangency::inline v0
