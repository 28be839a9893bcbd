// SPDX-License-Identifier: MIT
/// @file
/// The loop that the subcommands share: a table in, row by row, a table out.
///
/// A subcommand is a RowTask: the columns it writes, and Rows, which read, answer and write many
/// rows at a time. run_row_stream() does the rest: threads, the order of the output, refused rows,
/// the output file, progress and the exit status.
///
/// (1) The output is the same, byte for byte, for every number of threads.
/// (2) A refused row ends the run: rows before it are written to standard output, none for it or
///     after it; an output file is left as it was.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>

namespace tangency::inline v0::tables {

/// Exit statuses of every subcommand beside kRefused.
enum ExitStatus : int {
  every_row_answered = 0,
  some_row_unanswered = 1,  ///< some row is not_converged, not_applicable or invalid
};

enum class RowOutcome { answered, unanswered };

/// Rows on their way from questions to answers, in one thread.
class Rows {
 public:
  virtual ~Rows() = default;
  /// Takes the question of a row. Throws Error, and takes nothing, where it must be refused.
  virtual void read(const RowCursor& row) = 0;
  /// Answers all that was read since clear().
  virtual void answer() = 0;
  /// Writes the cells of the i-th of them, from the second output column on; or, where the task
  /// writes lines, none or more whole ones.
  virtual RowOutcome write(std::size_t i, RowText& out) const = 0;
  virtual void clear() = 0;
};

/// BindRows looks up the columns to read and throws Error for a header that must be refused;
/// MakeRows, called in each thread, does not.
using MakeRows = std::function<std::unique_ptr<Rows>()>;
using BindRows = std::function<MakeRows(const Header&)>;

/// Answers one row, reading its cells and writing those of the answer. Called from several threads
/// at once. Throws Error for a row that must be refused.
using RowFunction = std::function<RowOutcome(const RowCursor&, RowText&)>;
/// For tasks that gain nothing from many rows at a time.
BindRows row_by_row(std::function<RowFunction(const Header&)> bind);

struct RowTask {
  /// The first is `row`, the number of the data row from 0.
  std::vector<std::string_view> output_columns;
  /// The one of them that reads `invalid` for a refused row under --keep-going.
  std::string_view verdict_column;
  BindRows bind;
  /// Do its Rows write whole lines, row number and end included: none or several a row?
  bool writes_lines = false;
};

struct RowStreamOptions {
  std::string input;        ///< `-` or nothing: standard input
  std::string output;       ///< `-` or nothing: standard output
  unsigned threads = 1;     ///< at least 1
  bool keep_going = false;  ///< write refused rows as `invalid`, name the first ten, and go on
};

/// @throws Error  refused input, or a failed read or write
ExitStatus run_row_stream(const RowTask& task, const RowStreamOptions& options);

}  // namespace tangency::inline v0::tables
