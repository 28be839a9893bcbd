// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Bodies and pairs as the families of ellipsoids draw them.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <tangency/verify/corpus/draw.hpp>
#include <tangency/verify/corpus/families.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::verify {

// Longest semi-axis `aspect` times the shortest, the middle log-uniform between, in any order.
std::array<double, 3> triaxial_axes(Draw& draw, double shortest, double aspect);

// `axes` with a drawn orientation, centre 0.
RawEllipsoid turned_body(Draw& draw, const std::array<double, 3>& axes);

double least_axis(const RawEllipsoid& body);
double most_axis(const RawEllipsoid& body);
// a_min^2 / a_max of both added: deeper overlaps may have other answers than the one placed.
double least_radii(const EllipsoidPair& pair);

// c_B = c_A + share x_A(n) + share x_B(n) + gap n, rounded; share 1: the gap is `gap`, along n, but
// for the rounding.
void place_b(EllipsoidPair& pair, const Real3& n, const Real& gap, const Real& share = 1);

// What the rounding of c_B made of the gap along n: the true gap to first order.
Real placed_gap(const EllipsoidPair& pair, const Real3& n);

// A sequence that goes on drawing where `draw_pair` has nothing.
using PairDraw = std::function<std::optional<EllipsoidPair>(Draw&)>;
InputFamily<EllipsoidPair> drawn_family(std::string name, std::size_t count, PairDraw draw_pair);

// The family of this name of verify/families/adversarial.hpp: one of those made of integers alone.
InputFamily<EllipsoidPair> integer_family(std::string_view name, std::size_t count);

}  // namespace tangency::verify
