// SPDX-License-Identifier: MIT
/// @file
/// The gap from the factors A = R diag(a) of the shape matrices M = A A': the robust path. No
/// product of semi-axes is formed before a norm is, so that the condition of a shape is its aspect
/// ratio and not the square of it.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/normals/newton.hpp>

namespace tangency::inline v0::detail {

/// A pair whose size |d| + a_A + a_B is within [2^-60, 2^62].
class FactoredPair {
 public:
  /// @param nested  is f(n) = n.d - h_A + h_B, for a clearance, what is evaluated and climbed?
  FactoredPair(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, bool nested = false) noexcept;

  /// f(n) = n.d - h_A - h_B, or that of a clearance, at a unit normal; within 12 u of the size.
  double value(const Vec3& normal) const noexcept;

  /// R diag(a) of A, and of B.
  const Mat3& factor_a() const noexcept { return factor_a_; }
  const Mat3& factor_b() const noexcept { return factor_b_; }

  /// The Perram-Wertheim normal, by bracketing. Requires d != 0.
  Vec3 perram_wertheim_normal() const noexcept;

  /// Ascent to a local maximum: Newton's method in the tangent plane, with the absolute values of
  /// the curvatures where the function is not concave, and backtracking.
  Stationary climb(const Vec3& start) const noexcept;

  /// The axis of a body (0 to 2: A's, 3 to 5: B's), pointing with d; along the positive body axis
  /// where d is normal to it.
  Vec3 axis(int i) const noexcept;

 private:
  struct Tangent;
  Tangent tangent(const Vec3& normal) const noexcept;

  Mat3 factor_a_, factor_b_;
  Vec3 d_;
  double size_;
  double sign_b_;  ///< f = n.d - h_A - sign_b h_B
};

}  // namespace tangency::inline v0::detail
