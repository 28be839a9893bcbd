// SPDX-License-Identifier: MIT
/// @file
/// Sizes and shapes of a type of particles that are not all alike.
///
/// Nothing is drawn: of n particles number i has the size at the share (i + 1/2) / n of the
/// distribution of numbers, so that small samples follow the wanted curve as closely as they can,
/// and one scene has one set of particles whatever its seed. Ratios of semi-axes come from points
/// that fill a square evenly in the same order [Roberts2018], independent of the sizes.
///
/// Units: lengths are those of the scene. In the plane volumes, and with them masses, go with the
/// square of the size, in space with its cube.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <tangency/dem/particles.hpp>

namespace tangency::inline v0::dem {

/// How the mean radii of a type of particles are distributed.
struct BodySizes {
  /// By which rule.
  enum class Rule {
    equal,      ///< all have `radius`
    uniform,    ///< in number from radius (1 - spread) to radius (1 + spread)
    normal,     ///< in number about `radius`, with a standard deviation of radius spread
    lognormal,  ///< in number; the median is `radius`, and `spread` the deviation of its logarithm
    sieve,      ///< by mass, of what passes sieves
  };
  Rule rule = Rule::equal;  ///< how they are distributed
  double radius = 1.0;      ///< > 0, length; not of a sieve curve
  double spread = 0.0;      ///< >= 0; as the rule says
  double tails = 0.02;  ///< normal, lognormal: share in number left out at either end, in (0, 1/2)
  /// Sieve curve: square openings, ascending, > 0, length; and the share of mass that passes each,
  /// ascending from 0 to 1. Between two openings it grows with the logarithm of the opening.
  std::vector<double> openings{}, passing{};
};

/// Ratios of semi-axes, each uniform in number between two ends.
struct BodyRatios {
  std::array<double, 2> elongation{1.0, 1.0};  ///< a / b, from 1
  std::array<double, 2> flatness{1.0, 1.0};    ///< b / c, from 1; 1 in the plane
};

/// The square opening that an ellipsoid just passes, along its longest axis and turned by an eighth
/// about it: the root of 2 (b^2 + c^2). In the plane a disk passes a slit of 2 b.
double sieve_opening(const Shape& shape, int dimensions);

/// The shapes of so many particles, the smallest sizes first.
///
/// (1) The share of their mass that passes a sieve is that of the curve, but for one particle at
///     each of the openings.
/// (2) All are within the ends of the distribution; normal sizes are > 0 where spread times
///     normal_quantile(1 - tails) is below 1.
/// (3) The same bits on every machine.
std::vector<Shape> shapes_of(const BodySizes& sizes, const BodyRatios& ratios, std::size_t count,
                             int dimensions);

/// Where the normal distribution of mean 0 and deviation 1 has so much below it.
/// @param share  in [1e-7, 1 - 1e-7]
/// @return within 1e-9; the same bits on every machine
double normal_quantile(double share);

}  // namespace tangency::inline v0::dem
