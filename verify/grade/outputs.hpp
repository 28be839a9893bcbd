// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The outputs of a grade, each a whole file as text.
///
/// (1) None fails for what stands in names, commands or a tool's words: what a format cannot hold
///     is shown as `?`.
/// (2) The same grade at the same date (SOURCE_DATE_EPOCH) gives the same bytes, but for times.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tangency/verify/grade/report.hpp>

namespace tangency::inline v0::verify {

/// For a terminal: a line a family, then what is wrong with rows, as `near.csv:12: row 7: ...`.
std::string as_table(const CorpusReport& corpus);

/// One value of the full JSON; its name is CORPUS/FAMILY/QUANTITY, and CORPUS/all/QUANTITY for a
/// whole corpus.
struct NamedValue {
  enum class Kind {
    size,   ///< of the corpus
    count,  ///< of what should not be
    error,
    information,  ///< about which nothing is better
  };
  std::string name, unit;
  Kind kind;
  double value;  ///< finite: an error beyond doubles is the largest of them
};
std::vector<NamedValue> values_of(const std::vector<CorpusReport>& corpora);

/// An array of {name, unit, value}, one line a value.
std::string as_json(const GradeReport& report);

/// The same form with at most kMostSeries values, for a chart and an alert at a ratio: counts over
/// all corpora, then wrong answers and the largest errors of every corpus, as many as fit. An error
/// is in digits lost: log10(error / 1e-16), 0 where that is less, to two decimals; of floats and of
/// times log10(error), whose units are 2^-24 and a tolerance.
std::string as_json_summary(const GradeReport& report);
inline constexpr std::size_t kMostSeries = 40;

/// JUnit's XML, as Ant's task writes it: a suite a corpus, a test case a family, and in a suite of
/// its own one for what is about no row. It has a failure if and only if the grade has failed.
std::string as_junit(const GradeReport& report);

/// SARIF 2.1.0: a result a row that is named, where its inputs stand.
std::string as_sarif(const GradeReport& report);

/// GitHub's Markdown, for a step's summary.
std::string as_markdown(const GradeReport& report);

/// Workflow commands of GitHub's runner, which shows at most ten errors of a step: one for every
/// reason that is about no row, then for the first rows of all families that have failed in turn.
std::string as_annotations(const GradeReport& report);

/// HTML, self-contained, without scripts.
std::string as_page(const GradeReport& report);

}  // namespace tangency::inline v0::verify
