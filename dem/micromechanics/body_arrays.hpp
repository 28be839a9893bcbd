// SPDX-License-Identifier: MIT
/// @file
/// The bodies of a packing beside its contacts, as plain arrays: what the statistics of where
/// bodies are touched are computed from.
///
/// Signs, units and errors are those of contact_arrays.hpp. Functions read what they are given and
/// keep nothing: any number of threads may call them.
#pragma once

#include <span>

#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::micromechanics {

/// A body a particle, as ContactArrays::bodies numbers them.
struct BodyArrays {
  std::span<const Quaternion> orientation;  ///< unit, body to space
  std::span<const Vec3> semi_axes;
};
/// @throws std::invalid_argument  other lengths than `particles`, `bodies` or `arm` empty
void require_sound(const ContactArrays& contacts, const BodyArrays& bodies);

/// With its standard deviation. Contacts of one particle and the two sides of a contact may depend
/// on each other: deviations account for both. NaN where there are too few data to tell.
struct Estimate {
  double value = 0.0, error = 0.0;
};

}  // namespace tangency::micromechanics
