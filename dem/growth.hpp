// SPDX-License-Identifier: MIT
/// @file
/// Growth: particles change their shape, not their volume, by small increments between which the
/// assembly relaxes [Ouadfel1998, section 3.4.9].
///
/// The eccentricity of a shape is e = (a - b) / (a + b) [eq. 5.1], in [0, 1). Stresses: compression
/// is positive.
///
/// Spheres compacted at constant mean pressure and made longer without friction end up in a denser
/// assembly, with more contacts, than ellipsoids that are thrown together.
#pragma once

#include <cstdint>
#include <optional>

#include <tangency/dem/particles.hpp>

namespace tangency::inline v0::dem {

/// (a - b) / (a + b) of an elongation a / b.
inline double eccentricity_of(double elongation) { return (elongation - 1.0) / (elongation + 1.0); }
/// a / b of an eccentricity (a - b) / (a + b).
inline double elongation_of(double eccentricity) {
  return (1.0 + eccentricity) / (1.0 - eccentricity);
}

/// A mean stress that changes while e does [section 5.1.1]: in proportion, from `start` at the
/// growth's first e to the stage's mean stress at `eccentricity`, and no more from there on.
struct StressRamp {
  double start;         ///< > 0, force/area
  double eccentricity;  ///< (a - b) / (a + b) at which the ramp ends
};

/// A stage of growth: elongation and flatness go to their ends in equal increments.
struct Growth {
  double elongation;               ///< a / b at the end
  std::optional<double> flatness;  ///< b / c at the end; without: it stays
  std::int64_t increments;         ///< > 0: equal steps of the ratios [eq. 3.40]
  /// An increment that waits is made when the inertial fraction is at most this.
  double max_inertial_fraction;
  /// The steps are equal in e instead of the elongation.
  bool by_eccentricity = false;
  /// The increments of one per cent of e, > 0, with by_eccentricity. They are made one a cycle,
  /// and wait for relaxation only before the first of them [section 5.3]. Without: each waits.
  std::optional<std::int64_t> cycles_per_percent{};
  std::optional<StressRamp> ramp{};  ///< of the mean stress, if it is not constant

  /// The shape after so many of the increments.
  ///
  /// (1) Its mean radius, and so the volume, is that of `start`.
  /// (2) shape_after(start, increments) has exactly the wanted ratios, and shape_after(start, 0)
  ///     those of `start`.
  Shape shape_after(const Shape& start, std::int64_t done) const;

  /// Does the next increment after so many wait until the assembly is relaxed?
  bool waits_after(std::int64_t done) const {
    return !cycles_per_percent || done % *cycles_per_percent == 0;
  }

  /// The mean stress to hold after so many increments.
  ///
  /// (3) Without a ramp, and from the ramp's eccentricity on, it is exactly `full`; before any
  ///     increment it is the ramp's start.
  /// @param done  increments made
  /// @param start  the shape that the ramp goes by, before the growth
  /// @param full   the stage's mean stress
  double stress_after(const Shape& start, std::int64_t done, double full) const;

  /// The largest relative change of a semi-axis in one increment.
  double largest_change(const Shape& start, int dimensions) const;
};

/// The increments of a growth over this change of e, the last per cent of which may be a part: at
/// least 1.
std::int64_t increments_at(std::int64_t cycles_per_percent, double change_of_eccentricity);

}  // namespace tangency::inline v0::dem
