// SPDX-License-Identifier: MIT
/// @file
/// The type of a quadric, exact for its ten stored doubles.
///
/// The type follows from the inertias of the discriminant matrix Q and the sub-discriminant Q_s.
/// A filter in double arithmetic decides where Q and Q_s are regular by more than its proven error
/// bound (docs/derivations/classification-filter.md); everything else is decided in integers. Both
/// are right in every rounding mode and when subnormals are flushed or read as zero, and for all
/// finite doubles, however their magnitudes are mixed. The decision diagram:
/// docs/classification.md.
///
/// (1) classify(q.negated()) and classify(q) have the same type and ranks (and, while rounding is
/// to
///     nearest, tier).
/// (2) The type is the same after any regular affine map with exact coefficients, and after a
///     power-of-two scaling of all coefficients that is exact.
/// (3) rank3 <= rank4 <= min(4, rank3 + 2).
#pragma once

#include <string_view>

#include <tangency/geometry/quadric.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency {

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

struct Classification {
  QuadricType type;
  int rank4;  ///< rank of Q, 0 to 4
  int rank3;  ///< rank of Q_s, 0 to 3
  Tier tier;  ///< which tier answered; border types, with Q or Q_s singular, are always exact's
};

Classification classify(const Quadric& quadric) noexcept;

}  // namespace tangency
