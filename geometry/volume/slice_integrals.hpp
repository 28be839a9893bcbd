// SPDX-License-Identifier: MIT
/// @file
/// The common volume of two bodies by circular sections, and its derivative by the place of the
/// second, each with a proven error. Internal: docs/derivations/common-volume.md, sections 4 to 7.
#pragma once

#include <tangency/geometry/vectors.hpp>
#include <tangency/geometry/volume/circular_sections.hpp>

namespace tangency::inline v0::detail {

/// In the unit of CircularSections.
struct SliceIntegrals {
  double volume = 0.0;
  double volume_error = 0.0;
  Vec3 gradient = Vec3::Zero();  ///< by the second body's centre, in the ball's axes
  double gradient_error = 0.0;
  int slices = 0;  ///< sections whose area was taken
  int ranges = 0;  ///< of heights, that were looked at
};

/// The range of heights is halved until the area is known as a polynomial, or its Gaussian
/// quadrature is proven, on every part of it; or until what is not known is below the tolerance.
/// @param volume_tolerance, area_tolerance  of the errors of quadratures and of what stays open
template <class T>
SliceIntegrals slice_integrals(const CircularSections<T>& bodies, double volume_tolerance,
                               double area_tolerance) noexcept;

}  // namespace tangency::inline v0::detail
