// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: the type of a quadric surface, proven for the stored doubles.
///
/// Theorem used: an affine change of coordinates maps the 4x4 matrix Q of the form in (x, y, z, 1)
/// and its upper 3x3 block S by congruence, so (Sylvester) the inertias of Q and S, taken up to one
/// common sign, are affine invariants; the 17 real types and the three degenerate sets have 20
/// different ones (Cauchy and Haynsworth interlacing leaves no others). Both inertias come from
/// exact symmetric elimination on integers, never from signs of invariants of a characteristic
/// polynomial.
///
/// Identities: (1) classify(Q) == classify(k Q) for every k != 0, negative ones included;
/// (2) type and ranks do not change under an exact rigid motion or an exact change of units.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

enum class QuadricType {
  real_ellipsoid,
  imaginary_ellipsoid,
  hyperboloid_one_sheet,
  hyperboloid_two_sheets,
  elliptic_paraboloid,
  hyperbolic_paraboloid,
  real_elliptic_cone,
  imaginary_elliptic_cone,
  real_elliptic_cylinder,
  imaginary_elliptic_cylinder,
  hyperbolic_cylinder,
  parabolic_cylinder,
  real_intersecting_planes,
  imaginary_intersecting_planes,
  real_parallel_planes,
  imaginary_parallel_planes,
  coincident_planes,
  plane,      ///< no quadric: a linear form
  no_points,  ///< no quadric: a nonzero constant
  all_space,  ///< no quadric: zero
};

/// The name in the file formats, which is the enumerator's.
constexpr std::string_view name(QuadricType type) {
  constexpr std::array<std::string_view, 20> kNames{"real_ellipsoid",
                                                    "imaginary_ellipsoid",
                                                    "hyperboloid_one_sheet",
                                                    "hyperboloid_two_sheets",
                                                    "elliptic_paraboloid",
                                                    "hyperbolic_paraboloid",
                                                    "real_elliptic_cone",
                                                    "imaginary_elliptic_cone",
                                                    "real_elliptic_cylinder",
                                                    "imaginary_elliptic_cylinder",
                                                    "hyperbolic_cylinder",
                                                    "parabolic_cylinder",
                                                    "real_intersecting_planes",
                                                    "imaginary_intersecting_planes",
                                                    "real_parallel_planes",
                                                    "imaginary_parallel_planes",
                                                    "coincident_planes",
                                                    "plane",
                                                    "no_points",
                                                    "all_space"};
  return kNames.at(static_cast<std::size_t>(type));
}

struct Classification {
  QuadricType type;
  int rank4;  ///< rank of Q
  int rank3;  ///< rank of its upper 3x3 block
  friend bool operator==(const Classification&, const Classification&) = default;
};

/// Throws std::invalid_argument if a coefficient is not finite.
Classification classify(const RawQuadric& quadric);

}  // namespace tangency::inline v0::verify
