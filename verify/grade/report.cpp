// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/report.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr std::size_t kMostFaults = 10;     // chosen: of a family and a problem
constexpr std::size_t kMostConfusions = 5;  // chosen: what a reader takes in at a glance

// What the rows of a kind are, and what is answered of them.
struct RowNames {
  const char *rows, *answers;
};

RowNames row_names(CorpusKind kind) {
  switch (kind) {
    case CorpusKind::pairs:
    case CorpusKind::ellipses:
    case CorpusKind::matrices:
    case CorpusKind::floats:
      return {"pairs", "pairs"};
    case CorpusKind::neighbours:
      return {"bodies", "pairs"};
    case CorpusKind::quadrics:
    case CorpusKind::points:
    case CorpusKind::walls:
    case CorpusKind::rays:
    case CorpusKind::times:
      break;
  }
  return {"rows", "rows"};
}

// The quantities of a grade, in the order of its tables and values.
FamilyReport quantities(CorpusKind kind, const Grade& g, const FamilyGrade& f) {
  using enum Count::Kind;
  const RowNames names = row_names(kind);
  FamilyReport family{f.name, {{"pairs", names.rows, size, f.rows, names.rows}}, {}};
  std::vector<Count>& counts = family.counts;
  counts.push_back({"wrong relations", "wrong", fault, f.wrong, names.answers, g.judges_words});
  counts.push_back(
      {"overlaps on an external touch", "touches", information, f.touches, names.answers});
  counts.push_back({"missing answers", "missing", fault, f.missing, names.answers});
  counts.push_back({"rows without an answer", "", fault, f.unanswered, names.rows});
  counts.push_back({"rows without a gap", "", fault, f.without_gap, names.rows, g.judges_gaps});
  counts.push_back(
      {"broken bounds", "broken", fault, f.broken_bounds, names.answers, g.claims_bounds});
  counts.push_back(
      {"reversed normals", "reversed", fault, f.reversed, names.answers, g.judges_normals});
  counts.push_back({"rows not claimed", "not claimed", information, f.not_claimed, names.rows,
                    g.all.not_claimed > 0});
  counts.push_back({"expected failures", "expected", information, f.expected_failures, names.rows,
                    g.all.expected_failures > 0});
  for (const ErrorName& error : error_names(kind)) {
    family.errors.push_back({error.name, error.title, error.unit, f.*error.summary});
  }
  return family;
}

std::string equation(const Finding& found) {
  return found.column + " = " + (found.answered.empty() ? "nothing" : found.answered);
}

void add_faults(const CorpusGrade& grade, std::vector<FamilyReport>& families) {
  std::map<std::pair<std::size_t, Problem>, std::size_t> named;
  for (const Finding& found : grade.grade.findings) {
    const std::size_t which = grade.grade.family[found.row];
    FamilyReport& family = families[which];
    if (named[{which, found.problem}]++ >= kMostFaults) {
      ++family.unnamed;
      continue;
    }
    const auto& lines = grade.inputs.lines;
    family.faults.push_back({found.row, found.row < lines.size() ? lines[found.row] : 0,
                             found.problem, text_of(found, grade.kind)});
  }
}

// Failing for a reason of its own, whatever is allowed of wrong answers.
bool fails_by_itself(const FamilyGrade& family, const Thresholds& limits) {
  return family.missing > 0 || family.broken_bounds > 0 || family.reversed > 0 ||
         (limits.gap_error && family.gap.count > 0 && family.gap.largest > *limits.gap_error) ||
         (limits.normal_error && family.normal.count > 0 &&
          family.normal.largest > *limits.normal_error);
}

std::string place(const CorpusReport& corpus, std::size_t row) {
  for (const FamilyReport& family : corpus.families) {
    for (const RowFault& fault : family.faults) {
      if (fault.row != row || fault.line == 0) continue;
      return " row " + std::to_string(row) + " (" + corpus.file + ':' + std::to_string(fault.line) +
             ')';
    }
  }
  return " row " + std::to_string(row);
}

void add_excess(const CorpusReport& corpus, const char* name, const std::optional<double>& most,
                std::vector<Reason>& reasons) {
  for (const Errors& errors : corpus.whole.errors) {
    const ErrorSummary& s = errors.summary;
    if (std::string_view(errors.name) != name) continue;
    if (!most || s.count == 0 || s.largest <= *most) continue;
    reasons.push_back({corpus.name + ": " + errors.title + ' ' + shown(s.largest) + " in" +
                           place(corpus, s.worst_row) + " is above " + shown(*most),
                       true});
  }
}

// The rows with a problem: how many, and the first.
void add_problem(const CorpusReport& corpus, Problem problem, std::string_view count,
                 const char* what, std::vector<Reason>& reasons) {
  const auto counted = std::ranges::find(corpus.whole.counts, count, &Count::name);
  if (counted->number == 0) return;
  std::size_t first = kNoRow;
  for (const FamilyReport& family : corpus.families) {
    for (const RowFault& fault : family.faults) {
      if (fault.problem == problem) first = std::min(first, fault.row);
    }
  }
  reasons.push_back(
      {corpus.name + ": " + std::to_string(counted->number) + what + place(corpus, first), true});
}

