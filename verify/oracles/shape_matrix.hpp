// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracles for ellipsoids by shape matrices, for the stored entries: { x : (x - c)' M^-1 (x - c) <=
/// 1 }.
///
/// (1) The relation is that of the integer forms adj(M) with level det(M), by the pencil alone
///     (relation.hpp).
/// (2) Semi-axes and axes are roots of eigenvalues, and eigenvectors, in 150 digits. Eigenvalues
///     that agree to 1e-100 are one: entries that are doubles keep others farther apart, but where
///     shapes are flatter than 1e30.
#pragma once

#include <array>

#include <tangency/verify/oracles/real_ellipsoid.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

/// Requires finite numbers and a positive definite matrix.
struct RawShapeMatrix {
  std::array<double, 3> centre;
  std::array<double, 6> entries;  ///< xx yy zz xy yz zx
};

/// Throws std::invalid_argument unless both are ellipsoids.
ExactRelation exact_relation(const RawShapeMatrix& a, const RawShapeMatrix& b);

/// To 140 digits. Throws as above.
RealEllipsoid real(const RawShapeMatrix& body);

}  // namespace tangency::inline v0::verify
