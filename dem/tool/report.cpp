// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/report.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/tool/chart.hpp>
#include <tangency/dem/tool/report_charts.hpp>
#include <tangency/dem/tool/reported_run.hpp>
#include <tangency/dem/tool/results.hpp>
#include <tangency/dem/tool/run.hpp>
#include <tangency/dem/tool/summary.hpp>
#include <tangency/dem/tool/view/sample_view.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/html_text.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;
using tables::escaped;

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
.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(350px, 100%), 1fr)); gap: 1em; align-items: start; flex: 1 1 440px; }
.charts svg { width: 100%; max-width: 560px; }
.wide { overflow-x: auto; }
svg { max-width: 100%; height: auto; }
svg text { font: 12px sans-serif; fill: #222; }
svg text.title { font-weight: bold; font-size: 13px; }
svg text.stage { fill: #667; font-size: 11px; }
)";

std::string shown(double x, const char* format = "%.4g") { return tables::formatted(format, x); }

/// "mean stress (kPa)"; the name alone where there is no unit.
std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " (" + unit + ")";
}

struct Headed {
  std::string name, unit;
};

/// A table of texts.
using Line = std::vector<std::string>;
struct Table {
  std::vector<Headed> heads;
  std::vector<Line> lines;
};

/// Does any stage end in a sheared cell?
bool has_shear(const ReportedRun& run) {
  return std::any_of(run.stages().begin(), run.stages().end(), [&](const StageRows& stage) {
    return run.largest_shear(stage.end - 1) != 0.0;
  });
}

/// A line for each stage, of its last row.
Table table_of(const ReportedRun& run) {
  Table table{{{"stage", ""},
               {"cycles", ""},
               {"mean stress", run.units().stress},
               {"friction angle", "deg"},
               {"coordination", ""},
               {"porosity", ""},
               {"inertial fraction", ""},
               {"axial strain", ""}},
              {}};
  const bool shears = has_shear(run);
  if (shears) table.heads.push_back({"shear strain", "largest component"});
  table.heads.push_back({"energy error", "of the work done"});
  for (const StageRows& stage : run.stages()) {
    const std::size_t end = stage.end - 1;
    const auto of = [&](const char* name, const char* format = "%.4g") {
      return shown(run.value(name, end), format);
    };
    const double angle = run.friction_angle({stage.name, end, stage.end}).front();
    const double work = run.work_done(end);
    Line line{stage.name,
              of("stage_cycle", "%.0f"),
              of("mean_stress"),
              std::isfinite(angle) ? shown(angle, "%.2f") : "-",
              of("coordination_number", "%.3f"),
              of("porosity"),
              of("inertial_fraction", "%.2g"),
              of("axial_strain")};
    if (shears) line.push_back(shown(run.largest_shear(end)));
    line.push_back(work > 0.0 ? shown(run.value("energy_error", end) / work, "%.1e") : "-");
    table.lines.push_back(std::move(line));
  }
  return table;
}

std::string text_of(const Table& table) {
  Line head;
  std::vector<std::size_t> wide;
  for (const Headed& one : table.heads) {
    head.push_back(with_unit(one.name, one.unit));
    wide.push_back(head.back().size());
  }
  for (const Line& line : table.lines)
    for (std::size_t k = 0; k < line.size(); ++k) wide[k] = std::max(wide[k], line[k].size());
  std::string text;
  const auto put = [&](const Line& line) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      const std::string blanks(wide[k] - line[k].size(), ' ');
      text += k == 0 ? line[k] + blanks : "  " + blanks + line[k];
    }
    text += '\n';
  };
  put(head);
  for (const Line& line : table.lines) put(line);
  return text;
}

std::string html_of(const Table& table) {
  std::string text = "<div class=\"wide\"><table><tr>";
  for (const Headed& head : table.heads)
    text += "<th>" + head.name + (head.unit.empty() ? "" : "<br>" + head.unit) + "</th>";
  for (const Line& line : table.lines) {
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

/// What numbers are in.
std::string units_line(const ReportedRun& run) {
  const Units& units = run.units();
  if (!run.summary()) return " Units are named once it is complete, where the scene names them.";
  if (units.length.empty())
    return " The scene names no units (<code>[units]</code>): numbers are in its own, any "
           "consistent set.";
  std::string text = " Units:";
  for (const auto& [what, name] : units.entries())
    text +=
        (text.back() == ':' ? " " : ", ") + std::string(what) + " " + escaped(std::string(name));
  return text + ".";
}

std::string page_of(const ReportedRun& run, const fs::path& directory) {
  std::string page = kPageHead;
  page.append(view_style()) += "</style></head><body>\n";
  page += "<h1>" + escaped(directory.string()) + "</h1>\n<p>";
  page += run.summary() ? "A complete run." : "A run that is not complete.";
  page += " Compression is positive in stress and axial strain." + units_line(run) + "</p>\n" +
          html_of(table_of(run));
  page += sample_view(directory, run.units());
  page += "<div class=\"parts\"><div class=\"charts\">\n";
  for (const StageRows& stage : run.stages()) page += shear_charts(run, stage);
  page += time_charts(run) + "</div>\n";
  if (run.summary())
    page += "<div class=\"wide\"><h2>Summary</h2>\n" + summary_table(*run.summary()) + "</div>";
  return page + "</div>\n</body></html>\n";
}

}  // namespace

int report(const fs::path& directory) {
  const ReportedRun run(directory);
  write_whole(directory / "report.html", page_of(run, directory));
  tables::OutputFile("-").write(text_of(table_of(run)) +
                                "Charts: " + (directory / "report.html").string() + '\n');
  return success;
}

}  // namespace tangency::inline v0::dem
