// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Ellipsoids in 150-digit arithmetic: the stored doubles exactly, or bodies that no double can
/// store.
#pragma once

#include <boost/multiprecision/mpfr.hpp>

#include <array>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

/// MPFR, 150 decimal digits, round to nearest, no overflow within reach of doubles. Chosen: 50
/// digits more than are promised, for the shapes, sizes and depths that take some away.
using Real = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<150, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;
using Real3 = std::array<Real, 3>;

/// The solid { centre + R(q/|q|) diag(semi_axes) u : |u| <= 1 }, q = (w, x, y, z) not normalised.
struct RealEllipsoid {
  Real3 centre;
  Real3 semi_axes;
  std::array<Real, 4> orientation;
};

/// The stored doubles, exactly. Throws std::invalid_argument unless they are an ellipsoid: finite,
/// semi-axes > 0, orientation not 0.
RealEllipsoid real(const RawEllipsoid& body);

/// Two bodies as their support functions see them, in any arithmetic.
template <class T>
struct Shape {
  std::array<T, 3> semi_axes;
  std::array<std::array<T, 3>, 3> axes;  ///< axes[k]: unit, in space, along semi_axes[k]
};

template <class T>
struct Separation {
  std::array<T, 3> d;  ///< c_B - c_A
  Shape<T> a, b;
};

/// R(q/|q|) and d to 149 digits of themselves. Throws std::invalid_argument as real() does.
Separation<Real> separation(const RealEllipsoid& a, const RealEllipsoid& b);

}  // namespace tangency::inline v0::verify
