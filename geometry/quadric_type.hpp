// SPDX-License-Identifier: MIT
/// @file
/// What a quadric can be: classify.hpp says which one is what.
#pragma once

#include <array>
#include <string_view>

#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0 {

/// A B C D E F G H J K, as quadric.hpp writes them.
using QuadricCoefficients = std::array<double, 10>;

/// The 17 real types of quadrics and three sets that an equation without quadratic terms describes.
enum class QuadricType {
  real_ellipsoid,
  imaginary_ellipsoid,
  hyperboloid_one_sheet,
  hyperboloid_two_sheets,
  elliptic_paraboloid,
  hyperbolic_paraboloid,
  real_elliptic_cone,
  imaginary_elliptic_cone,  ///< one real point
  real_elliptic_cylinder,
  imaginary_elliptic_cylinder,
  hyperbolic_cylinder,
  parabolic_cylinder,
  real_intersecting_planes,
  imaginary_intersecting_planes,  ///< one real line
  real_parallel_planes,
  imaginary_parallel_planes,
  coincident_planes,
  plane,      ///< no quadratic term, some linear one
  no_points,  ///< a constant other than 0
  all_space,  ///< all coefficients 0
};

/// The name in the file formats: "real_ellipsoid" and so on, as spelled above.
std::string_view to_string(QuadricType type) noexcept;

/// Has the surface no real point? True for imaginary_ellipsoid, imaginary_elliptic_cylinder,
/// imaginary_parallel_planes and no_points.
bool is_empty(QuadricType type) noexcept;

/// The type of a quadric, and what decided it.
struct Classification {
  QuadricType type;  ///< exact
  int rank4;         ///< rank of Q, 0 to 4
  int rank3;         ///< rank of Q_s, 0 to 3
  Tier tier;  ///< which tier answered; border types, with Q or Q_s singular, are always exact's
};

}  // namespace tangency::inline v0
