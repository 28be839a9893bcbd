// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/report_charts.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <tangency/dem/tool/chart.hpp>

namespace tangency::inline v0::dem {
namespace {

constexpr const char* kAngle = "friction angle (degrees)";

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), std::minus<>());
  return result;
}

/// Parted where b is not > 0.
std::vector<double> ratio_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), [](double x, double y) {
    return y > 0.0 ? x / y : std::numeric_limits<double>::quiet_NaN();
  });
  return result;
}

bool is_any_not_0(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double x) { return x != 0.0; });
}

/// A stage, and the strain that its charts are drawn over.
struct Sheared {
  StageRows stage;
  Distortion by;
  std::vector<double> strain;

  Scale across() const { return {std::string(by.name)}; }
};

std::string stress_chart(const ReportedRun& run, const Sheared& sheared) {
  const auto& [stage, by, strain] = sheared;
  const auto s = run.principal_stresses(stage);
  std::vector<Curve> curves{{"s1", strain, s[0]}, {"s2", strain, s[1]}};
  if (run.dimensions() == 3) curves.push_back({"s3", strain, s[2]});
  const std::size_t least = curves.size() - 1;
  curves.push_back({"s1 - s" + std::to_string(least + 1), strain, difference(s[0], s[least])});
  curves.push_back({"friction angle (right)", strain, run.friction_angle(stage), true});
  return svg_of({"Principal stresses: " + stage.name,
                 sheared.across(),
                 {"stress", run.units().stress},
                 {kAngle},
                 std::move(curves)});
}

/// Of a shear strain what a simple shear test measures, else nothing.
std::string shear_stress_chart(const ReportedRun& run, const Sheared& sheared) {
  const auto& [stage, by, strain] = sheared;
  if (by.shear_stress.empty()) return "";
  const std::string along(by.shear_stress), across(by.normal_stress);
  const std::vector<double> shear = run.column(along, stage), normal = run.column(across, stage);
  const std::string ratio = along + " / " + across;
  return svg_of({"Shear and normal stress: " + stage.name,
                 sheared.across(),
                 {"stress", run.units().stress},
                 {ratio},
                 {{along, strain, shear},
                  {across, strain, normal},
                  {ratio + " (right)", strain, ratio_of(shear, normal), true}}});
}

std::string path_chart(const ReportedRun& run, const StageRows& stage) {
  const std::string& unit = run.units().stress;
  return svg_of({"Stress path: " + stage.name,
                 {"mean stress p", unit},
                 {"deviator q", unit},
                 {},
                 {{"q", run.column("p", stage), run.column("q", stage)}}});
}

std::string volume_chart(const ReportedRun& run, const Sheared& sheared) {
  const auto& [stage, by, strain] = sheared;
  return svg_of(
      {"Volumetric strain: " + stage.name,
       sheared.across(),
       {"volumetric strain"},
       {"porosity"},
       {{"volumetric strain, dilation > 0", strain, run.column("volumetric_strain", stage)},
        {"porosity (right)", strain, run.column("porosity", stage), true}}});
}

std::string coordination_chart(const ReportedRun& run, const Sheared& sheared) {
  const auto& [stage, by, strain] = sheared;
  return svg_of({"Coordination number: " + stage.name,
                 sheared.across(),
                 {"contacts a particle"},
                 {},
                 {{"of all particles", strain, run.column("coordination_number", stage)},
                  {"without rattlers", strain, run.column("mechanical_coordination", stage)}}});
}

/// Nothing without rows of micro.csv.
std::string fabric_chart(const ReportedRun& run, const Sheared& sheared) {
  const auto values = run.micro(sheared.stage, {sheared.by.strain, "A_r", "A_n", "A_t"});
  const std::vector<double>& strain = values.front();
  if (strain.empty()) return "";
  return svg_of({"Fabric: " + sheared.stage.name,
                 sheared.across(),
                 {"anisotropy A"},
                 {},
                 {{"contact normals", strain, values[1]},
                  {"normal forces", strain, values[2]},
                  {"tangential forces", strain, values[3]}}});
}

/// A curve over time of what each stage counts anew: it begins in each at 0, and is parted there.
Curve from_stage_starts(const ReportedRun& run, std::string name, std::string_view column) {
  Curve curve{std::move(name), {}, {}};
  double start = run.value("time", 0);
  for (const StageRows& stage : run.stages()) {
    curve.x.insert(curve.x.end(), {start, start});
    curve.y.insert(curve.y.end(), {std::numeric_limits<double>::quiet_NaN(), 0.0});
    for (std::size_t row = stage.first; row < stage.end; ++row) {
      curve.x.push_back(run.value("time", row));
      curve.y.push_back(run.value(column, row));
    }
    start = run.value("time", stage.end - 1);
  }
  return curve;
}

/// A shear strain where there is any.
std::vector<Curve> strains(const ReportedRun& run) {
  std::vector<Curve> curves{
      from_stage_starts(run, "axial (compression > 0)", "axial_strain"),
      from_stage_starts(run, "volumetric (dilation > 0)", "volumetric_strain")};
  for (const Distortion& shear : kShears)
    if (is_any_not_0(run.column(shear.strain, run.all())))
      curves.push_back(from_stage_starts(run, std::string(shear.name), shear.strain));
  return curves;
}

std::vector<Curve> energies(const ReportedRun& run, const std::vector<double>& time) {
  std::vector<Curve> curves;
  for (const char* name :
       {"boundary_work", "gravity_work", "growth_work", "branch_work", "sliding_loss",
        "damping_loss", "viscous_loss", "elastic_energy", "kinetic_energy", "energy_error"}) {
    std::vector<double> values = run.column(name, run.all());
    if (is_any_not_0(values)) curves.push_back({name, time, std::move(values)});
  }
  return curves;
}

}  // namespace

std::string shear_charts(const ReportedRun& run, const StageRows& stage) {
  const auto by = run.distortion(stage);
  if (!by) return "";
  const Sheared sheared{stage, *by, run.column(by->strain, stage)};
  return stress_chart(run, sheared) + shear_stress_chart(run, sheared) + path_chart(run, stage) +
         volume_chart(run, sheared) + coordination_chart(run, sheared) + fabric_chart(run, sheared);
}

std::string time_charts(const ReportedRun& run) {
  const StageRows all = run.all();
  const std::vector<double> time = run.column("time", all);
  const Units& units = run.units();
  const auto over_time = [&](const char* title, Scale left, Scale right, std::vector<Curve> curves,
                             bool logarithmic = false) {
    return svg_of({title,
                   {"time", units.time},
                   std::move(left),
                   std::move(right),
                   std::move(curves),
                   run.bands(),
                   logarithmic});
  };
  return over_time("Stress and friction angle", {"mean stress", units.stress}, {kAngle},
                   {{"mean stress", time, run.column("mean_stress", all)},
                    {"friction angle (right)", time, run.friction_angle(all), true}}) +
         over_time("Coordination and porosity", {"coordination number"}, {"porosity"},
                   {{"coordination", time, run.column("coordination_number", all)},
                    {"porosity (right)", time, run.column("porosity", all), true}}) +
         over_time("Strains, from the start of each stage", {"strain"}, {}, strains(run)) +
         over_time("Inertial fraction", {"inertial fraction"}, {},
                   {{"inertial fraction", time, run.column("inertial_fraction", all)}}, true) +
         over_time("Energy account, since the run began", {"energy", units.energy}, {},
                   energies(run, time));
}

}  // namespace tangency::inline v0::dem
