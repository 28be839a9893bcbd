// SPDX-License-Identifier: MIT
/// @file
/// The stress of a packing from the anisotropies of its contact normals, forces and branch vectors,
/// and what each of them bears [Ouadfel1998, chapter 6].
///
/// s_ij = (m_v/2) times the integral over the sphere of f_i z_j E: with models of order 2 a
/// polynomial in five tensors that need be neither coaxial nor axisymmetric. The order of factors
/// matters: stresses are not symmetric where moments are not balanced. Compression is positive;
/// units are those of force/area; tensors are pure numbers, symmetric and traceless. Functions keep
/// no state: any number of threads may call. Formulas and errata:
/// docs/derivations/micromechanics.md.
#pragma once

#include <array>
#include <optional>

#include <tangency/dem/micromechanics/fabric.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// What the theory knows of a packing, order 2. "Without shape": z and zt are 0.
struct SecondOrderState {
  double contact_density = 0.0;  ///< m_v, contact sides per volume
  double force = 0.0;            ///< f0, mean normal force over orientations
  double branch = 0.0;           ///< z0, mean normal component of branches over orientations
  Mat3 r = Mat3::Zero();         ///< contact normals
  Mat3 n = Mat3::Zero();         ///< normal forces
  Mat3 t = Mat3::Zero();         ///< tangential forces
  Mat3 z = Mat3::Zero();         ///< normal components of branches
  Mat3 zt = Mat3::Zero();        ///< tangential components of branches

  /// s0 = m_v f0 z0 / 6: the mean stress of an isotropic packing.
  double isotropic_stress() const { return contact_density * force * branch / 6.0; }
};
/// Empty where a fit is.
std::optional<SecondOrderState> second_order_state(const Fabric& fabric);

/// The parts of the stress. The published relation has the first seven.
///
/// (1) the eight together are the integral of the models of order 2
struct StressParts {
  /// of the isotropic state, of each anisotropy, and of two jointly
  Mat3 isotropic, fabric, branch, force, fabric_branch, fabric_force, force_branch;
  Mat3 fabric_force_branch;  ///< of order 3 in the anisotropies, dropped in eq. 6.21

  /// The sum of the seven parts above.
  Mat3 seven() const;
  /// All parts.
  Mat3 sum() const { return seven() + fabric_force_branch; }
};
/// The stress by parts.
StressParts stress_parts(const SecondOrderState& state);

/// A third of the trace, and the deviator of the symmetric part, of the first seven parts, by
/// contractions alone (eq. 6.24, 6.25).
///
/// (2) they are those of StressParts::seven()
double mean_stress(const SecondOrderState& state);
/// The deviator of the symmetric part.
Mat3 deviatoric_stress(const SecondOrderState& state);

/// The stress of models of orders 2 and 4 together, by a quadrature that is exact for them.
/// @param contact_density  contact sides per volume
/// @param force  of normal forces
/// @param tangential_force  of tangential forces
/// @param branch  of the normal components of branches
/// @param tangential_branch  of tangential branches
/// @param density  its mean counts: 1/(4 pi)
Mat3 stress_of_models(double contact_density, const ScalarHarmonics& density,
                      const ScalarHarmonics& force, const TangentialHarmonics& tangential_force,
                      const ScalarHarmonics& branch, const TangentialHarmonics& tangential_branch);

/// a_s = sqrt(3/2 s':s') / (tr s / 3) (eq. 6.23): (s1 - s3)/mean where s2 = s3. NaN without mean.
double shear_stress_ratio(const Mat3& stress);
/// sin(phi) of a triaxial state, s2 = s3: 3 a_s / (6 + a_s). From degrees and back.
double shear_stress_ratio_of_friction_angle(double degrees);
/// Of a ratio of shear stress to mean stress, rad.
double friction_angle_of_shear_stress_ratio(double ratio);

/// What each anisotropy and each pair of them gives to a_s. Pure numbers; NaN without deviator.
struct ShearShares {
  double r = 0.0, z = 0.0, zt = 0.0, n = 0.0, t = 0.0;  ///< of one alone
  double rz = 0.0, rf = 0.0, zf = 0.0;                  ///< of fabric, branches and forces jointly
  double rfz = 0.0;                                     ///< of all three, dropped in eq. 6.21

  /// All parts.
  double sum() const { return r + z + zt + n + t + rz + rf + zf + rfz; }
  /// Of the shape of particles: z + zt + rz/2 + zf/2.
  double shape() const { return z + zt + 0.5 * (rz + zf); }
};
/// In any state: each part's deviator along that of the whole, over the mean of the whole.
///
/// (3) they add up to a_s of the whole
/// @param state  of a run
/// @param eighth  whether the part of order 3 is in the whole; else rfz is 0
ShearShares shear_shares(const SecondOrderState& state, bool eighth = false);

/// Sizes with signs, A_X = sgn(X:a^r) |X| (eq. 6.28).
struct SignedMagnitudes {
  double r = 0.0, z = 0.0, zt = 0.0, n = 0.0, t = 0.0;  ///< signed magnitudes of the tensors
  /// + where contacts prefer the axis, as in compression; - in extension: sgn(det a^r), that of the
  /// axial principal value.
  double sense = 1.0;
};
/// Of each tensor along the deviatoric stress.
SignedMagnitudes signed_magnitudes(const SecondOrderState& state);

/// D_n = 1 + (2/15)(A_r A_n + A_r A_z + A_n A_z + (3/2) A_t A_zt): mean stress over s0.
double mean_stress_factor(const SignedMagnitudes& a);
/// Of tensors that are all axisymmetric about one axis, from magnitudes alone (eq. 6.46-6.48). The
/// single shares have the signs of A; joint shares change sign in extension.
///
/// (4) equals shear_shares of such a state
ShearShares axisymmetric_shares(const SignedMagnitudes& a);

/// sgn((X Y)' : a^r), the sense in which a pair of anisotropies adds to shear (section 6.5.3); 0 of
/// none. Products of single signs only where a^r is axially positive.
int joint_sign(const Mat3& x, const Mat3& y, const Mat3& r);

/// How far the principal axes of two symmetric tensors are apart. Of equal principal values the
/// axes, and so their angles, are arbitrary: `commutator` and, of an axisymmetric deviator,
/// `axial_deg` are not.
struct Coaxiality {
  /// Between the axes of the principal values that are largest in size: the axial ones. Of 90
  /// degrees or less.
  double axial_deg = 0.0;
  /// Between all axes, in the assignment that brings them nearest; ascending.
  std::array<double, 3> angles_deg{};
  /// |XY - YX| / (|X| |Y|): 0 of coaxial tensors, whether or not axes are told apart. NaN with a
  /// tensor that is 0.
  double commutator = 0.0;
};
/// How nearly two deviatoric tensors share their axes.
Coaxiality coaxiality(const Mat3& x, const Mat3& y);

/// |x2 - x3| / |x1| of the principal values of a deviator, x1 the largest in size: 0 is
/// axisymmetric, 1 is pure shear in a plane. NaN of 0.
double departure_from_axisymmetry(const Mat3& x);

}  // namespace tangency::inline v0::micromechanics
