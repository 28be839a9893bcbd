// SPDX-License-Identifier: MIT
/// @file
/// First and second derivatives of the signed gap: stiffnesses, sensitivities, optimisation.
///
/// Parameters, 18 in this order, six blocks of three:
///
///     (c_A, v_A, a_A, c_B, v_B, a_B)
///
/// c a centre, in space; v a rotation vector in space, rad: the body's R becomes exp([v]x) R, the
/// centre staying where it is, and derivatives are taken at v = 0; a the semi-axes in the order in
/// which the body stores them. Where n is the only best normal,
///
///     dg/dc_B = n = -dg/dc_A,  dg/dv_A = -(p_A - c_A) x n,  dg/dv_B = (p_B - c_B) x n,
///     dg/da_k = -a_k (R'n)_k^2 / h  for the body that owns the axis,
///
/// and with f(n; theta) = n.d - h_A - h_B, subscripts for derivatives on the tangent plane of the
/// sphere of normals, and W = -f_nn = Hess h_A + Hess h_B + g I,
///
///     Hess g = f_theta_theta + f_theta_n W^-1 f_n_theta.
///
/// (1) Moving both bodies alike changes nothing: dg/dc_A + dg/dc_B = 0; rows of the Hessian alike.
/// (2) Turning both bodies about the origin changes nothing:
///     c_A x dg/dc_A + dg/dv_A + c_B x dg/dc_B + dg/dv_B = 0.
/// (3) The gap is homogeneous of degree one: the lengths times their derivatives add up to g, and
///     the Hessian times the vector of the lengths is 0 in the rows of lengths and the gradient's
///     in the rows of angles.
/// (4) Exchange of the bodies exchanges the blocks.
/// (5) The Hessian is symmetric to the last bit.
///
/// Turns do not commute: the rate of change of dg/dv along a turn is the Hessian's column plus half
/// of (turn) x (dg/dv).
#pragma once

#include <tangency/geometry/gap.hpp>

namespace tangency::inline v0 {

/// Where a body's three parameters of a kind start; B's are 9 further.
enum GapParameter { kCentre = 0, kRotation = 3, kSemiAxes = 6, kOfBodyB = 9 };

// Unaligned, so that the layout is the same whatever instruction set a user compiles for.
/// First derivatives by the 18 parameters, in the order of the file's head.
using GapGradient = Eigen::Matrix<double, 18, 1, Eigen::DontAlign>;
/// Second derivatives by the 18 parameters.
using GapHessian = Eigen::Matrix<double, 18, 18, Eigen::DontAlign>;

/// Whether the derivatives exist and are known.
enum class DerivativeStatus {
  ok,          ///< derivatives of the gap
  local,       ///< of the branch of a `local` Gap: the gap's where no other branch ties or leads
  tie,         ///< n and -n reach equally far, up to rounding: the gap has no derivative
  degenerate,  ///< W is not safely positive definite: a circle of tied normals, a centre of
               ///< curvature, a pair too extreme for doubles, or a gap that is `beyond`
};

/// Gradient and Hessian are all 0 where the status is neither `ok` nor `local`.
struct GapDerivatives {
  GapGradient gradient;     ///< unit: length over that of the parameter (length or rad)
  GapHessian hessian;       ///< unit: length over those of the two parameters
  double least_radius;      ///< smallest eigenvalue of W, a length: how sharp the best normal is
  DerivativeStatus status;  ///< the numbers are derivatives where it is `ok` or `local`
};

/// Derivatives at an answer of signed_gap() or follow_gap() for these bodies.
///
/// Conditioning. With L = |d| + a_A + a_B (the largest semi-axes), kappa = 1 + L / least_radius,
/// beta the larger a_max / h(n) of the bodies, and deep = 1 + |g| / least_radius for g < 0, where W
/// is a difference, and 1 otherwise; kappa' = kappa deep. Scales s_i: 1 for a centre, L beta for an
/// angle, beta for a semi-axis, for a support point moves beta times as fast as the normal.
///
///     errors of the gradient  <= 128 u deep (kappa + sqrt(kappa beta)) s_i,
///     errors of the Hessian   <= 16 u kappa' beta s_i s_j / least_radius,
///
/// u = 2^-53. The first is derived for every aspect ratio, the second measured for those to 1e8
/// (docs/derivations/derivatives-and-curvature.md, which has the largest seen of both; tested by
/// tests/geometry/gap_derivatives_test.cpp on random normals and on the faces of discs).
///
/// A pair is `degenerate` where u kappa' beta > 2^-10 or Newton's method does not settle. Where g >
/// -rho, least_radius >= g + rho, rho the sum of the bodies' a_min^2 / a_max. Ties between
/// *separate* local maxima are known to the search alone: where the Gap is `local`, so are its
/// derivatives. Any scale; does not allocate.
/// @param a,b  the bodies, in this order
/// @param gap  of this pair; only its status and normal, polished here by Newton's method, are used
GapDerivatives gap_derivatives(const Ellipsoid& a, const Ellipsoid& b, const Gap& gap) noexcept;

/// The same with the separation d = c_B - c_A given, in place of the centres.
/// @param a,b  the bodies, in this order
/// @param gap  the answer for this pair
/// @param separation  finite: else the process ends with one line on standard error
GapDerivatives gap_derivatives(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
                               const Gap& gap) noexcept;

}  // namespace tangency::inline v0
