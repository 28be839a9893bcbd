// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/geometry/tool/output_file.hpp>
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

int complain(const std::string& message) {
  std::cerr << message << std::endl;
  return refused;
}

// Help and the version go to standard output; whatever else stops the parsing is a refusal.
int exit_after(const CLI::App& program, const CLI::ParseError& stop) {
  if (stop.get_exit_code() == 0) {
    std::ostringstream text;
    program.exit(stop, text);
    csv::OutputFile("-").write(text.str());
    return passed;
  }
  std::string name = "tangency-verify";
  for (const CLI::App* chosen : program.get_subcommands()) name += ' ' + chosen->get_name();
  return complain(name + ": " + stop.what() + " (`" + name + " --help` says what is allowed)");
}

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
    return exit_after(program, stop);
  }
  return refused;
}

}  // namespace
}  // namespace tangency::verify

int main(int argc, char** argv) {
  // A reader that has gone is then an error of write(2), which csv::OutputFile reports.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return tangency::verify::run(argc, argv);
  } catch (const std::bad_alloc&) {
    return tangency::verify::complain("tangency-verify: out of memory");
  } catch (const std::exception& error) {
    return tangency::verify::complain(error.what());
  }
}
