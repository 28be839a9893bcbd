// SPDX-License-Identifier: MIT
/// @file
/// Does where a body is touched depend on how it lies? The part of contact anisotropy that the
/// bodies' axes explain, what is left of it, and a test of independence [Ouadfel1998, section 7.4].
///
/// Relations and names are those of rotation_models.hpp; arrays and errors those of
/// contact_statistics.hpp. Deviations account for the dependence of the sides of one body and of
/// one contact. Nothing is kept between calls: any number of threads may call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <tangency/dem/micromechanics/contact_statistics.hpp>
#include <tangency/dem/micromechanics/sphere_partition.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::micromechanics {

/// Of all contact sides of bodies of one shape, in space.
struct NormalRotation {
  std::size_t sides = 0;
  Estimate second, fourth;  ///< <P2(cos gamma)>, <P4(cos gamma)>
  /// a^E, b^E: over bodies of that shape, and over sides. They are alike where coordination does
  /// not depend on orientation; the relation is exact with that over sides.
  Mat3 axes_of_bodies = Mat3::Zero(), axes_of_sides = Mat3::Zero();
  SymmetricTensor4 fourth_axes_of_bodies{}, fourth_axes_of_sides{};
  /// a^r, b^r of these sides.
  Mat3 normals = Mat3::Zero();
  SymmetricTensor4 fourth_normals{};
  /// a^r_rot = second axes_of_sides, a^r_other = a^r - a^r_rot, and its deviation, component by
  /// component, if it is 0 but for scatter; alike of order 4.
  Mat3 rotated = Mat3::Zero(), other = Mat3::Zero(), other_error = Mat3::Zero();
  SymmetricTensor4 fourth_rotated{}, fourth_other{}, fourth_other_error{};
};
/// Empty of spheres and triaxial bodies, to whose normals the relation does not apply, and without
/// a side.
///
/// (1) rotated + other is the anisotropy of the sides' normals
std::optional<NormalRotation> normal_rotation_of(const ContactArrays& contacts,
                                                 const BodyArrays& bodies, Shape shape);

/// The same in the plane, of bodies that are no circles there; tensors as in plane.hpp.
struct PlaneNormalRotation {
  std::size_t sides = 0;
  Estimate a_l;              ///< 2 <cos 2 beta>
  Estimate factor;           ///< <cos 2 gamma>: minus the published ratio
  double arc_law_a_l = 0.0;  ///< mean over sides of arc_law_anisotropy
  double calculated = 0.0;   ///< mean over sides of -(c1 + a_l c2), with the measured a_l
  Mat3 axes_of_bodies = Mat3::Zero(), axes_of_sides = Mat3::Zero();
  Mat3 normals = Mat3::Zero();
  Mat3 rotated = Mat3::Zero(), other = Mat3::Zero(), other_error = Mat3::Zero();
};
/// @param contacts  dimensions = 2; one body axis of each body must be that of z to 1e-6, else
///                  std::invalid_argument
std::optional<PlaneNormalRotation> plane_normal_rotation_of(const ContactArrays& contacts,
                                                            const BodyArrays& bodies);

/// The share of chi-squared's distribution above a value.
/// @param degrees  at least 1
///
/// (2) equals the incomplete gamma function
double chi_squared_tail(double chi_squared, std::int64_t degrees);

/// Of a table of counts: are rows and columns independent?
struct Contingency {
  std::int64_t count = 0;
  double chi_squared = 0.0;
  std::int64_t degrees = 0;  ///< (rows - 1)(columns - 1), of those that are not empty
  /// The share of independent samples whose chi-squared is larger. NaN where degrees are 0 or the
  /// least expected count is below 5: then the distribution is not that of chi-squared.
  double p_value = 0.0;
  double least_expected = 0.0;  ///< of the cells of rows and columns that are not empty
  /// With how many counts, spread alike, the least expected would be 5.
  std::int64_t count_needed = 0;
  double cramers_v = 0.0;  ///< 0 of none, 1 of full dependence
};
/// @param counts  row by row, none negative; std::invalid_argument otherwise
Contingency contingency_of(std::span<const std::int64_t> counts, std::size_t columns);

/// Contact sides by the class of |cos gamma|, equally many in each, and by the class of the body's
/// axis, opposite ones together. Sides count as independent data. They nearly are: bodies keep
/// their neighbours apart, which makes chi-squared smaller.
/// @param local_classes  at least 2
/// @param partition      of axes: near_uniform(1) has 12 pairs of classes
/// Empty as normal_rotation_of.
std::optional<Contingency> normal_independence(
    const ContactArrays& contacts, const BodyArrays& bodies, Shape shape, int local_classes = 6,
    const SpherePartition& partition = SpherePartition::near_uniform(1));
/// The same in the plane: gamma from -pi/2 to pi/2 in classes of equal numbers, axes in equal arcs.
std::optional<Contingency> plane_normal_independence(const ContactArrays& contacts,
                                                     const BodyArrays& bodies,
                                                     int local_classes = 8, int axis_classes = 12);

}  // namespace tangency::micromechanics
