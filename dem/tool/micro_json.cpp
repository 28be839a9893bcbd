// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/micro_json.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/micromechanics/direction_integrals.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace mm = micromechanics;
using Json = nlohmann::ordered_json;

Json json(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json json(const Mat3& m) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({json(m(i, 0)), json(m(i, 1)), json(m(i, 2))});
  return rows;
}

/// 3x3x3x3, nested.
Json json(const mm::SymmetricTensor4& b) {
  Json all = Json::array();
  for (int i = 0; i < 3; ++i) {
    all.push_back(Json::array());
    for (int j = 0; j < 3; ++j) {
      all.back().push_back(Json::array());
      for (int k = 0; k < 3; ++k)
        all.back().back().push_back(
            {json(b(i, j, k, 0)), json(b(i, j, k, 1)), json(b(i, j, k, 2))});
    }
  }
  return all;
}

Json json(const mm::TensorEstimate& x);

template <class T>
Json json(const std::optional<T>& x) {
  return x ? json(*x) : Json(nullptr);
}

Json json(const mm::TensorEstimate& x) {
  return {{"second", json(x.second)},
          {"fourth", json(x.fourth)},
          {"magnitude", mm::modulus(x.second)},
          {"second_error", json(x.second_error)},
          {"fourth_error", json(x.fourth_error)},
          {"magnitude_error", json(x.second_scatter())},
          {"fourth_magnitude", x.fourth ? json(x.fourth->norm()) : Json(nullptr)},
          {"mean", json(x.mean)},
          {"mean_error", json(x.mean_error)},
          {"unexplained2", is_rounding(x) ? Json(nullptr) : json(x.unexplained2)},
          {"unexplained4", is_rounding(x) ? Json(nullptr) : json(x.unexplained4)}};
}

/// The eight parts, their sum, and that of the published seven; null without a state.
Json stress_force_fabric(const mm::Averages& averages, int dimensions) {
  const auto state = mm::second_order_state(averages, dimensions);
  if (!state) return nullptr;
  const mm::StressParts parts = mm::stress_parts(*state);
  Json all{{"isotropic", json(parts.isotropic)}};
  for (const auto& [name, part] : parts_of(state)) all[name] = json(part);
  all["sum"] = json(parts.sum());
  all["seven"] = json(parts.seven());
  return all;
}

/// What an estimator makes of forces and branches.
void put_estimates(Json& to, const mm::Averages& averages, int dimensions) {
  to["normal_force"] = json(averages.force_normal);
  to["tangential_force"] = json(averages.force_tangential);
  to["branch_normal"] = json(averages.branch_normal);
  to["branch_tangential"] = json(averages.branch_tangential);
  to["branch_length"] = json(averages.branch_length);
  to["f0"] = json(mean_of(averages.force_normal));
  to["z0"] = json(mean_of(averages.branch_normal));
  to["mean_branch_length"] = json(mean_of(averages.branch_length));
  to["stress_force_fabric"] = stress_force_fabric(averages, dimensions);
}

Json coordination_of(const MicroSummary& summary) {
  const mm::Coordination& coordination = summary.coordination;
  return {{"mean", json(coordination.mean)},
          {"without_rattlers", json(summary.coordination_without_rattlers)},
          {"rattlers", summary.rattlers},
          {"std", json(coordination.deviation)},
          {"skewness", json(coordination.skewness)},
          {"excess_kurtosis", json(coordination.excess_kurtosis)},
          {"histogram", coordination.histogram}};
}

Json json(const StressSummary& stress) {
  Json principal = Json::array();
  for (const double value : stress.principal) principal.push_back(json(value));
  return {{"tensor", json(stress.tensor)},
          {"mean", json(stress.mean)},
          {"principal", principal},
          {"a_s", json(stress.ratio)}};
}

Json json(const mm::ShearShares& shares) {
  Json all;
  for (const auto& [name, share] : named_shares(shares)) all[name] = json(share);
  all["sum"] = json(shares.sum());
  all["shape"] = json(shares.shape());
  return all;
}

Json magnitudes_of(const std::optional<mm::SecondOrderState>& state) {
  if (!state) return nullptr;
  const mm::SignedMagnitudes a = mm::signed_magnitudes(*state);
  return {{"r", a.r}, {"n", a.n}, {"t", a.t}, {"z", a.z}, {"zt", a.zt}, {"sense", a.sense}};
}

Json json(const mm::Coaxiality& axes) {
  Json angles = Json::array();
  for (const double angle : axes.angles_deg) angles.push_back(json(angle));
  return {{"axial_deg", json(axes.axial_deg)},
          {"angles_deg", angles},
          {"commutator", json(axes.commutator)}};
}

