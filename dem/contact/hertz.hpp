// SPDX-License-Identifier: MIT
/// @file
/// Hertz's contact of two smooth bodies, whose surfaces part like (curvature[1] x^2 + curvature[0]
/// y^2) / 2 from the common tangent plane, and Mindlin's shear stiffness of it without slip.
///
/// The bodies touch in an ellipse with semi-axes a >= b, a along the direction of curvature[1], the
/// smaller one. With k = b/a, K the complete elliptic integral of the first kind and D = (K - E) /
/// (1 - k^2), both of modulus sqrt(1 - k^2) [Johnson1985, section 4.2]:
///
///     k^2 D / (K - D) = curvature[1] / curvature[0],
///     a^2 = 2 overlap D / (K curvature[1]),   P = (2 pi / 3) a overlap E* / K.
///
/// (1) Equal curvatures 1/R give P = (4/3) E* sqrt(R) overlap^(3/2) and a = b = sqrt(R overlap).
/// (2) P goes with overlap^(3/2) at given curvatures.
/// (3) Equal curvatures give a shear stiffness 4 a G / (2 - nu) for bodies of one material
///     [Mindlin1949].
#pragma once

namespace tangency::inline v0::dem {

/// An isotropic elastic material, that of both bodies.
struct Material {
  double young_modulus;  ///< E > 0, force/area
  double poisson_ratio;  ///< nu, in [0, 0.5]

  /// E* of two such bodies: E / (2 (1 - nu^2)).
  double contact_modulus() const {
    return young_modulus / (2.0 * (1.0 - poisson_ratio * poisson_ratio));
  }
  /// E / (2 (1 + nu)), force per length^2.
  double shear_modulus() const { return young_modulus / (2.0 * (1.0 + poisson_ratio)); }
};

/// The shape of a contact ellipse, which does not depend on the load.
struct ContactEllipse {
  double axis_ratio;  ///< k = b / a, in (0, 1]
  double K, D;        ///< see above; pi/2 and pi/4 for a circle
};

/// @param ratio  of the smaller relative curvature to the larger, in (0, 1]
/// axis_ratio to a few u of itself, u = 2^-53, for ratios down to 1e-200.
ContactEllipse contact_ellipse(double ratio);

/// A loaded contact.
struct HertzContact {
  double force;               ///< P, a push
  double stiffness;           ///< dP / d overlap at these curvatures
  double energy;              ///< 2/5 P overlap
  double semi_axes[2];        ///< a >= b
  double shear_stiffness[2];  ///< shear force over displacement along a and along b
};

/// @param material  of both bodies
/// @param curvature  principal relative curvatures, the larger first, 1/length, > 0
/// @param overlap    approach of the bodies, length, > 0
HertzContact hertz_contact(const double curvature[2], double overlap, const Material& material);

}  // namespace tangency::inline v0::dem
