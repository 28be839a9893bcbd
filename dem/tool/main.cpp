// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include <tangency/dem/micromechanics/averages.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/scene/scene_keys.hpp>
#include <tangency/dem/tool/check_command.hpp>
#include <tangency/dem/tool/contact_tables.hpp>
#include <tangency/dem/tool/exchange_commands.hpp>
#include <tangency/dem/tool/micro.hpp>
#include <tangency/dem/tool/micro_help.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/dem/tool/report.hpp>
#include <tangency/dem/tool/run.hpp>
#include <tangency/dem/tool/schema.hpp>
#include <tangency/dem/tool/strain_report.hpp>
#include <tangency/dem/tool/sweep.hpp>
#include <tangency/dem/tool/table_help.hpp>
#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/version.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgramDescription =
    "tangency-dem: assemblies of ellipsoids by the discrete element method";

constexpr const char* kProgramHelp = R"(
`tangency-dem run --help` lists what a run writes and how to stop and resume it;
`tangency-dem check --help` says what of a scene is looked at before it runs;
`tangency-dem report --help` says what a report of it shows;
`tangency-dem schema` lists every key of a scene;
`tangency-dem contacts --help` and `tangency-dem particles --help` list the columns of the tables
that these make of a state;
`tangency-dem export --help` and `tangency-dem import --help` say how LAMMPS, GSD and extended XYZ
give sizes and quaternions;
`tangency-dem micro --help` says what it tells of forces and directions, and the columns of
micro.csv.
)";

constexpr const char* kRunHelp = R"(
DIR receives:
  history.csv        a row every history_interval cycles, or history_strain, and at the end of each
                     stage, where a stage that ends at once has strains of 0; first one of the
                     start, or of the state itself where a run that is over is resumed in another
                     DIR
  summary.json       of a complete run: the values of its last row, and the keys below
  final.state        of a complete run: where another scene of the same particles goes on; a
                     second name of checkpoint.state where the file system has hard links
  checkpoint.state   every checkpoint_interval cycles, every minute or
                     checkpoint_seconds, and at the run's end, whichever it is
  frames.pvd, frames/CYCLE.vtp   particles for ParaView
  frames.xyz         the same for OVITO, extended XYZ; frames.xyz.part while the run lasts;
                     with frame_interval = 0 there are no frames
  contacts.pvd, chains.pvd, frames/CYCLE.contacts.vtp, frames/CYCLE.chains.vtp
                     with contact_frames: contacts for ParaView, as points with their forces, and
                     as lines between centres
  frames/CYCLE.bonds the same for OVITO: a dump of LAMMPS' style local for its modifier Load
                     Trajectory; id1, id2 are the columns Particle Identifiers, px, py, pz Periodic
                     Image
  micro.csv          with a micro_interval: fabric, forces and stress, a row every so many cycles
                     and at the end of each stage; columns: tangency-dem micro --help
  contacts/CYCLE.csv where there is a contact_interval: every so many cycles, at the start and at
                     the end of each stage a table as `tangency-dem contacts` makes of a state
  states/            states that stages keep, each to be resumed from like final.state:
    NAME.state         of the end of stage NAME, with save = true
    NAME-0.05.state    where the axial strain is first 0.05, with save_strains = [0.05]; the number
                       is the shortest that reads back to the same double
    NAME-A.state to NAME-D.state   at four points of a shear, with save_points = true: A its start;
                       B where yielding begins: the stress ratio a_s (over axial strain, slopes
                       within 0.002) rises at most 0.2 times as fast as where it is steepest; C at
                       the peak friction angle, as below; D where the volume begins to stay
                       constant: after C it changes by less than 0.02 per axial strain within
                       0.05, else the last row. B, C and D are rows of history.csv, so that
                       history_interval, or history_strain, bounds how well they are known. At the
                       stage's end its cycles up to the last of them are run once more, which takes
                       their time;
                       a stage that does not reach its end has A alone

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
                        contacts, over the mean contact force; 0 where no contact bears one
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
  elongation eccentricity
                        a / b and (a - b) / (a + b) of the scene's first type of particles, now
  packing_density       1 - porosity
  void_ratio            porosity / packing_density
  contact_density       1/m^3, 2 contacts / cell volume; with dimensions = 2 1/m^2
  overlap_fraction      mean_overlap over twice the mean of the mean radii
  asymmetry             |s - s'| / mean stress of the stress before it is made symmetric, by
                        moments out of balance; 0 without stress
  boundary_s_xx boundary_s_yy boundary_s_zz boundary_s_xy boundary_s_yz boundary_s_zx
                        Pa, from the forces on the walls and through the periodic faces: the
                        stress, but for what particles out of balance, or weights, make of it
  viscous_loss          J since the start: lost at contacts with a restitution below 1
  p q                   Pa: the mean stress again, and the deviator sqrt(3/2 s':s') of the stress
                        less its mean, s1 - s3 in a triaxial test; with dimensions = 2
                        (s1 - s2) / 2
  mechanical_coordination
                        mean number of contacts of the particles that have two or more, under
                        gravity one or more
  shear_strain_xy shear_strain_yz shear_strain_zx
                        in a simple shear how far layers have moved over how high they lie; else the
                        sum of the tangents by which lines along the two axes lean; of the sign
                        of s_xy, s_yz, s_zx

