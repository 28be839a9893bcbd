// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: the global signed gap of two solid ellipsoids between two proven bounds.
///
/// Branch and bound over the sphere of normals n for the greatest f(n) = n.d - h_A(n) - h_B(n), in
/// CGAL's interval arithmetic (Interval_nt: outward rounded doubles, rounding mode switched once a
/// call; the library is a dependency already and compiles to SSE2). What is proven with, on a cap
/// of angle theta about c, r the gradient of f at c:
///
///  (1) along the great circle from c in the direction e, f'' + f = -R, R = m'(J_A/h_A^3 +
///      J_B/h_B^3)m, J = adj M, and m = c x e the same all along; so with bounds h_A <= H_A, h_B <=
///      H_B on the cap, P(e) = m'(J_A/H_A^3 + J_B/H_B^3)m and X = e sin(angle),
///      f <= f(c) cos(angle) + r.X - P(e)(1 - cos(angle)), whose quadratic bound in X is maximised
///      by hand. At P = 0 this is the plane bound n.(d - x_A(c) - x_B(c)).
///  (2) where f + R > 0 on all of a cap and in every direction, f is concave along its great
///      circles, and the cap holds at most one stationary point.
///
///  (3) f(n) <= n.(d - x_A - x_B) for any points x_A of A, x_B of B; the points are chosen for the
///      creases of long bodies, where h turns within a cap.
///  (4) where |r| > theta max |f + R| on a cap it holds no stationary point; where f + R < 0 for
///  some
///      direction at each of its normals it holds no maximum.
///
/// A box (of a cube's face, seen from its centre, in a cap) is discarded if (1) or (3) lies below a
/// value of f that is reached, or if it lies in a cap by (2) about a maximum that Newton's method
/// found; else it is divided. So boxes do not cluster about isolated maxima; they do where maxima
/// tie along a curve (coaxial spheroids), and then the answer is a width.
///
/// Identities: (a) lower <= gap <= upper, whatever the budget; (b) `isolated` implies that every
/// local maximum with f >= lower - within is in one of `caps`, each with at most one.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

struct EnclosureLimits {
  double width = 0;                 ///< stop once upper - lower is no more; in the unit of length
  double within = 0;                ///< keep maxima that are lower than the best by up to this
  std::size_t most_boxes = 400000;  ///< chosen: about a second
};

/// All unit normals within `radius` (radians) of `centre` (unit to rounding).
struct NormalCap {
  std::array<double, 3> centre;
  double radius;
  double upper;  ///< f <= upper on the cap
  bool concave;  ///< f is concave on the cap and has a near-stationary point at its centre
};

struct GapEnclosure {
  double lower, upper;          ///< of the global gap
  std::vector<NormalCap> caps;  ///< every global maximiser is in one of them; best bounds first
  bool isolated;                ///< all caps are concave
  std::size_t boxes;            ///< spent
};

/// For bodies that differ by factors beyond 1e100 in size or distance the bounds may be infinite.
/// Throws std::invalid_argument unless both are ellipsoids.
GapEnclosure gap_enclosure(const RealEllipsoid& a, const RealEllipsoid& b,
                           const EnclosureLimits& limits = {});
GapEnclosure gap_enclosure(const RawEllipsoid& a, const RawEllipsoid& b,
                           const EnclosureLimits& limits = {});

}  // namespace tangency::inline v0::verify
