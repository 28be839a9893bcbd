// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/micro_summary.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include <tangency/dem/micromechanics/direction_integrals.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace mm = micromechanics;

double angle_deg(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi;
}

void count_rattlers(MicroSummary& summary, const Packing& packing) {
  const std::vector<std::int32_t>& count = packing.particles.contacts;
  const auto rattles = [&](std::int64_t id) { return count[static_cast<std::size_t>(id)] < 2; };
  for (std::int64_t id = 0; id < summary.particles; ++id) summary.rattlers += rattles(id) ? 1 : 0;
  std::int64_t between = 0;
  for (const auto& [a, b] : packing.contacts.bodies) between += rattles(a) || rattles(b) ? 0 : 1;
  const std::int64_t others = summary.particles - summary.rattlers;
  if (others > 0)
    summary.coordination_without_rattlers =
        2.0 * static_cast<double>(between) / static_cast<double>(others);
}

void measure_vector_angles(MicroSummary& summary, const mm::ContactArrays& contacts) {
  double sum = 0.0, largest = 0.0;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (const bool of_b : {false, true}) {
      const Vec3 outward = of_b ? Vec3(-contacts.normal[c]) : contacts.normal[c];
      const double angle = angle_deg(contacts.lever(c, of_b), outward);
      sum += angle;
      largest = std::max(largest, angle);
    }
  summary.mean_vector_angle = sum / (2.0 * static_cast<double>(contacts.size()));
  summary.largest_vector_angle = largest;
}

Mat3 undefined() { return Mat3::Constant(kNotDefined); }

/// The stress of groups whose means of force and of contact vector are multiplied.
Mat3 independent_stress(const mm::ContactArrays& arrays, const mm::Classes& classes) {
  const mm::SpherePartition partition =
      arrays.dimensions == 2 ? mm::SpherePartition::polar(1, classes.arcs()) : classes.partition();
  return mm::group_sums(mm::DirectionGroups(partition, arrays.normal), arrays).independent;
}

Named<StressSummary> stresses_of(const MicroSummary& summary, const mm::ContactArrays& arrays) {
  Mat3 seven = undefined(), eight = undefined(), fourth = undefined(), noshape = undefined();
  if (summary.state) {
    const mm::StressParts parts = mm::stress_parts(*summary.state);
    mm::SecondOrderState round = *summary.state;
    round.z = round.zt = Mat3::Zero();
    seven = parts.seven();
    eight = parts.sum();
    noshape = mm::stress_parts(round).seven();
    fourth = summary.averages.stress_of_both_orders().value_or(undefined());
  } else if (summary.plane) {
    mm::PlaneState round = *summary.plane;
    round.z = round.zt = Mat3::Zero();
    eight = mm::plane_stress(*summary.plane);
    noshape = mm::plane_stress(round);
  }
  const bool has_contacts = arrays.size() > 0;
  const Mat3 measured = has_contacts ? summary.averages.stress : undefined();
  const Mat3 independent = has_contacts ? independent_stress(arrays, summary.classes) : undefined();
  Named<StressSummary> stresses;
  const std::array all{measured, seven, eight, fourth, noshape, independent};
  static_assert(all.size() == kStressNames.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    stresses.emplace_back(kStressNames[k], summary_of(all[k], summary.dimensions));
  return stresses;
}

/// Of an anisotropy, over f0 or z0. Chosen: what remains of forces that have no tangential part is
/// 1e-16 or so, and scatter alone leaves 1e-3 of any that have.
constexpr double kRoundingAlone = 1e-12;

/// 0 where it has no axes.
std::optional<Mat3> second_of(const mm::Averages::Tensor& tensor) {
  if (!tensor) return std::nullopt;
  return has_axes(*tensor) ? tensor->second : Mat3(Mat3::Zero());
}

std::optional<Mat3> difference(const mm::Averages::Tensor& a, const mm::Averages::Tensor& b) {
  return a && b ? std::optional<Mat3>(*second_of(a) - *second_of(b)) : std::nullopt;
}

}  // namespace

bool has_axes(const mm::TensorEstimate& x) { return mm::modulus(x.second) >= kRoundingAlone; }

bool is_rounding(const mm::TensorEstimate& x) {
  return !has_axes(x) && !(x.fourth && x.fourth->norm() >= kRoundingAlone);
}

mm::Coaxiality compared(const Mat3& x, const Mat3& y) {
  const Mat3 of_x = mm::harmonic_part(x), of_y = mm::harmonic_part(y);
  if (of_x.isZero(0.0) || of_y.isZero(0.0))
    return {kNotDefined, {kNotDefined, kNotDefined, kNotDefined}, kNotDefined};
  return mm::coaxiality(of_x, of_y);
}

