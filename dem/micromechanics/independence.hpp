// SPDX-License-Identifier: MIT
/// @file
/// Does where a body is touched depend on how it lies? Pearson's chi-squared [Pearson1900] of
/// contact sides by the class of the local normal and by that of the body's axis [Ouadfel1998,
/// section 7.4].
///
/// Only dependence of gamma is looked for. In space the turn of the normal about the body's axis
/// counts too: normal_rotation.hpp compares component by component. gamma is as in
/// rotation_models.hpp; arrays and errors are those of contact_statistics.hpp. Nothing is kept
/// between calls: any number of threads may call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <tangency/dem/micromechanics/contact_statistics.hpp>
#include <tangency/dem/micromechanics/sphere_partition.hpp>

namespace tangency::inline v0::micromechanics {

/// The share of chi-squared's distribution above a value [AbramowitzStegun1964, eq. 26.4.4,
/// 26.4.5].
/// @param chi_squared  the value
/// @param degrees  at least 1
///
/// (1) equals the incomplete gamma function
double chi_squared_tail(double chi_squared, std::int64_t degrees);

/// Of a table of counts: are rows and columns independent?
struct Contingency {
  std::int64_t count = 0;    ///< counts in the table
  double chi_squared = 0.0;  ///< the statistic
  std::int64_t degrees = 0;  ///< (rows - 1)(columns - 1), of those that are not empty
  /// The share of independent samples whose chi-squared is larger. NaN where degrees are 0 or the
  /// least expected count is below 5: then the distribution is not that of chi-squared.
  double p_value = 0.0;
  double least_expected = 0.0;  ///< of the cells of rows and columns that are not empty
  /// With how many counts, spread alike, the least expected would be 5.
  std::int64_t count_needed = 0;
  double cramers_v = 0.0;  ///< [Cramer1946, chapter 21]: 0 of none, 1 of full dependence
};
/// @param columns  orientations and centres
/// @param counts  row by row, none negative; std::invalid_argument otherwise
Contingency contingency_of(std::span<const std::int64_t> counts, std::size_t columns);

/// Contact sides by the class of |cos gamma|, equally many in each, and by the class of the body's
/// axis, opposite ones together. Sides count as independent data. They nearly are: bodies keep
/// their neighbours apart, which makes chi-squared smaller.
/// @param contacts  the contacts
/// @param bodies  the bodies, by index
/// @param shape  of the bodies that count
/// @param local_classes  at least 2
/// @param partition      of axes: near_uniform(1) has 12 pairs of classes
/// Contacts must be in space, bodies of `shape`: errors and emptiness are normal_rotation_of's.
std::optional<Contingency> normal_independence(
    const ContactArrays& contacts, const BodyArrays& bodies, Shape shape, int local_classes = 6,
    const SpherePartition& partition = SpherePartition::near_uniform(1));
/// The same in the plane, errors as plane_normal_rotation_of's: gamma from 0 to pi in classes of
/// equal numbers, axes in equal arcs.
std::optional<Contingency> plane_normal_independence(const ContactArrays& contacts,
                                                     const BodyArrays& bodies,
                                                     int local_classes = 8, int axis_classes = 12);

}  // namespace tangency::inline v0::micromechanics
