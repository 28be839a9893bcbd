// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/picture.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <tangency/bench/speed_accuracy/subprocess.hpp>

namespace tangency::speed_accuracy {
namespace {

// A panel each, where they were measured.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kPanels = {
    {{"class2", "class2: aspect to 5, size ratio to 3"},
     {"class3", "class3: aspect and size ratio to 1000"}}};
constexpr double kLeastError = 1e-17;  // an error of 0 has no place on a logarithmic scale

// The option whose label stands below its point: two others' are above and beside.
constexpr std::string_view kBelow = "certified";

/// One method: its colour, and where labels stand, in characters from the point.
struct Series {
  std::string_view method;
  std::string_view option;  ///< empty: all
  const char* colour;
  bool joined;  ///< by a line, in the order of the rows
  const char* labels;
  const char* below = "";  ///< the place of kBelow
};

constexpr Series kSeries[] = {
    {"gap_lanes", "cold", "#7fa8d9", true, "left offset 0.8,0"},
    {"gap_lanes", "following", "#8cc7a1", true, "right offset -0.6,-0.5"},
    {"signed_gaps", "", "#1f4e8c", false, "left offset 0.6,0.6", "left offset -0.5,-0.8"},
    {"follow_gaps", "", "#2e7d4f", false, "right offset -0.6,0.6", "right offset 0.5,-1.6"},
    {"signed_gap", "", "#111111", false, "center offset 0,0.9"},
    {"follow_gap", "", "#8a6d00", false, "center offset 0,-0.9"},
    {"start alone", "", "#d9730d", true, "left offset 0.6,0.5"},
    {"perram_wertheim_gap", "", "#b3261e", false, "right offset -0.6,0.7"},
    {"trace_contact", "", "#c2185b", false, "right offset -0.6,0.7"},
    {"midpoint_potential_gap", "", "#6a3d9a", false, "right offset -0.6,-0.7"},
};

struct Point {
  double ns, error;
  std::string label;
};

std::string label_of(const Row& row) {
  if (row.steps) return std::to_string(*row.steps);
  if (row.option.starts_with("within ")) return row.option.substr(7);
  return row.option;
}

std::vector<Point> points_of(const std::vector<Row>& rows, std::string_view family,
                             const Series& series, std::string_view level) {
  std::vector<Point> points;
  for (const Row& row : rows) {
    const bool same = row.family == family && row.method == series.method && row.level == level &&
                      (series.option.empty() || row.option == series.option);
    if (same && row.score.gap && std::isfinite(row.score.gap->largest))
      points.push_back({row.ns, std::max(kLeastError, row.score.gap->largest), label_of(row)});
  }
  return points;
}

/// The steps after which nothing improves any more need no number.
void keep_improving_labels(std::vector<Point>& points) {
  double least = points.front().error;
  for (const Point& p : points) least = std::min(least, p.error);
  for (Point& p : points) {
    if (p.error < 100 * least) p.label.clear();
  }
}

/// Points too near each other for two labels get one: at the one next to where labels stand.
void merge_labels(std::vector<Point>& points, bool labels_are_left) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].label.empty() || points[i].label == kBelow) continue;
    std::size_t at = i;
    std::string all = points[i].label;
    for (std::size_t k = i + 1; k < points.size(); ++k) {
      const bool near = std::abs(std::log10(points[k].ns / points[i].ns)) < 0.1 &&
                        std::abs(std::log10(points[k].error / points[i].error)) < 0.8;
      if (!near || points[k].label.empty() || points[k].label == kBelow) continue;
      all += ", " + points[k].label;
      points[k].label.clear();
      if ((points[k].ns < points[at].ns) == labels_are_left) at = k;
    }
    points[i].label.clear();
    points[at].label = all;
  }
}

std::string title_of(const Series& series) {
  std::string title(series.method);
  if (!series.option.empty()) title += ", " + std::string(series.option);
  return title;
}

/// What one panel plots, and the data of it.
struct Panel {
  std::ostringstream data;
  std::vector<std::string> plots;
  int blocks = 0;
  double least = HUGE_VAL, largest = 0;

  std::string block(const std::vector<Point>& points) {
    const std::string name = "$p" + std::to_string(blocks++);
    data << name << " << EOD\n";
    for (const Point& p : points) {
      data << p.ns << ' ' << p.error << " \"" << p.label << "\"\n";
      least = std::min(least, p.error), largest = std::max(largest, p.error);
    }
    data << "EOD\n";
    return name;
  }

