// SPDX-License-Identifier: MIT
/// @file
/// The subcommands, and what they have in common on the command line.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/row_stream.hpp>

namespace tangency::inline v0::tool {

/// Adds --threads, --out and FILE. The options must outlive the parsing, here and below.
void add_table_options(tables::Command& command, tables::RowStreamOptions& options);
/// And --keep-going.
void add_row_stream_options(tables::Command& command, tables::RowStreamOptions& options);

/// Of commands whose bodies may be given by quadrics or, in the plane, by conics.
struct QuadricOptions : tables::RowStreamOptions {
  std::string mixed_terms = "half";
};
struct ConicOptions : tables::RowStreamOptions {
  std::string mixed_terms = "full";
};

/// Adds --mixed-terms half|full: how the coefficients are written.
void add_mixed_terms_option(tables::Command& command, QuadricOptions& options);
void add_mixed_terms_option(tables::Command& command, ConicOptions& options);

/// A subcommand from a table to a table, row by row: what it has of its own.
template <class Options>
struct RowCommand {
  std::string name, description;
  std::string help;  ///< at the end
  /// Adds its own options, if it has any, before those that all have.
  std::function<void(tables::Command&, Options&)> describe{};
  /// What it does, once the options are known.
  std::function<tables::RowTask(const Options&)> task;
  /// What it does in place of that, where an option asks for it: the exit status, else nothing.
  std::function<std::optional<int>(const Options&)> instead{};
};

/// The one way in which they are registered.
/// @tparam Options  QuadricOptions or ConicOptions, or what has more
template <class Options>
void add_row_command(tables::Program& program, const RowCommand<Options>& row_command) {
  const auto options = std::make_shared<Options>();
  tables::Command& command = program.subcommand(row_command.name, row_command.description);
  if (row_command.describe) row_command.describe(command, *options);
  add_mixed_terms_option(command, *options);
  add_row_stream_options(command, *options);
  command.footer(row_command.help);
  command.runs([options, task = row_command.task, instead = row_command.instead]() -> int {
    if (const std::optional<int> status = instead ? instead(*options) : std::nullopt)
      return *status;
    return tables::run_row_stream(task(*options), *options);
  });
}

/// A task that answers a row from its cells alone.
/// @param columns  of the output
template <class Columns>
tables::RowTask row_task(const Columns& columns, std::string_view verdict_column,
                         std::function<tables::RowFunction(const tables::Header&)> bind) {
  return {.output_columns = {columns.begin(), columns.end()},
          .verdict_column = verdict_column,
          .bind = tables::row_by_row(std::move(bind))};
}

void add_contact(tables::Program& program);
void add_overlap(tables::Program& program);
void add_classify(tables::Program& program);
void add_ellipse(tables::Program& program);
void add_point(tables::Program& program);
void add_ellipse_point(tables::Program& program);
void add_wall(tables::Program& program);
void add_ray(tables::Program& program);
void add_time(tables::Program& program);
void add_neighbours(tables::Program& program);

}  // namespace tangency::inline v0::tool
