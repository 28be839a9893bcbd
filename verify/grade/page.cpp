// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/verify/grade/report.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>tangency-verify</title><style>
body { font: 15px/1.4 sans-serif; margin: 2em auto; max-width: 70em; color: #222; }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px; white-space: nowrap; }
th, td { padding: .15em .6em; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child { text-align: left; }
.bad { color: #b00020; font-weight: bold; }
svg text { font: 12px sans-serif; fill: #222; }
</style></head><body>
)";

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string shown(double value, const char* format = "%.2g") {
  return tables::formatted(format, value);
}

// Chosen: what is below the first decade stands on it, what is above the last one on that.
constexpr int kFirstDecade = -18, kLastDecade = 0;
constexpr double kLeft = 190, kWidth = 520, kLine = 20, kTop = 34;

double place(double error) {
  const double decade = error > 0 ? std::log10(error) : kFirstDecade;
  const double inside = std::clamp<double>(decade, kFirstDecade, kLastDecade);
  return kLeft + kWidth * (inside - kFirstDecade) / (kLastDecade - kFirstDecade);
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + shown(x, "%.1f") + "\" y=\"" + shown(y, "%.1f") + "\" text-anchor=\"" +
         anchor + "\">" + text + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return "<line x1=\"" + shown(x1, "%.1f") + "\" y1=\"" + shown(y1, "%.1f") + "\" x2=\"" +
         shown(x2, "%.1f") + "\" y2=\"" + shown(y2, "%.1f") + "\" " + style + "/>\n";
}

std::string dot(double error, double y, const char* style, const std::string& hint) {
  return "<circle cx=\"" + shown(place(error), "%.1f") + "\" cy=\"" + shown(y, "%.1f") +
         "\" r=\"4\" " + style + "><title>" + escaped(hint) + "</title></circle>\n";
}

// Error by family: median hollow, 99 % grey, largest full.
std::string plot(const Grade& grade, ErrorSummary FamilyGrade::*which, const std::string& title) {
  const double height = kTop + kLine * static_cast<double>(grade.families.size()) + 30;
  std::string svg = "<svg width=\"740\" height=\"" + shown(height, "%.0f") +
                    "\" role=\"img\" aria-label=\"" + title + " by family\">\n";
  svg +=
      label(kLeft, 14, "start", title + " by family: median &#9675;, 99 % grey, largest &#9679;");
  for (int decade = kFirstDecade; decade <= kLastDecade; decade += 3) {
    const double x = kLeft + kWidth * (decade - kFirstDecade) / (kLastDecade - kFirstDecade);
    svg += line(x, kTop - 10, x, height - 22, "stroke=\"#ddd\"");
    svg += label(x, height - 6, "middle", "1e" + std::to_string(decade));
  }
  double y = kTop;
  for (const FamilyGrade& family : grade.families) {
    const ErrorSummary& s = family.*which;
    svg += label(kLeft - 12, y + 4, "end", escaped(family.name));
    if (s.count > 0) {
      svg += line(place(s.median), y, place(s.largest), y, "stroke=\"#888\"");
      svg += dot(s.median, y, "fill=\"#fff\" stroke=\"#1f5fa8\"", "median " + shown(s.median));
      svg += dot(s.percentile_99, y, "fill=\"#999\"", "99 %: " + shown(s.percentile_99));
      svg += dot(s.largest, y, "fill=\"#1f5fa8\"",
                 "largest " + shown(s.largest) + ", row " + std::to_string(s.worst_row));
    }
    y += kLine;
  }
  return svg + "</svg>\n";
}

std::string cell(const std::string& text, bool bad = false) {
  return (bad ? "<td class=\"bad\">" : "<td>") + text + "</td>";
}

std::string errors(const ErrorSummary& s) {
  if (s.count == 0) return cell("-") + cell("-") + cell("-") + cell("");
  return cell(shown(s.median)) + cell(shown(s.percentile_99)) + cell(shown(s.largest)) +
         cell(std::to_string(s.worst_row));
}

std::string all_errors(const std::vector<ErrorName>& kinds, const FamilyGrade& family) {
  std::string text;
  for (const ErrorName& one : kinds) text += errors(family.*one.summary);
  return text;
}

std::string table(const CorpusGrade& grade) {
  const Grade& g = grade.grade;
  const std::string four = "<th>median</th><th>99 %</th><th>largest</th><th>row</th>";
  std::string text =
      "<table><tr><th rowspan=\"2\">family</th><th rowspan=\"2\">pairs</th>"
      "<th rowspan=\"2\">wrong</th><th rowspan=\"2\">touches</th>"
      "<th rowspan=\"2\">missing</th><th rowspan=\"2\">broken bounds</th>"
      "<th rowspan=\"2\">reversed normals</th>";
  const std::vector<ErrorName> kinds = answered(grade);
  for (const ErrorName& one : kinds) text += "<th colspan=\"4\">" + escaped(one.title) + "</th>";
  text += "</tr><tr>";
  for (std::size_t i = 0; i < kinds.size(); ++i) text += four;
  text += "</tr>\n";
  std::vector<FamilyGrade> families = g.families;
  if (families.size() > 1) families.push_back(g.all);
  for (const FamilyGrade& family : families) {
    text += "<tr>" + cell(escaped(family.name)) + cell(std::to_string(family.rows)) +
            cell(g.judges_words ? std::to_string(family.wrong) : "-", family.wrong > 0) +
            cell(std::to_string(family.touches)) +
            cell(std::to_string(family.missing), family.missing > 0) +
            cell(g.claims_bounds ? std::to_string(family.broken_bounds) : "-",
                 family.broken_bounds > 0) +
            cell(g.judges_normals ? std::to_string(family.reversed) : "-", family.reversed > 0) +
            all_errors(kinds, family) + "</tr>\n";
  }
  return text + "</table>\n";
}

}  // namespace

std::string as_page(const std::vector<CorpusGrade>& grades, const std::string& title,
                    const std::vector<std::string>& failures, const std::string& verdict) {
  std::string page(kHead);
  page += "<h1>" + escaped(title) +
          "</h1>\n<p>Graded by tangency-verify. A gap's error is in units "
          "of L, the distance of the centres and both largest semi-axes; touches are answers "
          "<i>overlaps</i> on an external touch, which are not counted as wrong.</p>\n";
  page += (failures.empty() ? "<p>" : "<p class=\"bad\">") + escaped(verdict) + "</p>\n";
  for (const std::string& failure : failures) {
    page += "<p class=\"bad\">" + escaped(failure) + "</p>\n";
  }
  for (const CorpusGrade& grade : grades) {
    page += "<h2>" + escaped(grade.corpus) + "</h2>\n";
    if (grade.run) {
      page += "<p>The tool " + escaped(grade.run->ending) + ", " + shown(grade.run->seconds) +
              " s.</p>\n";
    }
    const Grade& g = grade.grade;
    page += table(grade);
    for (const ErrorName& one : answered(grade)) page += plot(g, one.summary, one.title);
    for (const std::string& fault : g.faults) page += "<p>" + escaped(fault) + "</p>\n";
  }
  return page + "</body></html>\n";
}

}  // namespace tangency::inline v0::verify
