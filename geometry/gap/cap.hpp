// SPDX-License-Identifier: MIT
/// @file
/// How the value f(n) = n.d - h_A(n) - h_B(n) bends at a normal, and the cap of normals around it
/// in which that bounds f: docs/derivations/gap-certificate.md, section 3. For a clearance, where
/// f(n) = n.d - h_A(n) + h_B(n): docs/derivations/containment.md, section 3.
#pragma once

#include <tangency/geometry/bodies/double_double_body.hpp>
#include <tangency/geometry/bodies/scaled_pair.hpp>

namespace tangency::inline v0::detail {

/// A pair in a unit in which nothing overflows: its size is within [2^-60, 2^62], semi-axes are at
/// least 2^-300.
struct Pair : UnitPair<Ellipsoid> {
  Vec3 d_low;   ///< c_B - c_A = d + d_low; each component at most u times that of d
  double size;  ///< |d| + a_A + a_B, the L of every bound
  Sought sought;

  [[gnu::always_inline]] explicit Pair(const AskedPair<Ellipsoid>& pair,
                                       Sought wanted = Sought::gap) noexcept
      : Pair(pair, pair.d(), wanted) {}
  /// rho: f'' + f <= -rho along every great circle; for a gap a ball of this radius rolls inside
  /// A + (-B). Rounded down.
  double least_radius() const noexcept { return least_radius_of(a, b, sought); }

 private:
  [[gnu::always_inline]] Pair(const AskedPair<Ellipsoid>& pair, const Vec3& given,
                              Sought wanted) noexcept
      : UnitPair(pair, given, moderate_size(pair.a, pair.b, given) && thick_enough(pair.a, pair.b)),
        d_low(rest_of_d()),
        size(d.norm() + (a.largest_semi_axis() + b.largest_semi_axis())),
        sought(wanted) {}
};

/// (S) of the derivation: generously the rounding of curvatures and lengths in double, but for what
/// thin bodies amplify.
inline constexpr double kRoundings = 0x1p-20;
inline constexpr double kMore = 1.0 + kRoundings, kLess = 1.0 - kRoundings;

/// The part of one body in the bending at a normal, along the two principal tangents e. All but for
/// 2^-40 of themselves.
struct SideHessian {
  double h;             ///< support function, at most
  double curvature[2];  ///< e' Hess h e, a radius of curvature of a normal section, at least
  double stretch[2];    ///< |A' e|^2, A = R diag(a), at least
};

/// Principal tangents e1, e2 of H = Hess(h_A + h_B) at a normal, and bounds of H from below.
struct Hessian {
  Vec3 tangent[2];
  double curvature[2];  ///< c_i: H >= (1 - loss) (c_1 e1 e1' + c_2 e2 e2') in the tangent plane
  double loss;          ///< (S) of the derivation: rounding, which thin bodies amplify
  SideHessian a, b;
  double off = 0.0;  ///< of a difference: its rounding
};

/// A body at a normal, as evaluated in double-double.
struct SideAt {
  const DoubleDoubleSide& side;
  Vec3 point;  ///< support point, rounded
};

/// @param normal  unit: what both sides were evaluated at
Hessian hessian_at(const SideAt& a, const SideAt& b, const Vec3& normal) noexcept;

/// The same for a clearance: H = Hess(h_A - h_B), in the tangent plane within `off` of diag(c_1,
/// c_2), which may be of any sign; no `loss`.
Hessian difference_at(const SideAt& a, const SideAt& b, const Vec3& normal) noexcept;

/// What is known of f at a normal to first order.
struct Gradient {
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
Cap cap_around(const Hessian& hessian, const Gradient& gradient, double widest) noexcept;

/// The same for a clearance, with the Hessian of difference_at().
Cap cap_within(const Hessian& hessian, const Gradient& gradient, double widest) noexcept;

/// v_1 / G_1 + v_2 / G_2
inline double in_inverse_norm(const Cap& cap, double v1, double v2) noexcept {
  return v1 / cap.least[0] + v2 / cap.least[1];
}

}  // namespace tangency::inline v0::detail
