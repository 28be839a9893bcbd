// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pairs of ellipsoids as the families draw and place them: choose A, B's shape, a unit normal n
/// and a gap g, and put c_B = c_A + x_A(n) + g n + x_B(n). Then n is stationary with gap g, and it
/// is the global answer for g > -least_radii().
#pragma once

#include <array>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::verify {

struct EllipsoidPair {
  RawEllipsoid a, b;
};

/// Longest semi-axis `aspect` times the shortest, the middle log-uniform between, in any order.
std::array<double, 3> triaxial_axes(Draw& draw, double shortest, double aspect);

/// `axes` with a drawn orientation, centre 0.
RawEllipsoid turned_body(Draw& draw, const std::array<double, 3>& axes);

double least_axis(const RawEllipsoid& body);
double most_axis(const RawEllipsoid& body);
/// Of both bodies.
double least_axis(const EllipsoidPair& pair);
/// rho, a_min^2 / a_max of both added: deeper overlaps may have other answers than the one placed.
double least_radii(const EllipsoidPair& pair);

/// c_B = c_A + share x_A(n) + share x_B(n) + gap n, rounded to doubles. Returns what that left of
/// the gap along n, which with share 1 is the gap to second order in rounding / radius of
/// curvature.
Real place_b(EllipsoidPair& pair, const Real3& n, const Real& gap, const Real& share = 1);

}  // namespace tangency::verify
