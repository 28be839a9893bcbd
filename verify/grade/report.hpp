// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A finished grade as every output shows it (outputs.hpp), made once from what was graded.
///
/// What is counted, which errors there are and why a grade fails is said here alone; a writer knows
/// no quantity and no kind of corpus by name.
///
/// (1) A grade has passed if and only if there is no reason to fail. That no row was judged is one.
/// (2) A reason is about rows, and then the families of these rows have failed, or about none of
///     them: the tool, lines that cannot be read, the baseline.
/// (3) Of every family the first ten findings of each problem are named; a tool that died without
///     an answer is said once, and none of its rows.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/verify/grade/grade.hpp>

namespace tangency::inline v0::verify {

struct RunNote {
  bool sound;  ///< ended by itself
  std::string ending;
  std::string last_words;
  double seconds;
  bool has_printed;  ///< anything on standard output
};

/// Where the inputs of a corpus stand.
struct InputLines {
  std::string file;                ///< NAME.csv, with its folder where it has one
  std::vector<std::size_t> lines;  ///< of every row, from 1; nothing where the file was not read
};

struct CorpusGrade {
  std::string corpus;
  CorpusKind kind;
  Grade grade;
  std::optional<RunNote> run;  ///< of a tool
  InputLines inputs{};
};

struct Thresholds {
  std::size_t wrong = 0;  ///< most in all corpora together: none, unless more are allowed
  std::optional<double> gap_error, normal_error;
};

/// Of the rows of a family.
struct Count {
  enum class Kind {
    size,         ///< of the family
    fault,        ///< of what should not be
    information,  ///< about which nothing is better
  };
  const char* name;   ///< "missing answers"
  const char* title;  ///< of its column in a table; nothing: in none
  Kind kind;
  std::size_t number;
  const char* unit;      ///< what is counted: pairs, rows or bodies
  bool is_known = true;  ///< false: nothing was answered that it could be counted of
};

struct Errors {
  const char* name;   ///< "gap error"
  const char* title;  ///< with its unit: "gap error / L"
  const char* unit;
  ErrorSummary summary;
};

struct RowFault {
  std::size_t row;
  std::size_t line;  ///< of the corpus's inputs; 0 where it is not known
  Problem problem;
  std::string text;  ///< "relation = overlap, true is separate"
};

/// A word for rules and classes: "wrong-answer".
const char* to_string(Problem problem);

/// What is at fault, without the row: "relation = overlap, true is separate".
std::string text_of(const Finding& finding, CorpusKind kind);

struct FamilyReport {
  std::string name;
  std::vector<Count> counts;  ///< the size first
  std::vector<Errors> errors;
  std::vector<RowFault> faults{};
  std::size_t unnamed = 0;  ///< findings beyond those
  bool has_failed = false;

  std::size_t rows() const { return counts.front().number; }
};

struct CorpusReport {
  std::string name, file;
  std::optional<RunNote> run;
  bool is_dead = false;      ///< a tool answered no row: none is named
  bool is_repeated = false;  ///< dead in the same way as in an earlier corpus
  std::vector<FamilyReport> families;
  FamilyReport whole;
  std::vector<std::size_t> mended{};  ///< rows of expected failures that did not fail
  std::vector<std::string> faults;    ///< the first lines and cells that cannot be read
  std::size_t fault_count = 0;
};

struct Reason {
  std::string text;
  bool is_about_rows;
};

/// What a reader has to know to take the same grade again, in the order to show it.
using Facts = std::vector<std::pair<std::string, std::string>>;

struct GradeReport {
  std::string title;  ///< what was graded: the command, or the file of answers
  std::string program_version;
  std::string date;  ///< 2026-12-01T05:55:00, of UTC
  Facts facts;
  Thresholds thresholds;
  std::vector<CorpusReport> corpora{};
  std::vector<Reason> reasons{};
  /// Of wrong answers: how many have each text.
  std::map<std::string, std::size_t> confusions{};
  std::string verdict{};  ///< one line: passed or FAILED, and the totals over the corpora

  bool has_passed() const { return reasons.empty(); }
};

/// Takes the grade of the next corpus in, and returns what it shows.
const CorpusReport& add(GradeReport& report, const CorpusGrade& grade);

/// Judges what was taken in, once all is: reasons and verdict. `further` are reasons about no row.
void judge(GradeReport& report, const std::vector<std::string>& further);

/// Of all corpora together.
FamilyReport total(const GradeReport& report);

/// What wrong answers have in common, a line each, the commonest first: "1205 times relation =
/// overlap, true is separate".
std::vector<std::string> commonest_confusions(const GradeReport& report);

/// An error as outputs show it: two digits.
std::string shown(double error);

}  // namespace tangency::inline v0::verify
