// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/report.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <tuple>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::verify {
namespace {

std::string number(double value) { return tables::rounded_text(value, 2); }

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string row_name(std::size_t row) { return row == kNoRow ? "" : std::to_string(row); }

std::string table_line(const CorpusGrade& grade, const FamilyGrade& family, std::size_t width) {
  const Grade& g = grade.grade;
  std::string line = family.name + std::string(width - family.name.size(), ' ');
  line += padded(std::to_string(family.rows), 9);
  line += padded(g.judges_words ? std::to_string(family.wrong) : "-", 7);
  line += padded(std::to_string(family.touches), 8) + padded(std::to_string(family.missing), 9);
  if (g.claims_bounds) line += padded(std::to_string(family.broken_bounds), 8);
  if (g.judges_normals) line += padded(std::to_string(family.reversed), 10);
  for (const ErrorName& errors : answered(grade)) {
    const ErrorSummary& s = family.*errors.summary;
    const bool any = s.count > 0;
    line += "  |" + padded(any ? number(s.median) : "-", 9) +
            padded(any ? number(s.percentile_99) : "-", 9) +
            padded(any ? number(s.largest) : "-", 9) + padded(row_name(s.worst_row), 8);
  }
  return line + '\n';
}

void add_counts(const CorpusGrade& grade, std::vector<std::string>& lines) {
  const FamilyGrade& all = grade.grade.all;
  for (const auto& [count, what, first] :
       {std::tuple(all.missing, " missing answers, the first is row ", all.first_missing),
        std::tuple(all.broken_bounds, " errors above the claimed gap_error, the first in row ",
                   all.first_broken),
        std::tuple(all.reversed, " normals that point away from every true one, the first in row ",
                   all.first_reversed)}) {
    if (count > 0)
      lines.push_back(grade.corpus + ": " + std::to_string(count) + what + row_name(first));
  }
  if (grade.grade.fault_count > 0) {
    lines.push_back(grade.corpus + ": " + std::to_string(grade.grade.fault_count) +
                    " faulty lines or cells, the first: " + grade.grade.faults.front());
  }
  if (grade.run && !grade.run->sound)
    lines.push_back(grade.corpus + ": the tool " + grade.run->ending);
}

void add_excess(const CorpusGrade& grade, ErrorSummary FamilyGrade::*which,
                const std::optional<double>& most, std::vector<std::string>& lines) {
  const ErrorSummary& s = grade.grade.all.*which;
  if (!most || s.count == 0 || s.largest <= *most) return;
  const auto names = error_names(grade.kind);
  const auto errors = std::ranges::find(names, which, &ErrorName::summary);
  lines.push_back(grade.corpus + ": " + errors->title + ' ' + number(s.largest) + " in row " +
                  row_name(s.worst_row) + " is above " + number(*most));
}

}  // namespace

std::vector<ErrorName> answered(const CorpusGrade& grade) {
  std::vector<ErrorName> kinds;
  for (const ErrorName& errors : error_names(grade.kind)) {
    if ((grade.grade.all.*errors.summary).count > 0) kinds.push_back(errors);
  }
  return kinds;
}

std::vector<std::string> failures(const std::vector<CorpusGrade>& grades,
                                  const Thresholds& thresholds) {
  std::vector<std::string> lines;
  std::size_t wrong = 0;
  std::string where;
  for (const CorpusGrade& grade : grades) {
    add_counts(grade, lines);
    add_excess(grade, &FamilyGrade::gap, thresholds.gap_error, lines);
    add_excess(grade, &FamilyGrade::normal, thresholds.normal_error, lines);
    const FamilyGrade& all = grade.grade.all;
    if (wrong == 0 && all.wrong > 0) where = grade.corpus + " row " + row_name(all.first_wrong);
    wrong += all.wrong;
  }
  if (wrong > thresholds.wrong) {
    lines.push_back(std::to_string(wrong) + " wrong answers are more than " +
                    std::to_string(thresholds.wrong) + "; the first: " + where);
  }
  return lines;
}

std::string verdict(const std::vector<CorpusGrade>& grades, const Thresholds& thresholds,
                    bool has_passed) {
  Grade total;
  std::vector<std::pair<std::string_view, double>> largest;  // errors by their titles
  FamilyGrade& sum = total.all;
  for (const CorpusGrade& grade : grades) {
    const Grade& g = grade.grade;
    total.judges_words |= g.judges_words;
    total.judges_normals |= g.judges_normals;
    total.claims_bounds |= g.claims_bounds;
    total.fault_count += g.fault_count;
    sum.rows += g.all.rows;
    sum.wrong += g.all.wrong;
    sum.missing += g.all.missing;
    sum.broken_bounds += g.all.broken_bounds;
    sum.reversed += g.all.reversed;
    for (const ErrorName& errors : answered(grade)) {
      const std::string_view title = errors.title;
      auto at = std::ranges::find(largest, title, &std::pair<std::string_view, double>::first);
      if (at == largest.end()) at = largest.insert(at, {title, 0});
      at->second = std::max(at->second, (g.all.*errors.summary).largest);
    }
  }
  const auto count = [](std::size_t number, const char* what) {
    return ", " + std::to_string(number) + what;
  };
  std::string text = (has_passed ? "passed: " : "FAILED: ") + std::to_string(sum.rows) +
                     " rows in " + std::to_string(grades.size()) +
                     (grades.size() == 1 ? " corpus: " : " corpora: ");
  text += total.judges_words ? std::to_string(sum.wrong) + " wrong" : "relations not answered";
  if (thresholds.wrong > 0) text += " (" + std::to_string(thresholds.wrong) + " allowed)";
  text += count(sum.missing, " missing");
  if (total.claims_bounds) text += count(sum.broken_bounds, " bounds broken");
  if (total.judges_normals) text += count(sum.reversed, " normals reversed");
  text += count(total.fault_count, " faulty lines or cells");
  for (const auto& [title, error] : largest)
    text += ", largest " + std::string(title) + ' ' + number(error);
  return text;
}

