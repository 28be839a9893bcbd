// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How the families place pairs of ellipsoids: choose A, B's shape, a unit normal n
/// and a gap g, and put c_B = c_A + x_A(n) + g n + x_B(n). Then n is stationary with gap g, and it
/// is the global answer for g > -least_radii().
#pragma once

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/pair.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

inline double rounded(const Real& v) { return v.convert_to<double>(); }

/// Uniform over the unit sphere.
Real3 drawn_direction(Draw& draw);

/// c_B = c_A + share x_A(n) + share x_B(n) + gap n, rounded to doubles. Returns what that left of
/// the gap along n, which with share 1 is the gap to second order in rounding / radius of
/// curvature.
Real place_b(EllipsoidPair& pair, const Real3& n, const Real& gap, const Real& share = 1);

}  // namespace tangency::inline v0::verify
