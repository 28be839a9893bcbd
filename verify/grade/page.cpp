// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/verify/grade/markup.hpp>
#include <tangency/verify/grade/outputs.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1"><title>Contact accuracy</title><style>
body { font: 15px/1.4 sans-serif; margin: 2em auto; max-width: 70em; color: #222; }
h1 { font-size: 1.4em; overflow-wrap: anywhere; } h2 { margin-top: 2em; }
table { border-collapse: collapse; font-size: 13px; }
th, td { padding: .15em .6em; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child { text-align: left; }
.numbers { white-space: nowrap; }
.words th, .words td { text-align: left; vertical-align: top; overflow-wrap: anywhere; }
.wide { overflow-x: auto; margin: 1em 0; }
.verdict { padding: .6em .8em; border-left: 6px solid #1b7f3b; background: #eef7f0; }
.verdict.failed { border-color: #b00020; background: #fbeef0; }
.bad { color: #b00020; font-weight: bold; }
ul { padding-left: 1.2em; overflow-wrap: anywhere; }
th[colspan] { text-align: center; }
svg { display: block; width: 100%; margin: 1em 0; }
svg text { font: 12px sans-serif; fill: #222; }
@media (max-width: 600px) { body { margin: 1em .7em; } h1 { font-size: 1.2em; } }
</style></head><body>
)";

std::string coordinate(double value) { return tables::formatted("%.1f", value); }

// Chosen: what is below the first decade stands on it, what is above the last one on that.
constexpr int kFirstDecade = -18, kLastDecade = 0;
constexpr double kWidth = 330, kLine = 20, kTop = 34, kRight = 24;

// From the first decade on.
double place(double error) {
  const double decade = error > 0 ? std::log10(error) : kFirstDecade;
  const double inside = std::clamp<double>(decade, kFirstDecade, kLastDecade);
  return kWidth * (inside - kFirstDecade) / (kLastDecade - kFirstDecade);
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor +
         "\">" + text + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return "<line x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) + "\" x2=\"" +
         coordinate(x2) + "\" y2=\"" + coordinate(y2) + "\" " + style + "/>\n";
}

std::string dot(double error, double y, const char* style, const std::string& hint) {
  return "<circle cx=\"" + coordinate(place(error)) + "\" cy=\"" + coordinate(y) + "\" r=\"4\" " +
         style + "><title>" + escaped(hint) + "</title></circle>\n";
}

// Room for names at 12 pixels a letter's height.
double width_of_names(const std::vector<FamilyReport>& families) {
  std::size_t letters = 0;
  for (const FamilyReport& family : families) letters = std::max(letters, family.name.size());
  return 7.0 * static_cast<double>(letters) + 16;
}

// The i-th error by family: median hollow, 99 % grey, largest full.
std::string plot(const std::vector<FamilyReport>& families, std::size_t i) {
  const std::string title = families.front().errors[i].title;
  const double height = kTop + kLine * static_cast<double>(families.size()) + 30;
  const double left = width_of_names(families), width = left + kWidth + kRight;
  std::string svg = "<svg viewBox=\"" + coordinate(-left) + " 0 " + coordinate(width) + ' ' +
                    coordinate(height) + "\" style=\"max-width: " + coordinate(width) +
                    "px\" role=\"img\" aria-label=\"" + escaped(title) + " by family\">\n";
  svg += label(0, 14, "start",
               escaped(title) + " by family: median &#9675;, 99 % grey, largest &#9679;");
  for (int decade = kFirstDecade; decade <= kLastDecade; decade += 3) {
    const double x = kWidth * (decade - kFirstDecade) / (kLastDecade - kFirstDecade);
    svg += line(x, kTop - 10, x, height - 22, "stroke=\"#ddd\"");
    svg += label(x, height - 6, "middle", "1e" + std::to_string(decade));
  }
  double y = kTop;
  for (const FamilyReport& family : families) {
    const ErrorSummary& s = family.errors[i].summary;
    svg += label(-12, y + 4, "end", escaped(family.name));
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

std::string cell(const std::string& text, bool is_bad = false) {
  return (is_bad ? "<td class=\"bad\">" : "<td>") + text + "</td>";
}

bool has_column(const Count& count) {
  return count.is_known && !std::string_view(count.title).empty();
}

std::string heads(const FamilyReport& whole) {
  std::string first = "<tr><th rowspan=\"2\">family</th>", second = "<tr>";
  for (const Count& count : whole.counts) {
    if (has_column(count)) first += "<th rowspan=\"2\">" + escaped(count.title) + "</th>";
  }
  for (const Errors& errors : whole.errors) {
    if (errors.summary.count == 0) continue;
    first += "<th colspan=\"4\">" + escaped(errors.title) + "</th>";
    second += "<th>median</th><th>99 %</th><th>largest</th><th>row</th>";
  }
  return first + "</tr>" + second + "</tr>\n";
}

std::string line(const FamilyReport& family, const FamilyReport& whole) {
  std::string text = "<tr>" + cell(escaped(family.name));
  for (const Count& count : family.counts) {
    if (!has_column(count)) continue;
    text +=
        cell(std::to_string(count.number), count.kind == Count::Kind::fault && count.number > 0);
  }
  for (std::size_t i = 0; i < whole.errors.size(); ++i) {
    if (whole.errors[i].summary.count == 0) continue;
    const ErrorSummary& s = family.errors[i].summary;
    const bool any = s.count > 0;
    text += cell(any ? shown(s.median) : "-") + cell(any ? shown(s.percentile_99) : "-") +
            cell(any ? shown(s.largest) : "-") + cell(any ? std::to_string(s.worst_row) : "");
  }
  return text + "</tr>\n";
}

std::string table(const CorpusReport& corpus) {
  std::string text = "<div class=\"wide\"><table class=\"numbers\">" + heads(corpus.whole);
  for (const FamilyReport& family : corpus.families) text += line(family, corpus.whole);
  if (corpus.families.size() > 1) text += line(corpus.whole, corpus.whole);
  return text + "</table></div>\n";
}

std::string rows_at_fault(const CorpusReport& corpus) {
  std::string text;
  std::size_t unnamed = 0;
  for (const FamilyReport& family : corpus.families) {
    unnamed += family.unnamed;
    for (const RowFault& fault : family.faults) {
      text += "<tr>" + cell(escaped(family.name)) + cell(std::to_string(fault.row)) +
              cell(fault.line > 0 ? std::to_string(fault.line) : "") + cell(escaped(fault.text)) +
              "</tr>\n";
    }
  }
  if (text.empty()) return {};
  return "<details><summary>Rows at fault</summary><table class=\"words\"><tr><th>family</th>"
         "<th>row</th><th>line of " +
         escaped(corpus.file) + "</th><th>what</th></tr>\n" + text + "</table>" +
         (unnamed > 0 ? "<p>and " + std::to_string(unnamed) + " more</p>" : "") + "</details>\n";
}

std::string section(const CorpusReport& corpus) {
  std::string text = "<h2>" + escaped(corpus.name) + "</h2>\n";
  if (corpus.run) {
    text += "<p>The tool " + escaped(corpus.run->ending) + ", " + shown(corpus.run->seconds) +
            " s" + (corpus.is_dead ? ", without an answer" : "") + ".</p>\n";
  }
  text += table(corpus) + rows_at_fault(corpus);
  for (std::size_t i = 0; i < corpus.whole.errors.size(); ++i) {
    if (corpus.whole.errors[i].summary.count > 0) text += plot(corpus.families, i);
  }
  for (const std::string& fault : corpus.faults) text += "<p>" + escaped(fault) + "</p>\n";
  return text;
}

}  // namespace

std::string as_page(const GradeReport& report) {
  std::string page(kHead);
  page += "<h1>" + escaped(report.title) + "</h1>\n<p class=\"verdict" +
          (report.has_passed() ? "" : " failed") + "\">" + escaped(report.verdict) + "</p>\n";
  if (!report.has_passed()) page += "<ul class=\"bad\">\n";
  for (const Reason& reason : report.reasons) page += "<li>" + escaped(reason.text) + "</li>\n";
  if (!report.has_passed()) page += "</ul>\n";
  const std::vector<std::string> confusions = commonest_confusions(report);
  if (!confusions.empty()) page += "<ul>\n";
  for (const std::string& line : confusions) page += "<li>" + escaped(line) + "</li>\n";
  if (!confusions.empty()) page += "</ul>\n";
  page += "<table class=\"words\">\n";
  for (const auto& [name, value] : report.facts) {
    page += "<tr><th>" + escaped(name) + "</th>" + cell(escaped(value)) + "</tr>\n";
  }
  page +=
      "</table>\n<p>A gap's error is in units of L, the distance of the centres and both "
      "largest semi-axes. Touches are answers <i>overlaps</i> on an external touch, which are "
      "not counted as wrong.</p>\n";
  for (const CorpusReport& corpus : report.corpora) page += section(corpus);
  return page + "</body></html>\n";
}

}  // namespace tangency::inline v0::verify
