// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The kit of the adversarial families: bodies of integers, and two of them that touch exactly.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify::construction {

using Vector = std::array<mpz_class, 3>;
using Quaternion = std::array<int, 4>;  ///< w x y z

/// Entries from -2 to 2, not all 0.
Quaternion small_quaternion(Draw& draw);

int norm(const Quaternion& q);  ///< w^2 + x^2 + y^2 + z^2

/// norm(q) R(q) v, or norm(q) R(q)' v.
Vector turned(const Quaternion& q, const Vector& v, bool back = false);

struct ExactBody {
  Vector centre, axes;
  Quaternion q{1, 0, 0, 0};
};

/// The body times 2^exponent. Nothing unless every number is a double: below 2^53 before that.
std::optional<RawEllipsoid> raw(const ExactBody& body, int exponent = 0);

/// An integer point of a sphere of integer radius, no coordinate zero.
struct SpherePoint {
  Vector u;
  int radius;
};

SpherePoint sphere_point(Draw& draw);

/// Entries from -size to size, and from 1 to largest.
Vector small_vector(Draw& draw, int size);
Vector small_axes(Draw& draw, int largest);

/// Two integer bodies that touch in an integer point with a common normal n (outward for A).
/// With the surface point R diag(a) u the normal is R diag(1/a) u: u is an integer point of a
/// sphere, and B's semi-axes are whatever gives its own such point the normal -n (outside) or n
/// (inside).
struct Contact {
  ExactBody a, b;
  Vector n;
  /// Outside: sum of the smallest radii of curvature; inside: A's smallest - B's largest.
  double rho;
  bool inside;
};

/// Nothing if this draw leads to no contact.
std::optional<Contact> contact(Draw& draw, bool inside);

}  // namespace tangency::inline v0::verify::construction
