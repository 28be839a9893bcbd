// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem run` from explicit arrangements, and what is left to go on from after a kill or a
/// full disk.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "../tool/process.hpp"
#include "csv_columns.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

/// A mixture of sizes and shapes, stopped nowhere: some 1500 cycles with frames and checkpoints.
std::string mixture() {
  return "schema = 1\n"
         "[particles.ball]\ncount = 12\nmean_radius = 10.0\n"
         "[particles.disk]\ncount = 9\nmean_radius = 8.0\nflatness = 1.8\n"
         "[particles.rod]\ncount = 6\nmean_radius = 9.0\nelongation = 2.0\ndensity = 2600.0\n"
         "[contact]\nnormal_stiffness = 1.5e10\nfriction_coefficient = 0.5\n"
         "[contact.ball-rod]\nfriction_coefficient = 0.1\n"
         "[[stage]]\nkind = \"place\"\narrangement = \"random\"\nbounding_fraction = 0.3\n"
         "[[stage]]\nkind = \"compress\"\nmean_stress = 20e6\nmax_strain_rate = 0.1\n"
         "time_step_factor = 0.3\n"
         "[[stage]]\nkind = \"shear\"\nmean_stress = 20e6\naxial_strain_rate = 0.05\n"
         "axial_strain = 0.1\ntime_step_factor = 0.3\n"
         "[output]\nhistory_interval = 7\nframe_interval = 100\ncheckpoint_interval = 60\n"
         "micro_interval = 35\n";
}

constexpr const char* kResults[] = {"final.state", "history.csv", "micro.csv", "frames.xyz",
                                    "frames.pvd"};

void expect_same_results(const std::string& a, const std::string& b) {
  for (const char* file : kResults) {
    EXPECT_EQ(std::filesystem::exists(a + "/" + file), std::filesystem::exists(b + "/" + file));
    EXPECT_TRUE(read_file(a + "/" + file) == read_file(b + "/" + file)) << file;
  }
  auto of_a = nlohmann::json::parse(read_file(a + "/summary.json"));
  auto of_b = nlohmann::json::parse(read_file(b + "/summary.json"));
  for (const char* key : {"wall_seconds", "ns_per_listed_pair_per_cycle"})
    of_a.erase(key), of_b.erase(key);
  EXPECT_EQ(of_a, of_b);
}

Finished run_quietly(const std::string& scene, const std::string& out,
                     std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run", scene, "--out", out, "--quiet", "--threads", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_tool(arguments);
}

// What is on the disk changes with the writes alone, so these are all the moments there are to be
// killed at: in the middle of a write of each file, each time resumed from the last checkpoint. In
// the end every file is as if the run had gone through.
TEST(RunAgain, AfterKillsAtAnyMomentEndsWithTheSameFiles) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", mixture());
  const std::string whole = folder.path("whole"), parts = folder.path("parts");
  const Finished uninterrupted = run_quietly(scene, whole);
  ASSERT_TRUE(uninterrupted.status == 0) << uninterrupted.err;
  const std::string state = parts + "/checkpoint.state";
  std::filesystem::create_directories(parts + "/frames");
  // Frames 3, 8 and 13 lie between checkpoints, and carry the run on from one kill to the next.
  for (const char* file :
       {"frames/300.vtp", "checkpoint.state", "history.csv", "frames/800.vtp", "frames.pvd",
        "frames.xyz.part", "frames/1300.vtp", "checkpoint.state", "final.state", "summary.json"}) {
    std::vector<std::string> arguments{"run", scene, "--out", parts, "--quiet", "--threads", "1"};
    if (std::filesystem::exists(state)) arguments.insert(arguments.end(), {"--resume", state});
    const std::string part = parts + "/" + file + ".part";
    std::filesystem::remove(part);
    const FullPipe pipe(part);
    Process run(arguments);
    ASSERT_TRUE(pipe.is_met_by(run)) << file;
    run.send(SIGKILL);
    EXPECT_EQ(run.wait().signal, SIGKILL) << file;
    std::filesystem::remove(part);
    folder.write("parts/" + std::string(file) + ".part", "a half of it");
    ASSERT_TRUE(std::filesystem::exists(state)) << file;
  }
  ASSERT_EQ(run_quietly(scene, parts, {"--resume", state}).status, 0);
  expect_same_results(whole, parts);
}

