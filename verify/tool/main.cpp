// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include <vector>

#include <tangency/geometry/tool/program.hpp>
#include <tangency/verify/tool/command_line.hpp>

namespace tangency::verify {
namespace {

constexpr const char* kProgramDescription =
    "tangency-verify: golden corpora of ellipsoids, ellipses and quadrics, and a grade for any\n"
    "program that answers them.";

constexpr const char* kProgramHelp = R"(
Exit status:
  0  done; every threshold is kept and no answer is missing
  1  a threshold is passed, answers are missing, or the tool died, hung or printed rubbish
  2  the command line or a file was refused, or writing failed;
     one line on standard error says where, what and what is allowed

`tangency-verify SUBCOMMAND --help` gives an example.
)";

int run(int argc, char** argv) {
  CLI::App program(kProgramDescription, "tangency-verify");
  program.set_version_flag("--version", "tangency-verify " TANGENCY_VERSION);
  program.footer(kProgramHelp);
  program.require_subcommand(1);
  const std::vector<Subcommand> subcommands{add_generate(program), add_grade(program)};
  try {
    program.parse(argc, argv);
    for (const Subcommand& subcommand : subcommands) {
      if (subcommand.app->parsed()) return subcommand.run();
    }
  } catch (const CLI::ParseError& stop) {
    return tool::exit_after(program, stop, argc, argv);
  }
  return refused;
}

}  // namespace
}  // namespace tangency::verify

int main(int argc, char** argv) {
  return tangency::tool::guarded("tangency-verify",
                                 [&] { return tangency::verify::run(argc, argv); });
}
