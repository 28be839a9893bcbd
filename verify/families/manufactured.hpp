// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Manufactured contacts: pairs of ellipsoids whose gap, normal and witness points are known
/// without a solver. Choose A, B's shape, a unit normal n and a gap g and put
///     c_B = c_A + x_A(n) + g n + x_B(n);
/// then n is stationary with gap g, and it is the global answer for g > -rho, rho the sum of the
/// least radii of curvature a_min^2 / a_max. Computed in long double; after rounding c_B to double
/// g is corrected by n . (rounding), exact to second order in rounding / radius of curvature.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <string>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::families {

using verify::RawEllipsoid;

/// How shapes, sizes and gaps of a family are drawn.
struct ContactFamily {
  enum class Shape {
    spheroid,  ///< two equal semi-axes, the third `aspect` times as long
    triaxial,  ///< log-uniform: the longest `aspect` times the shortest, the middle in between
    drawn,     ///< triaxial with the aspect ratio itself log-uniform in [1, aspect]
  };
  enum class GapUnit { smallest_semi_axis, rho };  ///< of the pair

  std::string name;
  Shape shape;
  double aspect;
  double size_ratio;  ///< B's size over A's is log-uniform in [1/size_ratio, size_ratio]
  GapUnit gap_unit;
  double largest_gap;  ///< gaps are uniform in +- this, in gap_unit; rho stays the limit below 0
};

struct ManufacturedContact {
  RawEllipsoid a, b;
  std::array<double, 3> normal;  ///< unit, from A to B, rounded
  double gap;                    ///< of the stored doubles, rounded
  double smallest_semi_axis;     ///< of the two bodies
  double size;                   ///< |c_B - c_A| + largest semi-axis of A + that of B
};

/// Classes 1, 2 and 3 of the published comparison of methods, in this order.
std::span<const ContactFamily> contact_classes();

/// An endless, reproducible sequence of contacts of one family.
class ManufacturedContacts {
 public:
  ManufacturedContacts(const ContactFamily& family, std::uint64_t seed);
  ManufacturedContact next();

 private:
  using Real = long double;
  Real uniform(Real low, Real high);
  Real log_uniform(Real high_over_low);  ///< in [1/sqrt, sqrt] of it
  std::array<double, 3> semi_axes(Real size);

  ContactFamily family_;
  std::mt19937_64 random_;
};

}  // namespace tangency::families