// Two bodies have a small state and, with a row a cycle, a long history, which is what the disk has
// no room for: a state must not be ahead of the history that belongs to it.
TEST(RunAgain, AfterADiskThatFilledUpInTheMiddleEndsWithTheSameFiles) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "scene.toml",
      "schema = 1\n[cell]\nsize = [10, 10, 10]\n[particles.p]\ncount = 2\nmean_radius = 1.0\n"
      "[contact]\nnormal_stiffness = 1e6\n[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\n"
      "[[body]]\ntype = \"p\"\nposition = [4.0, 5.0, 5.0]\nvelocity = [1.0, 0.0, 0.0]\n"
      "[[body]]\ntype = \"p\"\nposition = [6.1, 5.0, 5.0]\n"
      "[[stage]]\nkind = \"servo\"\nduration = 100\n"
      "[output]\nhistory_interval = 1\nframe_interval = 0\ncheckpoint_interval = 1\n");
  const std::string whole = folder.path("whole"), parts = folder.path("parts");
  ASSERT_EQ(run_quietly(scene, whole).status, 0);
  ASSERT_LT(std::filesystem::file_size(whole + "/final.state"), 4096u);
  ASSERT_GT(std::filesystem::file_size(whole + "/history.csv"), 8192u);
  for (const rlim_t bytes : {rlim_t{5000}, rlim_t{8192}}) {
    const Finished full = [&] {
      const FileSizeLimit limit(bytes);
      return run_quietly(scene, parts, {"--replace"});
    }();
    EXPECT_EQ(full.status, 2);
    EXPECT_EQ(full.err, parts + "/history.csv: cannot be written: File too large\n");
    ASSERT_EQ(run_quietly(scene, parts, {"--resume", parts + "/checkpoint.state"}).status, 0);
    expect_same_results(whole, parts);
  }
}

std::string with_version(std::string state, char version) {
  state.at(8) = version;  // after the 8 letters at the start
  return state;
}

TEST(RunAgain, AfterABlowUpTheLastSoundCheckpointIsThereStill) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "scene.toml",
      "schema = 1\n[particles.s]\ncount = 8\nmean_radius = 10.0\nelongation = 1.2\n"
      "[contact]\nnormal_stiffness = 1.5e10\n[[stage]]\nkind = \"place\"\n"
      "[[stage]]\nkind = \"servo\"\nstrain_rate = [-29, 0, 0]\nduration = 30000\n"
      "[output]\nhistory_interval = 50\ncheckpoint_interval = 500\nframe_interval = 0\n");
  const std::string out = folder.path("out"), state = out + "/checkpoint.state";
  for (const std::vector<std::string>& from : {{}, std::vector<std::string>{"--resume", state}}) {
    const Finished run = run_quietly(scene, out, from);
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err.find("tangency-dem: the run blew up: "), 0u) << run.err;
    EXPECT_EQ(read_file(out + "/history.csv").find("inf"), std::string::npos);
  }
  const Finished profiled = run_quietly(scene, out, {"--resume", state, "--profile"});
  EXPECT_EQ(profiled.status, 1);
  EXPECT_TRUE(profiled.out.starts_with("phase ")) << profiled.out;
  EXPECT_NE(profiled.out.find("\nmotion "), profiled.out.npos) << profiled.out;
}

TEST(RunAgain, RefusesAHistoryThatItDidNotWriteAndLeavesIt) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", mixture()), out = folder.path("out");
  ASSERT_EQ(run_quietly(scene, out).status, 0);
  const std::string edited = "# a note\n" + read_file(out + "/history.csv"),
                    summary = read_file(out + "/summary.json");
  folder.write("out/history.csv", edited);
  const Finished again = run_quietly(scene, out, {"--resume", out + "/final.state"});
  EXPECT_EQ(again.status, 2);
  EXPECT_EQ(again.err.find(out + "/history.csv: not as this program wrote it"), 0u) << again.err;
  EXPECT_EQ(read_file(out + "/history.csv"), edited);
  EXPECT_EQ(read_file(out + "/summary.json"), summary);
}

