// SPDX-License-Identifier: MIT
/// @file
/// Contact laws: the linear one [Ouadfel1998, eq. 3.3-3.12] and that of Hertz and Mindlin.
///
/// Signs: a contact force is what particle a does to particle b; the normal points from a to b; so
/// a normal force > 0 is a push. The shear force is the part in the tangent plane.
///
/// The shear force after a step is the old one turned with the normal by the smallest rotation that
/// takes the one normal to the other (of opposite ones reversed), less the stiffness times the
/// tangential part of the displacement, cut back to the Coulomb limit c + F_n tan(phi). Where a
/// Hertz contact is unloaded its shear force shrinks with its stiffness, lest it gain energy in a
/// closed cycle [ThorntonRandall1988]. contact_lanes.hpp computes it:
///
/// (1) The result is normal to the normal up to rounding.
/// (2) Its length is at most the limit, up to rounding.
/// (3) Without displacement, limit and change of stiffness its length is that of the old force.
/// (4) The work done on the contact, -(old turned + new force)/2 . displacement, is the energy
///     stored plus what is lost to sliding.
///
/// A law may damp the approach: to the push of the overlap it adds 2 zeta sqrt(m S) times the rate
/// at which the overlap grows, S the stiffness d force / d overlap, m the mass that the two bodies
/// together show to an impulse along the normal at the contact, turns included; of a Hertz contact
/// sqrt(5/6) of it [Tsuji1992]. The sum is never a pull: the push ends where it comes to 0, before
/// the overlap does [SchwagerPoeschel2007]. zeta is given as the coefficient of restitution, which
/// then does not depend on speed, mass or stiffness (docs/derivations/restitution.md):
///
/// (5) A head-on impact gives back restitution() times the approach, in the limit of short steps.
#pragma once

#include <optional>

#include <tangency/dem/contact/hertz.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// Shear force over shear displacement of a contact, symmetric in the tangent plane.
struct ShearStiffness {
  double along = 0.0;             ///< force/length, for displacements along `direction`
  double across = 0.0;            ///< for those normal to it
  Vec3 direction = Vec3::Zero();  ///< unit and tangent, or 0 where the two are equal

  /// The larger of both.
  double largest() const { return along > across ? along : across; }
};

/// The push of a contact, and how its shear answers.
struct NormalResponse {
  double force = 0.0;      ///< > 0 pushes the bodies apart
  double stiffness = 0.0;  ///< d force / d overlap
  double energy = 0.0;     ///< stored by the overlap
  ShearStiffness shear;    ///< tangential stiffness, force per length
};

/// What a contact carries from step to step.
struct ShearState {
  Vec3 force = Vec3::Zero();  ///< of a on b, in the tangent plane
  double stiffness = 0.0;     ///< the larger one at the last step, force/length
  double energy = 0.0;        ///< stored by the shear displacement
};

/// Least coefficient of restitution of a law. Chosen: below it a damper, and not the spring, would
/// decide how short the step has to be.
inline constexpr double kLeastRestitution = 0.05;

/// zeta with which a law shows a coefficient of restitution in [kLeastRestitution, 1]: 0 for 1. Its
/// bits are the same on every machine.
double damping_ratio_of(double restitution);

/// The law of contacts between two types of particles.
struct ContactLaw {
  double normal_stiffness;      ///< K_n > 0, force/length; of a Hertz contact: the largest expected
  double shear_stiffness;       ///< K_s >= 0, alike
  double friction_coefficient;  ///< tan(phi) >= 0
  double cohesion;              ///< c >= 0, force: shear that a contact bears without a push
  std::optional<Material> hertz = {};  ///< instead of the linear law
  double damping_ratio = 0.0;          ///< zeta >= 0 of the approach; 0: nothing is lost

  /// Does an impact lose energy to the approach?
  bool dissipates() const { return damping_ratio > 0.0; }
  /// Of a head-on impact, in (0, 1]. Its bits are the same on every machine.
  double restitution() const;

  /// A law that bears no shear needs no shear history.
  bool bears_shear() const {
    return shear_stiffness > 0.0 && (friction_coefficient > 0.0 || cohesion > 0.0);
  }

  /// Of a Hertz contact: of the relative curvatures.
  /// @param relative  the curvatures of the distance
  /// @param overlap  > 0
  NormalResponse hertz_response(double overlap, const PrincipalCurvatures& relative) const;
};

}  // namespace tangency::inline v0::dem