  void add_labels(const std::vector<Point>& points, const Series& series, const char* place) {
    const bool any =
        std::any_of(points.begin(), points.end(), [](const Point& p) { return !p.label.empty(); });
    if (!any) return;
    plots.push_back(block(points) + " using 1:2:3 with labels " + place +
                    " font ',12' textcolor rgb '" + series.colour + "' notitle");
  }

  /// @param symbol  of gnuplot: 7 filled circle, 6 open circle, 5 filled square
  void add(const Series& series, std::vector<Point> points, int symbol, bool named) {
    if (points.empty()) return;
    if (series.joined) keep_improving_labels(points);
    merge_labels(points, std::string_view(series.labels).starts_with("right"));
    plots.push_back(
        block(points) + " using 1:2" +
        (series.joined ? " with linespoints pointsize 0.55" : " with points pointsize 0.95") +
        " pointtype " + std::to_string(symbol) + " linewidth 1.4 linecolor rgb '" + series.colour +
        "' " + (named ? "title '" + title_of(series) + "'" : "notitle"));
    if (!named) return;
    std::vector<Point> below, others;
    for (const Point& p : points) (p.label == kBelow ? below : others).push_back(p);
    add_labels(others, series, series.labels);
    add_labels(below, series, series.below);
  }
};

std::string panel_of(const std::vector<Row>& rows, std::string_view family,
                     std::string_view title) {
  Panel panel;
  const std::vector<std::string> levels = levels_of(rows);
  for (const Series& series : kSeries) {
    panel.add(series, points_of(rows, family, series, "single"), 5, true);
    if (levels.empty()) continue;
    panel.add(series, points_of(rows, family, series, levels[0]), 7, true);
    if (levels.size() > 1 && !series.joined)
      panel.add(series, points_of(rows, family, series, levels[1]), 6, false);
  }
  if (panel.plots.empty()) return {};
  std::ostringstream range;
  range << "set yrange [" << panel.least / 300 << ":" << panel.largest * 10 << "]\n";
  std::string text =
      panel.data.str() + range.str() + "set title '" + std::string(title) + "'\nplot ";
  for (std::size_t i = 0; i < panel.plots.size(); ++i)
    text += (i == 0 ? "" : ", \\\n  ") + panel.plots[i];
  return text + "\n";
}

std::string script(const std::vector<Row>& rows) {
  std::vector<std::string> panels;
  for (const auto& [family, title] : kPanels) {
    std::string panel = panel_of(rows, family, title);
    if (!panel.empty()) panels.push_back(std::move(panel));
  }
  if (panels.empty()) throw std::runtime_error("the picture needs class2 or class3");
  const std::vector<std::string> levels = levels_of(rows);
  std::string symbols = "squares: one pair at a time";
  if (!levels.empty()) symbols += "; discs: " + levels[0];
  if (levels.size() > 1) symbols += "; circles: " + levels[1];
  std::ostringstream text;
  text << "set terminal svg size 1000," << 600 * panels.size()
       << " fixed enhanced font 'Helvetica,14' background '#ffffff'\n"
          "set output 'picture.svg'\nset encoding utf8\nset termoption noenhanced\n"
          "set border 3 linewidth 1 linecolor '#555555'\n"
          "set tics nomirror out scale 0.5 textcolor '#222222'\n"
          "set grid linewidth 0.5 linetype 1 linecolor '#dddddd'\n"
          "set logscale xy\nset format x '%g'\nset format y '1e%T'\n"
          "set xrange [2:200000]\nset ytics 100\n"
          "set xlabel 'ns a pair  ("
       << symbols
       << ")'\n"
          "set ylabel 'largest error of the gap / smallest semi-axis'\n"
          "set bmargin 8\n"
          "set key below center vertical maxrows 4 samplen 1.5 font ',13' textcolor '#222222'\n"
          "set multiplot layout "
       << panels.size() << ",1\n";
  for (const std::string& panel : panels) text << panel;
  text << "unset multiplot\n";
  return text.str();
}

}  // namespace

std::string draw(const std::vector<Row>& rows) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  std::string commands = script(rows);
  const std::string_view place = "'picture.svg'";
  commands.replace(commands.find(place), place.size(), "'" + path("picture.svg") + "'");
  std::ofstream(path("picture.gp")) << commands;
  run_program({"gnuplot", path("picture.gp")});
  std::ostringstream svg;
  svg << std::ifstream(path("picture.svg")).rdbuf();
  std::string text = svg.str();
  const std::string_view after = "?>\n";
  const std::size_t head = text.find(after);
  text.insert(head == std::string::npos ? 0 : head + after.size(),
              "<!-- SPDX-License-Identifier: MIT -->\n");
  return text;
}

}  // namespace tangency::speed_accuracy
