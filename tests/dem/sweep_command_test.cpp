// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem run` of a scene with a [sweep], and with --set: each combination is the run of its
/// own scene, none runs twice, and what was stopped goes on.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "../tool/process.hpp"
#include "csv_columns.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string sweeping(const std::string& table) { return small_scene() + "[sweep]\n" + table; }

Finished run_of(const TemporaryFolder& folder, const std::string& scene,
                std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{
      "run", folder.write("scene.toml", scene), "--threads", "1", "--out", folder.path("out")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_tool(arguments);
}

json summary_in(const TemporaryFolder& folder, const std::string& of) {
  return json::parse(read_file(folder.path("out/" + of + "/summary.json")));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

constexpr const char* kSeeds = "\"stage.place.seed\" = [1, 2]\n";

TEST(Settings, AreSaidInTheSummaryAndAreThoseOfTheSceneThatHasThem) {
  const TemporaryFolder set, written;
  ASSERT_EQ(
      run_of(set, small_scene(), {"--quiet", "--set", "contact.friction_coefficient=0.25"}).status,
      0);
  ASSERT_EQ(run_of(written, with(small_scene(), "= 0.5\n", "= 0.25\n"), {"--quiet"}).status, 0);
  const json one = summary_in(set, "."), other = summary_in(written, ".");
  EXPECT_EQ(one.at("set"), (json{{"contact.friction_coefficient", 0.25}}));
  EXPECT_EQ(one.at("state_hash"), other.at("state_hash"));
  EXPECT_FALSE(other.contains("set"));
}

TEST(Sweep, RunsEachCombinationAsTheSceneThatItIs) {
  const TemporaryFolder folder, alone;
  const Finished run =
      run_of(folder, sweeping(std::string(kSeeds) + "contact.friction_coefficient = [0.25, 0.5]\n"),
             {"--quiet"});
  ASSERT_EQ(run.status, 0) << run.err;
  ASSERT_EQ(
      run_of(alone, with(small_scene(), "\"place\"", "\"place\"\nseed = 2"), {"--quiet"}).status,
      0);
  const json one = summary_in(folder, "seed=2_friction_coefficient=0.5");
  EXPECT_EQ(one.at("state_hash"), summary_in(alone, ".").at("state_hash"));
  EXPECT_EQ(one.at("set").at("stage.place.seed"), 2);
  const auto table = lines_of(read_file(folder.path("out/sweep.csv")));
  ASSERT_EQ(table.size(), 5u);
  EXPECT_EQ(table[0].find("folder,status,stage.place.seed,contact.friction_coefficient,cycle,"), 0u)
      << table[0];
  EXPECT_EQ(table[4].find("seed=2_friction_coefficient=0.5,0,2,0.5,"), 0u) << table[4];
  // The scene that stands in the folder is whole.
  const Finished again =
      run_tool({"run", folder.path("out/seed=2_friction_coefficient=0.5/scene.toml"), "--out",
                folder.path("again"), "--quiet"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(json::parse(read_file(folder.path("again/summary.json"))).at("state_hash"),
            one.at("state_hash"));
}

TEST(Sweep, RunsNothingTwiceAndGoesOnWhereARunWasStopped) {
  const TemporaryFolder folder;
  const std::string scene =
      with(sweeping(kSeeds), "[output]\n", "[output]\ncheckpoint_interval = 100\n");
  ASSERT_EQ(run_of(folder, scene, {"--quiet"}).status, 0);
  const json first = summary_in(folder, "seed=1"), second = summary_in(folder, "seed=2");
  const std::string table = read_file(folder.path("out/sweep.csv"));
  const Finished again = run_of(folder, scene);
  EXPECT_EQ(again.status, 0) << again.err;
  for (const char* said : {"run seed=1 (1 of 2) is complete", "run seed=2 (2 of 2) is complete"})
    EXPECT_NE(again.err.find(said), again.err.npos) << again.err;
  EXPECT_EQ(read_file(folder.path("out/sweep.csv")), table);

  // As a run that was killed leaves it: a checkpoint, and no end.
  for (const char* file : {"summary.json", "final.state"})
    fs::remove(folder.path(std::string("out/seed=2/") + file));
  const Finished resumed = run_of(folder, scene);
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("run seed=1 (1 of 2) is complete"), resumed.err.npos);
  EXPECT_EQ(resumed.err.find("run seed=2 (2 of 2) is complete"), resumed.err.npos);
  EXPECT_EQ(summary_in(folder, "seed=2").at("state_hash"), second.at("state_hash"));
  EXPECT_EQ(summary_in(folder, "seed=1"), first);
}

TEST(Sweep, RefusesAFolderOfAnotherSceneBeforeAnythingRuns) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_of(folder, sweeping(kSeeds), {"--quiet"}).status, 0);
  const json before = summary_in(folder, "seed=1");
  const std::string changed = with(sweeping(kSeeds), "count = 27", "count = 20");
  const Finished refused = run_of(folder, changed, {"--quiet"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err, "--out " + folder.path("out") + ": " +
                             folder.path("out/seed=1/scene.toml") +
                             " is of another scene: --replace takes its results away; or another "
                             "--out\n");
  EXPECT_EQ(summary_in(folder, "seed=1"), before);
  EXPECT_EQ(run_of(folder, changed, {"--quiet", "--replace"}).status, 0);
  EXPECT_EQ(summary_in(folder, "seed=2").at("particles"), 20);
}

// Results without the scene that they are of would pass for those of the sweep's when it is started
// once more.
TEST(Sweep, RefusesAFolderThatHasResultsWithoutAScene) {
  const TemporaryFolder folder;
  const std::string other = folder.write("other.toml", with(small_scene(), "= 0.5\n", "= 0.25\n"));
  ASSERT_EQ(run_tool({"run", other, "--out", folder.path("out/seed=1"), "--quiet"}).status, 0);
  const json before = summary_in(folder, "seed=1");
  for (int times = 0; times < 2; ++times) {
    const Finished refused = run_of(folder, sweeping(kSeeds), {"--quiet"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_EQ(refused.err, "--out " + folder.path("out") + ": " +
                               folder.path("out/seed=1/history.csv") +
                               " is of another scene: --replace takes its results away; or another "
                               "--out\n");
  }
  EXPECT_EQ(summary_in(folder, "seed=1"), before);
  EXPECT_EQ(run_of(folder, sweeping(kSeeds), {"--quiet", "--replace"}).status, 0);
  EXPECT_NE(summary_in(folder, "seed=1").at("state_hash"), before.at("state_hash"));
}

TEST(Sweep, BeginsAnewWhereAKillLeftNoCheckpoint) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_of(folder, sweeping(kSeeds), {"--quiet"}).status, 0);
  const json first = summary_in(folder, "seed=1");
  for (const char* file : {"summary.json", "final.state", "checkpoint.state"})
    fs::remove(folder.path(std::string("out/seed=1/") + file));
  const Finished again = run_of(folder, sweeping(kSeeds), {"--quiet"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(summary_in(folder, "seed=1").at("state_hash"), first.at("state_hash"));
}

/// Three ellipsoids, each of a shape of its own, from a table.
std::string tabled(const std::string& sweep) {
  return "schema = 1\n[cell]\nsize = [80.0, 80.0, 80.0]\n[particles.grain]\ncount = 3\n"
         "mean_radius = 10.0\n[contact]\nnormal_stiffness = 1.5e10\n[[stage]]\nkind = \"place\"\n"
         "arrangement = \"explicit\"\nfile = \"one.csv\"\n[[stage]]\nkind = \"servo\"\n"
         "duration = 20\n[sweep]\n" +
         sweep;
}

TEST(Sweep, FindsTablesOfBodiesFromTheScenesFolder) {
  const TemporaryFolder folder, alone;
  const std::string rows = ",10,10,9,8,7\ngrain,30,10,10,9,8,7\ngrain,50,10,10,9,8,8\n";
  for (const TemporaryFolder* each : {&folder, &alone}) {
    each->write("one.csv", "type,x,y,z,r1,r2,r3\ngrain,10" + rows);
    each->write("two.csv", "type,x,y,z,r1,r2,r3\ngrain,12" + rows);
  }
  // An --out that is a link: `..` leads from where it points to.
  fs::create_directories(folder.path("a/b/c"));
  fs::create_directory_symlink(folder.path("a/b/c"), folder.path("out"));
  const Finished over =
      run_of(folder, tabled("\"stage.place.file\" = [\"one.csv\", \"two.csv\"]\n"), {"--quiet"});
  EXPECT_EQ(over.status, 0) << over.err;
  const Finished set = run_of(alone, tabled("\"stage.servo.duration\" = [20, 30]\n"),
                              {"--quiet", "--set", "stage.place.file=two.csv"});
  EXPECT_EQ(set.status, 0) << set.err;
  const json two = summary_in(folder, "file=two.csv");
  EXPECT_EQ(two.at("state_hash"), summary_in(alone, "duration=20").at("state_hash"));
  EXPECT_NE(two.at("state_hash"), summary_in(folder, "file=one.csv").at("state_hash"));
}

TEST(Sweep, RefusesABadValueBeforeAnythingRuns) {
  const TemporaryFolder folder;
  const Finished run = run_of(folder, sweeping("\"particles.grain.count\" = [8, 0]\n"));
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, folder.path("scene.toml") +
                         ":23: particles.grain.count = 0: an integer from 1 to 1000000\n");
  EXPECT_FALSE(fs::exists(folder.path("out")));
  const Finished resumed =
      run_of(folder, sweeping(kSeeds), {"--resume", folder.path("none.state")});
  EXPECT_EQ(resumed.err, "--resume " + folder.path("none.state") +
                             ": without [sweep]; the runs of a sweep go on by themselves\n");
}

TEST(Sweep, GoesOnWithTheOthersWhereOneDoesNotReachItsEnd) {
  const TemporaryFolder folder;
  const Finished run =
      run_of(folder, sweeping("\"stage.compress.max_cycles\" = [1, 200000]\n"), {"--quiet"});
  EXPECT_EQ(run.status, 1);
  const auto table = lines_of(read_file(folder.path("out/sweep.csv")));
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table[1].find("max_cycles=1,1,1,,"), 0u) << table[1];
  EXPECT_EQ(table[2].find("max_cycles=200000,0,200000,"), 0u) << table[2];
}

// The published study: one preparation, and a pressure a run.
TEST(SweepAfterAStage, RunsWhatIsCommonOnceAndEachThenAsByItself) {
  const std::string pressures = "\"stage.relax.mean_stress\" = [5e6, 10e6]\n";
  const TemporaryFolder branched, whole;
  const Finished run =
      run_of(branched, sweeping("after = \"compress\"\n" + pressures), {"--quiet"});
  ASSERT_EQ(run.status, 0) << run.err;
  ASSERT_EQ(run_of(whole, sweeping(pressures), {"--quiet"}).status, 0);
  EXPECT_EQ(summary_in(branched, "compress").at("stage"), "compress");
  for (const char* one : {"mean_stress=5e+06", "mean_stress=1e+07"}) {
    EXPECT_EQ(summary_in(branched, one).at("state_hash"), summary_in(whole, one).at("state_hash"));
    const Columns history =
        columns_of(read_file(branched.path(std::string("out/") + one + "/history.csv")));
    EXPECT_EQ(history.at("stage").front(), "relax");
  }
  const Finished again = run_of(branched, sweeping("after = \"compress\"\n" + pressures));
  EXPECT_NE(again.err.find("run compress (compress) is complete"), again.err.npos) << again.err;
}

// The runs have the same scenes still, but another start.
TEST(SweepAfterAStage, RunsAllAnewWhereWhatIsCommonIsReplaced) {
  const TemporaryFolder folder, fresh;
  const std::string table = "after = \"compress\"\ncontact.friction_coefficient = [0.25, 0.5]\n";
  ASSERT_EQ(run_of(folder, sweeping(table), {"--quiet"}).status, 0);
  const std::string changed = with(sweeping(table), "coefficient = 0.5\n", "coefficient = 0.125\n");
  ASSERT_EQ(run_of(folder, changed, {"--quiet", "--replace"}).status, 0);
  ASSERT_EQ(run_of(fresh, changed, {"--quiet"}).status, 0);
  for (const char* one : {"compress", "friction_coefficient=0.25", "friction_coefficient=0.5"})
    EXPECT_EQ(summary_in(folder, one).at("state_hash"), summary_in(fresh, one).at("state_hash"))
        << one;
}

TEST(SweepAfterAStage, RefusesKeysThatChangeWhatIsCommonAndAStageThatIsNotThere) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_of(folder, sweeping(std::string("after = \"compress\"\n") + kSeeds)).err,
            folder.path("scene.toml") +
                ": sweep.after = 'compress': a stage before which seed=1 changes nothing but "
                "contacts\n");
  EXPECT_EQ(run_of(folder, sweeping(std::string("after = \"shear\"\n") + kSeeds)).err,
            folder.path("scene.toml") + ":23: sweep.after = 'shear': the name of one stage\n");
  EXPECT_EQ(run_of(folder, sweeping(std::string("after = \"relax\"\n") + kSeeds)).err,
            folder.path("scene.toml") + ":23: sweep.after = 'relax': a stage before the last\n");
}

}  // namespace
}  // namespace tangency::testing
