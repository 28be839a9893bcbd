// SPDX-License-Identifier: MIT
/// @file
/// The micromechanics of one packing: every number that `tangency-dem micro` and micro.csv tell.
///
/// Contacts are those between particles. The axial direction is z, in the plane y. What is not
/// defined, as of no contact, of spheres or in the plane, is NaN, null or empty. Names are those of
/// columns and keys. Units, signs and sources are those of dem/micromechanics.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/micromechanics/averages.hpp>
#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/distributions.hpp>
#include <tangency/dem/micromechanics/plane.hpp>
#include <tangency/dem/micromechanics/stress_force_fabric.hpp>
#include <tangency/dem/tool/body_summary.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

using micromechanics::kNotDefined;

/// Names and values, in the order in which they are told.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

/// A stress and what is read off it.
struct StressSummary {
  Mat3 tensor = Mat3::Constant(kNotDefined);
  double mean = kNotDefined;
  /// Of the symmetric part, the largest first; the third NaN in the plane.
  std::array<double, 3> principal{kNotDefined, kNotDefined, kNotDefined};
  double ratio = kNotDefined;  ///< a_s, in the plane (s1 - s2)/(s1 + s2)
};
StressSummary summary_of(const Mat3& stress, int dimensions);

/// Sums over contacts; the published seven parts; all eight, in the plane all there are; models of
/// orders 2 and 4; the seven of bodies without shape, a^z = a^zt = 0; group means multiplied.
inline constexpr std::array kStressNames{"measured", "seven",   "eight",
                                         "fourth",   "noshape", "independent"};

struct MicroSummary {
  int dimensions = 3;
  std::int64_t particles = 0, contacts = 0, wall_contacts = 0;
  double volume = 0.0;  ///< an area in the plane
  micromechanics::Classes classes;

  micromechanics::Coordination coordination;
  std::int64_t rattlers = 0;  ///< particles with fewer than two contacts, walls included
  /// Of the others and of contacts between them.
  double coordination_without_rattlers = kNotDefined;

  /// By the unbiased estimator; the stress has its share of contacts with walls.
  micromechanics::Averages averages;
  /// Each empty where a tensor of it is, and in the other dimension.
  std::optional<micromechanics::SecondOrderState> state;
  std::optional<micromechanics::PlaneState> plane;
  Named<StressSummary> stresses;  ///< those of kStressNames

  BodySummary bodies;

  double mean_normal_force = kNotDefined;  ///< over contacts
  std::array<micromechanics::AxisGroup, 3> axis_groups{};
  /// Between contact vectors and normals, over both sides of all contacts, degrees.
  double mean_vector_angle = kNotDefined, largest_vector_angle = kNotDefined;
};
/// @throws std::invalid_argument  for classes that are none
MicroSummary micro_summary(const Packing& packing, const micromechanics::Classes& classes);

/// The bodies of a packing as averages take them; valid as long as the packing.
micromechanics::BodyArrays bodies_of(const Packing& packing);

/// r n t z zt len E lambda cv.
Named<const micromechanics::TensorEstimate*> tensors_of(const micromechanics::Averages& averages);

/// Is more of its second order there than the rounding of a tensor that is 0, as without friction?
/// Without that it has neither a sign nor axes.
bool has_axes(const micromechanics::TensorEstimate& x);
/// Is there nothing but rounding in any order?
bool is_rounding(const micromechanics::TensorEstimate& x);
/// |X - X'| / |X|; not defined where X is rounding.
inline double asymmetry_of(const micromechanics::Averages::Tensor& tensor, double asymmetry) {
  return tensor && is_rounding(*tensor) ? kNotDefined : asymmetry;
}
/// The axes of the deviators; not defined where one is 0.
micromechanics::Coaxiality compared(const Mat3& x, const Mat3& y);

/// Over orientations; NaN without a tensor.
double mean_of(const micromechanics::Averages::Tensor& tensor);
/// 1, 0 or -1.
inline int sign_of(double x) { return (x > 0.0) - (x < 0.0); }

/// The size of a tensor with the sign of its sense, sgn(X:a^r) |X|; NaN without either.
double signed_size(const micromechanics::TensorEstimate* x,
                   const micromechanics::TensorEstimate* r);

/// fabric, branch, force, fabric_branch, fabric_force, force_branch, fabric_force_branch.
Named<std::optional<Mat3>> parts_of(const std::optional<micromechanics::SecondOrderState>& state);

/// r n t z zt rz rf zf rfz.
Named<double> named_shares(const micromechanics::ShearShares& shares);
micromechanics::ShearShares undefined_shares();
/// Of the seven parts, of the eight, and by magnitudes alone; not defined without a state.
struct SharesSummary {
  micromechanics::ShearShares seven = undefined_shares(), eight = undefined_shares(),
                              axisymmetric = undefined_shares();
};
SharesSummary shares_of(const std::optional<micromechanics::SecondOrderState>& state);

/// sin(phi) of coaxial tensors in the plane, for small anisotropies and in full.
struct PlaneRatios {
  double small = kNotDefined, coaxial = kNotDefined;
};
PlaneRatios plane_ratios(const std::optional<micromechanics::PlaneState>& plane);

/// The tensors whose axes and signs are compared with those of a^r: n t z zt E df dz, the last two
/// a^n - a^t and a^z - a^zt.
Named<std::optional<Mat3>> compared_tensors(const micromechanics::Averages& averages);

/// In the order of columns: f_short f_intermediate f_long, the same with _model, pair_ss to
/// pair_ll, pair_model_ss to pair_model_ll, P2 P4 P2_model a_axial_r_rot chi_squared chi_degrees
/// chi_p.
Named<double> body_numbers(const BodySummary& bodies);

/// sgn((XY)':a^r) of r_t r_df r_zt r_dz t_zt t_dz df_zt df_dz.
Named<std::optional<int>> joint_signs_of(const micromechanics::Averages& averages);

}  // namespace tangency::inline v0::dem
