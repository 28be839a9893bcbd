// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The subcommands of tangency-verify.
#pragma once

#include <tangency/geometry/tables/command_line.hpp>

namespace tangency::inline v0::verify {

enum ExitStatus : int {
  passed = 0,
  failed = 1,  // a threshold is passed or answers are missing
};

void add_generate(tables::Program& program);
void add_grade(tables::Program& program);
void add_hunt(tables::Program& program);
void add_inputs(tables::Program& program);
void add_show(tables::Program& program);

}  // namespace tangency::inline v0::verify
