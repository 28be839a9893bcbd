// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene pays for: one dense assembly of 1000 particles, one cycle at a time, with features
// on and off. Times are a cycle's; `per_pair` is a cycle's over the listed pairs.
//
//     OMP_NUM_THREADS=1 bench_dem --benchmark_enable_random_interleaving=true
//
// Checks its answers first: spheres by their own formula bear what nearly round ellipsoids do by
// the general one, and a frictionless scene is the same with turning left out.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

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
};

/// Compacted without friction until it bears stress, then held.
std::string text_of(const Features& features) {
  const std::string motion =
      "mean_stress = 50e6\nmax_strain_rate = 0.1\ntime_step_factor = 0.2\ndamping = 0.1\n";
  return "schema = 1\n[cell]\ndimensions = " + std::string(features.plane ? "2" : "3") + "\n" +
         features.more + "[particles.p]\ncount = 1000\nmean_radius = 10.0\nelongation = " +
         std::to_string(features.elongation) + "\n[contact]\n" + features.law +
         "friction_coefficient = " + std::to_string(features.friction) +
         "\n[[stage]]\nkind = \"place\"\narrangement = \"random\"\n" +
         "[[stage]]\nkind = \"compress\"\nfriction_coefficient = 0.0\nstress_tolerance = 0.05\n" +
         motion + "[[stage]]\nkind = \"relax\"\nmax_unbalanced_ratio = 1e-9\n" + motion;
}

/// In its last stage, `cycles` in.
Simulation assembly(const Features& features, int cycles) {
  Simulation simulation(parse_scene(text_of(features), features.name));
  while (simulation.status() == StageStatus::running) simulation.step();
  simulation.next_stage();
  for (int k = 0; k < cycles; ++k) simulation.step();
  return simulation;
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
      {"spheres", 1.0},
      {"spheres, frictionless", 1.0, 0.0},
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
  if (!answers_agree()) return 1;
  for (const Features& features : scenes())
    benchmark::RegisterBenchmark(
        features.name.c_str(),
        [features](benchmark::State& state) {
          Simulation simulation = assembly(features, 20);
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
  return 0;
}
