// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: the gap of two solid ellipsoids by the Perram-Wertheim function, by the midpoint of
/// potentials and along the line of centres, to 100 digits.
///
///     F = max over 0 < s < 1 of s (1-s) d' ((1-s) M_A + s M_B)^-1 d,   d = c_B - c_A,
///
/// M the shape matrices [PerramWertheim1985]. With l = s/(1-s) it is l N / ((1+l) D), N and D
/// polynomials in l with positive coefficients; the root of its slope is bisected in 150 digits. At
/// the best s the normal n is along v = ((1-s) M_A + s M_B)^-1 d, and c_A + (1-s) M_A v is where
/// both level functions are F.
#pragma once

#include <optional>

#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

struct DefinedGap {
  Real gap;
  Real3 normal;        ///< unit, from A to B
  Real3 arm_a, arm_b;  ///< witness points relative to their body's centre
};

struct PerramWertheimTruth {
  Real contact_function;  ///< F; > 1 <=> apart
  /// Between the tangent planes with the normal n: (1 - 1/sqrt F) n.d; support points.
  DefinedGap tangent_planes;
  /// From the last point in A to the first in B of the line along n through the point of equal
  /// levels; nothing where the line misses a body.
  std::optional<DefinedGap> midpoint;
  /// Along the line of centres, (1 - 1/sqrt F) |d|: how far B moves along -d until both touch, F
  /// being homogeneous of degree 2 in d.
  Real centre_line;
};

/// Nothing where the centres coincide. Throws std::invalid_argument unless both are ellipsoids.
std::optional<PerramWertheimTruth> perram_wertheim(const RealEllipsoid& a, const RealEllipsoid& b);
std::optional<PerramWertheimTruth> perram_wertheim(const RawEllipsoid& a, const RawEllipsoid& b);

}  // namespace tangency::inline v0::verify
