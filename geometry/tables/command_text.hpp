// SPDX-License-Identifier: MIT
/// @file
/// What a program says of its own command line, in the forms that are installed beside it. All of
/// them are made of the options that it parses, as its help is.
///
/// (1) Manual page and completions name every subcommand and option that the help names, and no
///     other.
#pragma once

#include <string>
#include <vector>

namespace tangency::inline v0::tables {

/// An option, or an argument by its place.
struct OptionText {
  std::vector<std::string> names;  ///< "-h", "--help"; "FILE" for an argument by its place
  /// What the help calls its value: "N", its words "half|full", "FILE" or "DIR"; empty for a flag.
  std::string value;
  std::string help;
};

struct CommandText {
  std::string name, description, footer;
  std::vector<OptionText> options, arguments;
  std::vector<CommandText> subcommands;
};

/// For man(1), section 1.
/// @param version  what stands at the foot of the page behind the program's name
std::string manual_page(const CommandText& program, const std::string& version);

/// For bash: names of subcommands, options, and the words of a value "half|full"; else files.
std::string bash_completion(const CommandText& program);

/// For zsh, the same with each option's help; files for values FILE and DIR and arguments alone.
std::string zsh_completion(const CommandText& program);

}  // namespace tangency::inline v0::tables