StressSummary summary_of(const Mat3& stress, int dimensions) {
  StressSummary found;
  found.tensor = stress;
  if (!stress.allFinite()) return found;
  const Eigen::SelfAdjointEigenSolver<Mat3> solved(0.5 * (stress + stress.transpose()),
                                                   Eigen::EigenvaluesOnly);
  const Vec3& value = solved.eigenvalues();
  if (dimensions == 3) {
    found.mean = stress.trace() / 3.0;
    found.principal = {value[2], value[1], value[0]};
    found.ratio = mm::shear_stress_ratio(stress);
    return found;
  }
  const double size = mm::amplitude(stress);
  found.mean = 0.5 * (stress(0, 0) + stress(1, 1));
  found.principal = {found.mean + size, found.mean - size, kNotDefined};
  found.ratio = mm::plane_shear_ratio(stress);
  return found;
}

mm::BodyArrays bodies_of(const Packing& packing) {
  return {packing.particles.orientation, packing.particles.semi_axes};
}

MicroSummary micro_summary(const Packing& packing, const mm::Classes& classes) {
  const mm::ContactArrays arrays = packing.arrays();
  MicroSummary summary;
  summary.dimensions = packing.dimensions;
  summary.particles = static_cast<std::int64_t>(packing.particles.size());
  summary.contacts = static_cast<std::int64_t>(arrays.size());
  summary.wall_contacts = packing.wall_contacts;
  summary.volume = packing.volume;
  summary.classes = classes;
  summary.coordination = mm::coordination_of(arrays);
  count_rattlers(summary, packing);
  summary.averages = mm::averages_of(arrays, bodies_of(packing), classes);
  summary.averages.stress += packing.wall_stress;
  summary.state = mm::second_order_state(summary.averages, summary.dimensions);
  summary.plane = mm::plane_state(summary.averages, summary.dimensions);
  summary.stresses = stresses_of(summary, arrays);
  summary.axis_groups = mm::axis_groups(arrays.normal, arrays.force);
  if (arrays.size() == 0) return summary;
  double sum = 0.0;
  for (const double force : packing.contacts.normal_force) sum += force;
  summary.bodies = body_summary(arrays, bodies_of(packing));
  summary.mean_normal_force = sum / static_cast<double>(arrays.size());
  measure_vector_angles(summary, arrays);
  return summary;
}

Named<const mm::TensorEstimate*> tensors_of(const mm::Averages& averages) {
  const auto at = [](const mm::Averages::Tensor& tensor) { return tensor ? &*tensor : nullptr; };
  return {{"r", at(averages.normals)},
          {"n", at(averages.force_normal)},
          {"t", at(averages.force_tangential)},
          {"z", at(averages.branch_normal)},
          {"zt", at(averages.branch_tangential)},
          {"len", at(averages.branch_length)},
          {"E", at(averages.long_axes)},
          {"lambda", at(averages.contact_vectors)},
          {"cv", at(averages.local_contacts)}};
}

double mean_of(const mm::Averages::Tensor& tensor) { return tensor ? tensor->mean : kNotDefined; }

double signed_size(const mm::TensorEstimate* x, const mm::TensorEstimate* r) {
  if (!x || !r) return kNotDefined;
  const double along = mm::contracted(x->second, r->second);
  return along == 0.0 ? 0.0 : std::copysign(mm::modulus(x->second), along);
}

Named<std::optional<Mat3>> parts_of(const std::optional<mm::SecondOrderState>& state) {
  using Part = std::optional<Mat3>;
  const auto parts = state ? std::optional(mm::stress_parts(*state)) : std::nullopt;
  const auto part = [&](Mat3 mm::StressParts::*which) {
    return parts ? Part((*parts).*which) : std::nullopt;
  };
  return {{"fabric", part(&mm::StressParts::fabric)},
          {"branch", part(&mm::StressParts::branch)},
          {"force", part(&mm::StressParts::force)},
          {"fabric_branch", part(&mm::StressParts::fabric_branch)},
          {"fabric_force", part(&mm::StressParts::fabric_force)},
          {"force_branch", part(&mm::StressParts::force_branch)},
          {"fabric_force_branch", part(&mm::StressParts::fabric_force_branch)}};
}

Named<double> named_shares(const mm::ShearShares& shares) {
  return {{"r", shares.r},   {"n", shares.n},   {"t", shares.t},
          {"z", shares.z},   {"zt", shares.zt}, {"rz", shares.rz},
          {"rf", shares.rf}, {"zf", shares.zf}, {"rfz", shares.rfz}};
}

