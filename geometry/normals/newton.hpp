// SPDX-License-Identifier: MIT
/// @file
/// The gap by Newton's method on the sphere of normals, without a tangent basis: the fast path.
#pragma once

#include <cmath>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/symmetric3.hpp>

namespace tangency::inline v0::detail {

/// Where a search stopped, and whether it may be believed.
struct Stationary {
  Vec3 normal;    ///< unit
  bool accepted;  ///< a strict local maximum of n.d - h_A - h_B
};

/// Newton's step from normals near one at which the tangent Hessian -K of n.d - h_A - h_B was
/// formed: K^-1 = (P j P + gap P) / det K, j = J_A / h_A^3 + J_B / h_B^3, P the projection on the
/// tangent plane.
struct NewtonStep {
  Symmetric3 j;
  Vec3 jn;
  double gap;
  double inverse_determinant;
  double turned;  ///< |step|^2 from that normal, in rad^2: each later step leaves that part of it

  /// @param r  tangential rest at `normal`
  Vec3 operator()(const Vec3& r, const Vec3& normal) const noexcept {
    return inverse_determinant * ((j * r - jn.dot(r) * normal) + gap * r);
  }
};

/// Where one step is left, which prove_gap_and_step() of gap/proof.hpp takes.
struct NearlyStationary : Stationary {
  NewtonStep step;  ///< where accepted
};

/// Newton's method from a unit normal. Accepted where the tangent Hessian was negative definite at
/// *every* step and the last step gained less than 2^-54 of the size of the pair, below the
/// rounding of the lengths that are added; "the last step was small" alone lets wrong answers
/// through on extreme shapes. What it returns is still to be proven: gap/proof.hpp. Requires
/// moderate() bodies.
Stationary newton_from(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                       const Vec3& normal) noexcept;

/// The same, but accepted where what is left of the way, as the lengths of the steps so far tell,
/// is one short step: for shapes whose curvature varies moderately.
NearlyStationary newton_near(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                             const Vec3& normal) noexcept;

/// Newton's start, the Perram-Wertheim normal: unit. Requires moderate() bodies and d != 0.
Vec3 newton_start(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept;

/// n / |n|; cheap for |n| near 1. Within 3.65 u of unit length: gap-certificate.md, section 2.
inline Vec3 renormalised(const Vec3& n) noexcept {
  const double x = n.squaredNorm() - 1.0;
  if (!(std::abs(x) < 0x1p-18)) [[unlikely]]
    return n.normalized();
  return n * (1.0 - x * (0.5 - 0.375 * x));  // the series of 1 / sqrt(1 + x), to below rounding
}

}  // namespace tangency::inline v0::detail
