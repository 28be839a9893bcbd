// SPDX-License-Identifier: MIT
/// @file
/// Where the bodies of a packing are touched, and what their axes explain of the contact normals:
/// the numbers of chapter 7 [Ouadfel1998] that `tangency-dem micro` and micro.csv tell.
///
/// Of bodies of one shape; spheres, and packings of several shapes, have none.
#pragma once

#include <optional>

#include <tangency/dem/micromechanics/averages.hpp>
#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/contact_statistics.hpp>
#include <tangency/dem/micromechanics/independence.hpp>
#include <tangency/dem/micromechanics/normal_rotation.hpp>

namespace tangency::inline v0::dem {

struct BodySummary {
  std::optional<micromechanics::ContactStatistics> contacts;    ///< in space
  std::optional<micromechanics::NormalRotation> rotation;       ///< in space
  std::optional<micromechanics::PlaneNormalRotation> in_plane;  ///< in the plane
  /// <P2(cos gamma)> of the model with the measured a1, in the plane <cos 2 gamma>.
  double calculated_factor = micromechanics::kNotDefined;
  std::optional<micromechanics::Contingency> independence;
};
BodySummary body_summary(const micromechanics::ContactArrays& contacts,
                         const micromechanics::BodyArrays& bodies);

}  // namespace tangency::inline v0::dem
