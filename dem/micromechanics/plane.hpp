// SPDX-License-Identifier: MIT
/// @file
/// The same in the plane: disks and ellipses [Ouadfel1998, eq. 5.5 and section 7.4;
/// RothenburgBathurst1992].
///
/// Vectors have z = 0 and tensors the third row and column 0, as plane cells have them. A tensor is
/// symmetric and traceless in the plane: its positive principal value is the amplitude A, its axis
/// has the angle phi, and a:nn = A cos 2(theta - phi). E = (1/2 pi)(1 + a^r:nn), v . n = v0 (1 +
/// a:nn), the tangential rest v0 (a^t n - (a^t:nn) n). Signs, errors and threads are as in
/// contact_arrays.hpp and fabric.hpp; stresses are those of the unit thickness.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/fabric.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// What the theory knows of a plane packing; names as in SecondOrderState.
struct PlaneState {
  double contact_density = 0.0;      ///< contact sides per area
  double force = 0.0, branch = 0.0;  ///< means that the tensors are relative to
  /// tensors of normals, forces along and across them, branches along and across
  Mat3 r = Mat3::Zero(), n = Mat3::Zero(), t = Mat3::Zero(), z = Mat3::Zero(), zt = Mat3::Zero();

  /// m_v f0 z0 / 4
  double isotropic_stress() const { return contact_density * force * branch / 4.0; }
};

/// (m_v/2) times the integral over the circle of f_i z_j E, in closed form, of tensors that need
/// not be coaxial. Not symmetric where moments are not balanced.
///
/// (1) equals the quadrature of the models
Mat3 plane_stress(const PlaneState& state);

/// (s1 - s2)/(s1 + s2) = sin(phi) of the symmetric part; NaN without mean stress.
double plane_shear_ratio(const Mat3& stress);

/// Amplitudes of coaxial tensors along the major axis of contact normals, with signs.
struct PlaneAmplitudes {
  double r = 0.0, n = 0.0, t = 0.0, z = 0.0, zt = 0.0;  ///< signed amplitudes of the same tensors
};
/// The positive principal value of a plane tensor.
double amplitude(const Mat3& a);

/// (a_r + a_n + a_t)/2: of disks with small anisotropies, as published (eq. 5.5).
double shear_ratio_of_small_anisotropy(const PlaneAmplitudes& a);
/// In full, of ellipses; of disks z = zt = 0: (1/2)(r + n + t)/(1 + r n/2).
///
/// (2) equals plane_shear_ratio(plane_stress) of coaxial tensors, where it is not negative
double coaxial_shear_ratio(const PlaneAmplitudes& a);

/// Estimates and standard deviations; of fields that are empty in Fabric, alike.
struct PlaneScalarFit {
  double mean = 0.0, mean_error = 0.0;  ///< over all directions, and its standard error
  /// deviatoric, and standard errors of its components
  Mat3 second = Mat3::Zero(), second_error = Mat3::Zero();
};
/// A vector in the plane by harmonics.
struct PlaneVectorFit {
  PlaneScalarFit normal;  ///< the part along the normal
  /// The mean is that of the normal component, without an error of its own.
  PlaneScalarFit tangential;
};

/// a = 4 (<nn> - I/2) over the directions themselves; its mean is 1/(2 pi). Empty without any.
std::optional<PlaneScalarFit> fit_plane_orientations(std::span<const Vec3> directions);

/// By contacts sorted into equal arcs, as fit_vectors. `contact_sums` takes no arcs.
/// @param normals  unit, one a contact
/// @param vectors  one a contact
/// @param estimator  how coefficients are estimated
/// @param arcs  even and at least 4, so that opposite directions are of opposite classes;
///              std::invalid_argument otherwise
std::optional<PlaneVectorFit> fit_plane_vectors(std::span<const Vec3> normals,
                                                std::span<const Vec3> vectors, int arcs = 36,
                                                Estimator estimator = Estimator::unbiased);

/// Fabric and stress of contacts in the plane.
struct PlaneFabric {
  Mat3 stress = Mat3::Zero();             ///< force per length
  double contact_density = 0.0;           ///< contact sides per area
  std::size_t contacts = 0;               ///< how many
  std::optional<PlaneScalarFit> normals;  ///< empty where there are no contacts
  /// of forces and branches, empty where there are no contacts
  std::optional<PlaneVectorFit> force, branch;
};
/// Of contacts in the plane: dimensions must be 2, else std::invalid_argument.
PlaneFabric plane_fabric_of(const ContactArrays& contacts, int arcs = 36,
                            Estimator estimator = Estimator::unbiased);
/// Empty where a fit is.
std::optional<PlaneState> plane_state(const PlaneFabric& fabric);

}  // namespace tangency::inline v0::micromechanics
