// SPDX-License-Identifier: MIT
/// @file
/// A body, and a periodic image of another or of itself: relation and gap of A and of B moved by
/// edges * image (lattice.hpp), meant without rounding, though c_B + edges * image is in general no
/// triple of doubles. Conventions are those of relation.hpp and gap.hpp. All answers are the same
/// in every floating-point environment.
///
/// (1) relation() is exact for the doubles as stored; with the image 0 it is that of relation.hpp.
/// (2) relation(b, a, edges, -image) is relation(a, b, edges, image) with the bodies exchanged.
/// (3) signed_gap() is within its gap_error of the true one where `ok`, and has the sign of
///     relation(): 0 for a touch.
/// (4) The true separation is within separation().error of separation().vector; error 0 says that
///     it is that vector.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency {

/// c_B + edges * image - c_A, rounded.
struct ImageSeparation {
  Vec3 vector;   ///< finite; where the true one is not within the range of doubles, the nearest
  double error;  ///< of its length; infinite where the true one is beyond the range of doubles
};

/// @param edges  columns; finite, here and below. Those that the image does not count are not read
ImageSeparation separation(const Vec3& centre_a, const Vec3& centre_b, const Mat3& edges,
                           const LatticeImage& image) noexcept;

/// Where the separation is a vector of doubles at the price of relation.hpp, else some 15 us, of
/// bodies by matrices 50 us; allocates then.
RelationAnswer relation(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
                        const LatticeImage& image) noexcept;
RelationAnswer relation(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const Mat3& edges,
                        const LatticeImage& image) noexcept;

/// signed_gap() of that pair; what the separation is rounded by goes into gap_error.
Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
               const LatticeImage& image) noexcept;
Gap signed_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const Mat3& edges,
               const LatticeImage& image) noexcept;

/// The answer for the true pair from one for bodies that are altogether `off` further away: of
/// separation() and of MatrixEllipsoid::rounding().
/// @param off  length, >= 0
Gap widened_gap(const Gap& rounded, double off, const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                const Mat3& edges, const LatticeImage& image) noexcept;

}  // namespace tangency
