// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/micro_fields.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <tangency/dem/micromechanics/direction_integrals.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace mm = micromechanics;

class Columns {
 public:
  explicit Columns(const MicroSummary& summary)
      : summary_(summary),
        averages_(summary.averages),
        tensors_(tensors_of(summary.averages)),
        r_(averages_.normals ? &*averages_.normals : nullptr) {}

  std::vector<Field> all() {
    add_counts();
    add_second_order();
    add_local_contacts();
    add_fourth_order();
    add_goodness();
    add_stresses();
    add_parts();
    add_shares();
    add_axes();
    add_signs();
    add_axis_groups();
    for (const auto& [name, value] : body_numbers(summary_.bodies)) add(name, value);
    return std::move(fields_);
  }

 private:
  void add(const std::string& name, double value) { fields_.push_back({name, value}); }
  void add(const std::string& name, std::int64_t value) { fields_.push_back({name, value}); }

  void add_counts() {
    const mm::Coordination& coordination = summary_.coordination;
    add("contacts", summary_.contacts);
    add("wall_contacts", summary_.wall_contacts);
    add("particles", summary_.particles);
    add("rattlers", summary_.rattlers);
    add("coordination_number", coordination.mean);
    add("coordination_without_rattlers", summary_.coordination_without_rattlers);
    add("coordination_std", coordination.deviation);
    add("coordination_skewness", coordination.skewness);
    add("coordination_excess_kurtosis", coordination.excess_kurtosis);
    add("empty_classes", static_cast<std::int64_t>(averages_.empty_classes));
    add("contact_density", averages_.contact_density);
    add("f0", mean_of(averages_.force_normal));
    add("z0", mean_of(averages_.branch_normal));
    add("mean_branch_length", mean_of(averages_.branch_length));
    add("mean_normal_force", summary_.mean_normal_force);
  }

  /// Of tensors in space axes.
  void add_second_order() {
    for (const auto& [name, x] : tensors_)
      if (name != "cv") add("A_" + name, signed_size(x, r_));
    for (const auto& [name, x] : tensors_)
      if (name != "cv") add("A_error_" + name, x ? x->second_scatter() : kNotDefined);
    const int axial = summary_.dimensions - 1;
    for (const auto& [name, x] : tensors_)
      if (name != "cv") add("a_axial_" + name, x ? x->second(axial, axial) : kNotDefined);
  }

  void add_local_contacts() {
    const auto& local = averages_.local_contacts;
    const auto axis = averages_.body_axis;
    const bool has_axis = local && axis;
    add("a_cv", local ? mm::modulus(local->second) : kNotDefined);
    add("a_cv_error", local ? local->second_scatter() : kNotDefined);
    add("a1", has_axis ? local->second(*axis, *axis) : kNotDefined);
    add("a1_error", has_axis ? local->second_error(*axis, *axis) : kNotDefined);
  }

  void add_fourth_order() {
    const auto has = [](const std::string& name) {
      return name != "len" && name != "lambda" && name != "cv";
    };
    for (const auto& [name, x] : tensors_)
      if (has(name)) add("b_" + name, x && x->fourth ? x->fourth->norm() : kNotDefined);
    for (const auto& [name, x] : tensors_)
      if (has(name)) add("b_error_" + name, x ? x->fourth_scatter() : kNotDefined);
  }

  void add_goodness() {
    for (std::size_t k = 0; k < 5; ++k) {  // r n t z zt
      const auto& [name, x] = tensors_[k];
      const bool has = x && !is_rounding(*x);
      add("unexplained2_" + name, has ? x->unexplained2 : kNotDefined);
      add("unexplained4_" + name, has ? x->unexplained4 : kNotDefined);
    }
    add("asymmetry_t", asymmetry_of(averages_.force_tangential, averages_.force_asymmetry));
    add("asymmetry_zt", asymmetry_of(averages_.branch_tangential, averages_.branch_asymmetry));
    add("vector_normal_angle_mean_deg", summary_.mean_vector_angle);
    add("vector_normal_angle_largest_deg", summary_.largest_vector_angle);
    add("stress_asymmetry", mm::stress_asymmetry(averages_.stress, summary_.dimensions));
  }

