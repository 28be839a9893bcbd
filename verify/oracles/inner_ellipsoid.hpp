// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How deep a pair is at least, by one ellipsoid. Inner header of the gap oracles; the derivation
/// is in docs/derivations/cheap-oracle.md.
///
/// Let P = diag(a) R' of a body, so that h(n) = |P n|. For every orthogonal O, |P_A n + O P_B n| <=
/// h_A(n) + h_B(n): the ellipsoid E with h_E(n) = |T n|, T = P_A + O P_B, lies in A - B about d =
/// 0. Let M = T'T. For every m > 0 with K = M - m I positive definite, a ball of the radius t, t^2
/// = m (1 - d'K^-1 d), about d lies in E where t^2 > 0, and then gap <= -t.
#pragma once

#include <array>
#include <optional>

#include <tangency/verify/oracles/proven_body.hpp>

namespace tangency::inline v0::verify {

/// An upper bound of d'K^-1 d; nothing where K, symmetric by its rows, is not proven to be positive
/// definite. The bound is close where v is near K^-1 d.
std::optional<Ball> inverse_form(const std::array<Ball3, 3>& k, const Ball3& d, const Ball3& v);

/// Minus this is an upper bound of the gap, in the unit of the bodies; nothing where none is
/// proven. It is f(n) itself but for roundings where n is the best normal of E.
/// @param d  c_B - c_A
/// @param n  unit to rounding, the best normal that is known
/// @param depth  -f(n), whose error counts for nothing
std::optional<Ball> depth_by_inner_ellipsoid(const ProvenBody& a, const ProvenBody& b,
                                             const Ball3& d, const Ball3& n, const Ball& depth);

}  // namespace tangency::inline v0::verify
