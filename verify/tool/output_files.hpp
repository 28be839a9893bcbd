// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The files that a grade is also written to, and what it says at its end.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/verify/grade/report.hpp>

namespace tangency::inline v0::verify {

/// Of each form its file, or nothing where it is not asked for.
inline constexpr std::size_t kOutputForms = 6;
using OutputPaths = std::array<std::string, kOutputForms>;

/// `--json FILE` and so on; `paths` outlives the parsing.
void add_output_options(tables::Command& command, OutputPaths& paths);

/// Open from the start, so that what cannot be written is refused before a tool is started; each
/// appears whole with write().
class OutputFiles {
 public:
  /// Throws tables::Error, also where two are one file.
  explicit OutputFiles(const OutputPaths& paths);
  /// Throws tables::Error.
  void write(const GradeReport& report);

 private:
  std::array<std::unique_ptr<tables::OutputFile>, kOutputForms> files_;
};

/// Now, or the moment that SOURCE_DATE_EPOCH names, as 2026-12-01T05:55:00 of UTC. Throws
/// tables::Error where that is no number of seconds.
std::string date_of_outputs();

/// The lines at the end: what wrong answers have in common, why it fails, how to look at a row,
/// annotations where GITHUB_ACTIONS is true, and last the verdict. `corpora` is what `show` needs
/// behind --corpora, or nothing.
std::string closing_of(const GradeReport& report, const std::string& corpora);

}  // namespace tangency::inline v0::verify
