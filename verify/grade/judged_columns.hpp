// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What is judged of each kind of corpus: a list of columns, each with its judge. A grade knows no
/// kind beyond this list.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/verify/answers/truth_table.hpp>
#include <tangency/verify/grade/finding.hpp>

namespace tangency::inline v0::verify {

/// What became of one row. Errors are nan where there is none.
struct RowVerdict {
  bool seen = false, touch = false, broken = false, reversed = false;
  std::size_t wrong = 0, missing = 0;  ///< 0 or 1, but for the pairs of a list
  std::array<double, kErrorKinds> errors = no_errors();

  double& error(ErrorKind kind) { return errors[static_cast<std::size_t>(kind)]; }
  double error(ErrorKind kind) const { return errors[static_cast<std::size_t>(kind)]; }

 private:
  static constexpr std::array<double, kErrorKinds> no_errors() {
    std::array<double, kErrorKinds> none{};
    none.fill(std::numeric_limits<double>::quiet_NaN());
    return none;
  }
};

/// Where a grade keeps what it comes upon in a table of answers.
struct Findings {
  const tables::Header& header;
  const Demands& demands;
  std::function<void(const tables::Error&)> fault;
  std::function<void(Finding)> find;
};

/// The cells of one line of answers, to one row. A cell that is no answer makes the row missing,
/// and one that cannot be read is a fault as well.
class AnswerCells {
 public:
  AnswerCells(const tables::RowCursor& line, std::size_t row, RowVerdict& verdict,
              const Findings& findings)
      : line_(line), row_(row), verdict_(verdict), findings_(findings) {}

  std::string_view text(tables::Column column) const { return line_.text(column); }
  std::optional<double> number(tables::Column column);
  /// Empty where there is none.
  std::string_view word(tables::Column column);
  /// This cell holds what the column does not allow.
  void refuse(tables::Column column, std::string_view rule);
  /// It holds something else than `truth`, which may be nothing.
  void wrong(tables::Column column, std::string truth);
  void find(Problem problem, std::string column, std::string answered, std::string truth,
            double error);
  const Demands& demands() const { return findings_.demands; }
  RowVerdict& verdict() { return verdict_; }

 private:
  void find_missing(tables::Column column);

  const tables::RowCursor& line_;
  std::size_t row_;
  RowVerdict& verdict_;
  const Findings& findings_;
};

/// Where the columns of one judge are in a table of answers.
struct FoundColumns {
  std::array<std::optional<tables::Column>, 3> judged;
  std::array<std::optional<tables::Column>, 2> beside;
};

struct JudgedColumns {
  enum class Sort { word, gap, normal, number };
  using Judge = void (*)(AnswerCells& cells, const FoundColumns& at, const TruthTable& truth,
                         const TruthRow& row);

  Sort sort;
  std::array<const char*, 3> names;   ///< all of them are answered, or none; null: no further one
  std::array<const char*, 2> beside;  ///< that say more of the answer, where they are there
  Judge judge;
};

/// In the order in which they are judged. Of neighbours none: their list is held against the true
/// one as a whole.
std::span<const JudgedColumns> judged_columns(CorpusKind kind);

}  // namespace tangency::inline v0::verify
