// SPDX-License-Identifier: GPL-3.0-or-later
// Does the peak friction angle of a shear test depend on how it is computed? A longer check:
//
//     shear_study dem/scenes/growth-1000.toml [--growth-alone]
//
// makes the scene's sample and shears it again and again with one thing changed. Exit status 1
// where the sample is not the published one (coordination above 10 at e = 0.05, 12 to 12.7 at the
// end, no crystal) or a halved step, rate or tolerance moves the peak by 0.5 degrees or more.
// Five minutes on one core.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iomanip>
#include <iostream>
#include <string>

#include <tangency/dem/simulation.hpp>
#include <tangency/geometry/tables/command_line.hpp>

namespace {

using namespace tangency::dem;

constexpr double kMostShift = 0.5;  // degrees

struct Peak {
  double angle = 0.0, strain = 0.0;
  double largest_inertial = 0.0;
  double largest_step_ratio = 0.0;
  double energy_error = 0.0;  // of the boundary work
  std::int64_t cycles = 0;
};

bool run_stage(Simulation& simulation, const std::function<void()>& look) {
  while (simulation.status() == StageStatus::running) {
    simulation.step();
    look();
  }
  if (simulation.status() == StageStatus::done) return true;
  std::cout << "stage " << simulation.stage().name << " did not reach its end\n";
  return false;
}

/// The rest of a scene from a state, and the peak of its last stage.
Peak shear(const Scene& scene, const State& from) {
  Simulation simulation(scene, from);
  while (simulation.state().stage + 1 < scene.stages.size()) {
    if (!run_stage(simulation, [] {})) return {};
    simulation.next_stage();
  }
  Peak peak;
  run_stage(simulation, [&] {
    if (simulation.state().stage_cycle % 20 != 0) return;
    const Observation seen = simulation.observe();
    const double angle = friction_angle_deg(seen.stress.tensor);
    if (angle > peak.angle) {
      peak.angle = angle;
      peak.strain = seen.axial_strain;
    }
    peak.largest_inertial = std::max(peak.largest_inertial, seen.balance.inertial_fraction);
    peak.largest_step_ratio = std::max(peak.largest_step_ratio, simulation.time_step_ratio());
    peak.energy_error = seen.energy_error / seen.account.boundary;
  });
  peak.cycles = simulation.state().stage_cycle;
  return peak;
}

void print(const std::string& name, const Peak& peak) {
  std::cout << std::left << std::setw(28) << name << std::right << std::fixed
            << std::setprecision(3) << std::setw(9) << peak.angle << std::setw(8) << peak.strain
            << std::setw(9) << peak.cycles << std::setprecision(4) << std::setw(10)
            << peak.largest_inertial << std::setprecision(2) << std::setw(8)
            << peak.largest_step_ratio << std::scientific << std::setw(11) << peak.energy_error
            << std::defaultfloat << std::endl;
}

bool study(const std::string& path, bool growth_alone) {
  bool sound = true;
  const auto expect = [&](bool holds, const std::string& what) {
    if (!holds) std::cout << "NOT SO: " << what << std::endl;
    sound = sound && holds;
  };
  const Scene scene = load_scene(path);
  Simulation simulation(scene);
  double early_coordination = 0.0;
  while (simulation.state().stage + 2 < scene.stages.size()) {
    run_stage(simulation, [&] {
      const auto& axes = simulation.state().particles.semi_axes.front();
      if (axes[0] - axes[1] < 0.05 * (axes[0] + axes[1])) return;
      if (early_coordination == 0.0) early_coordination = simulation.observe().coordination_number;
    });
    simulation.next_stage();
  }
  const State grown = simulation.state();
  const Observation seen = simulation.observe();
  std::cout << "coordination " << early_coordination << " at e = 0.05, " << seen.coordination_number
            << " at the end of the growth, deviation " << seen.coordination_std << ", porosity "
            << seen.porosity << ", mean normal force " << seen.mean_normal_force << "\n\n";
  expect(early_coordination > 10.0, "coordination above 10 at e = 0.05");
  expect(seen.coordination_number > 12.0 && seen.coordination_number < 12.7,
         "coordination of 12 to 12.7 at the end");
  expect(seen.coordination_std > 0.5, "no crystal");

  if (growth_alone) return sound;

  std::cout << "                             peak/deg  strain   cycles  inertial  step/critical  "
               "energy error / work\n";
  const Peak base = shear(scene, grown);
  print("as the scene says", base);
  const auto variant = [&](const std::string& name, bool must_agree, const auto& change) {
    Scene changed = scene;
    change(changed, *changed.stages.back().drive, *changed.stages[changed.stages.size() - 2].drive);
    const Peak peak = shear(changed, grown);
    print(name, peak);
    if (must_agree)
      expect(std::abs(peak.angle - base.angle) < kMostShift, name + " moves the peak too far");
  };
  variant("half the step", true, [](Scene&, Drive& shear, Drive&) { shear.time_step_factor /= 2; });
  variant("half the rate", true, [](Scene&, Drive& shear, Drive&) {
    shear.loading.strain_rate /= 2;
    shear.loading.servo.max_strain_rate /= 2;
  });
  variant("half the tolerance", true, [](Scene&, Drive&, Drive& relax) {
    *relax.stress_tolerance /= 2;
    *relax.max_unbalanced_ratio /= 2;
  });
  variant("simplified Euler equations", true,
          [](Scene& all, Drive&, Drive&) { all.rotation = Rotation::simplified; });
  // What the limits on the step are for.
  for (const double factor : {0.33, 0.36, 0.4, 0.45})
    variant("step " + std::to_string(factor).substr(0, 4) + " sqrt(m/K)", false,
            [&](Scene&, Drive& shear, Drive&) { shear.time_step_factor = factor; });
  return sound;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::tables::Program program("shear_study",
                                    "How a shear's peak depends on step, rate and equations");
  std::string scene;
  bool growth_alone = false;
  program
      .option("SCENE", scene,
              "Its stages before the last two make a sample, the last but one relaxes it and the "
              "last shears it")
      .required();
  program.flag("--growth-alone", growth_alone, "Ends with the sample");
  program.runs([&] { return study(scene, growth_alone) ? 0 : 1; });
  return program.run(argc, argv);
}
