// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/report.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/dem/tool/chart.hpp>
#include <tangency/dem/tool/history.hpp>
#include <tangency/dem/tool/results.hpp>
#include <tangency/dem/tool/run.hpp>
#include <tangency/dem/tool/summary.hpp>
#include <tangency/dem/tool/view/sample_view.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPageHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1"><title>tangency-dem report</title><style>
body { font: 15px/1.45 sans-serif; margin: 1.5em auto; max-width: 112em; padding: 0 1em; color: #222; }
h1 { overflow-wrap: anywhere; }
h2 { margin: 1.2em 0 .3em; }
table { border-collapse: collapse; font-size: 13px; }
th, td { padding: .2em .7em; text-align: right; border-bottom: 1px solid #ddd; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; }
.parts { display: flex; gap: 2em; align-items: flex-start; }
@media (max-width: 70em) { .parts { flex-wrap: wrap; } }
.parts > * { min-width: 0; max-width: 100%; }
.charts { display: flex; flex-wrap: wrap; gap: 1em; flex: 1 1 620px; }
.wide { overflow-x: auto; }
svg { max-width: 100%; height: auto; }
svg text { font: 12px sans-serif; fill: #222; }
svg text.title { font-weight: bold; font-size: 13px; }
svg text.stage { fill: #667; font-size: 11px; }
)";

/// How far a cell's shape may be off a uniform strain before a stage counts as one that shears.
/// Chosen: rounding leaves 1e-12, a shear test starts where stresses differ at some 1e-3.
constexpr double kLeastDistortion = 1e-3;

std::string shown(double x, const char* format = "%.4g") { return tables::formatted(format, x); }

struct Headed {
  std::string name, unit;
};

/// The table's columns.
const std::array<Headed, 9> kHeads{{{"stage", ""},
                                    {"cycles", ""},
                                    {"mean stress", "Pa"},
                                    {"friction angle", "deg"},
                                    {"coordination", ""},
                                    {"porosity", ""},
                                    {"inertial fraction", ""},
                                    {"axial strain", ""},
                                    {"energy error", "of the work done"}}};
using Line = std::array<std::string, kHeads.size()>;

/// A run as far as its directory knows it.
class Run {
 public:
  explicit Run(const fs::path& directory)
      : history_(directory / "history.csv"),
        stages_(stages_of(history_)),
        summary_(read_summary(directory)) {
    if (stages_.empty())
      throw OutputError((directory / "history.csv").string() +
                        ": no row; a run writes it at its first checkpoint and at its end");
  }

  /// Nothing of a run that is not complete.
  const std::optional<SummaryLines>& summary() const { return summary_; }
  const std::vector<StageRows>& stages() const { return stages_; }

  double value(std::string_view name, std::size_t row) const { return history_.column(name)[row]; }

  /// A line of the table for each stage, of its last row.
  std::vector<Line> lines() const {
    std::vector<Line> lines;
    for (const StageRows& stage : stages_) {
      const std::size_t end = stage.end - 1;
      const auto of = [&](const char* name) { return shown(value(name, end)); };
      const double work = work_done(end);
      lines.push_back({stage.name, shown(value("stage_cycle", end), "%.0f"), of("mean_stress"),
                       shown(value("friction_angle_deg", end), "%.2f"),
                       shown(value("coordination_number", end), "%.3f"), of("porosity"),
                       shown(value("inertial_fraction", end), "%.2g"), of("axial_strain"),
                       work > 0.0 ? shown(value("energy_error", end) / work, "%.1e") : "-"});
    }
    return lines;
  }

  /// Does the cell change its shape in this stage?
  bool shears(const StageRows& stage) const {
    const std::size_t end = stage.end - 1;
    const double sideways = value("volumetric_strain", end) + value("axial_strain", end);
    const double uniform = value("volumetric_strain", end) / dimensions();
    return std::abs(sideways - (dimensions() - 1.0) * uniform) > kLeastDistortion;
  }

  std::vector<double> column(std::string_view name, std::size_t first, std::size_t end,
                             double scale = 1.0) const {
    std::vector<double> values;
    for (const double x : history_.column(name).subspan(first, end - first))
      values.push_back(scale * x);
    return values;
  }
  std::vector<double> column(std::string_view name) const {
    return column(name, 0, history_.size());
  }

  std::vector<Band> bands() const {
    std::vector<Band> bands;
    double from = value("time", 0);
    for (const StageRows& stage : stages_) {
      const double to = value("time", stage.end - 1);
      if (to > from) bands.push_back({stage.name, from, to});
      from = to;
    }
    return bands;
  }

 private:
  /// What the assembly was given since the run began: by its boundary, by gravity and by growth, of
  /// each the largest of any row up to there. What goes to and fro comes to nothing in the end.
  double work_done(std::size_t row) const {
    double sum = 0.0;
    for (const char* name : {"boundary_work", "gravity_work", "growth_work"}) {
      double largest = 0.0;
      for (const double work : history_.column(name).first(row + 1))
        largest = std::max(largest, std::abs(work));
      sum += largest;
    }
    return sum;
  }

  /// A plane assembly has no stress across its plane.
  double dimensions() const {
    const auto across = history_.column("s_zz");
    const auto in_plane = history_.column("s_xx");
    const auto bears = [](double s) { return s != 0.0; };
    return std::none_of(across.begin(), across.end(), bears) &&
                   std::any_of(in_plane.begin(), in_plane.end(), bears)
               ? 2.0
               : 3.0;
  }

  History history_;
  std::vector<StageRows> stages_;
  std::optional<SummaryLines> summary_;
};

std::string text_of(const std::vector<Line>& lines) {
  Line head;
  std::array<std::size_t, kHeads.size()> wide{};
  for (std::size_t k = 0; k < kHeads.size(); ++k) {
    head[k] = kHeads[k].name + (kHeads[k].unit.empty() ? "" : " (" + kHeads[k].unit + ")");
    wide[k] = head[k].size();
    for (const Line& line : lines) wide[k] = std::max(wide[k], line[k].size());
  }
  std::string text;
  const auto put = [&](const Line& line) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      const std::string blanks(wide[k] - line[k].size(), ' ');
      text += k == 0 ? line[k] + blanks : "  " + blanks + line[k];
    }
    text += '\n';
  };
  put(head);
  for (const Line& line : lines) put(line);
  return text;
}

std::string table_of(const std::vector<Line>& lines) {
  std::string text = "<div class=\"wide\"><table><tr>";
  for (const Headed& head : kHeads)
    text += "<th>" + head.name + (head.unit.empty() ? "" : "<br>" + head.unit) + "</th>";
  for (const Line& line : lines) {
    text += "</tr>\n<tr>";
    for (const std::string& cell : line) text += "<td>" + escaped(cell) + "</td>";
  }
  return text + "</tr></table></div>\n";
}

std::string summary_table(const SummaryLines& summary) {
  std::string text = "<table>";
  for (const auto& [name, value] : summary)
    text += "<tr><td>" + escaped(name) + "</td><td>" + escaped(value) + "</td></tr>\n";
  return text + "</table>\n";
}

constexpr double kToMega = 1e-6;

/// What a shear test is looked at for, against its axial strain.
std::string shear_charts(const Run& run, const StageRows& stage) {
  const auto column = [&](const char* name, double scale = 1.0) {
    return run.column(name, stage.first, stage.end, scale);
  };
  const std::vector<double> strain = column("axial_strain");
  const Chart stresses{"Stress and friction angle: " + stage.name,
                       "axial strain",
                       "stress (MPa)",
                       "friction angle (degrees)",
                       {{"mean stress", strain, column("mean_stress", kToMega)},
                        {"xx", strain, column("s_xx", kToMega)},
                        {"yy", strain, column("s_yy", kToMega)},
                        {"zz", strain, column("s_zz", kToMega)},
                        {"friction angle (right)", strain, column("friction_angle_deg"), true}}};
  const Chart volume{"Volumetric strain: " + stage.name,
                     "axial strain",
                     "volumetric strain (dilation > 0)",
                     "coordination number",
                     {{"volumetric strain", strain, column("volumetric_strain")},
                      {"coordination (right)", strain, column("coordination_number"), true}}};
  return svg_of(stresses) + svg_of(volume);
}

/// Everything against time, stages shaded.
std::string time_charts(const Run& run) {
  const std::vector<double> time = run.column("time");
  const auto over_time = [&](const char* title, const char* y, const char* y_right,
                             std::vector<Curve> curves, bool logarithmic = false) {
    return svg_of({title, "time (s)", y, y_right, std::move(curves), run.bands(), logarithmic});
  };
  const std::size_t rows = time.size();
  std::vector<Curve> energies;
  for (const char* name :
       {"boundary_work", "gravity_work", "growth_work", "branch_work", "sliding_loss",
        "damping_loss", "viscous_loss", "elastic_energy", "kinetic_energy", "energy_error"}) {
    std::vector<double> values = run.column(name);
    if (std::any_of(values.begin(), values.end(), [](double x) { return x != 0.0; }))
      energies.push_back({name, time, std::move(values)});
  }
  return over_time("Stress and friction angle", "mean stress (MPa)", "friction angle (degrees)",
                   {{"mean stress", time, run.column("mean_stress", 0, rows, kToMega)},
                    {"friction angle (right)", time, run.column("friction_angle_deg"), true}}) +
         over_time("Coordination and porosity", "coordination number", "porosity",
                   {{"coordination", time, run.column("coordination_number")},
                    {"porosity (right)", time, run.column("porosity"), true}}) +
         over_time("Strains, from the start of each stage", "strain", "",
                   {{"axial (compression > 0)", time, run.column("axial_strain")},
                    {"volumetric (dilation > 0)", time, run.column("volumetric_strain")}}) +
         over_time("Inertial fraction", "inertial fraction", "",
                   {{"inertial fraction", time, run.column("inertial_fraction")}}, true) +
         over_time("Energy account, since the run began", "energy (J)", "", std::move(energies));
}

std::string page_of(const Run& run, const fs::path& directory) {
  std::string page = kPageHead;
  page.append(view_style()) += "</style></head><body>\n";
  page += "<h1>" + escaped(directory.string()) + "</h1>\n<p>";
  page += run.summary() ? "A complete run." : "A run that is not complete.";
  page += " Compression is positive in stress and axial strain.</p>\n" + table_of(run.lines());
  page += sample_view(directory);
  page += "<div class=\"parts\"><div class=\"charts\">\n";
  for (const StageRows& stage : run.stages())
    if (run.shears(stage)) page += shear_charts(run, stage);
  page += time_charts(run) + "</div>\n";
  if (run.summary())
    page += "<div class=\"wide\"><h2>Summary</h2>\n" + summary_table(*run.summary()) + "</div>";
  return page + "</div>\n</body></html>\n";
}

}  // namespace

int report(const fs::path& directory) {
  const Run run(directory);
  write_whole(directory / "report.html", page_of(run, directory));
  tables::OutputFile("-").write(text_of(run.lines()) +
                                "Charts: " + (directory / "report.html").string() + '\n');
  return success;
}

}  // namespace tangency::inline v0::dem
