// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene pays for: one dense assembly of 1000 particles, one cycle at a time, with features
// on and off, on one thread. Times are a cycle's; `per_pair` is a cycle's over the listed pairs.
//
//     bench_dem --benchmark_enable_random_interleaving=true
//
// Checks its answers first: spheres by their own formula bear what nearly round ellipsoids do by
// the general one, a frictionless scene is the same with turning left out, and every assembly bears
// its stress. Other sizes, two builds or LAMMPS beside ours: bench/dem_scenes/measure.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <tangency/dem/parallel.hpp>
#include <tangency/dem/simulation.hpp>

namespace {

using namespace tangency::dem;

struct Features {
  std::string name;
  double elongation = 1.4;
  double friction = 0.5;
  std::string more = "";  ///< tables of the scene
  std::string law = "normal_stiffness = 1.5e10\n";
  bool plane = false;
  double flatness = 1.0;
  bool grown = false;       ///< compacted as spheres: long bodies placed at random start too loose
  double size_ratio = 1.0;  ///< above 1: one more particle, so many times as large
};

/// Wanted in every scene, Pa. With the stiffness of most scenes overlaps are 0.05 of the radius.
constexpr double kStress = 50e6;

/// Relatively, of an assembly that is timed. Chosen: twice what its compaction ends at.
constexpr double kBorneWithin = 0.1;

std::string particles_text(const std::string& name, int count, double radius,
                           const Features& features) {
  const double elongation = features.grown ? 1.0 : features.elongation;
  const double flatness = features.grown ? 1.0 : features.flatness;
  return "[particles." + name + "]\ncount = " + std::to_string(count) +
         "\nmean_radius = " + std::to_string(radius) +
         "\nelongation = " + std::to_string(elongation) +
         "\nflatness = " + std::to_string(flatness) + "\n";
}

/// Compacted without friction until it bears stress, grown where wanted, then held.
std::string text_of(const Features& features) {
  const std::string motion = "mean_stress = " + std::to_string(kStress) +
                             "\nmax_strain_rate = 0.1\ntime_step_factor = 0.2\ndamping = 0.1\n";
  std::string text = "schema = 1\n[cell]\ndimensions = " + std::string(features.plane ? "2" : "3") +
                     "\n" + features.more + particles_text("p", 1000, 10.0, features);
  if (features.size_ratio > 1.0)
    text += particles_text("large", 1, 10.0 * features.size_ratio, features);
  text += "[contact]\n" + features.law +
          "friction_coefficient = " + std::to_string(features.friction) +
          "\n[[stage]]\nkind = \"place\"\narrangement = \"random\"\n" +
          "[[stage]]\nkind = \"compress\"\nfriction_coefficient = 0.0\nstress_tolerance = 0.05\n" +
          motion;
  // So many increments change no semi-axis by more than 0.01 up to an aspect ratio of 3.
  if (features.grown)
    text +=
        "[[stage]]\nkind = \"grow\"\nincrements = 150\nmax_inertial_fraction = 0.1\n"
        "stress_tolerance = 0.05\nelongation = " +
        std::to_string(features.elongation) + "\nflatness = " + std::to_string(features.flatness) +
        "\n" + motion;
  return text + "[[stage]]\nkind = \"relax\"\nmax_unbalanced_ratio = 1e-9\n" + motion;
}

/// In its last stage, `cycles` in.
Simulation assembly(const Features& features, int cycles) {
  Simulation simulation(parse_scene(text_of(features), features.name));
  while (simulation.state().stage + 1 < simulation.scene().stages.size()) {
    while (simulation.status() == StageStatus::running) simulation.step();
    simulation.next_stage();
  }
  for (int k = 0; k < cycles; ++k) simulation.step();
  return simulation;
}

/// 20 cycles in; made once for all repetitions.
const Simulation& ready_assembly(const Features& features) {
  static std::map<std::string, Simulation> made;
  const auto found = made.find(features.name);
  if (found != made.end()) return found->second;
  return made.emplace(features.name, assembly(features, 20)).first->second;
}

const std::vector<Features>& scenes() {
  static const std::string hertz = "law = \"hertz\"\nyoung_modulus = 3e10\n";
  static const std::vector<Features> all{
      {"ellipsoids"},
      {"ellipsoids, simplified rotation", 1.4, 0.5, "[motion]\nrotation = \"simplified\"\n"},
      {"ellipsoids, gravity", 1.4, 0.5, "[motion]\ngravity = [0.0, 0.0, -1.0]\n"},
      {"ellipsoids, frictionless", 1.4, 0.0},
      {"ellipsoids, global answers", 1.4, 0.5, "[motion]\ncontacts = \"global\"\n"},
      {"ellipsoids, Hertz", 1.4, 0.5, "", hertz},
      {.name = "ellipsoids 3:2:1", .elongation = 1.5, .flatness = 2.0},
      {.name = "ellipsoids 3:2:1, Hertz", .elongation = 1.5, .law = hertz, .flatness = 2.0},
      {.name = "aspect 3", .elongation = 3.0, .grown = true},
      {.name = "size ratio 5", .elongation = 1.4, .size_ratio = 5.0},
      {"spheres", 1.0},
      {"spheres, frictionless", 1.0, 0.0},
      {.name = "spheres, size ratio 5", .elongation = 1.0, .size_ratio = 5.0},
      {"spheres, Hertz", 1.0, 0.5, "", hertz},
      {"ellipses", 1.4, 0.5, "", "normal_stiffness = 1.5e10\n", true},
      {"ellipses, frictionless", 1.4, 0.0, "", "normal_stiffness = 1.5e10\n", true},
  };
  return all;
}

bool close(double a, double b, double tolerance, const char* what) {
  if (std::abs(a - b) <= tolerance * std::abs(b)) return true;
  std::fprintf(stderr, "bench_dem: %s: %.17g and %.17g\n", what, a, b);
  return false;
}

/// One contact update of the same positions each way.
bool answers_agree() {
  const Simulation round = assembly({"round", 1.0, 0.0}, 0);
  State state = round.state();
  const Stress spheres = stress_of(state.contacts, state.cell);
  for (tangency::Vec3& axes : state.particles.semi_axes) axes[0] *= 1.0 + 1e-9;
  state.contacts.update(state.particles, state.cell, state.list, round.scene().laws, 0.0);
  const Stress ellipsoids = stress_of(state.contacts, state.cell);
  bool agree = close(spheres.mean(), ellipsoids.mean(), 1e-5, "stress of spheres and ellipsoids");
  // Overlaps are some 1e-2 of the radius: 1e-9 of an axis moves the stress by up to 1e-7.
  Simulation turning = assembly({"turning", 1.0, 0.0}, 50);
  Simulation still = assembly({"still", 1.0, 0.0, "[motion]\nrotation = \"none\"\n"}, 50);
  return close(turning.observe().stress.mean(), still.observe().stress.mean(), 0.0,
               "frictionless spheres with and without turning") &&
         agree;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  set_threads(1);
  if (!answers_agree()) return 1;
  bool sound = true;
  for (const Features& features : scenes())
    benchmark::RegisterBenchmark(
        features.name.c_str(),
        [&sound, features](benchmark::State& state) {
          Simulation simulation = ready_assembly(features);
          if (!close(simulation.observe().stress.mean(), kStress, kBorneWithin,
                     features.name.c_str())) {
            sound = false;
            state.SkipWithError("does not bear its stress");
            return;
          }
          for (auto _ : state) simulation.step();
          const auto pairs = static_cast<double>(simulation.state().list.pairs().size());
          state.counters["pairs"] = pairs;
          state.counters["contacts"] = static_cast<double>(simulation.observe().contacts);
          state.counters["per_pair"] = benchmark::Counter(
              pairs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
        })
        ->Unit(benchmark::kMicrosecond)
        ->MinTime(0.3);
  benchmark::RunSpecifiedBenchmarks();
  return sound ? 0 : 1;
}