A scene with a [sweep] has a run for each combination of its values, in DIR/KEY=VALUE_KEY=VALUE:
  scene.toml         in each folder: the whole scene of that run
  sweep.csv          in DIR: a row a run: folder, exit status, the values of [sweep], and the numbers
                     of summary.json
What is complete is not run again, and what was stopped goes on from its checkpoint. With `after`
DIR/NAME has the one run of the stages up to that of this name, from whose end all go on. A folder of
another scene is refused; --replace takes its results away. Exit status: that of the worst run.

More keys of summary.json:
  set                   with --set or [sweep]: keys and the values that they were set to
  units                 with [units]: names of length, stress, time, force and energy
  particles, cycles, threads
  wall_seconds          of this process: what ran before a resumption is not in it
  ns_per_listed_pair_per_cycle, listed_pairs
                        an entry of the neighbour list, each pair once
  state_hash            of final.state; the same at every number of threads, and with
                        --reproducible on every x86-64 processor
  instruction_set, reproducible
                        that of the processor's which the run used, on which last bits depend;
                        and whether --reproducible was given
  verified              with --verify: what was checked in this process, and what was found
  profile               with --profile: seconds of each phase, counts of pairs a cycle, builds
                        of the neighbour list, and the most memory the run has had, bytes
  unanswered_contacts   with contacts = "trace": of final.state, those that the published scheme
                        does not answer, and for which the certified answer is taken
  rattlers              particles with fewer than two contacts; under gravity with none
  peak_friction_angle_deg, strain_at_peak_friction
                        of the last stage of kind shear: the largest mean over rows within
                        0.01 of axial strain, at least three, and their mean axial strain
  peak_dilation_rate, strain_at_peak_dilation
                        of that stage: largest slope of volumetric over axial strain, by least
                        squares over such rows
  relaxation_share      of the last stage of kind grow: the share of its cycles in which no
                        increment was made
  strain_at_A, strain_at_B, strain_at_C, strain_at_D, D_is_last_row
                        of the last stage with save_points: axial strains of its states, and
                        whether D is the last row for want of a constant volume
  largest_unbalanced_ratio, largest_unbalanced_moment_ratio
                        of any particle that has contacts: unbalanced force, and moment over
                        its largest semi-axis, over the mean contact force

Stop and resume: HUP, INT (Ctrl-C) and TERM end a run after its cycle, with history, frames
and checkpoint.state. With --resume it goes on bit for bit as if it had not been stopped; in
the same DIR history, frames, contacts/ and states/ are carried on, and what is there of later
cycles is taken away. The scene must have the same particles;
stages may be added after those that the state has passed, and contact laws may differ,
which is said. A DIR with the results of another run is refused; --replace takes them away.

