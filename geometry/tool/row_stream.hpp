// SPDX-License-Identifier: MIT
/// @file
/// The loop that the subcommands share: a table in, row by row, a table out.
///
/// A subcommand is a RowTask: the columns it writes, and a function that looks up the columns it
/// reads and returns what to do with a row. run_row_stream() does the rest: threads, the order of
/// the output, refused rows, the output file, progress and the exit status.
///
/// (1) The output is the same, byte for byte, for every number of threads.
/// (2) A refused row ends the run: rows before it are written to standard output, none for it or
///     after it; an output file is left as it was.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tool/csv.hpp>

namespace tangency::tool {

/// Exit statuses of every subcommand.
enum ExitStatus : int {
  every_row_answered = 0,
  some_row_unanswered = 1,  ///< some row is not_converged, not_applicable or invalid
  refused = 2,
};

enum class RowOutcome { answered, unanswered };

/// Writes the cells of one row, from the second output column on. Called from several threads at
/// once. Throws csv::Error for a row that must be refused.
using RowFunction = std::function<RowOutcome(const csv::RowCursor&, csv::RowText&)>;

struct RowTask {
  /// The first is `row`, the number of the data row from 0.
  std::vector<std::string_view> output_columns;
  /// The one of them that reads `invalid` for a refused row under --keep-going.
  std::string_view verdict_column;
  /// Throws csv::Error for a header that must be refused.
  std::function<RowFunction(const csv::Header&)> bind;
};

struct RowStreamOptions {
  std::string input;        ///< `-` or nothing: standard input
  std::string output;       ///< `-` or nothing: standard output
  unsigned threads = 1;     ///< at least 1
  bool keep_going = false;  ///< write refused rows as `invalid`, name the first ten, and go on
};

/// @throws csv::Error  refused input, or a failed read or write
ExitStatus run_row_stream(const RowTask& task, const RowStreamOptions& options);

}  // namespace tangency::tool
