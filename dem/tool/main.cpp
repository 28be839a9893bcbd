// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <system_error>

#include <tangency/dem/scene_keys.hpp>
#include <tangency/dem/tool/report.hpp>
#include <tangency/dem/tool/run.hpp>
#include <tangency/geometry/tables/not_empty.hpp>
#include <tangency/geometry/tool/program.hpp>

namespace {

using namespace tangency::dem;
using tangency::tool::exit_after;

constexpr const char* kProgramDescription =
    "tangency-dem: assemblies of ellipsoids by the discrete element method";

constexpr const char* kProgramHelp = R"(
`tangency-dem run --help` lists what a run writes and how to stop and resume it;
`tangency-dem report --help` says what a report of it shows;
`tangency-dem schema` lists every key of a scene.
)";

constexpr const char* kRunHelp = R"(
DIR receives:
  history.csv        a row every history_interval cycles and at the end of each stage, where a
                     stage that ends at once has strains of 0; first one of the start, or of the
                     state itself where a run that is over is resumed in another DIR
  summary.json       of a complete run: the values of its last row, and the keys below
  final.state        of a complete run: where another scene of the same particles goes on
  checkpoint.state   every checkpoint_interval cycles, every minute or
                     checkpoint_seconds, and at the run's end, whichever it is
  frames.pvd, frames/CYCLE.vtp   particles for ParaView
  frames.xyz         the same for OVITO, extended XYZ; frames.xyz.part while the run lasts

Columns of history.csv. Compression is positive in stress and axial strain; strains are
logarithmic and count from the start of the stage:
  cycle                 from 0
  time                  s
  stage                 its name
  axial_strain          along z; with dimensions = 2 along y
  volumetric_strain     dilation is positive
  mean_stress           Pa
  s_xx s_yy s_zz s_xy s_yz s_zx
                        stress, Pa
  friction_angle_deg    asin((s1 - s3) / (s1 + s3)) of the principal stresses, degrees
  coordination_number   2 contacts / particles, rattlers included
  coordination_std      standard deviation of a particle's number of contacts
  porosity              1 - particle volumes / cell volume; overlaps count twice
  contacts              number of touching pairs
  mean_normal_force     N, of a contact; a push is positive
  mean_overlap          m, of a contact
  inertial_fraction     mean unbalanced force (of contacts and weight) of a particle that has
                        contacts, over the mean contact force
  kinetic_energy        J, of the motion relative to the cell, half a step ago
  elastic_energy        J, stored by the contacts
  boundary_work gravity_work growth_work branch_work
                        J since the start: done on the assembly by the straining cell and its
                        walls, by gravity, by particles that change shape, and gained where a
                        contact went over to another normal
  sliding_loss damping_loss
                        J since the start: lost to friction and to damping
  energy_error          J: kinetic and elastic energy less what all these say it should be
  stage_cycle           cycles of the stage

More keys of summary.json:
  particles, cycles, threads
  wall_seconds          of this process: what ran before a resumption is not in it
  ns_per_listed_pair_per_cycle, listed_pairs
                        an entry of the neighbour list, each pair once
  state_hash            of final.state; the same at every number of threads
  rattlers              particles with fewer than two contacts; under gravity with none
  peak_friction_angle_deg, strain_at_peak_friction
                        of the last stage of kind shear: the largest mean over rows within
                        0.01 of axial strain, at least three, and their mean axial strain
  peak_dilation_rate, strain_at_peak_dilation
                        of that stage: largest slope of volumetric over axial strain, by least
                        squares over such rows
  largest_unbalanced_ratio, largest_unbalanced_moment_ratio
                        of any particle that has contacts: unbalanced force, and moment over
                        its largest semi-axis, over the mean contact force

Stop and resume: HUP, INT (Ctrl-C) and TERM end a run after its cycle, with history, frames
and checkpoint.state. With --resume it goes on bit for bit as if it had not been stopped; in
the same DIR history and frames are carried on. The scene must have the same particles;
stages may be added after those that the state has passed, and contact laws may differ,
which is said. A DIR with the results of another run is refused; --replace takes them away.

