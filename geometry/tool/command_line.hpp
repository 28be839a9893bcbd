// SPDX-License-Identifier: MIT
/// @file
/// What the subcommands have in common on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

#include <tangency/geometry/tables/row_stream.hpp>

namespace tangency::tool {

/// A subcommand as main() sees it.
struct Subcommand {
  CLI::App* app;
  std::function<ExitStatus()> run;  ///< once the command line has been parsed
};

/// Adds --threads, --out, --keep-going and FILE. The options must outlive the parsing.
void add_row_stream_options(CLI::App& app, RowStreamOptions& options);

Subcommand add_contact(CLI::App& program);
Subcommand add_overlap(CLI::App& program);
Subcommand add_classify(CLI::App& program);
Subcommand add_ellipse(CLI::App& program);

}  // namespace tangency::tool
