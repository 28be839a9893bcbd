// SPDX-License-Identifier: MIT
/// @file
/// Curvature of ellipsoids where they touch: what a Hertz law needs [Johnson1985, sec. 4.1].
///
/// Curvatures in 1/length, positive (an ellipsoid is convex); directions in space, unit. Where the
/// outer normal of { c + y : y' M^-1 y <= 1 } is n the surface lies t' K t / 2 below its tangent
/// plane at a small distance t from the point of touch, K = h M^-1 restricted to the plane, h the
/// support function.
///
/// (1) curvature[0] curvature[1] = h(n)^4 / (a_1 a_2 a_3)^2.
/// (2) Points where the normals are n and -n have the same curvatures and directions.
/// (3) A rotation turns the directions; a scaling by s divides the curvatures by s.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::inline v0 {

/// Principal curvatures and directions of a surface, or of the distance between two.
struct PrincipalCurvatures {
  double curvature[2];  ///< 1/length, the larger first
  /// Unit and tangent; direction[0], direction[1] and the normal are a right-handed frame.
  /// direction[0] is one of two opposite ones, and any tangent where the curvatures are equal
  /// (umbilics; every point of a sphere).
  Vec3 direction[2];
};

/// Of a body's surface where its outer normal is `normal`: at support_point(normal).
///
/// Each curvature, the smaller one too, to a relative error of 128 u beta, u = 2^-53, beta = a_max
/// / h(n): that is how much the rounding of the rotation and of tangents matters. Directions to 64
/// u beta (k_0 + k_1) / (k_0 - k_1). Derived in docs/derivations/derivatives-and-curvature.md; the
/// largest seen is 57 u beta (tests/geometry/curvature_test.cpp). Any scale; no square leaves the
/// range of doubles for aspect ratios to 1e70. In any floating-point environment.
/// @param body  the body
/// @param normal  unit
PrincipalCurvatures surface_curvature(const Ellipsoid& body, const Vec3& normal) noexcept;

/// Curvatures at a contact.
struct ContactCurvature {
  PrincipalCurvatures a;  ///< of A at its witness point, with its outer normal n
  PrincipalCurvatures b;  ///< of B at its witness point, with its outer normal -n
  /// Of the distance between the surfaces, gap + t' (K_A + K_B) t / 2 across the tangent plane,
  /// with the normal n. In Hertz theory: curvature[0] = 1/R' = 2B and curvature[1] = 1/R'' = 2A,
  /// the contact ellipse is longest along direction[1], and sqrt(R' R'') is the equivalent radius.
  PrincipalCurvatures relative;
};

/// (4) Exchange, contact_curvature(b, a, -normal), exchanges a and b and leaves the relative
///     curvatures.
/// (5) The relative curvatures add up to the four of the bodies.
///
/// The bodies' curvatures err as surface_curvature's, the relative ones by 512 u beta, the smaller
/// one by 2^-91 beta times the larger aspect ratio more, with the larger beta; directions by as
/// much as the bodies'. Two large curvatures that are nearly parallel leave a small one that
/// depends on the angle between them: it is computed in double-double. For pairs whose longest
/// semi-axis is up to 1e70 times the shortest. In any floating-point environment.
/// @param a,b  the bodies, in this order
/// @param normal  unit, from A to B: Gap::normal
ContactCurvature contact_curvature(const Ellipsoid& a, const Ellipsoid& b,
                                   const Vec3& normal) noexcept;

}  // namespace tangency::inline v0
