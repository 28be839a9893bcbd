// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pairs of ellipsoids and their shapes as the families draw them. In doubles alone, so that who
/// only takes pairs reads no header of high precision.
#pragma once

#include <array>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

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

}  // namespace tangency::inline v0::verify