TEST(RunAgain, RefusesAPlaceWhereAnotherRunIsWriting) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", mixture()), out = folder.path("out");
  ASSERT_EQ(run_quietly(scene, out).status, 0);
  const int other = ::open(out.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  const Finished second = run_quietly(scene, out, {"--replace"});
  EXPECT_EQ(second.status, 2);
  EXPECT_EQ(second.err.find("--out " + out + ": another run is writing there"), 0u) << second.err;
  EXPECT_TRUE(std::filesystem::exists(out + "/summary.json"));
  ::close(other);
  EXPECT_EQ(run_quietly(scene, out, {"--replace"}).status, 0);
}

std::map<std::string, std::string> files_below(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path()] = read_file(entry.path());
  return files;
}

TEST(RunAgain, RefusesAPlaceWithTheResultsOfAnotherRunUnlessItMayReplaceThem) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", mixture());
  const std::string other = folder.write(
      "other.toml", with(mixture(), "friction_coefficient = 0.5", "friction_coefficient = 0.4"));
  const std::string out = folder.path("out"), elsewhere = folder.path("elsewhere");
  ASSERT_EQ(run_quietly(scene, out).status, 0);
  ASSERT_EQ(run_quietly(other, elsewhere).status, 0);
  const auto before = files_below(out);
  const Finished again = run_quietly(scene, out);
  EXPECT_EQ(again.status, 2);
  EXPECT_EQ(again.err, "--out " + out +
                           ": holds results of an earlier run, history.csv: --replace takes them "
                           "away; or --resume one of its states, or another --out\n");
  const std::string state = elsewhere + "/checkpoint.state";
  const Finished joined = run_quietly(other, out, {"--resume", state});
  EXPECT_EQ(joined.status, 2);
  EXPECT_EQ(joined.err, "--out " + out + ": holds results not of the run of " + state +
                            ", history.csv: --replace takes them away; or another --out\n");
  EXPECT_TRUE(files_below(out) == before);

  ASSERT_EQ(run_quietly(other, out, {"--replace"}).status, 0);
  expect_same_results(out, elsewhere);
  // A state of the same run is known wherever it lies.
  const std::string kept = folder.path("kept.state");
  std::filesystem::copy_file(out + "/checkpoint.state", kept);
  EXPECT_EQ(run_quietly(other, out, {"--resume", kept}).status, 0);
  expect_same_results(out, elsewhere);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(RunAgain, AFinishedStateInAnEmptyPlaceHasARowAndAReport) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", mixture());
  const std::string out = folder.path("out"), empty = folder.path("empty");
  ASSERT_EQ(run_quietly(scene, out).status, 0);
  ASSERT_EQ(run_quietly(scene, empty, {"--resume", out + "/final.state"}).status, 0);
  const auto rows = lines_of(read_file(empty + "/history.csv"));
  ASSERT_EQ(rows.size(), 2u);
  // The last row of the run, but for the cycles of its stage, which the state has gone on from.
  const Rows of_run = rows_of(read_file(out + "/history.csv"));
  std::map<std::string, std::string> last = of_run.back();
  EXPECT_NE(last.at("stage_cycle"), "0");
  last["stage_cycle"] = "0";
  EXPECT_EQ(rows_of(read_file(empty + "/history.csv")).back(), last);
  const Finished report = run_tool({"report", empty});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_NE(report.out.find("\nshear "), report.out.npos) << report.out;
}

