// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Grades as text, as an array of {name, unit, value} and as a page of its own.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tangency/verify/grade/grade.hpp>

namespace tangency::inline v0::verify {

struct RunNote {
  bool sound;  ///< ended by itself
  std::string ending;
  std::string last_words;
  double seconds;
};

struct CorpusGrade {
  std::string corpus;
  CorpusKind kind;
  Grade grade;
  std::optional<RunNote> run;  ///< of a tool
};

/// Of the errors that some row has.
std::vector<ErrorName> answered(const CorpusGrade& grade);

struct Thresholds {
  std::size_t wrong = 0;  ///< most in all corpora together: none, unless more are allowed
  std::optional<double> gap_error, normal_error;
};

/// What fails, one line each, naming corpora and rows; nothing where all is well.
std::vector<std::string> failures(const std::vector<CorpusGrade>& grades,
                                  const Thresholds& thresholds);

/// One line, the last of a grade: passed or FAILED, and the totals over the corpora of what was
/// answered: rows, counts, the largest errors. What no answer was asked for is said too.
std::string verdict(const std::vector<CorpusGrade>& grades, const Thresholds& thresholds,
                    bool has_passed);

std::string as_table(const CorpusGrade& grade);

/// What as_json() writes. Names are CORPUS/FAMILY/QUANTITY, and CORPUS/all/QUANTITY for a whole
/// corpus.
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
std::vector<NamedValue> values_of(const std::vector<CorpusGrade>& grades);

/// One line a value.
std::string as_json(const std::vector<CorpusGrade>& grades);
/// `title` says what was graded. Self-contained, without scripts.
std::string as_page(const std::vector<CorpusGrade>& grades, const std::string& title,
                    const std::vector<std::string>& failures, const std::string& verdict);

}  // namespace tangency::inline v0::verify
