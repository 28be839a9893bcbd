// SPDX-License-Identifier: MIT
/// @file
/// The linear contact law [Ouadfel1998, eq. 3.3-3.12].
///
/// Signs: a contact force is what particle a does to particle b; the normal points from a to b; so
/// a normal force > 0 is a push. The shear force is the part in the tangent plane.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::dem {

struct ContactLaw {
  double normal_stiffness;      ///< K_n > 0, force/length
  double shear_stiffness;       ///< K_s >= 0, force/length
  double friction_coefficient;  ///< tan(phi) >= 0
  double cohesion;              ///< c >= 0, force: shear that a contact bears without a push

  /// A law that bears no shear needs no shear history.
  bool bears_shear() const {
    return shear_stiffness > 0.0 && (friction_coefficient > 0.0 || cohesion > 0.0);
  }

  /// F_n = K_n overlap, 0 for bodies apart.
  double normal_force(double overlap) const {
    return overlap > 0.0 ? normal_stiffness * overlap : 0.0;
  }

  /// The shear force after a step: the old one turned with the normal, less K_s times the
  /// tangential part of the relative displacement, cut back to the Coulomb limit
  /// c + F_n tan(phi).
  ///
  /// (1) The result is normal to `normal` up to rounding.
  /// (2) Its length is at most the limit, up to rounding.
  /// (3) Without displacement and limit its length is that of the old force.
  /// @param shear         before the step, normal to previous_normal
  /// @param displacement  of b relative to a at the contact during the step, length
  Vec3 shear_force(const Vec3& shear, const Vec3& previous_normal, const Vec3& normal,
                   const Vec3& displacement, double normal_force) const;
};

/// v turned by the smallest rotation that takes unit vector `from` to unit vector `to`; for
/// opposite vectors, where that is not unique, reversed.
Vec3 turned_with(const Vec3& v, const Vec3& from, const Vec3& to);

}  // namespace tangency::dem
