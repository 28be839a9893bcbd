// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The grade of one table of answers, family by family.
///
/// An answer is a line with `row` and any of the columns that its kind of corpus is judged by
/// (judged_columns.hpp). Rows come in any order. What the table's header offers, and what is
/// demanded, is asked of every row.
///
///  (1) wrong: relation, crossings, type, result, status or yes/no differ from the truth, or the
///      sign of a point's gap does, unless that is 0.
///      `overlaps` 1 on an external touch is counted apart (`touches`) and never wrong; `contact`
///      for a time that grazes is right.
///  (2) missing: an answer that was asked for and is not there, or is no finite number, known word,
///      bound >= 0, or normal whose length is 1 to three digits.
///  (3) gap error: |gap - truth| / L, L = |d| + both largest semi-axes (of points and walls that of
///      the one body); the difference is taken with 106 bits, so that a correctly rounded gap is
///      seen as that. Of floats the unit is 2^-24 L, and of their normals 2^-24.
///  (4) normal error: length of the difference to the nearest true normal. reversed: the normal is
///      more than a right angle from every true one.
///  (5) area error: |area - truth| / area of the smaller ellipse.
///  (6) t error, of rays: |t - truth| |direction| / L, of the worse of t1 and t2. time error: how
///      far `time` is from the true interval, in tolerances.
///  (7) broken bound: |gap - truth| > gap_error; on a `local` row: truth < gap - gap_error. A row
///      without gap_error claims none. Of times: the bodies meet before `time`, or, of a contact,
///      not by `latest`.
///  (8) Neighbours are a list, without `row`: of a pair (i, j, ix, iy, iz) that shares no point
///      body i is wrong, of one that is not listed it is missing; (j, i, -image) is the same pair.
///      Rows are bodies; both counts are of pairs.
///  (9) Every line of the answers is graded, or is named as a fault, or both: of a row answered
///      twice the first answer counts. A header without `row`, and a line of a mebibyte, end the
///      reading, which is named too.
/// (10) Whatever is counted above, but for touches, has a finding, which says what was answered and
///      what is true; so has an error above what the demands allow.
/// (11) Rows that are not claimed (TruthRow::standing) are in no count, error, finding and fault
/// but
///      in not_claimed; an expected failure that fails is in no other than expected_failures, and
///      one that is answered rightly is judged as every row, and named.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/verify/grade/finding.hpp>
#include <tangency/verify/grade/judge.hpp>

namespace tangency::inline v0::verify {

struct FamilyGrade {
  std::string name;
  std::size_t rows = 0;  ///< that are judged
  std::size_t wrong = 0, first_wrong = kNoRow;
  std::size_t touches = 0;  ///< overlaps 1 on an external touch
  std::size_t missing = 0, first_missing = kNoRow;
  std::size_t unanswered = 0;   ///< of the missing: rows without any line
  std::size_t without_gap = 0;  ///< rows that have a true gap and were given none
  std::size_t broken_bounds = 0, first_broken = kNoRow;
  std::size_t reversed = 0, first_reversed = kNoRow;  ///< normals
  ErrorSummary gap, normal, area, time;
  std::size_t not_claimed = 0, expected_failures = 0;  ///< none of them in rows
};

/// What is said of an error: `gap error / L` in tables, `gap error` with its unit in JSON.
struct ErrorName {
  const char *title, *name, *unit;
  ErrorSummary FamilyGrade::*summary;
};

/// Of the errors that this kind of corpus may have.
std::span<const ErrorName> error_names(CorpusKind kind);

struct Grade {
  std::vector<FamilyGrade> families;
  FamilyGrade all;                  ///< of the whole corpus
  std::vector<Finding> findings;    ///< all of them, in the order of the rows
  std::vector<std::size_t> family;  ///< of each row, in families
  std::vector<std::size_t> mended;  ///< rows of expected failures that are answered rightly
  std::vector<std::string> faults;  ///< the first ten: duplicates, unknown rows, rubbish
  std::size_t fault_count = 0;
  bool judges_words = false;    ///< relation, overlaps, crossings or type were answered
  bool judges_gaps = false;     ///< gaps were answered
  bool judges_normals = false;  ///< normals were answered
  bool claims_bounds = false;   ///< gap_error was answered
};

/// `answers` is a path, or the table itself. Never throws for what stands in it.
Grade grade(const TruthTable& truth, const std::string& answers, const Demands& demands);
Grade grade(const TruthTable& truth, const tables::NamedText& answers, const Demands& demands);

}  // namespace tangency::inline v0::verify