/// Of the deviators of tensors in space against one of them.
Json coaxialities(const Named<std::optional<Mat3>>& tensors, const Mat3& other) {
  Json all;
  for (const auto& [name, x] : tensors) all[name] = x ? json(compared(*x, other)) : Json(nullptr);
  return all;
}

void put_axes(Json& to, const MicroSummary& summary) {
  const mm::Averages& averages = summary.averages;
  const bool in_space = summary.dimensions == 3 && averages.normals;
  to["coaxiality"] =
      in_space ? coaxialities(compared_tensors(averages), averages.normals->second) : Json(nullptr);
  to["part_coaxiality"] =
      summary.state ? coaxialities(parts_of(summary.state), averages.stress) : Json(nullptr);
  Json axisymmetry;
  for (const auto& [name, x] : tensors_of(averages))
    axisymmetry[name] = in_space && x && has_axes(*x)
                            ? json(mm::departure_from_axisymmetry(x->second))
                            : Json(nullptr);
  to["axisymmetry"] = axisymmetry;
}

void put_signs(Json& to, const MicroSummary& summary) {
  Json signs, joint;
  const auto& r = summary.averages.normals;
  for (const auto& [name, x] : compared_tensors(summary.averages)) {
    signs[name] = x && r ? Json(sign_of(mm::contracted(*x, r->second))) : Json(nullptr);
  }
  for (const auto& [name, sign] : joint_signs_of(summary.averages))
    joint[name] = sign && summary.dimensions == 3 ? Json(*sign) : Json(nullptr);
  to["signs"] = signs;
  to["joint_signs"] = joint;
}

Json axis_groups_of(const MicroSummary& summary) {
  Json all;
  for (std::size_t k = 0; k < 3; ++k) {
    const mm::AxisGroup& group = summary.axis_groups[k];
    all[std::string(1, "xyz"[k])] = {{"contacts", group.contacts},
                                     {"fraction", json(group.fraction)},
                                     {"mean_normal_force", json(group.mean_normal_force)}};
  }
  return all;
}

/// Of a polar partition, with the models of order 2 and of both; else null.
Json radial_rings(const Packing& packing, const MicroSummary& summary) {
  const auto& model = summary.averages.force_tangential;
  if (summary.dimensions != 3 || summary.classes.kind != mm::Classes::Kind::polar || !model)
    return nullptr;
  const mm::DirectionGroups groups(summary.classes.partition(), packing.contacts.normal);
  const mm::TangentialHarmonics second{model->mean, model->second, {}};
  const mm::TangentialHarmonics both{model->mean, model->second, *model->fourth};
  const Vec3& axis = groups.partition().axis();
  Json rings = Json::array();
  for (const mm::RadialRing& ring : mm::radial_means(
           groups, mm::tangential_components(groups.normals(), packing.contacts.force)))
    rings.push_back({{"beta", ring.beta},
                     {"value", ring.filled_sectors > 0 ? json(ring.value) : Json(nullptr)},
                     {"sectors", ring.filled_sectors},
                     {"model2", json(second.radial(ring.beta, axis))},
                     {"model4", json(both.radial(ring.beta, axis))}});
  return rings;
}

/// The columns' numbers with their deviations, and the distances and correlations beside them.
Json contact_statistics_of(const BodySummary& bodies) {
  Json all;
  for (const auto& [name, value] : body_numbers(bodies)) all[name] = json(value);
  const auto put = [&](const char* name, const mm::Estimate& x) {
    all[name] = json(x.value);
    all[std::string(name) + "_error"] = json(x.error);
  };
  if (const auto& turn = bodies.rotation) {
    put("P2", turn->second);
    put("P4", turn->fourth);
    all["r_rot"] = json(turn->rotated);
    all["r_other"] = json(turn->other);
    all["r_other_error"] = json(turn->other_error);
  }
  if (const auto& turn = bodies.in_plane) {
    put("P2", turn->mean_cosine);
    put("a_L", turn->a_l);
    all["a_L_by_arc"] = json(turn->arc_law_a_l);
    all["r_rot"] = json(turn->rotated);
    all["r_other"] = json(turn->other);
    all["r_other_error"] = json(turn->other_error);
  }
  if (bodies.contacts && bodies.contacts->spheroid) {
    const mm::SpheroidStatistics& seen = *bodies.contacts->spheroid;
    put("a1", seen.a1);
    all["a1_by_area"] = json(seen.area_law_a1);
    all["f_by_area"] = seen.by_area;
    all["G_off_model"] = json(seen.off_model);
    all["G_off_area"] = json(seen.off_area);
    put("correlation_coordination", seen.correlations.coordination);
    for (std::size_t k = 0; k < 3; ++k)
      put((std::string("correlation_orientation_") + "xyz"[k]).c_str(),
          seen.correlations.orientation[k]);
  }
  return all;
}