mm::ShearShares undefined_shares() {
  constexpr double none = kNotDefined;
  return {none, none, none, none, none, none, none, none, none};
}

SharesSummary shares_of(const std::optional<mm::SecondOrderState>& state) {
  if (!state) return {};
  return {mm::shear_shares(*state), mm::shear_shares(*state, true),
          mm::axisymmetric_shares(mm::signed_magnitudes(*state))};
}

PlaneRatios plane_ratios(const std::optional<mm::PlaneState>& plane) {
  if (!plane) return {};
  const auto amplitude = [&](const Mat3& x) {
    return std::copysign(mm::amplitude(x), mm::contracted(x, plane->r));
  };
  const mm::PlaneAmplitudes all{amplitude(plane->r), amplitude(plane->n), amplitude(plane->t),
                                amplitude(plane->z), amplitude(plane->zt)};
  return {mm::shear_ratio_of_small_anisotropy(all), mm::coaxial_shear_ratio(all)};
}

Named<std::optional<Mat3>> compared_tensors(const mm::Averages& averages) {
  return {{"n", second_of(averages.force_normal)},
          {"t", second_of(averages.force_tangential)},
          {"z", second_of(averages.branch_normal)},
          {"zt", second_of(averages.branch_tangential)},
          {"E", second_of(averages.long_axes)},
          {"df", difference(averages.force_normal, averages.force_tangential)},
          {"dz", difference(averages.branch_normal, averages.branch_tangential)}};
}

Named<double> body_numbers(const BodySummary& bodies) {
  constexpr std::array kLengths{"short", "intermediate", "long"};
  constexpr std::array kPairs{"ss", "si", "sl", "ii", "il", "ll"};
  const auto& seen = bodies.contacts;
  const bool has_model = seen && seen->spheroid;
  Named<double> all;
  const auto add = [&](const std::string& name, double value) { all.emplace_back(name, value); };
  for (std::size_t k = 0; k < kLengths.size(); ++k)
    add(std::string("f_") + kLengths[k], seen ? seen->length[k].value : kNotDefined);
  for (std::size_t k = 0; k < kLengths.size(); ++k)
    add(std::string("f_") + kLengths[k] + "_model",
        has_model ? seen->spheroid->calculated[k] : kNotDefined);
  for (std::size_t k = 0; k < kPairs.size(); ++k)
    add(std::string("pair_") + kPairs[k], seen ? seen->pairs[k].value : kNotDefined);
  for (std::size_t k = 0; k < kPairs.size(); ++k)
    add(std::string("pair_model_") + kPairs[k],
        has_model ? seen->spheroid->calculated_pairs[k] : kNotDefined);
  const auto& in_space = bodies.rotation;
  const auto& in_plane = bodies.in_plane;
  add("P2", in_space   ? in_space->second.value
            : in_plane ? in_plane->mean_cosine.value
                       : kNotDefined);
  add("P4", in_space ? in_space->fourth.value : kNotDefined);
  add("P2_model", bodies.calculated_factor);
  add("a_axial_r_rot", in_space   ? in_space->rotated(2, 2)
                       : in_plane ? in_plane->rotated(1, 1)
                                  : kNotDefined);
  const auto& chi = bodies.independence;
  add("chi_squared", chi ? chi->chi_squared : kNotDefined);
  add("chi_degrees", chi ? static_cast<double>(chi->degrees) : kNotDefined);
  add("chi_p", chi ? chi->p_value : kNotDefined);
  return all;
}

Named<std::optional<int>> joint_signs_of(const mm::Averages& averages) {
  const auto r = second_of(averages.normals), t = second_of(averages.force_tangential);
  const auto zt = second_of(averages.branch_tangential);
  const auto df = difference(averages.force_normal, averages.force_tangential);
  const auto dz = difference(averages.branch_normal, averages.branch_tangential);
  const auto sign = [&](const std::optional<Mat3>& x, const std::optional<Mat3>& y) {
    return x && y && r ? std::optional(mm::joint_sign(*x, *y, *r)) : std::nullopt;
  };
  return {{"r_t", sign(r, t)},     {"r_df", sign(r, df)},  {"r_zt", sign(r, zt)},
          {"r_dz", sign(r, dz)},   {"t_zt", sign(t, zt)},  {"t_dz", sign(t, dz)},
          {"df_zt", sign(df, zt)}, {"df_dz", sign(df, dz)}};
}

}  // namespace tangency::inline v0::dem
