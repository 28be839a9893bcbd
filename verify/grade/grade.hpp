// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The grade of one table of answers, family by family.
///
/// An answer is a line with `row` and any of: relation; overlaps (0 or 1); gap; nx, ny, nz; and
/// with gap: gap_error, a claimed bound, and status, whose word `local` says that the bound is for
/// a local gap; of ellipses also crossings and area; of quadrics type. Rows come in any order. What
/// the table's header offers, and what is demanded, is asked of every row.
///
///  (1) wrong: the relation, crossings, type or yes/no differ from the truth. `overlaps` 1 on an
///      external touch is counted apart (`touches`) and never wrong.
///  (2) missing: an answer that was asked for and is not there, or is no finite number or known
///      word.
///  (3) gap error: |gap - truth| / L, L = |d| + both largest semi-axes; the difference is taken
///      with 106 bits, so that a correctly rounded gap is seen as that.
///  (4) normal error: length of the difference to the nearest true normal. reversed: the normal is
///      more than a right angle from every true one.
///  (5) area error: |area - truth| / area of the smaller ellipse.
///  (6) broken bound: |gap - truth| > gap_error; on a `local` row: truth < gap - gap_error. A row
///      without gap_error claims none.
///  (7) Every line of the answers is graded, or is named as a fault, or both: of a row answered
///      twice the first answer counts. A header without `row`, and a line of a mebibyte, end the
///      reading, which is named too.
///  (8) Whatever is counted above, but for touches, has a finding, which says what was answered and
///      what is true; so has an error above what the demands allow.
///  (9) Rows that are not claimed (TruthRow::standing) are in no count, error, finding and fault
///  but
///      in not_claimed; an expected failure that fails is in no other than expected_failures, and
///      one that is answered rightly is judged as every row, and named.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/verify/grade/judge.hpp>

namespace tangency::inline v0::verify {

enum class Problem { wrong, missing, broken_bound, reversed, gap_error, normal_error };

/// What is at fault in the answer to one row.
struct Finding {
  std::size_t row;
  Problem problem;
  std::string column;    ///< "relation", "nx ny nz"; nothing where the whole row is missing
  std::string answered;  ///< as it stands in the answers, or nothing
  std::string truth;     ///< a word or a number, as an answer would say it; nothing where none is
  double error = 0;      ///< of a gap or a normal, in the unit of its summary
};

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
  ErrorSummary gap, normal, area;
  std::size_t not_claimed = 0, expected_failures = 0;  ///< none of them in rows
};

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

/// Asked of every row even where the answers' header does not offer it; of numbers the largest
/// error without a finding.
struct Demands {
  bool words = false;
  std::optional<double> gap{}, normal{};
};

/// `answers` is a path, or the table itself. Never throws for what stands in it.
Grade grade(const TruthTable& truth, const std::string& answers, const Demands& demands);
Grade grade(const TruthTable& truth, const tables::NamedText& answers, const Demands& demands);

}  // namespace tangency::inline v0::verify