// A tool that died, or that answered nothing: said once, with all corpora where it did so.
void add_deaths(const std::vector<CorpusReport>& corpora, std::vector<Reason>& reasons) {
  std::map<std::tuple<bool, std::string, std::string, std::string>, std::vector<std::string>>
      deaths;
  for (const CorpusReport& corpus : corpora) {
    if (!corpus.run || (corpus.run->sound && !corpus.is_dead)) continue;
    const bool is_rubbish = corpus.is_dead && corpus.run->has_printed && !corpus.faults.empty();
    deaths[{corpus.is_dead, corpus.run->ending, is_rubbish ? corpus.faults.front() : "",
            corpus.run->last_words}]
        .push_back(corpus.name);
  }
  for (const auto& [death, names] : deaths) {
    const auto& [is_dead, ending, rubbish, last_words] = death;
    std::string text = "the tool " + ending + (is_dead ? " without an answer, in " : ", in ");
    for (const std::string& name : names) text += (name == names.front() ? "" : ", ") + name;
    if (!rubbish.empty()) text += "; of what it printed, " + rubbish;
    if (!last_words.empty()) text += "; its last words: " + last_words;
    reasons.push_back({text, false});
  }
}

void add_reasons(GradeReport& report) {
  std::vector<Reason>& reasons = report.reasons;
  add_deaths(report.corpora, reasons);
  for (const CorpusReport& corpus : report.corpora) {
    if (corpus.is_dead) continue;
    add_problem(corpus, Problem::missing, "missing answers", " missing answers, the first is",
                reasons);
    add_problem(corpus, Problem::broken_bound, "broken bounds",
                " errors above the claimed gap_error, the first in", reasons);
    add_problem(corpus, Problem::reversed, "reversed normals",
                " normals that point away from every true one, the first in", reasons);
    if (corpus.fault_count > 0) {
      reasons.push_back({corpus.name + ": " + std::to_string(corpus.fault_count) +
                             " faulty lines or cells, the first: " + corpus.faults.front(),
                         false});
    }
    add_excess(corpus, "gap error", report.thresholds.gap_error, reasons);
    add_excess(corpus, "normal error", report.thresholds.normal_error, reasons);
  }
}

std::size_t number(const FamilyReport& family, std::string_view count) {
  return std::ranges::find(family.counts, count, &Count::name)->number;
}

// Wrong answers, if they are more than are allowed.
void add_wrong(GradeReport& report) {
  std::size_t wrong = 0;
  std::string first;
  for (const CorpusReport& corpus : report.corpora) {
    for (const FamilyReport& family : corpus.families) {
      wrong += number(family, "wrong relations");
      for (const RowFault& fault : family.faults) {
        if (!first.empty() || fault.problem != Problem::wrong) continue;
        first = corpus.name + place(corpus, fault.row) + ", " + fault.text;
      }
    }
  }
  if (wrong <= report.thresholds.wrong) return;
  report.reasons.push_back({std::to_string(wrong) + " wrong answers are more than " +
                                std::to_string(report.thresholds.wrong) + "; the first: " + first,
                            true});
  for (CorpusReport& corpus : report.corpora) {
    for (FamilyReport& family : corpus.families) {
      family.has_failed = family.has_failed || number(family, "wrong relations") > 0;
    }
  }
}

std::string verdict_of(const GradeReport& report) {
  const FamilyReport sum = total(report);
  const std::size_t corpora = report.corpora.size();
  std::string text = (report.has_passed() ? "passed: " : "FAILED: ") + std::to_string(sum.rows()) +
                     " rows in " + std::to_string(corpora) +
                     (corpora == 1 ? " corpus: " : " corpora: ");
  std::size_t faults = 0;
  for (const CorpusReport& corpus : report.corpora) faults += corpus.fault_count;
  for (const auto& [name, what] :
       {std::pair("wrong relations", "wrong"), std::pair("missing answers", "missing"),
        std::pair("broken bounds", "bounds broken"),
        std::pair("reversed normals", "normals reversed")}) {
    const bool is_first = std::string_view(what) == "wrong";
    const Count& count = *std::ranges::find(sum.counts, std::string_view(name), &Count::name);
    if (!count.is_known && !is_first) continue;
    text += is_first ? "" : ", ";
    text += count.is_known ? std::to_string(count.number) + ' ' + what : "relations not answered";
    if (is_first && report.thresholds.wrong > 0) {
      text += " (" + std::to_string(report.thresholds.wrong) + " allowed)";
    }
  }
  text += ", " + std::to_string(faults) + " faulty lines or cells";
  for (const auto& [name, what] : {std::pair("rows not claimed", " rows not claimed"),
                                   std::pair("expected failures", " failed as expected")}) {
    const std::size_t aside = number(sum, name);
    if (aside > 0) text += ", " + std::to_string(aside) + what;
    const auto features = std::ranges::find(report.facts, "not claimed", &Facts::value_type::first);
    if (aside > 0 && std::string_view(name) == "rows not claimed" && features != report.facts.end())
      text += " (" + features->second + ')';
  }
  for (const Errors& errors : sum.errors) {
    if (errors.summary.count == 0) continue;
    text += std::string(", largest ") + errors.title + ' ' + shown(errors.summary.largest);
  }
  return text;
}

}  // namespace

