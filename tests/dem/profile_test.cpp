// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <numeric>
#include <string>

#include <tangency/dem/profile.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/simulation.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

using dem::Phase;

TEST(Profile, HasTheTimeAndCountsOfCyclesAndLeavesTheStateAlone) {
  const std::string scene = with(small_scene(), "max_strain_rate = 0.05", "max_strain_rate = 1.0");
  dem::Simulation plain(dem::parse_scene(scene, "scene.toml"));
  for (int k = 0; k < 300; ++k) plain.step();

  dem::Simulation watched(dem::parse_scene(scene, "scene.toml"));
  dem::Profile profile;
  watched.record(&profile);
  const auto start = std::chrono::steady_clock::now();
  std::int64_t listed = 0, touching = 0, builds = 0;
  for (int k = 0; k < 300; ++k) {
    const Mat3 before = watched.state().list.reference().edges;
    watched.step();
    builds += watched.state().list.reference().edges == before ? 0 : 1;
    listed += static_cast<std::int64_t>(watched.state().list.pairs().size());
    touching += watched.state().contacts.totals().contacts;
  }
  const double all =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(dem::state_hash(watched.state()), dem::state_hash(plain.state()));
  EXPECT_EQ(profile.cycles, 300);
  EXPECT_EQ(profile.listed_pairs, listed);
  EXPECT_GT(builds, 0);
  EXPECT_EQ(profile.list_builds, builds);
  for (const Phase phase : {Phase::motion, Phase::bodies, Phase::list, Phase::gaps, Phase::law,
                            Phase::sums, Phase::control})
    EXPECT_GT(profile[phase], 0.0) << name_of(phase);
  EXPECT_EQ(profile.touching_pairs, touching);
  EXPECT_EQ(profile.slow_pairs, 0) << "the fast tier answers all of these";
  EXPECT_LE(std::accumulate(profile.seconds.begin(), profile.seconds.end(), 0.0), all)
      << "no phase lies within another";

  watched.record(nullptr);
  watched.step();
  EXPECT_EQ(profile.cycles, 300);
}

TEST(Profile, IsReportedByNameWithWhatNoPhaseHas) {
  dem::Profile profile;
  profile[Phase::motion] = 0.25;
  profile[Phase::gaps] = 0.5;
  profile.cycles = 10;
  profile.list_builds = 2;
  profile.listed_pairs = 1000;
  profile.slow_pairs = 5;
  const std::string table = table_of(profile, 1.0);
  for (const char* line : {"motion             0.250     25.0       250000.00\n",
                           "gaps               0.500     50.0       500000.00\n",
                           "other              0.250     25.0       250000.00\n",
                           "all                1.000    100.0      1000000.00\n"})
    EXPECT_NE(table.find(line), table.npos) << line << table;
  EXPECT_NE(table.find("slow pairs a cycle                     0.5\n"), table.npos) << table;
  EXPECT_EQ(table.find("touching"), table.npos) << "nobody counted";
  EXPECT_GT(dem::peak_memory(), 1 << 20);
}

TEST(Profile, OfARunIsPrintedAndInItsSummary) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene()), out = folder.path("out");
  const auto summary_of = [&] { return nlohmann::json::parse(read_file(out + "/summary.json")); };
  const Finished run = run_tool({"run", scene, "--out", out, "--quiet", "--profile"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(run.out.starts_with("phase ")) << run.out;
  EXPECT_NE(run.out.find("\nmotion "), run.out.npos) << run.out;
  EXPECT_NE(run.out.find("\npeak memory, MB "), run.out.npos) << run.out;
  const auto summary = summary_of();
  ASSERT_TRUE(summary.contains("profile"));
  EXPECT_EQ(summary["profile"]["cycles"], summary["cycles"]);
  EXPECT_GT(summary["profile"]["motion_seconds"].get<double>(), 0.0);
  EXPECT_GT(summary["profile"]["peak_memory_bytes"].get<double>(), 1e6);
  EXPECT_EQ(run_tool({"report", out}).status, 0) << "reads such a summary";

  const Finished plain = run_tool({"run", scene, "--out", out, "--quiet", "--replace"});
  EXPECT_EQ(plain.out, "");
  EXPECT_FALSE(summary_of().contains("profile"));
  EXPECT_EQ(summary_of()["state_hash"], summary["state_hash"]);
}

}  // namespace
}  // namespace tangency::testing