Exit status:
  0          the run is complete
  1          a stage did not reach its criterion within max_cycles, the cell became too thin for
             its particles, or the run blew up
  2          the scene, the state or the command line was refused, and earlier results are
             untouched; or a file could not be written
  3          --verify found a fault: fault.state is the state, what was saved before stays
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
the account of energy against time; the numbers of summary.json; and the sample in space, of the
frames that are there (24 MB of them at most, evenly spread): drag to turn it, click on a particle
for its values, colour it by any column, draw force chains, cut it, play its frames.

Exit status:
  0    done
  2    DIR is not one of a run that has written its history, or report.html cannot be written
)";

/// DIR where none is given: the scene's name without its ending, in the working directory.
fs::path default_directory(const fs::path& scene) { return scene.stem().string() + "-out"; }

void add_run(tables::Program& program) {
  struct Words {
    RunOptions options;
    std::string scene, out, resume;
  };
  const auto words = std::make_shared<Words>();
  tables::Command& command = program.subcommand("run", "Run a scene");
  command.option("SCENE", words->scene, "Scene in TOML; its keys: tangency-dem schema").required();
  command.option("--out", words->out, "Directory for the results [SCENE's name + -out]")
      .type_name("DIR")
      .not_empty();
  command.option("--threads", words->options.threads, "Number of threads [all]").between(1, 1024);
  command.option("--set", words->options.settings, kSetHelp).type_name("KEY=VALUE");
  command.option("--resume", words->resume, "Continue from a final.state or checkpoint.state")
      .type_name("FILE")
      .not_empty();
  command.flag("--replace", words->options.replace,
               "Take away the results of another run in the directory");
  command.flag("--profile", words->options.profile,
               "Print the time of the cycles by phase after the run");
  command.flag("--reproducible", words->options.reproducible,
               "Compute without fused multiply-adds: one state_hash on every x86-64 processor");
  command.flag("--verify", words->options.verify,
               "Check every cycle: contacts exactly, neighbours, energy, history; a fault ends it");
  command.footer(kRunHelp);
  command.flag("--quiet", words->options.quiet, "No progress, no advice before the run");
  command.runs([words] {
    RunOptions& options = words->options;
    options.scene = words->scene;
    options.out = words->out.empty() ? default_directory(words->scene) : fs::path(words->out);
    if (!words->resume.empty()) options.resume = words->resume;
    catch_interrupts();
    const SceneFile file = scene_file_of(options);
    return file.sweep() ? sweep(options, file) : run(options, file);
  });
}

void add_report(tables::Program& program) {
  const auto directory = std::make_shared<std::string>();
  tables::Command& command = program.subcommand("report", "Tables and charts of a run");
  command.option("DIR", *directory, "Directory of a run's results").required();
  command.footer(kReportHelp);
  command.runs([directory] { return report(*directory); });
}

/// N of --classes, which has another meaning and default in each partition.
micromechanics::Classes classes_of(const std::string& partition, int count, bool is_given) {
  const auto kind = partition_named(partition);
  if (!is_given) return {kind, micromechanics::Classes::usual_count(kind)};
  if (const int fewest = micromechanics::Classes::fewest(kind); count < fewest)
    throw tables::UsageError("--classes " + std::to_string(count) + ": with --partition " +
                             partition + " from " + std::to_string(fewest) + " to " +
                             std::to_string(micromechanics::Classes::kMost));
  return {kind, count};
}

/// Of a text that is no number the option itself says so.
std::string refused_friction(const std::string& text) {
  char* end = nullptr;
  const double friction = std::strtod(text.c_str(), &end);
  const bool is_number = end != text.c_str() && *end == '\0';
  return is_number && std::isfinite(friction) && friction >= 0.0
             ? ""
             : text + ": a finite number from 0";
}