const char* to_string(Problem problem) {
  constexpr std::array kWords{"wrong-answer",    "missing-answer", "broken-bound",
                              "reversed-normal", "gap-error",      "normal-error"};
  return kWords[static_cast<std::size_t>(problem)];
}

std::string text_of(const Finding& found, CorpusKind kind) {
  const std::string truth = ", true is " + (found.truth.empty() ? "nothing" : found.truth);
  switch (found.problem) {
    case Problem::wrong:
      return equation(found) + truth;
    case Problem::missing:
      if (found.column.empty()) return "no answer";
      if (!found.truth.empty()) return "no " + found.column + " = " + found.truth;
      if (found.answered.empty()) return "no " + found.column;
      return equation(found) + ", which is no answer";
    case Problem::broken_bound:
      return equation(found) + ", but the error is " + found.truth;
    case Problem::reversed:
      return equation(found) + truth + ": the other way";
    case Problem::gap_error:
    case Problem::normal_error:
      break;
  }
  const auto summary =
      found.problem == Problem::gap_error ? &FamilyGrade::gap : &FamilyGrade::normal;
  const std::string unit = std::ranges::find(error_names(kind), summary, &ErrorName::summary)->unit;
  return equation(found) + truth + ": off by " + shown(found.error) +
         (unit == "1" ? "" : ' ' + unit);
}

std::string shown(double error) { return tables::rounded_text(error, 2); }

const CorpusReport& add(GradeReport& report, const CorpusGrade& grade) {
  const Grade& g = grade.grade;
  CorpusReport corpus{.name = grade.corpus,
                      .file = grade.inputs.file,
                      .run = grade.run,
                      .is_dead = grade.run && g.all.rows > 0 && g.all.unanswered == g.all.rows,
                      .families = {},
                      .whole = quantities(grade.kind, g, g.all),
                      .mended = g.mended,
                      .faults = g.faults,
                      .fault_count = g.fault_count};
  for (const FamilyGrade& family : g.families) {
    corpus.families.push_back(quantities(grade.kind, g, family));
    corpus.families.back().has_failed = fails_by_itself(family, report.thresholds);
  }
  if (!corpus.is_dead) add_faults(grade, corpus.families);
  for (const Finding& found : g.findings) {
    if (found.problem == Problem::wrong) ++report.confusions[text_of(found, grade.kind)];
  }
  for (const CorpusReport& earlier : report.corpora) {
    corpus.is_repeated |=
        corpus.is_dead && earlier.is_dead && earlier.run->ending == corpus.run->ending &&
        earlier.run->last_words == corpus.run->last_words && earlier.faults == corpus.faults;
  }
  report.corpora.push_back(std::move(corpus));
  return report.corpora.back();
}

FamilyReport total(const GradeReport& report) {
  FamilyReport sum{"all", {}, {}};
  for (const CorpusReport& corpus : report.corpora) {
    if (sum.counts.empty()) {
      sum = corpus.whole;
      continue;
    }
    for (std::size_t i = 0; i < sum.counts.size(); ++i) {
      sum.counts[i].number += corpus.whole.counts[i].number;
      sum.counts[i].is_known |= corpus.whole.counts[i].is_known;
    }
    for (const Errors& errors : corpus.whole.errors) {
      const auto known =
          std::ranges::find(sum.errors, std::string_view(errors.title), &Errors::title);
      if (known == sum.errors.end()) {
        sum.errors.push_back(errors);
        continue;
      }
      known->summary.count += errors.summary.count;
      known->summary.largest = std::max(known->summary.largest, errors.summary.largest);
    }
  }
  return sum;
}

std::vector<std::string> commonest_confusions(const GradeReport& report) {
  std::vector<std::pair<std::size_t, std::string>> counted;
  for (const auto& [text, count] : report.confusions) counted.emplace_back(count, text);
  std::ranges::stable_sort(counted, std::ranges::greater(),
                           &std::pair<std::size_t, std::string>::first);
  std::vector<std::string> lines;
  for (const auto& [count, text] : counted) {
    if (lines.size() == kMostConfusions) break;
    lines.push_back(std::to_string(count) + (count == 1 ? " time " : " times ") + text);
  }
  return lines;
}

void judge(GradeReport& report, const std::vector<std::string>& further) {
  if (total(report).rows() == 0)
    report.reasons.push_back(
        {"no row is judged: all are not claimed, or fail as they are expected to", false});
  add_reasons(report);
  add_wrong(report);
  for (const std::string& text : further) report.reasons.push_back({text, false});
  report.verdict = verdict_of(report);
}

}  // namespace tangency::inline v0::verify
