// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Normals that are as good as the true ones, where normals nearly tie.
///
/// The gap is the greatest f(n) = n.d - h_A(n) - h_B(n) (gap.hpp). Where maxima of f differ by less
/// than the rounding of the inputs, or f is level along a curve up to that, the true normal is a
/// matter of the last bits: an answer that lies far from it may be the true one of a pair that the
/// same table could as well have meant.
///
/// Let every number of the pair change by a share of at most u = 2^-53, L = |d| + both largest
/// semi-axes (of the space between the bodies alone: B's centre is taken relative to A's). A
/// quaternion of such components turns a body by 2u at most. Then, to first order in u,
///
///  (1) f(n) changes by at most u|d| + (1 + 2) u (a_max + b_max) <= 4 u L for every n: h_A changes
///      by at most u a_max with the semi-axes and by 2u a_max with the orientation. So a true
///      normal of the changed pair has f(n) >= gap - 8 u L in the stored one.
///  (2) r(n), the part of d - x_A(n) - x_B(n) across n, is 0 at a true normal. It changes by at
///  most
///      u|d| + (3 + 2) u (a_max + b_max) + 2 u R, R = a_max^2/a_min + b_max^2/b_min: x_A(n) =
///      M n / h_A moves by 3 u a_max with the semi-axes, and with the orientation by 2u times
///      itself and 2u times the largest radius of curvature a_max^2/a_min. So |r(n)| <= 6 u (L +
///      R).
///  (3) The answer is itself rounded, by as much at most: twice (1) and (2) are allowed.
///
/// Neither alone is enough. By (1) alone a normal on a sharp tip could be off by sqrt(u), by (2)
/// alone it could be that of a lower maximum.
#pragma once

#include <array>

#include <tangency/verify/families/pair.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

/// Is its direction true up to rounding, by (1) to (3)? In 150 digits. Not that of 0 0 0.
/// @param normal  finite, of any length
/// @param gap  the true one
bool is_normal_within_rounding(const EllipsoidPair& pair, const std::array<double, 3>& normal,
                               const Real& gap);

}  // namespace tangency::inline v0::verify
