// SPDX-License-Identifier: MIT
/// @file
/// The subcommands, and what they have in common on the command line.
#pragma once

#include <string>

#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/row_stream.hpp>

namespace tangency::tool {

/// Adds --threads, --out and FILE. The options must outlive the parsing, here and below.
void add_table_options(tables::Command& command, tables::RowStreamOptions& options);
/// And --keep-going.
void add_row_stream_options(tables::Command& command, tables::RowStreamOptions& options);

/// Adds --mixed-terms half|full: how the coefficients of quadrics are written.
void add_mixed_terms_option(tables::Command& command, std::string& mixed_terms);

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

}  // namespace tangency::tool
