// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include <vector>

#include <tangency/geometry/tool/command_line.hpp>
#include <tangency/geometry/tool/program.hpp>

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
    return exit_after(program, stop, argc, argv);
  }
  for (const Subcommand& subcommand : subcommands) {
    if (subcommand.app->parsed()) return subcommand.run();
  }
  return refused;
}

}  // namespace
}  // namespace tangency::tool

int main(int argc, char** argv) {
  return tangency::tool::guarded("tangency", [&] { return tangency::tool::run(argc, argv); });
}
