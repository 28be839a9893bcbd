// SPDX-License-Identifier: MIT
/// @file
/// All tensors of a packing by one estimator, in space and in the plane alike: what tables and
/// files are made of.
///
/// Each tensor is empty where its data do not define it: without contacts, where contacts leave
/// coefficients open, and of spheres and disks what needs an axis of the body. Numbers that are not
/// defined are NaN. Units, signs, errors and threads are those of contact_arrays.hpp and
/// fabric.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/fabric.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>
#include <tangency/dem/micromechanics/plane.hpp>
#include <tangency/dem/micromechanics/sphere_partition.hpp>
#include <tangency/dem/micromechanics/stress_force_fabric.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// How directions are sorted, by a number of the user.
struct Classes {
  /// How the sphere of directions is divided.
  enum class Kind { near_uniform, polar };
  Kind kind = Kind::near_uniform;  ///< how it is divided
  int count = 4;  ///< N: near_uniform has 24 N^2 classes, polar N rings of 2 N sectors about z

  /// The published choices: 4 and 18.
  static int usual_count(Kind kind) { return kind == Kind::near_uniform ? 4 : 18; }
  static constexpr int kMost = 100;  ///< chosen: 240000 classes are more than contacts fill
  /// Fewest: a polar partition of one ring has two classes, and no arcs in the plane.
  static int fewest(Kind kind) { return kind == Kind::near_uniform ? 1 : 2; }

  /// Requires fewest() <= count <= kMost.
  SpherePartition partition() const;
  /// In the plane: as many equal arcs as classes meet its circle, 8 N or 2 N.
  int arcs() const { return kind == Kind::near_uniform ? 8 * count : 2 * count; }
};

/// The body axis that tells how a body lies: of revolution, that axis; of three different axes the
/// longest. In the plane, where body axis 2 is that of z, the longer one of the other two. Empty of
/// spheres, and of disks in the plane.
std::optional<int> telling_axis(const Vec3& semi_axes, int dimensions = 3);

/// A tensor of orientations, with standard errors.
struct TensorEstimate {
  double mean = kNotDefined, mean_error = kNotDefined;      ///< what the tensor is relative to
  Mat3 second = Mat3::Zero(), second_error = Mat3::Zero();  ///< deviatoric, symmetric, in space
  std::optional<SymmetricTensor4> fourth, fourth_error;     ///< in space
  /// unexplained_variance of the model of order 2, and of orders 2 and 4; in space.
  double unexplained2 = kNotDefined, unexplained4 = kNotDefined;

  /// The root of the sum of squares of the standard errors of all components: what |second| is from
  /// scatter alone.
  double second_scatter() const { return second_error.norm(); }
  /// As second_scatter(), of the fourth order; NaN where there is none.
  double fourth_scatter() const { return fourth_error ? fourth_error->norm() : kNotDefined; }
};

/// All averages over the contacts of one state.
struct Averages {
  /// Empty where no contact or no column tells it.
  using Tensor = std::optional<TensorEstimate>;

  Mat3 stress = Mat3::Zero();                  ///< stress_of
  double contact_density = 0.0;                ///< m_v, contact sides per volume
  std::size_t classes = 0, empty_classes = 0;  ///< in the plane: arcs
  Tensor normals;                              ///< a^r, b^r
  Tensor force_normal, force_tangential;       ///< f0, a^n, b^n, a^t, b^t
  Tensor branch_normal, branch_tangential;     ///< z0, a^z, b^z, a^zt, b^zt
  Tensor branch_length;                        ///< of |branch|
  Tensor contact_vectors;                      ///< in space axes; needs `arm`
  Tensor local_contacts;                       ///< in body axes: a^cv; needs `arm` and `bodies`
  Tensor long_axes;                            ///< telling_axis of all bodies that have one: a^E
  /// The telling_axis of all bodies that have one; empty where it is not the same of all. a1 is the
  /// component of a^cv along it [Ouadfel1998, eq. 7.8].
  std::optional<int> body_axis;
  /// VectorFit's; NaN in the plane.
  double force_asymmetry = kNotDefined, branch_asymmetry = kNotDefined;

  /// Of the models of orders 2 and 4 in space, empty where a tensor is.
  std::optional<Mat3> stress_of_both_orders() const;
};

/// @param contacts  the contacts
/// @param classes  how directions are sorted
/// @param estimator  how coefficients are estimated
/// @param bodies  may be empty: then what needs them is
/// @throws std::invalid_argument  as require_sound() and SpherePartition do
///
/// (1) each tensor is that of fabric_of, plane_fabric_of or fit_orientations
/// (2) renumbering the bodies changes nothing but rounding
Averages averages_of(const ContactArrays& contacts, const BodyArrays& bodies,
                     const Classes& classes = {}, Estimator estimator = Estimator::unbiased);

/// What the theory of the stress takes; empty where a tensor is, and in the other dimension.
std::optional<SecondOrderState> second_order_state(const Averages& averages, int dimensions);
/// The averages in the plane; empty in space, and where a tensor is empty.
std::optional<PlaneState> plane_state(const Averages& averages, int dimensions);

}  // namespace tangency::inline v0::micromechanics
