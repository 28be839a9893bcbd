// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/geometry/tool/command_line.hpp>
#include <tangency/geometry/tool/output_file.hpp>

namespace tangency::tool {
namespace {

constexpr const char* kProgramDescription =
    "tangency: how two ellipsoids touch, exactly.\n"
    "Reads a table of pairs, ellipses or quadrics (CSV), writes a table of answers.";

constexpr const char* kProgramHelp = R"(
Exit status:
  0  every row was answered
  1  some row has the status not_converged, not_applicable or invalid
  2  the command line or the input was refused, or reading or writing failed;
     one line on standard error says where, what and what is allowed

`tangency SUBCOMMAND --help` lists columns and statuses and gives an example.
)";

int complain(const std::string& message) {
  std::cerr << message << std::endl;
  return refused;
}

/// Help and the version go to standard output; whatever else stops the parsing is a refusal.
int exit_after(const CLI::App& program, const CLI::ParseError& stop) {
  if (stop.get_exit_code() == 0) {
    std::ostringstream text;
    program.exit(stop, text);
    csv::OutputFile output("-");
    output.write(text.str());
    return every_row_answered;
  }
  std::string name = "tangency";
  for (const CLI::App* chosen : program.get_subcommands()) name += ' ' + chosen->get_name();
  return complain(name + ": " + stop.what() + " (`" + name + " --help` says what is allowed)");
}

int run(int argc, char** argv) {
  CLI::App program(kProgramDescription, "tangency");
  program.set_version_flag("--version", "tangency " TANGENCY_VERSION);
  program.footer(kProgramHelp);
  program.require_subcommand(1);
  const std::vector<Subcommand> subcommands{add_contact(program), add_overlap(program),
                                            add_classify(program), add_ellipse(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    return exit_after(program, stop);
  }
  for (const Subcommand& subcommand : subcommands) {
    if (subcommand.app->parsed()) return subcommand.run();
  }
  return refused;
}

}  // namespace
}  // namespace tangency::tool

int main(int argc, char** argv) {
  // A reader that has gone is then an error of write(2), which csv::OutputFile reports.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return tangency::tool::run(argc, argv);
  } catch (const std::bad_alloc&) {
    return tangency::tool::complain("tangency: out of memory");
  } catch (const std::exception& error) {
    return tangency::tool::complain(error.what());
  }
}
