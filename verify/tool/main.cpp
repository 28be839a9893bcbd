// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include <tangency/verify/answers/corpus_source.hpp>
#include <tangency/verify/tool/command_line.hpp>
#include <tangency/version.hpp>

namespace tangency::inline v0::verify {
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

}  // namespace
}  // namespace tangency::inline v0::verify

int main(int argc, char** argv) {
  using namespace tangency::verify;
  tangency::tables::Program program(
      "tangency-verify", kProgramDescription,
      TANGENCY_VERSION_STRING ", corpora " + std::string(built_in_version()));
  program.footer(kProgramHelp);
#ifdef TANGENCY_HAS_ORACLES
  add_generate(program);
  add_hunt(program);
#endif
  add_grade(program);
  add_show(program);
  add_inputs(program);
  return program.run(argc, argv);
}
