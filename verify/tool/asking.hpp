// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What grade, show and inputs have in common: where corpora come from, what gap and normal mean,
/// and a tool that is asked. All errors are tables::Error.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/verify/answers/corpus_source.hpp>
#include <tangency/verify/answers/tool_run.hpp>
#include <tangency/verify/answers/truth_table.hpp>
#include <tangency/verify/grade/report.hpp>

namespace tangency::inline v0::verify {

/// `--corpora DIR`
void add_corpora_option(tables::Command& command, std::string& folder);
/// The corpora of a folder, or without one those in this program.
CorpusSource corpus_source(const std::string& folder);

/// `--definition D`; `name` holds the default.
void add_definition_option(tables::Command& command, std::string& name);
/// Of a name that the option allows.
Definition definition_named(std::string_view name);

/// Throws where a file of answers cannot be read; `-` is standard input.
void require_readable(const std::string& path);

/// Where the rows stand. Throws where they are not as many as the truth has.
InputLines input_lines(const CorpusTable& inputs, std::size_t rows);

/// Runs the command on the inputs, for so many seconds and with room for answers to all rows.
ToolRun asked(const std::string& command, const CorpusTable& inputs, std::size_t rows,
              double seconds);

}  // namespace tangency::inline v0::verify
