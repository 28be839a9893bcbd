// SPDX-License-Identifier: MIT
/// @file
/// Growth: particles change their shape, not their volume, by small increments between which the
/// assembly relaxes [Ouadfel1998, section 3.4.9].
///
/// Spheres compacted at constant mean pressure and made longer without friction end up in a denser
/// assembly, with more contacts, than ellipsoids that are thrown together.
#pragma once

#include <cstdint>
#include <optional>

#include <tangency/dem/particles.hpp>

namespace tangency::dem {

struct Growth {
  double elongation;               ///< a / b at the end
  std::optional<double> flatness;  ///< b / c at the end; without: it stays
  std::int64_t increments;         ///< > 0: equal steps of the ratios [eq. 3.40]
  /// An increment is made when the inertial fraction is at most this.
  double max_inertial_fraction;

  /// The shape after so many of the increments.
  ///
  /// (1) Its mean radius, and so the volume, is that of `start`.
  /// (2) shape_after(start, increments) has exactly the wanted ratios.
  Shape shape_after(const Shape& start, std::int64_t done) const;

  /// The largest relative change of a semi-axis in one increment.
  double largest_change(const Shape& start, int dimensions) const;
};

}  // namespace tangency::dem