Json plane_of(const MicroSummary& summary) {
  if (!summary.plane) return nullptr;
  const mm::PlaneState& state = *summary.plane;
  const PlaneRatios ratios = plane_ratios(summary.plane);
  return {{"amplitudes",
           {{"r", mm::amplitude(state.r)},
            {"n", mm::amplitude(state.n)},
            {"t", mm::amplitude(state.t)},
            {"z", mm::amplitude(state.z)},
            {"zt", mm::amplitude(state.zt)}}},
          {"a_s_small", json(ratios.small)},
          {"a_s_coaxial", json(ratios.coaxial)}};
}

void put_packing(Json& to, const State& state, const Packing& packing,
                 const MicroSummary& summary) {
  to["cycle"] = state.cycle;
  to["time"] = state.time;
  to["dimensions"] = summary.dimensions;
  to["particles"] = summary.particles;
  to["contacts"] = summary.contacts;
  to["wall_contacts"] = summary.wall_contacts;
  to["volume"] = summary.volume;
  to["cell"] = json(packing.edges);
  to["partition"] = summary.classes.kind == mm::Classes::Kind::polar ? "polar" : "near-uniform";
  to["classes"] = summary.classes.count;
  to["class_count"] = summary.averages.classes;
  to["empty_classes"] = summary.averages.empty_classes;
}

void put_stresses(Json& to, const MicroSummary& summary) {
  to["stress_asymmetry"] = json(mm::stress_asymmetry(summary.averages.stress, summary.dimensions));
  for (const auto& [name, stress] : summary.stresses) to["stresses"][name] = json(stress);
  to["s0"] = summary.state   ? json(summary.state->isotropic_stress())
             : summary.plane ? json(summary.plane->isotropic_stress())
                             : Json(nullptr);
  to["D_n"] = summary.state ? json(mm::mean_stress_factor(mm::signed_magnitudes(*summary.state)))
                            : Json(nullptr);
  const SharesSummary shares = shares_of(summary.state);
  to["shares"] = json(shares.seven);
  to["shares_eight"] = json(shares.eight);
  to["axisymmetric_shares"] = json(shares.axisymmetric);
  to["signed_magnitudes"] = magnitudes_of(summary.state);
}

/// A line a key: tensors nested over many lines are no easier to read.
std::string lines_of(const Json& all) {
  std::string text;
  for (const auto& [key, value] : all.items())
    text += (text.empty() ? "{\n" : ",\n") + Json(key).dump() + ": " + value.dump();
  return text + "\n}\n";
}

}  // namespace

std::string micro_json(const State& state, const Packing& packing, const MicroSummary& summary,
                       const StrainReport& strain) {
  const mm::Averages& averages = summary.averages;
  const int dimensions = summary.dimensions;
  Json all;
  all["fabric"] = json(averages.normals);
  put_estimates(all, averages, dimensions);
  all["long_axes"] = json(averages.long_axes);
  all["local_contacts"] = json(averages.local_contacts);
  all["contact_vectors"] = json(averages.contact_vectors);
  all["coordination_number"] = json(summary.coordination.mean);
  all["contact_density"] = averages.contact_density;
  all["stress"] = json(averages.stress);
  for (const auto& [name, estimator] : {std::pair("published", mm::Estimator::published),
                                        std::pair("contact_sums", mm::Estimator::contact_sums)})
    put_estimates(all[name],
                  mm::averages_of(packing.arrays(), bodies_of(packing), summary.classes, estimator),
                  dimensions);
  put_packing(all, state, packing, summary);
  all["coordination"] = coordination_of(summary);
  all["mean_normal_force"] = json(summary.mean_normal_force);
  put_stresses(all, summary);
  put_axes(all, summary);
  put_signs(all, summary);
  all["force_asymmetry"] = json(asymmetry_of(averages.force_tangential, averages.force_asymmetry));
  all["branch_asymmetry"] =
      json(asymmetry_of(averages.branch_tangential, averages.branch_asymmetry));
  all["vector_normal_angle_mean_deg"] = json(summary.mean_vector_angle);
  all["vector_normal_angle_largest_deg"] = json(summary.largest_vector_angle);
  all["direction_groups"] = axis_groups_of(summary);
  all["radial_rings"] = radial_rings(packing, summary);
  all["contact_statistics"] = contact_statistics_of(summary.bodies);
  all["plane"] = plane_of(summary);
  all["average_strain"] = strain_json(strain);
  return lines_of(all);
}

}  // namespace tangency::inline v0::dem