TEST(RunAgain, AStageThatEndsAtOnceHasARowWhichTheSummaryIsOf) {
  const TemporaryFolder folder;
  const std::string rest =
      "[[stage]]\nkind = \"relax\"\nname = \"rest\"\nmean_stress = 10e6\n"
      "max_strain_rate = 0.05\n[output]\n";
  const std::string scene = folder.write("scene.toml", with(small_scene(), "[output]\n", rest));
  const std::string out = folder.path("out");
  const Finished run = run_quietly(scene, out);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto rows = lines_of(read_file(out + "/history.csv"));
  const auto cell = [](const std::string& row, int k) {
    std::istringstream in(row);
    std::string text;
    for (; k >= 0; --k) std::getline(in, text, ',');
    return text;
  };
  const std::string &last = rows.back(), &before = rows[rows.size() - 2];
  EXPECT_EQ(cell(last, 0), cell(before, 0)) << "the same cycle";
  EXPECT_EQ(cell(before, 2), "relax");
  EXPECT_EQ(cell(last, 2), "rest");
  EXPECT_EQ(cell(last, 3), "0") << "axial strain, from the start of the stage";
  EXPECT_EQ(cell(last, 4), "0");
  const auto summary = nlohmann::json::parse(read_file(out + "/summary.json"));
  EXPECT_EQ(summary["stage"], "rest");
  EXPECT_EQ(summary["axial_strain"].get<double>(), 0.0);
  EXPECT_EQ(summary["mean_stress"].get<double>(), std::stod(cell(last, 5)));
  // And once more from any state: no row comes twice.
  ASSERT_EQ(run_quietly(scene, out, {"--resume", out + "/final.state"}).status, 0);
  EXPECT_TRUE(lines_of(read_file(out + "/history.csv")) == rows);
}

TEST(RunAgain, RefusesNamesThatAreEmptyAndLinksThatLeadNowhereAndTakesNothingAway) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", mixture()), out = folder.path("out");
  ASSERT_EQ(run_quietly(scene, out).status, 0);
  EXPECT_EQ(run_quietly(scene, out, {"--resume", ""}).status, 2);
  EXPECT_EQ(run_tool({"run", scene, "--out", ""}).status, 2);
  EXPECT_TRUE(std::filesystem::exists(out + "/summary.json"));
  const std::filesystem::path link = folder.path("link");
  std::filesystem::create_symlink("/nonexistent/disk", link);
  EXPECT_EQ(run_quietly(scene, link.string()).status, 2);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST(RunAgain, RefusesStatesItCannotReadAndLeavesEarlierResults) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", mixture());
  const std::string out = folder.path("out");
  ASSERT_EQ(run_quietly(scene, out).status, 0);
  const std::string good = read_file(out + "/final.state"),
                    summary = read_file(out + "/summary.json");
  std::string damaged = good;
  damaged[good.size() / 2] ^= 1;
  const std::vector<std::pair<std::string, std::string>> cases{
      {folder.path("none"), ": cannot be read: No such file or directory\n"},
      {folder.path(""), ": cannot be read: Is a directory\n"},
      {folder.write("empty", ""),
       ": no state of tangency-dem: final.state or checkpoint.state of a run\n"},
      {folder.write("short", good.substr(0, good.size() - 1)), ": damaged: its hash is wrong\n"},
      {folder.write("damaged", damaged), ": damaged: its hash is wrong\n"},
      {folder.write("newer", with_version(good, 99)),
       ": state of version 99: this program reads version "}};
  for (const auto& [file, message] : cases) {
    const Finished run = run_quietly(scene, out, {"--resume", file});
    EXPECT_EQ(run.status, 2) << file;
    EXPECT_EQ(run.err.find(file + message), 0u) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(read_file(out + "/summary.json"), summary);
    EXPECT_TRUE(read_file(out + "/final.state") == good);
  }
}

/// Three bodies, in the scene or in a table, and the first line of frames.xyz that holds them.
std::string explicit_scene(const std::string& place, const std::string& bodies) {
  return "schema = 1\n[cell]\nsize = [40, 40, 40]\n[particles.a]\ncount = 2\nmean_radius = 2.0\n"
         "elongation = 1.5\n[particles.b]\ncount = 1\nmean_radius = 3.0\n[contact]\n"
         "normal_stiffness = 1e6\n[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\n" +
         place + bodies + "[[stage]]\nkind = \"servo\"\nduration = 20\n";
}

