// SPDX-License-Identifier: MIT
/// @file
/// Areas of circular sections and what they contribute, over a range of heights: by Gaussian
/// quadrature with a proven error. Internal: docs/derivations/common-volume.md, sections 4 to 6.
#pragma once

#include <optional>

#include <tangency/geometry/vectors.hpp>
#include <tangency/geometry/volume/slice_expansion.hpp>

namespace tangency::inline v0::detail {

/// What a range of heights adds to the integrals.
struct SliceShare {
  double volume = 0.0;
  double volume_error = 0.0;
  Vec3 gradient = Vec3::Zero();
  double gradient_error = 0.0;
  double surface = 0.0;  ///< of the ball's surface in the second body
  int slices = 0;
};

/// A range of v: [-1, 1] about the middle, or [0, 1] from an end where the circles touch and P is
/// taken as v times its deflated polynomial.
enum class SliceRange { about_middle, from_touch };

/// Least and most of what the area is made of, for |v| <= r.
struct SliceBounds {
  double ball, second, distance, q1, q2;  ///< most
  double least_distance;
  double p, least_p;        ///< of P, or of P / v
  double least_1, least_2;  ///< of q_1^2 + P = 4 D r_1^2, of q_2^2 + P
  double rate_1, rate_2;    ///< of |d angle / dv|, or d angle / d sqrt(v)

  SliceBounds(const SliceExpansion& e, SliceRange range, double r) noexcept;
  /// Is there no point where an angle is not analytic?
  bool regular() const noexcept { return least_p > 0.0 && least_1 > 0.0 && least_2 > 0.0; }
};

/// How far P is off at most on the range, beyond what a rounding of its coefficients makes of it.
double discriminant_error(const SliceExpansion& e, SliceRange range) noexcept;

/// Where the circles cross at all heights of the range, or nothing where no quadrature is proven to
/// err less than `volume_budget` and `gradient_budget`.
std::optional<SliceShare> crossing_share(const SliceExpansion& e, SliceRange range,
                                         double volume_budget, double gradient_budget) noexcept;

}  // namespace tangency::inline v0::detail
