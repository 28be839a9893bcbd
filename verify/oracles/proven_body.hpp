// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// An ellipsoid with a proven error beside every number (ball.hpp). Inner header of the oracles
/// that prove in microseconds. Lengths are in a unit of the reader's, a power of two; points are
/// relative to the body's centre.
#pragma once

#include <array>

#include <tangency/verify/oracles/ball.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

class ProvenBody {
 public:
  /// Lengths in units of 2^unit. Throws std::invalid_argument unless it is an ellipsoid: finite,
  /// semi-axes > 0, orientation not 0.
  ProvenBody(const RawEllipsoid& body, int unit);

  /// a_min^2 / a_max, the least radius of curvature.
  const Ball& least_radius() const { return radius_; }
  /// diag(a) R'n, of the length h(n) for a unit n, in body axes.
  Ball3 stretched(const Ball3& n) const;
  /// The rows of diag(a) R'.
  std::array<Ball3, 3> rows() const;
  /// h(n) for n of any length.
  Ball support(const Ball3& n) const;
  /// The same, and subtracts the support point x(n) from `w`.
  Ball support_from(const Ball3& n, Ball3& w) const;
  /// Is x proven to be inside?
  bool holds(const Ball3& x) const;

 private:
  std::array<Ball3, 3> axes_;  // unit
  Ball3 lengths_;
  Ball radius_;
};

/// The same body in long double, for guesses, in the unit of its numbers. Throws as above.
Shape<long double> guessed_shape(const RawEllipsoid& body);

/// A length in units of 2^unit.
Ball in_unit(double length, int unit);

}  // namespace tangency::inline v0::verify
