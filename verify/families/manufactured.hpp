// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Manufactured contacts: pairs of ellipsoids whose gap and normal are known without a solver
/// (placing.hpp).
#pragma once

#include <array>
#include <span>
#include <string>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/pair.hpp>

namespace tangency::inline v0::verify {

/// How shapes, sizes and gaps of a family are drawn.
struct ContactFamily {
  enum class Shape {
    spheroid,  ///< two equal semi-axes, the third `aspect` times as long
    triaxial,  ///< log-uniform: the longest `aspect` times the shortest, the middle in between
    drawn,     ///< triaxial with the aspect ratio itself log-uniform in [1, aspect]
  };
  enum class GapUnit { smallest_semi_axis, rho };  ///< of the pair; rho: least_radii()

  std::string name;
  Shape shape;
  double aspect;
  double size_ratio;  ///< B's size over A's is log-uniform in [1/size_ratio, size_ratio]
  GapUnit gap_unit;
  double largest_gap;  ///< gaps are uniform in +- this, in gap_unit; rho stays the limit below 0
};

struct ManufacturedContact : EllipsoidPair {
  std::array<double, 3> normal;  ///< unit, from A to B, rounded
  double gap;                    ///< of the stored doubles, to second order, rounded
  double smallest_semi_axis;     ///< of the two bodies
  double size;                   ///< |c_B - c_A| + largest semi-axis of A + that of B
};

/// Classes 1, 2 and 3 of the published comparison of methods, in this order.
std::span<const ContactFamily> contact_classes();

/// Shapes and sizes of a family, A somewhere near the origin and B at it.
EllipsoidPair contact_bodies(Draw& draw, const ContactFamily& family);

ManufacturedContact drawn(Draw& draw, const ContactFamily& family);

using ManufacturedContacts = Sequence<ContactFamily>;

}  // namespace tangency::inline v0::verify
