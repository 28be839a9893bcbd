// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One run of a tool under test: inputs in, answers out, whatever the tool does.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tangency::inline v0::verify {

struct ToolLimits {
  double seconds;          ///< of wall time
  std::size_t most_bytes;  ///< of standard output
  int deadline = -1;  ///< a descriptor that is readable once the time is up, in place of a clock
};

struct ToolRun {
  std::string output;  ///< what came on standard output
  bool sound;          ///< ended by itself, not by a signal, a limit or an interrupt
  std::string ending;  ///< "ended with status 0", "was ended by signal 11 (Segmentation fault)",
                       ///< "had not ended after 300 s", "printed more than 2097152 bytes"
  std::string last_words;  ///< last line on standard error
  double seconds;
};

/// The table without its comment lines: what a tool reads.
std::string inputs_for_a_tool(std::string_view table);

/// `sh -c COMMAND` in a process group of its own, with the table `inputs` on standard input, its
/// comment lines left out. The group is killed at a limit and when it has ended, and before SIGHUP,
/// SIGINT or SIGTERM are obeyed, which end this process too; what was printed until then, and no
/// more, is kept: a tool waits for what it has started.
/// A process that leaves the group is left alone. An exit status of 129 to 159 is a signal's, told
/// by a shell.
/// Throws tables::Error where there is no /bin/sh, std::system_error where no process starts.
ToolRun run_tool(const std::string& command, std::string_view inputs, const ToolLimits& limits);

}  // namespace tangency::inline v0::verify
