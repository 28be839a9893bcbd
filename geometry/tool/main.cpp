// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/command_line.hpp>
#include <tangency/version.hpp>

namespace tangency::inline v0::tool {
namespace {

constexpr const char* kProgramDescription =
    "tangency: how ellipsoids touch each other, points, walls and rays, exactly.\n"
    "Reads a table of questions (CSV), writes a table of answers.";

constexpr const char* kProgramHelp = R"(
Exit status:
  0  every row was answered
  1  some row has the status not_converged, not_applicable or invalid
  2  the command line or the input was refused, or reading or writing failed;
     one line on standard error says where, what and what is allowed

`tangency SUBCOMMAND --help` lists columns and statuses and gives an example.
)";

}  // namespace
}  // namespace tangency::inline v0::tool

int main(int argc, char** argv) {
  using namespace tangency::tool;
  tangency::tables::Program program("tangency", kProgramDescription, tangency::version());
  program.footer(kProgramHelp);
  add_contact(program);
  add_overlap(program);
  add_classify(program);
  add_ellipse(program);
  add_point(program);
  add_ellipse_point(program);
  add_wall(program);
  add_ray(program);
  add_time(program);
  add_neighbours(program);
  return program.run(argc, argv);
}
