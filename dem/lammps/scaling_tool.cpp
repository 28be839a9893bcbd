// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// tangency-lammps-scaling: the table of scaling.hpp.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/dem/lammps/scaling.hpp>
#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/output_file.hpp>

namespace tangency::inline v0::lammps {
namespace {

constexpr const char* kHelp = R"(
Prints how long a step is expected to take, and how much of it is work on particles, by a model whose
constants are options: what an earlier trial measured on one machine, or assumed of a cluster. A CSV
table, a row each number of particles and of ranks:
  particles, ranks
  own             particles a rank
  ghosts_per_own  copies of other ranks' particles, relative to them
  step_ms         milliseconds a step
  efficiency      own work over all of it
  memory_MB       a rank, ghosts included
  bounded_by      the largest part of the rest
  test_days       a quasi-static test: its steps grow as particles^(1/3), since waves have to cross
                  the box, from --steps of 1,000 particles
Not in it: noise of the system, the memory bandwidth of full nodes, output. What breaks before the
step does is told in docs/lammps-fixes.md. Measure your own machine: run 64,000 particles on one rank
and on two, take own and ghost from the Pair, Modify and Neigh times that LAMMPS prints.

Exit status:
  0    done
  2    the command line is refused, or standard output cannot be written
)";

constexpr double kSecondsOfADay = 86400.0;

std::string refusal_of_not_above_zero(const std::string& text) {
  double value = 0.0;
  return !tables::parse_number(text, value) && value > 0.0 ? "" : "must be a finite number > 0";
}

/// A list of numbers such as 1e6,1e8. @throws tables::UsageError
std::vector<double> numbers(const std::string& option, const std::string& text) {
  std::vector<double> found;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    double value = 0.0;
    if (tables::parse_number(std::string_view(text).substr(at, end - at), value) || value < 1.0)
      throw tables::UsageError(option + " = " + text + ": numbers >= 1 with commas between them");
    found.push_back(value);
    at = end + 1;
  }
  return found;
}

std::string row_text(const ScalingModel& model, double particles, double ranks, double steps) {
  const ScalingRow row = scaled(model, particles, ranks);
  const double days = row.step * steps * std::cbrt(particles / 1000.0) / kSecondsOfADay;
  char text[256];
  std::snprintf(text, sizeof text, "%.0f,%.0f,%.0f,%.2f,%.3g,%.2f,%.3g,%s,%.3g\n", particles, ranks,
                row.own_per_rank, row.ghosts_per_own, 1e3 * row.step, row.efficiency,
                1e-6 * row.bytes_per_rank, row.bounded_by, days);
  return text;
}

struct Constant {
  const char* option;
  double ScalingModel::*value;
  const char* help;
};

constexpr Constant kConstants[] = {
    {"--own", &ScalingModel::own, "Seconds an own particle and step"},
    {"--ghost", &ScalingModel::ghost, "Seconds the body of a ghost and step"},
    {"--halo", &ScalingModel::halo, "Both sides of a halo, in mean distances of particles"},
    {"--ghost-bytes", &ScalingModel::ghost_bytes, "Bytes sent a ghost and step"},
    {"--node-ranks", &ScalingModel::node_ranks, "Ranks a node"},
    {"--leaving", &ScalingModel::leaving, "Share of the halos that leaves a node"},
    {"--node-bandwidth", &ScalingModel::node_bandwidth, "Bytes a second of a node's wire"},
    {"--copy-bandwidth", &ScalingModel::copy_bandwidth, "Bytes a second of a rank's copies"},
    {"--copies", &ScalingModel::copies, "Times that a byte of a halo is copied"},
    {"--latency", &ScalingModel::latency, "Seconds a message, and a level of a sum over ranks"},
    {"--messages", &ScalingModel::messages, "Messages a step"},
    {"--variation", &ScalingModel::variation, "Of the work of a particle, relative"},
    {"--bytes", &ScalingModel::bytes, "Bytes of memory a particle"},
};

/// @throws tables::UsageError
int print_table(const ScalingModel& model, const std::string& particles, const std::string& ranks,
                double steps) {
  std::string text =
      "particles,ranks,own,ghosts_per_own,step_ms,efficiency,memory_MB,bounded_by,test_days\n";
  const std::vector<double> all_ranks = numbers("--ranks", ranks);
  for (const double n : numbers("--particles", particles))
    for (const double r : all_ranks)
      if (r <= n) text += row_text(model, n, r, steps);
  tables::OutputFile out("-");
  out.write(text);
  out.commit();
  return 0;
}

}  // namespace
}  // namespace tangency::inline v0::lammps

int main(int argc, char** argv) {
  using namespace tangency::lammps;
  ScalingModel model;
  std::string particles = "1e6,1e8,1e9", ranks = "1e3,1e4,1e5";
  double steps = 1e5;
  tangency::tables::Program program("tangency-lammps-scaling",
                                    "What a step of tangency-lammps costs on many ranks");
  program.option("--particles", particles, "Numbers of particles").shows_default();
  program.option("--ranks", ranks, "Numbers of ranks").shows_default();
  program.option("--steps", steps, "Steps of a test of 1,000 particles")
      .check(&refusal_of_not_above_zero)
      .shows_default();
  for (const Constant& constant : kConstants)
    program.option(constant.option, model.*constant.value, constant.help)
        .check(&refusal_of_not_above_zero)
        .shows_default();
  program.footer(kHelp);
  program.runs([&] { return print_table(model, particles, ranks, steps); });
  return program.run(argc, argv);
}
