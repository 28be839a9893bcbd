// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the subcommands of tangency-verify have in common.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace tangency::verify {

enum ExitStatus : int {
  passed = 0,
  failed = 1,   // a threshold is passed or answers are missing
  refused = 2,  // the command line or a file
};

// A subcommand as main() sees it.
struct Subcommand {
  CLI::App* app;
  std::function<ExitStatus()> run;  // once the command line has been parsed
};

Subcommand add_generate(CLI::App& program);
Subcommand add_grade(CLI::App& program);

}  // namespace tangency::verify
