// SPDX-License-Identifier: MIT
/// @file
/// The part of the anisotropy of contact normals that the bodies' axes explain, as measured, and
/// what is left of it [Ouadfel1998, section 7.4].
///
/// Relations and names are those of rotation_models.hpp; arrays and errors those of
/// contact_statistics.hpp. Deviations account for the dependence of the sides of one body and of
/// one contact. Nothing is kept between calls: any number of threads may call.
#pragma once

#include <cstddef>
#include <optional>

#include <tangency/dem/micromechanics/contact_statistics.hpp>
#include <tangency/dem/micromechanics/rotation_models.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// Of all contact sides of bodies of one shape, in space.
struct NormalRotation {
  std::size_t sides = 0;    ///< sides of contacts that are counted
  Estimate second, fourth;  ///< <P2(cos gamma)>, <P4(cos gamma)>
  /// The same of the model, c1 + a1 c2 and d1 + a1 d2 with the measured a1: means over the sides.
  RotationFactors calculated;
  /// a^E, b^E: over bodies of that shape, and over sides. They are alike where coordination does
  /// not depend on orientation; the relation is exact with that over sides.
  Mat3 axes_of_bodies = Mat3::Zero(), axes_of_sides = Mat3::Zero();
  /// mean deviatoric tensors of fourth order
  SymmetricTensor4 fourth_axes_of_bodies{}, fourth_axes_of_sides{};
  /// a^r, b^r of these sides.
  Mat3 normals = Mat3::Zero();
  /// of the normals, fourth order
  SymmetricTensor4 fourth_normals{};
  /// a^r_rot = second axes_of_sides, a^r_other = a^r - a^r_rot, and its deviation, component by
  /// component, if it is 0 but for scatter; alike of order 4.
  Mat3 rotated = Mat3::Zero(), other = Mat3::Zero(), other_error = Mat3::Zero();
  /// the same of the fourth order
  SymmetricTensor4 fourth_rotated{}, fourth_other{}, fourth_other_error{};
};
/// Empty of spheres and triaxial bodies, to whose normals the relation does not apply, and without
/// a side.
/// @param bodies  the bodies, by index
/// @param shape  of the bodies that count
/// @param contacts  in space, else std::invalid_argument
///
/// (1) rotated + other is the anisotropy of the sides' normals
std::optional<NormalRotation> normal_rotation_of(const ContactArrays& contacts,
                                                 const BodyArrays& bodies, Shape shape);

/// The same in the plane, of bodies that are no circles there; tensors as in plane.hpp.
struct PlaneNormalRotation {
  std::size_t sides = 0;     ///< sides of contacts that are counted
  Estimate a_l;              ///< 2 <cos 2 beta>
  Estimate mean_cosine;      ///< <cos 2 gamma>: minus the published ratio, PlaneRotation::factor
  double arc_law_a_l = 0.0;  ///< mean over sides of arc_law_anisotropy
  double calculated = 0.0;   ///< mean over sides of -(c1 + a_l c2), with the measured a_l
  /// mean deviatoric tensors of second order
  Mat3 axes_of_bodies = Mat3::Zero(), axes_of_sides = Mat3::Zero();
  Mat3 normals = Mat3::Zero();  ///< of the normals, second order
  /// the normals' part by rotated axes, what is left, and its standard errors
  Mat3 rotated = Mat3::Zero(), other = Mat3::Zero(), other_error = Mat3::Zero();
};
/// @param bodies  the bodies, by index
/// @param contacts  in the plane, else std::invalid_argument
std::optional<PlaneNormalRotation> plane_normal_rotation_of(const ContactArrays& contacts,
                                                            const BodyArrays& bodies);

}  // namespace tangency::inline v0::micromechanics
