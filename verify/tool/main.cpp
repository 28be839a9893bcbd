// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include <tangency/verify/answers/corpus_source.hpp>
#include <tangency/verify/tool/command_line.hpp>
#include <tangency/version.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr const char* kProgramDescription =
    "tangency-verify: golden corpora of ellipsoids, ellipses, quadrics and what else is asked of\n"
    "them, and a grade for any program that answers.";

constexpr const char* kProgramHelp = R"(
Exit status:
  0  done; of grade: every threshold is kept and no answer is wrong or missing; of hunt:
     nothing was found
  1  of grade: a threshold is passed, answers are wrong or missing, or the tool died, hung or
     printed rubbish; of hunt: an answer that is wrong was found
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
