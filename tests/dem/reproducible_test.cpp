// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/lanes/instruction_set.hpp>

#include "../tool/process.hpp"
#include "golden_states.hpp"

namespace tangency::testing {
namespace {

std::string hash_of(const GoldenRun& run) {
  dem::Simulation simulation = start(run);
  run_cycles(simulation, run.cycles);
  return state_hash(simulation.state());
}

// dem/lanes/instruction_set.hpp
TEST(Reproducible, ArithmeticIsThatOfEveryInstructionSetWithoutFusedMultiplyAdds) {
  const GoldenRun& run = kGoldenRuns[0];
  std::map<std::string, std::string> hashes;  // by instruction set
  at_every_level([&](std::int64_t level) { hashes[hwy::TargetName(level)] = hash_of(run); });
  const std::string best = dem::instruction_set();
  EXPECT_TRUE(hashes.contains(best)) << best;
  EXPECT_FALSE(dem::uses_reproducible_arithmetic());

  dem::use_reproducible_arithmetic();
  EXPECT_TRUE(dem::uses_reproducible_arithmetic());
  const std::string used = dem::instruction_set(), hash = hash_of(run);
  detail::use_every_instruction_set();
  EXPECT_EQ(dem::instruction_set(), best);
  EXPECT_FALSE(dem::uses_reproducible_arithmetic()) << "as the test found it";
  int alike = 0;
  for (const auto& [name, other] : hashes) {
    const bool fused = name.starts_with("AVX");
    EXPECT_EQ(other == hash, !fused) << name << ", reproducible by " << used;
    alike += fused ? 0 : 1;
  }
  EXPECT_GE(alike, 2) << "there was something to compare";
}

/// Of a run of the tool, with glibc's functions for this processor or for one without fused
/// multiply-adds.
nlohmann::json summary_of(const std::string& scene, const std::string& out, bool plain_glibc,
                          std::vector<std::string> more) {
  if (plain_glibc) ::setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2", 1);
  more.insert(more.begin(), {"run", scene, "--out", out, "--quiet", "--replace"});
  const Finished run = run_tool(more);
  ::unsetenv("GLIBC_TUNABLES");
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(read_file(out + "/summary.json"));
}

// Random places and orientations, of particles enough that some sines of two versions differ,
// shapes and skins by their cube roots, and a shear to a strain. What else of the simulator could
// call a libm, build/StatesTakeNoFunctionOfLibm sees.
TEST(Reproducible, RunsOfTheToolHaveOneHashWhateverTheLibrarysFunctionsAre) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", R"(schema = 1
[cell]
[particles.grain]
count = 12000
mean_radius = 10.0
elongation = 1.4
flatness = 1.3
[contact]
normal_stiffness = 1.5e10
friction_coefficient = 0.5
[[stage]]
kind = "place"
arrangement = "random"
[[stage]]
kind = "shear"
mean_stress = 50e6
axial_strain = 0.002
axial_strain_rate = 5.0
[output]
frame_interval = 0
)");
  const auto run = [&](bool plain_glibc, std::vector<std::string> more) {
    return summary_of(scene, folder.path("out"), plain_glibc, std::move(more));
  };
  const auto here = run(false, {"--reproducible"}), there = run(true, {"--reproducible"});
  EXPECT_EQ(here["state_hash"], there["state_hash"]);
  EXPECT_EQ(here["reproducible"], true);
  EXPECT_FALSE(here["instruction_set"].get<std::string>().starts_with("AVX"));
  const auto fast = run(false, {});
  EXPECT_EQ(fast["reproducible"], false);
  EXPECT_EQ(fast["instruction_set"], dem::instruction_set());
  EXPECT_EQ(fast["cycles"], here["cycles"]) << "the same but for roundings";
}

}  // namespace
}  // namespace tangency::testing
