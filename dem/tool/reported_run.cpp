// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/reported_run.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tangency/dem/tool/run_table.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;

/// How far a cell's shape may be off a uniform strain before a stage counts as one that shears.
/// Chosen: rounding leaves 1e-12, a shear test starts where stresses differ at some 1e-3.
constexpr double kLeastDistortion = 1e-3;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Units units_in(const std::optional<SummaryLines>& summary) {
  if (!summary) return {};
  const auto of = [&](const std::string& what) {
    for (const auto& [name, value] : *summary)
      if (name == "units." + what) return value;
    return std::string();
  };
  return units_of(of("length"), of("stress"), of("time")).value_or(Units());
}

}  // namespace

ReportedRun::ReportedRun(const fs::path& directory)
    : directory_(directory),
      history_(directory / "history.csv"),
      stages_(stages_of(history_)),
      summary_(read_summary(directory)),
      units_(units_in(summary_)) {
  if (stages_.empty())
    throw OutputError((directory / "history.csv").string() +
                      ": no row; a run writes it at its first checkpoint and at its end");
}

std::vector<double> ReportedRun::column(std::string_view name, const StageRows& rows) const {
  const auto all = history_.column(name).subspan(rows.first, rows.end - rows.first);
  return {all.begin(), all.end()};
}

std::vector<double> ReportedRun::friction_angle(const StageRows& rows) const {
  std::vector<double> angle = column("friction_angle_deg", rows);
  for (std::size_t k = 0; k < angle.size(); ++k)
    if (!(value("contacts", rows.first + k) > 0.0 && value("mean_stress", rows.first + k) > 0.0))
      angle[k] = kNone;
  return angle;
}

std::array<std::vector<double>, 3> ReportedRun::principal_stresses(const StageRows& rows) const {
  std::array<std::vector<double>, 3> all;
  const int dimensions = this->dimensions();
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    Mat3 stress;
    stress << value("s_xx", row), value("s_xy", row), value("s_zx", row),  //
        value("s_xy", row), value("s_yy", row), value("s_yz", row),        //
        value("s_zx", row), value("s_yz", row), value("s_zz", row);
    using UpTo3 = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
    const Eigen::SelfAdjointEigenSolver<UpTo3> principal(
        stress.topLeftCorner(dimensions, dimensions), Eigen::EigenvaluesOnly);
    for (int k = 0; k < 3; ++k)
      all[static_cast<std::size_t>(k)].push_back(
          k < dimensions ? principal.eigenvalues()[dimensions - 1 - k] : kNone);
  }
  return all;
}

int ReportedRun::dimensions() const {
  const auto bears = [](double s) { return s != 0.0; };
  const auto across = history_.column("s_zz"), in_plane = history_.column("s_xx");
  return std::none_of(across.begin(), across.end(), bears) &&
                 std::any_of(in_plane.begin(), in_plane.end(), bears)
             ? 2
             : 3;
}

std::optional<Distortion> ReportedRun::distortion(const StageRows& stage) const {
  const std::size_t end = stage.end - 1;
  const double sideways = value("volumetric_strain", end) + value("axial_strain", end);
  const double uniform = value("volumetric_strain", end) / dimensions();
  double largest = std::abs(sideways - (dimensions() - 1.0) * uniform);
  std::optional<Distortion> found;
  if (largest > kLeastDistortion) found = {"axial_strain", "axial strain"};
  for (const Distortion& shear : kShears) {
    const double strain = std::abs(value(shear.strain, end));
    if (strain <= std::max(largest, kLeastDistortion)) continue;
    largest = strain;
    found = shear;
  }
  return found;
}

double ReportedRun::largest_shear(std::size_t row) const {
  double largest = 0.0;
  for (const Distortion& shear : kShears) {
    const double strain = value(shear.strain, row);
    if (std::abs(strain) > std::abs(largest)) largest = strain;
  }
  return largest;
}

double ReportedRun::work_done(std::size_t row) const {
  double sum = 0.0;
  for (const char* name : {"boundary_work", "gravity_work", "growth_work"}) {
    double largest = 0.0;
    for (const double work : history_.column(name).first(row + 1))
      largest = std::max(largest, std::abs(work));
    sum += largest;
  }
  return sum;
}

std::vector<Band> ReportedRun::bands() const {
  std::vector<Band> bands;
  double from = value("time", 0);
  for (const StageRows& stage : stages_) {
    const double to = value("time", stage.end - 1);
    if (to > from) bands.push_back({stage.name, from, to});
    from = to;
  }
  return bands;
}

std::vector<std::vector<double>> ReportedRun::micro(
    const StageRows& stage, const std::vector<std::string_view>& names) const {
  std::vector<std::vector<double>> values(names.size());
  if (!fs::exists(directory_ / "micro.csv")) return values;
  tables::Reader reader((directory_ / "micro.csv").string());
  const tables::Header& header = reader.header();
  const tables::Column cycle = header.require("cycle"), of_stage = header.require("stage_cycle");
  const tables::Column name = header.require("stage");
  std::vector<tables::Column> columns;
  for (const std::string_view wanted : names) columns.push_back(header.require(wanted));
  const double begin = value("cycle", stage.first) - value("stage_cycle", stage.first);
  tables::for_each_row(reader, [&](const tables::RowCursor& row) {
    if (row.text(name) != stage.name || row.number(cycle) - row.number(of_stage) != begin) return;
    for (std::size_t k = 0; k < columns.size(); ++k)  // an empty cell is not defined
      values[k].push_back(row.text(columns[k]).empty() ? kNone : row.number(columns[k]));
  });
  return values;
}

}  // namespace tangency::inline v0::dem