Exit status:
  0          the run is complete
  1          a stage did not reach its criterion within max_cycles, the cell became too thin for
             its particles, or the run blew up
  2          the scene, the state or the command line was refused, and earlier results are
             untouched; or a file could not be written
  128 + N    signal N stopped it: 129 HUP, 130 INT, 143 TERM
)";

constexpr const char* kReportHelp = R"(
DIR is that of a run, complete or not: its history.csv is read and, if it is there, summary.json.
Prints a line a stage with the values at its end (or at the last row so far):
  cycles, mean stress, friction angle, coordination number, porosity, inertial fraction, axial
  strain, and the energy error over the work done: energy_error / (|boundary_work| +
  |gravity_work| + |growth_work|), all since the run began; - without work
Writes DIR/report.html, one page that needs no network: for each stage in which the cell changes
its shape stresses, friction angle, volumetric strain and coordination against axial strain; for
the whole run, stages shaded, stress, coordination and porosity, strains, inertial fraction and
the account of energy against time; and the numbers of summary.json.

Exit status:
  0    done
  2    DIR is not one of a run that has written its history, or report.html cannot be written
)";

/// DIR where none is given: the scene's name without its ending, in the working directory.
std::filesystem::path default_directory(const std::filesystem::path& scene) {
  return scene.stem().string() + "-out";
}

/// Starts the program again with OpenMP's threads sleeping while they wait, unless the user chose:
/// libgomp reads the choice when it is loaded. A cycle is so short that threads which wait busily
/// on a machine with other work slow it by a factor of ten and more (measured: assembly-125 with 2
/// threads on 2 cores under load, 47 s against 3 s).
void let_idle_threads_sleep(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  std::error_code error;
  // Resolved: the process is called after the path that it was started by.
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) execv(program.c_str(), argv);  // returns only where it failed: then go on, slower
}

int parse_and_run(int argc, char** argv) {
  CLI::App app(kProgramDescription, "tangency-dem");
  app.set_version_flag("--version", "tangency-dem " TANGENCY_VERSION);
  app.footer(kProgramHelp);
  app.require_subcommand(1);

  RunOptions options;
  std::string scene, out, resume;
  CLI::App* run_command = app.add_subcommand("run", "Run a scene");
  run_command->add_option("SCENE", scene, "Scene in TOML; its keys: tangency-dem schema")
      ->required();
  run_command->add_option("--out", out, "Directory for the results [SCENE's name + -out]")
      ->check(tangency::tool::not_empty());
  run_command->add_option("--threads", options.threads, "Number of threads [all]")
      ->check(CLI::Range(1, 1024));
  run_command->add_option("--resume", resume, "Continue from a final.state or checkpoint.state")
      ->check(tangency::tool::not_empty());
  run_command->add_flag("--replace", options.replace,
                        "Take away the results of another run in the directory");
  run_command->footer(kRunHelp);
  run_command->add_flag("--quiet", options.quiet, "No progress");
  CLI::App* report_command = app.add_subcommand("report", "Tables and charts of a run");
  report_command->add_option("DIR", out, "Directory of a run's results")->required();
  report_command->footer(kReportHelp);
  CLI::App* schema_command = app.add_subcommand("schema", "Print every key of a scene");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    return exit_after(app, stop, argc, argv);
  }

  if (schema_command->parsed()) {
    std::ostringstream text;
    print_schema(text);
    tangency::csv::OutputFile("-").write(text.str());
    return success;
  }
  options.scene = scene;
  options.out = out.empty() ? default_directory(scene) : std::filesystem::path(out);
  if (!resume.empty()) options.resume = resume;
  return report_command->parsed() ? report(out) : run(options);
}

}  // namespace

int main(int argc, char** argv) {
  let_idle_threads_sleep(argv);
  return tangency::tool::guarded("tangency-dem", [&]() -> int {
    try {
      return parse_and_run(argc, argv);
    } catch (const std::filesystem::filesystem_error& error) {
      return tangency::tool::complain(std::string("tangency-dem: ") + error.what());
    }
  });
}