const char* const kBodies =
    "[[body]]\ntype = \"b\"\nposition = [3.0, 4.0, 5.0]\nvelocity = [0.5, 0.0, -1.0]\n"
    "[[body]]\ntype = \"a\"\nposition = [-1.0, 50.0, 5.5]\norientation = [0.0, 0.0, 0.0, 2.0]\n"
    "[[body]]\ntype = \"a\"\nposition = [20.0, 20.0, 20.0]\nangular_velocity = [1.0, 2.0, 3.0]\n";
const char* const kTable =
    "qw,qx,qy,qz,x,y,z,type,vx,vy,vz,wx,wy,wz\n"
    "1,0,0,0,3,4,5,b,0.5,0,-1,0,0,0\n"
    "0,0,0,2,-1,50,5.5,a,0,0,0,0,0,0\n"
    "1,0,0,0,20,20,20,a,0,0,0,1,2,3\n";

TEST(ExplicitBodies, OfTheSceneAndOfATableRunTheSame) {
  const TemporaryFolder folder;
  folder.write("bodies.csv", kTable);
  const std::string here = folder.write("here.toml", explicit_scene("", kBodies));
  const std::string table =
      folder.write("table.toml", explicit_scene("file = \"bodies.csv\"\n", ""));
  ASSERT_EQ(run_quietly(here, folder.path("here")).status, 0);
  ASSERT_EQ(run_quietly(table, folder.path("table")).status, 0);
  expect_same_results(folder.path("here"), folder.path("table"));
  std::istringstream frames(read_file(folder.path("here/frames.xyz")));
  std::string line;
  for (int skipped = 0; skipped < 3; ++skipped) std::getline(frames, line);
  EXPECT_EQ(line.find("b 3 4 5 0 0 0 1 3 3 3 0.5 0 -1"), 0u) << line;
  std::getline(frames, line);  // wrapped into the cell, its quaternion made unit
  EXPECT_EQ(line.find("a 39 10 5.5 0 0 1 0 "), 0u) << line;
}

TEST(ExplicitBodies, OfABadTableAreRefusedWithTheirLine) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", explicit_scene("file = \"bodies.csv\"\n", ""));
  const std::string file = folder.path("bodies.csv");
  const auto message = [&](const std::string& before, const std::string& after) {
    folder.write("bodies.csv", with(kTable, before, after));
    const Finished run = run_quietly(scene, folder.path("out"));
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path("out")));
    return run.err.substr(0, run.err.size() - 1);
  };
  EXPECT_EQ(message("5,b", "5,c"),
            file + ":2: type = c: a name of one of the scene's particle types");
  EXPECT_EQ(message("0,0,0,2", "0,0,0,0"), file + ":3: qw = 0: 4 finite numbers, not all 0");
  EXPECT_EQ(message("50,", "nan,").find(file + ":3: y = nan: "), 0u);
  EXPECT_EQ(message("50,", "1e300,").find(file + ":3: y = 1e300: one of 3 "), 0u);
  EXPECT_EQ(message("50,", "2e10,"),
            file + ":3: y = 2e10: at most 2^28 edges of the cell away from its corner");
  EXPECT_EQ(message("0.5,0,-1", "0.5,-1e31,0").find(file + ":2: vy = -1e31: one of 3 "), 0u);
  EXPECT_EQ(message("type", "kind").find(file + ":1: "), 0u);
  EXPECT_EQ(message("qz", "q").find(file + ":1: "), 0u);
  EXPECT_EQ(message("5,b", "5,a"), file + ": 3 bodies of type a: as many as particles.a.count, 2");
  std::filesystem::remove(file);
  EXPECT_EQ(run_quietly(scene, folder.path("out")).err.find(file + ": cannot be read"), 0u);
}

}  // namespace
}  // namespace tangency::testing
