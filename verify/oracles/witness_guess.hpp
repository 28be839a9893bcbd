// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Floating-point guesses of witnesses for the relation oracle. Nothing here proves anything: every
/// guess is verified on integers by its reader, and no guess is an answer of its own.
///
/// Frame: origin at A's centre, the unit of the input. Level functions q_A and q_B are -1 at the
/// centre, 0 on the surface.
#pragma once

#include <array>
#include <optional>
#include <variant>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

using Point = std::array<long double, 3>;

/// One body in long double, whose exponents hold squares and cubes of every double.
struct ApproximateBody {
  Point centre;                        ///< from A's centre
  std::array<Point, 3> axes;           ///< unit vectors
  std::array<long double, 3> lengths;  ///< semi-axes
  std::array<Point, 3> form;           ///< M^-1
};

ApproximateBody approximate_body(const RawEllipsoid& body, const Point& centre);

/// sign_a q_A t + sign_b q_B may be positive definite at this t > 0.
struct DefiniteMember {
  long double t;
};

/// A point that may lie inside both.
struct CommonPoint {
  Point x;
};

using Guess = std::variant<std::monostate, DefiniteMember, CommonPoint>;

/// Bisects t for the member t sign_a q_A + sign_b q_B with the largest smallest value. Signs (+,+):
/// a definite member, or a common point met on the way; (+,-) and (-,+): a definite member.
Guess guess_member(const ApproximateBody& a, const ApproximateBody& b, int sign_a, int sign_b);

/// A point of `body` that may lie outside `other`: tried are the support points in the directions
/// of both bodies' axes and of the line of centres, drawn in a little.
std::optional<Point> guess_protruding_point(const ApproximateBody& body,
                                            const ApproximateBody& other);

}  // namespace tangency::inline v0::verify
