// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the oracles read: plain numbers, in the conventions of the file formats, and nothing of the
/// kernel. Every double is taken to mean the rational number that it stores.
#pragma once

#include <array>

namespace tangency::inline v0::verify {

/// The solid { centre + R(q/|q|) diag(semi_axes) u : |u| <= 1 }. Requires finite numbers, semi-axes
/// > 0 in any order and q != 0; q = (w, x, y, z) need not be normalised and means R(q/|q|) exactly.
struct RawEllipsoid {
  std::array<double, 3> centre;
  std::array<double, 3> semi_axes;
  std::array<double, 4> orientation = {1, 0, 0, 0};
};

/// A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx + 2G x + 2H y + 2J z + K = 0. Requires finite
/// numbers.
struct RawQuadric {
  double A, B, C, D, E, F, G, H, J, K;
};

}  // namespace tangency::inline v0::verify