void add_friction(tables::Command& command, StateFriction& friction) {
  const tables::Option scene =
      command
          .option("--scene", friction.scene,
                  "Scene of the run, whose stages tell the friction [that of its contacts]")
          .type_name("FILE")
          .not_empty();
  command.option("--friction", friction.given, "Or the friction_coefficient itself")
      .type_name("MU")
      .check(refused_friction)
      .excludes(scene);
  command.option("--set", friction.settings, "What the run had of that scene otherwise, as run's")
      .type_name("KEY=VALUE");
}

void add_micro(tables::Program& program) {
  struct Words {
    MicroOptions options;
    std::string partition = "near-uniform";
    int count = 0;
  };
  const auto words = std::make_shared<Words>();
  tables::Command& command =
      program.subcommand("micro", "Micromechanics of a state: fabric, forces and their stress");
  command.option("STATE", words->options.state, "A .state file of a run").required();
  command.option("--partition", words->partition, "Classes of directions")
      .one_of({"near-uniform", "polar"})
      .shows_default();
  const tables::Option count =
      command.option("--classes", words->count, "N of the partition [4; polar 18]")
          .between(1, micromechanics::Classes::kMost);
  add_friction(command, words->options.friction);
  command
      .option("--since", words->options.since,
              "An older state of the same run: strain since then, too")
      .type_name("FILE")
      .not_empty();
  command.option("--json", words->options.json, "All numbers as JSON; - to standard output")
      .type_name("FILE")
      .not_empty();
  command
      .option("--histogram", words->options.histogram,
              "A row a class of directions as CSV; - to standard output")
      .type_name("FILE")
      .not_empty();
  command.footer(std::string(kMicroHelp) + kStrainHelp);
  command.runs([words, count] {
    words->options.classes = classes_of(words->partition, words->count, count.given());
    return micro(words->options);
  });
}

/// A command that writes a table of a state.
tables::Command& add_table(tables::Program& program, const char* name, const char* what,
                           const char* help,
                           std::function<std::string(const State&, const std::string&)> table) {
  struct Words {
    std::string state, out;
  };
  const auto words = std::make_shared<Words>();
  tables::Command& command = program.subcommand(name, what);
  command.option("STATE", words->state, "State of a run").required();
  command.option("--out", words->out, "File for the table [standard output]")
      .type_name("FILE")
      .not_empty();
  command.footer(help);
  command.runs([words, table = std::move(table)] {
    const std::string text = table(load_state(words->state), words->state);
    tables::OutputFile out(words->out.empty() ? "-" : words->out);
    out.write(text);
    out.commit();
    return success;
  });
  return command;
}

void add_tables(tables::Program& program) {
  const auto friction = std::make_shared<StateFriction>();
  add_friction(add_table(program, "contacts", "Table of a state's contacts", kContactsHelp,
                         [friction](const State& state, const std::string& file) {
                           return contact_table(state, laws_of(state, file, *friction));
                         }),
               *friction);
  add_table(program, "particles", "Table of a state's particles", kParticlesHelp,
            [](const State& state, const std::string&) { return particle_table(state); });
}

void add_schema(tables::Program& program) {
  struct Words {
    bool json = false, markdown = false;
  };
  const auto words = std::make_shared<Words>();
  tables::Command& command = program.subcommand("schema", "Print every key of a scene");
  const tables::Option json = command.flag("--json", words->json, "As JSON");
  command.flag("--markdown", words->markdown, "As a page of Markdown").excludes(json);
  command.footer(kSchemaHelp);
  command.runs([words] {
    std::ostringstream text;
    if (words->json)
      text << schema_json();
    else if (words->markdown)
      text << schema_markdown();
    else
      print_schema(text);
    tables::OutputFile("-").write(text.str());
    return success;
  });
}

}  // namespace
}  // namespace tangency::inline v0::dem

int main(int argc, char** argv) {
  using namespace tangency::dem;
  tangency::tables::Program program("tangency-dem", kProgramDescription, tangency::version());
  program.footer(kProgramHelp);
  add_run(program);
  add_check(program);
  add_report(program);
  add_tables(program);
  add_export(program);
  add_import(program);
  add_micro(program);
  add_schema(program);
  return program.run(argc, argv);
}