  void add_stresses() {
    for (const auto& [name, stress] : named_stresses()) {
      const std::string end = name == "measured" ? "" : "_" + name;
      add("mean_stress" + end, stress.mean);
      for (std::size_t k = 0; k < 3; ++k)
        add("s" + std::to_string(k + 1) + end, stress.principal[k]);
      add("a_s" + end, stress.ratio);
    }
    const auto& [state, plane] = std::tie(summary_.state, summary_.plane);
    add("s0", state ? state->isotropic_stress() : plane ? plane->isotropic_stress() : kNotDefined);
    add("D_n", state ? mm::mean_stress_factor(mm::signed_magnitudes(*state)) : kNotDefined);
  }

  /// Of a packing that was not summed up the names alone.
  Named<StressSummary> named_stresses() const {
    if (!summary_.stresses.empty()) return summary_.stresses;
    Named<StressSummary> names;
    for (const char* name : kStressNames) names.emplace_back(name, StressSummary());
    return names;
  }

  void add_parts() {
    const Named<std::optional<Mat3>> parts = parts_of(summary_.state);
    for (const auto& [name, part] : parts)
      for (int k = 0; k < 3; ++k)
        add(name + "_" + std::string(2, "xyz"[k]), part ? (*part)(k, k) : kNotDefined);
    for (const auto& [name, part] : parts) {
      const auto along = compared(part, averages_.stress);
      add("axial_deg_" + name, along.axial_deg);
      add("commutator_" + name, along.commutator);
    }
  }

  /// The deviators' axes.
  static mm::Coaxiality compared(const std::optional<Mat3>& x, const Mat3& y) {
    if (!x) return {kNotDefined, {}, kNotDefined};
    return dem::compared(*x, y);
  }

  void add_shares() {
    const SharesSummary shares = shares_of(summary_.state);
    for (const auto& [name, share] : named_shares(shares.seven))
      if (name != "rfz") add("share_" + name, share);
    add("share_shape", shares.seven.shape());
    for (const auto& [name, share] : named_shares(shares.axisymmetric))
      if (name != "rfz") add("axisymmetric_" + name, share);
    add("a_s_axisymmetric", shares.axisymmetric.sum());
    const auto in_plane = plane_ratios(summary_.plane);
    add("a_s_small", in_plane.small);
    add("a_s_coaxial", in_plane.coaxial);
  }

  void add_axes() {
    for (const auto& [name, x] : compared_tensors(averages_)) {
      if (name == "df" || name == "dz") continue;
      // In the plane both principal values are equally large, and none is the axial one.
      const auto along = r_ && summary_.dimensions == 3
                             ? compared(x, r_->second)
                             : mm::Coaxiality{kNotDefined, {}, kNotDefined};
      add("axial_deg_" + name, along.axial_deg);
      add("commutator_" + name, along.commutator);
    }
    for (std::size_t k = 0; k < 5; ++k) {  // r n t z zt
      const auto& [name, x] = tensors_[k];
      add("axisymmetry_" + name, x && has_axes(*x) && summary_.dimensions == 3
                                     ? mm::departure_from_axisymmetry(x->second)
                                     : kNotDefined);
    }
  }

  void add_signs() {
    for (const auto& [name, x] : compared_tensors(averages_))
      if (name != "E")
        add("sign_" + name,
            x && r_ ? double(sign_of(mm::contracted(*x, r_->second))) : kNotDefined);
    for (const auto& [name, sign] : joint_signs_of(averages_))
      add("joint_" + name, sign && summary_.dimensions == 3 ? double(*sign) : kNotDefined);
  }

  void add_axis_groups() {
    for (std::size_t k = 0; k < 3; ++k)
      add(std::string("fraction_") + "xyz"[k], summary_.axis_groups[k].fraction);
    for (std::size_t k = 0; k < 3; ++k)
      add(std::string("normal_force_") + "xyz"[k], summary_.axis_groups[k].mean_normal_force);
  }

  const MicroSummary& summary_;
  const mm::Averages& averages_;
  Named<const mm::TensorEstimate*> tensors_;
  const mm::TensorEstimate* r_;
  std::vector<Field> fields_;
};

}  // namespace

std::vector<Field> micro_fields(const MicroSummary& summary) { return Columns(summary).all(); }

}  // namespace tangency::inline v0::dem
