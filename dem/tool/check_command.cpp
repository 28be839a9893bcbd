// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/check_command.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/tool/check.hpp>
#include <tangency/dem/tool/run.hpp>
#include <tangency/geometry/tables/output_file.hpp>

namespace tangency::inline v0::dem {
namespace {

constexpr const char* kCheckHelp = R"(
Places the particles, runs nothing, and tells of each stage:
  cycles at least  those that its duration, axial strain, increments or the way to a packing need,
                   and the key that needs them
  time step        s
  steps a contact  time steps of the shortest impact
  stress           Pa, held in the stage or before it, or of the weight at the bottom
  inertial number  rate d sqrt(density / stress) of the given strain rates; marked
                   (servo) where there are none, and it is that of max_strain_rate
  overlap          mean overlap over mean radius under that stress, of equal spheres packed at random
  cell / least     least period of the cell at the stage's end over the least that its particles need
Advice names keys by their path, as --set takes them, and values with which it is gone:
  cycles                 more than max_cycles; a softer contact where the overlap is below 0.001
  inertial_number        above 0.001: stresses depend on the rate
  servo_inertial_number  above 0.1 in a stage that ends at its stress, in balance or not
  overlap, impact        more than 0.1 of the mean radius under the stress, or where bodies meet at
                         the speed that they start with
  largest_overlap        of a Hertz law, less than half of that
  time_step              restitution without damping, and fewer than 11 steps a contact
  cell                   the run would end for a cell that is too thin
  gravity                along an axis without walls
  memory                 more than 0.8 of this machine's
  servo_gain             of a stage whose contacts have a restitution: so large that the servo rings;
                         of a simple shear above 0.005 that is meant: more than 0.1
What is meant as it is, a scene or a stage names in a list: intended = ["inertial_number"]. Then
neither check nor a run speaks of it; cycles, cell, memory and servo_gain cannot be meant.
Walls that go 0.1 of the smallest semi-axis in a time step are refused, by check and by run. With
--json: scene, particles, memory_bytes, stages (each with stage, time_step, steps_a_contact,
cycles_at_least, cycles_key, max_cycles, stress, inertial_number, servo_inertial_number, overlap,
cell_over_least; null for none), advice (each with stage, about, reason, changes: a list of key,
from, to). Of a [sweep] each combination is checked; what is printed is that of the first with
advice, or of the first. A run says its advice before it begins, without
--quiet. How to choose: docs/choosing.md.

Exit status:
  0    nothing to change
  1    advice was given
  2    the scene or the command line was refused
)";

/// A scene, or one combination of its sweep.
struct Checked {
  std::string text, json;
  bool has_advice;
};

Checked checked(const RunOptions& options, const SceneFile& file) {
  const Simulation simulation = simulation_of(options, file);
  const SceneCheck seen = check_of(simulation);
  return {text_of(seen, simulation), json_of(seen, simulation, options.scene.string()),
          !seen.advice.empty()};
}

SceneFile with(const RunOptions& options, const Sweep& sweep, std::size_t combination) {
  SceneFile file = scene_file_of(options);
  const std::vector<Setting> settings = sweep.combination(combination);
  for (std::size_t k = 0; k < settings.size(); ++k)
    file.set(settings[k], sweep.axes[k].file, sweep.axes[k].line);
  return file;
}

std::string name_of(const std::vector<Setting>& settings) {
  std::string name;
  for (const auto& [keys, value] : settings)
    name += (name.empty() ? "" : ", ") + keys + " = " + value;
  return name;
}

int check(const RunOptions& options, bool as_json) {
  const SceneFile file = scene_file_of(options);
  const auto sweep = file.sweep();
  std::string which;
  Checked shown{};
  for (std::size_t k = 0; k < (sweep ? sweep->combinations() : 1) && !shown.has_advice; ++k) {
    Checked one = sweep ? checked(options, with(options, *sweep, k)) : checked(options, file);
    if (k > 0 && !one.has_advice) continue;
    if (sweep) which = "with " + name_of(sweep->combination(k)) + '\n';
    shown = std::move(one);
  }
  tables::OutputFile("-").write(as_json ? shown.json : which + shown.text);
  return shown.has_advice ? not_reached : success;
}

}  // namespace

void add_check(tables::Program& program) {
  struct Words {
    RunOptions options;
    std::string scene;
    bool json = false;
  };
  const auto words = std::make_shared<Words>();
  tables::Command& command =
      program.subcommand("check", "What to change in a scene before it runs");
  command.option("SCENE", words->scene, "Scene in TOML; its keys: tangency-dem schema").required();
  command.option("--set", words->options.settings, kSetHelp).type_name("KEY=VALUE");
  command.flag("--json", words->json, "As JSON");
  command.footer(kCheckHelp);
  command.runs([words] {
    words->options.scene = words->scene;
    return check(words->options, words->json);
  });
}

}  // namespace tangency::inline v0::dem
