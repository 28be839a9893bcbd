// SPDX-License-Identifier: MIT
/// @file
/// The tensors of a packing: how contact normals, forces, branch vectors and long axes depend on
/// direction, by harmonics of orders 2 and 4, with their sampling errors [Ouadfel1998, sections 2.3
/// to 2.5, 5.4.8 and 6.3].
///
/// The models (harmonics.hpp): E(n) = (1/4 pi)(1 + a^r:nn + b^r::nnnn); of a vector v of contacts
/// v . n = v0 (1 + a:nn + b::nnnn) and the tangential rest v0 times the gradient on the sphere of
/// a^t:nn/2 + b^t::nnnn/4. v0 is the mean of v . n over orientations. Signs are those of
/// contact_arrays.hpp; all coefficients are pure numbers, v0 has the unit of v.
///
/// Errors: what arrays must be is said in contact_arrays.hpp. What the contacts leave open is
/// empty, not 0: no contact has no fabric, and normals all in one plane have no least squares.
/// Nothing is kept between calls: any number of threads may call.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/distributions.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// How coefficients come from contacts.
enum class Estimator {
  /// Class means at the middles of their classes, projected: the integral over orientations as a
  /// sum. The middle of a class is not its mean: on the near-uniform partition of 384 classes an
  /// anisotropy of order 2 comes out 0.8 to 1 % small.
  published,
  /// Least squares on the contacts themselves, weighted as over orientations, so that what the
  /// model lacks is left out alike in all directions. Without bias where the model holds.
  unbiased,
  /// Sums over contacts of v/(1 + a^r:nn), projected, as `compute fabric` of LAMMPS has them: no
  /// partition enters, but the density's model of order 2 does. Empty where that is not positive.
  contact_sums,
};

/// Standard deviations of the estimates, component by component, from the scatter of the data; one
/// physical contact is one datum. For independent contacts and a model that holds. NaN where there
/// are too few data to tell.
struct HarmonicErrors {
  double mean = 0.0;           ///< of the mean
  Mat3 second = Mat3::Zero();  ///< of the tensor of order 2
  /// of the tensor of order 4
  SymmetricTensor4 fourth{};
};

/// Directions: of contact normals, long axes, contact vectors. n and -n count as one. Estimates are
/// sums over the directions themselves, as published, and without bias.
struct OrientationFit {
  ScalarHarmonics model;  ///< the mean is 1/(4 pi)
  HarmonicErrors error;   ///< of independent directions all alike: sqrt(5/count) of a_xx
  std::size_t count = 0;  ///< how many directions
};
/// a = (15/2)(<nn> - I/3), b = (315/8) times the harmonic part of <nnnn>. Empty without directions.
/// @param directions  unit, else std::invalid_argument
///
/// (1) turning all directions turns the tensors
std::optional<OrientationFit> fit_orientations(std::span<const Vec3> directions);

/// A scalar by harmonics of even order, with standard errors.
struct ScalarFit {
  ScalarHarmonics model;     ///< the fit
  HarmonicErrors error;      ///< standard errors of its coefficients
  double unexplained = 0.0;  ///< unexplained_variance of the class means
};
/// The tangential part of a vector by harmonics, with standard errors.
struct TangentialFit {
  TangentialHarmonics model;  ///< its mean is that of the normal component
  HarmonicErrors error;       ///< its mean has none: 0
  double unexplained = 0.0;   ///< share of the variance that the model leaves
  /// |F - F'| over |F|, F the mean over orientations of v_t (x) n: the part of moments that are not
  /// balanced. The model has none of it. NaN without tangential components.
  double asymmetry = 0.0;
};
/// A vector by harmonics: its part along the normal and the rest.
struct VectorFit {
  ScalarFit normal;          ///< the part along the normal
  TangentialFit tangential;  ///< the part across it
};

/// Of a scalar that is the same from both sides. Empty where coefficients are open or the mean is
/// 0.
/// @param groups  the contacts, sorted by direction
/// @param values  one a contact
/// @param estimator  how coefficients are estimated
/// @param order  2 or 4, else std::invalid_argument; with 2 the fourth-order tensor is 0
std::optional<ScalarFit> fit_scalars(const DirectionGroups& groups, std::span<const double> values,
                                     Estimator estimator = Estimator::unbiased, int order = 4);

/// Of a vector that is the opposite from the other side: a force or a branch vector.
///
/// (2) turning normals and vectors by a symmetry of the partition turns the tensors; of `unbiased`
///     and `contact_sums` with fields that the model holds, turning by any rotation does
/// (3) exchanging a and b, and the order of contacts, change nothing but rounding
/// (4) vectors in another unit change the mean alone
std::optional<VectorFit> fit_vectors(const DirectionGroups& groups, std::span<const Vec3> vectors,
                                     Estimator estimator = Estimator::unbiased, int order = 4);

/// All of it. Each part is empty where its fit is.
struct Fabric {
  Mat3 stress = Mat3::Zero();    ///< stress_of
  double contact_density = 0.0;  ///< m_v, contact sides per volume
  /// contacts, and classes of directions that hold none
  std::size_t contacts = 0, empty_classes = 0;
  std::optional<OrientationFit> normals;  ///< a^r, b^r
  /// share of the variance of their density that the model leaves
  double normals_unexplained = 0.0;
  std::optional<VectorFit> force;                 ///< f0, a^n, b^n, a^t, b^t
  std::optional<VectorFit> branch;                ///< z0, a^z, b^z, a^zt, b^zt
  std::optional<ScalarFit> branch_length;         ///< of |branch|
  std::optional<OrientationFit> contact_vectors;  ///< in space axes; needs `arm`
};
/// Of contacts in space: dimensions must be 3, else std::invalid_argument; plane.hpp has the plane.
Fabric fabric_of(const ContactArrays& contacts, const SpherePartition& partition,
                 Estimator estimator = Estimator::unbiased, int order = 4);

}  // namespace tangency::inline v0::micromechanics