std::string as_table(const CorpusGrade& grade) {
  const Grade& g = grade.grade;
  std::size_t width = 12;
  for (const FamilyGrade& family : g.families) width = std::max(width, family.name.size() + 1);
  const std::vector<ErrorName> kinds = answered(grade);
  std::string text = grade.corpus;
  if (grade.run) {
    text += ": the tool " + grade.run->ending + ", " + number(grade.run->seconds) + " s";
    if (!grade.run->last_words.empty()) text += "; its last words: " + grade.run->last_words;
  }
  if (!kinds.empty())
    text += '\n' +
            std::string(width + 33 + (g.claims_bounds ? 8 : 0) + (g.judges_normals ? 10 : 0), ' ');
  for (const ErrorName& errors : kinds) {
    std::string title = "  | " + std::string(errors.title);
    if (errors.title != kinds.back().title) title.resize(38, ' ');
    text += title;
  }
  text += "\nfamily" + std::string(width - 6, ' ') + "    pairs  wrong touches  missing";
  if (g.claims_bounds) text += "  broken";
  if (g.judges_normals) text += "  reversed";
  for (std::size_t i = 0; i < kinds.size(); ++i) text += "  |   median     99 %  largest     row";
  text += '\n';
  for (const FamilyGrade& family : g.families) text += table_line(grade, family, width);
  if (g.families.size() > 1) text += table_line(grade, g.all, width);
  for (const std::string& fault : g.faults) text += "  " + fault + '\n';
  if (g.fault_count > g.faults.size()) {
    text += "  and " + std::to_string(g.fault_count - g.faults.size()) + " more faults\n";
  }
  return text;
}

std::vector<NamedValue> values_of(const std::vector<CorpusGrade>& grades) {
  using enum NamedValue::Kind;
  std::vector<NamedValue> values;
  const auto add = [&](const std::string& name, const char* unit, NamedValue::Kind kind,
                       auto value) {
    // JSON has no infinity, and a reader takes the null in its place for the best of all.
    constexpr double kMost = std::numeric_limits<double>::max();
    values.push_back({name, unit, kind, std::min(static_cast<double>(value), kMost)});
  };
  for (const CorpusGrade& grade : grades) {
    const Grade& g = grade.grade;
    std::vector<FamilyGrade> families = g.families;
    families.push_back(g.all);
    for (const FamilyGrade& family : families) {
      const std::string name = grade.corpus + '/' + family.name + '/';
      add(name + "pairs", "pairs", size, family.rows);
      if (g.judges_words) add(name + "wrong relations", "pairs", count, family.wrong);
      add(name + "overlaps on an external touch", "pairs", information, family.touches);
      add(name + "missing answers", "pairs", count, family.missing);
      add(name + "rows without an answer", "pairs", count, family.unanswered);
      if (g.judges_gaps) add(name + "rows without a gap", "pairs", count, family.without_gap);
      if (g.claims_bounds) add(name + "broken bounds", "pairs", count, family.broken_bounds);
      if (g.judges_normals) add(name + "reversed normals", "pairs", count, family.reversed);
      for (const ErrorName& errors : error_names(grade.kind)) {
        const ErrorSummary& s = family.*errors.summary;
        if (s.count == 0) continue;
        const std::string what = name + errors.name;
        add(what + ", median", errors.unit, error, s.median);
        add(what + ", 99 %", errors.unit, error, s.percentile_99);
        add(what + ", largest", errors.unit, error, s.largest);
      }
    }
    add(grade.corpus + "/faulty lines or cells", "cells", count, g.fault_count);
    if (grade.run) add(grade.corpus + "/time", "s", information, grade.run->seconds);
  }
  return values;
}

std::string as_json(const std::vector<CorpusGrade>& grades) {
  using Json = nlohmann::ordered_json;
  std::string text = "[";
  for (const NamedValue& one : values_of(grades)) {
    Json entry{{"name", one.name}, {"unit", one.unit}};
    if (one.unit == "pairs" || one.unit == "cells") {
      entry["value"] = static_cast<std::size_t>(one.value);
    } else {
      entry["value"] = one.value;
    }
    text +=
        (text == "[" ? "\n" : ",\n") + entry.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return text + "\n]\n";
}

}  // namespace tangency::inline v0::verify
