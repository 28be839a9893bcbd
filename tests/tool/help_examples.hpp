// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The examples of a help text, run: whatever it prints is real.
#pragma once

#include <string>

namespace tangency::testing {

/// Writes the files that stand behind `$ cat FILE`, runs every `$ tangency ...` with them and holds
/// its output against the lines below it, to the next `$` or the end. At least one of them has to
/// be there.
void expect_help_examples(const std::string& subcommand);

}  // namespace tangency::testing
