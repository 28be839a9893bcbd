// SPDX-License-Identifier: MIT
/// @file
/// How the value f(n) = n.d - h_A(n) - h_B(n) bends at a normal, and the cap of normals around it
/// in which that bounds f: docs/derivations/gap-certificate.md, section 3.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::methods {

/// A pair in a unit in which nothing overflows: its size is within [2^-60, 2^62], semi-axes are at
/// least 2^-300.
struct Pair {
  const Ellipsoid& a;
  const Ellipsoid& b;
  Vec3 d;
  Vec3 d_low;   ///< c_B - c_A = d + d_low; each component at most u times that of d
  double size;  ///< |d| + a_A + a_B, the L of every bound

  Pair(const Ellipsoid& a_, const Ellipsoid& b_, const Vec3& d_, const Vec3& d_low_) noexcept
      : a(a_),
        b(b_),
        d(d_),
        d_low(d_low_),
        size(d_.norm() + (a_.largest_semi_axis() + b_.largest_semi_axis())) {}

  /// rho: a ball of this radius rolls inside A + (-B). Rounded down.
  double least_radius() const noexcept {
    return (1.0 - 0x1p-40) * (a.least_radius() + b.least_radius());
  }
};

/// (S) of the derivation: generously the rounding of curvatures and lengths in double.
inline constexpr double kRoundings = 0x1p-20;
inline constexpr double kMore = 1.0 + kRoundings, kLess = 1.0 - kRoundings;

/// The part of one body in the bending at a normal, along the two principal tangents.
struct SideBend {
  double h;             ///< support function
  double curvature[2];  ///< e' Hess h e: a radius of curvature of the body's normal section
  double stretch[2];    ///< |A' e|^2, A = R diag(a)
};

/// Principal tangents of Hess(h_A + h_B) at a normal, and its eigenvalues, each to a relative
/// accuracy far below 2^-20 wherever their ratio is below 2^80.
struct Bend {
  Vec3 tangent[2];
  double curvature[2];
  double skew;  ///< |e1' Hess e2| over the root of the product of the eigenvalues: rounding
  SideBend a, b;
};

/// @param h_a, h_b  the support functions at the normal
Bend bend_at(const Ellipsoid& a, const Ellipsoid& b, const Vec3& normal, double h_a,
             double h_b) noexcept;

/// e' Hess h e for unit normal n, unit tangent e and m = n x e: by m' adj(M) m / h^3, which keeps
/// its accuracy where M/h - x x'/h would cancel.
double hessian_along(const Ellipsoid& body, double h, const Vec3& m) noexcept;

/// What is known of f at a normal to first order.
struct Slope {
  double value;    ///< f
  double rest[2];  ///< r along the principal tangents
  double error;    ///< of each of the two
};

/// A convex cap of normals p around n in which f is at most f(n) + height, and which holds a
/// maximum of f. In the chart p = n + s, s normal to n, it is where |A's| <= width h_A and
/// |B's| <= width h_B.
struct Cap {
  bool proven = false;
  double height = 0.0;
  double width = 0.0;
  double eta = 0.0;      ///< the maximum lies where s' G s <= 4 eta^2 ...
  double least[2] = {};  ///< ... G >= diag(least) in the principal tangents
};

/// @param widest  the largest width wanted, > 0 and at most 1
Cap cap_around(const Bend& bend, const Slope& slope, double widest) noexcept;

/// v_1 / G_1 + v_2 / G_2
inline double in_inverse_norm(const Cap& cap, double v1, double v2) noexcept {
  return v1 / cap.least[0] + v2 / cap.least[1];
}

}  // namespace tangency::methods
