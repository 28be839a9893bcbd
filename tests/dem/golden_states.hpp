// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Runs whose last states' hashes are committed, in tests/data/golden_states/states.csv, and what
/// tells which of its rows are those of this machine. golden_states.cpp writes the rows; what
/// changes them: docs/simulator.md.
#pragma once

#include <hwy/targets.h>
#ifdef __SSE__
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <tangency/dem/scene.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/saved/state_file.hpp>

namespace tangency::testing {

struct GoldenRun {
  const char* name;
  const char* scene;
  int cycles;
};

/// Pairs and, but for `hertz`, particles enough to be shared among threads; at the end some
/// hundred contacts that slide and roll.
inline constexpr GoldenRun kGoldenRuns[] = {{"linear", R"(schema = 1
[cell]
[particles.grain]
count = 512
mean_radius = 10.0
elongation = 1.4
flatness = 1.2
[contact]
normal_stiffness = 1.5e10
shear_stiffness = 1.2e10
friction_coefficient = 0.5
[[stage]]
kind = "place"
[[stage]]
kind = "compress"
mean_stress = 10e6
max_strain_rate = 1.0
)",
                                             250},
                                            {"hertz", R"(schema = 1
[cell]
walls = "z"
[motion]
gravity = [0.0, 0.0, -9.81]
[particles.grain]
count = 83
mean_radius = 10.0
elongation = 1.4
[particles.ball]
count = 42
mean_radius = 12.0
[contact]
law = "hertz"
young_modulus = 1e9
friction_coefficient = 0.4
[[stage]]
kind = "place"
[[stage]]
kind = "compress"
mean_stress = 10e6
max_strain_rate = 1.0
)",
                                             200},
                                            {"plane", R"(schema = 1
[cell]
dimensions = 2
[particles.disk]
count = 484
mean_radius = 10.0
[contact]
normal_stiffness = 1.5e10
friction_coefficient = 0.3
[[stage]]
kind = "place"
[[stage]]
kind = "grow"
friction_coefficient = 0.3
elongation = 1.3
increments = 50
mean_stress = 10e6
max_strain_rate = 1.0
)",
                                             250}};

inline dem::Simulation start(const GoldenRun& run) {
  return dem::Simulation(dem::parse_scene(run.scene, run.name));
}

inline void run_cycles(dem::Simulation& simulation, int cycles) {
  for (int cycle = 0; cycle < cycles; ++cycle) simulation.step();
}

/// 8 hexadecimal digits that tell processors apart by their approximate inverse roots, where the
/// lanes of AVX2 start: those of different makers have other last bits.
inline std::string approximate_roots() {
  std::uint32_t hash = 0;
#ifdef __SSE__
  for (int k = 1; k <= 4096; ++k) {
    const __m128 root = _mm_rsqrt_ps(_mm_set1_ps(static_cast<float>(k) * 0x1.9p-9f));
    hash = (hash ^ std::bit_cast<std::uint32_t>(_mm_cvtss_f32(root))) * 0x9e3779b1u;
    hash ^= hash >> 15;
  }
#endif
  std::array<char, 9> text;
  std::snprintf(text.data(), text.size(), "%08x", static_cast<unsigned>(hash));
  return text.data();
}

/// Which kind of arithmetic the lanes have with an instruction set of Highway: gap_batch.hpp and
/// contact_lanes.hpp let last bits depend on it.
inline std::string arithmetic_of(std::int64_t level) {
  if (level == HWY_AVX2) return "AVX2-" + approximate_roots();
  return (level & (HWY_SSE4 | HWY_SSSE3 | HWY_SCALAR | HWY_EMU128)) != 0
             ? "no-FMA"
             : std::string(hwy::TargetName(level)).substr(0, 4);
}

/// Only this instruction set from now on; 0: all.
inline void use_level(std::int64_t level) {
  hwy::SetSupportedTargetsForTest(level);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// Runs with each instruction set that this machine and this build have, the best one last.
template <class Run>
void at_every_level(Run&& run) {
  std::vector<std::int64_t> levels = hwy::SupportedAndGeneratedTargets();
  std::sort(levels.rbegin(), levels.rend());
  for (const std::int64_t level : levels) {
    use_level(level);
    run(level);
  }
  use_level(0);
}

/// What a row of the file begins with: the arithmetic that runs here now have.
inline std::string arithmetic_now() {
  return arithmetic_of(hwy::SupportedTargets() & -hwy::SupportedTargets());
}

/// "linear,250,582,65099ab460d4226f": what a row goes on with.
inline std::string row_of(const GoldenRun& run, const dem::Simulation& simulation) {
  return std::string(run.name) + ',' + std::to_string(simulation.state().cycle) + ',' +
         std::to_string(simulation.observe().contacts) + ',' + state_hash(simulation.state());
}

}  // namespace tangency::testing
