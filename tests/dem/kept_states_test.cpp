// SPDX-License-Identifier: GPL-3.0-or-later
/// The states and the tables of contacts that `tangency-dem run` keeps: where they are of, that
/// each is gone on from bit for bit, and that a run that was ended anywhere comes to the same
/// files.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/dem/micromechanics/stress_force_fabric.hpp>
#include <tangency/dem/observe.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/tool/shear_points.hpp>

#include "../tool/process.hpp"
#include "csv_columns.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

namespace fs = std::filesystem;

/// A mixture sheared to 0.2, with all that can be kept. Of little friction, so that its volume is
/// constant after the peak.
std::string keeping_scene() {
  return "schema = 1\n"
         "[particles.ball]\ncount = 12\nmean_radius = 10.0\n"
         "[particles.disk]\ncount = 9\nmean_radius = 8.0\nflatness = 1.8\n"
         "[particles.rod]\ncount = 6\nmean_radius = 9.0\nelongation = 2.0\n"
         "[contact]\nnormal_stiffness = 1.5e10\nfriction_coefficient = 0.1\n"
         "[[stage]]\nkind = \"place\"\narrangement = \"random\"\nbounding_fraction = 0.3\n"
         "save = true\n"
         "[[stage]]\nkind = \"compress\"\nmean_stress = 20e6\nmax_strain_rate = 0.1\n"
         "time_step_factor = 0.3\nsave = true\n"
         "[[stage]]\nkind = \"shear\"\nmean_stress = 20e6\naxial_strain_rate = 0.05\n"
         "axial_strain = 0.2\ntime_step_factor = 0.3\n"
         "save = true\nsave_strains = [0.05, 0.125]\nsave_points = true\n"
         "[output]\nhistory_interval = 7\nframe_interval = 0\ncheckpoint_interval = 60\n"
         "contact_interval = 300\n";
}

const std::vector<std::string> kStates{"compress.state",    "place.state",   "shear-0.05.state",
                                       "shear-0.125.state", "shear-A.state", "shear-B.state",
                                       "shear-C.state",     "shear-D.state", "shear.state"};

Finished run_quietly(const std::string& scene, const std::string& out,
                     std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run", scene, "--out", out, "--quiet", "--threads", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_tool(arguments);
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

nlohmann::json summary_of(const std::string& out) {
  auto summary = nlohmann::json::parse(read_file(out + "/summary.json"));
  for (const char* key : {"wall_seconds", "ns_per_listed_pair_per_cycle"}) summary.erase(key);
  return summary;
}

void expect_same_results(const std::string& a, const std::string& b) {
  for (const char* file : {"final.state", "history.csv"})
    EXPECT_TRUE(read_file(a + "/" + file) == read_file(b + "/" + file)) << file;
  for (const std::string folder : {"/states", "/contacts"}) {
    EXPECT_EQ(names_in(a + folder), names_in(b + folder));
    for (const std::string& name : names_in(a + folder))
      EXPECT_TRUE(read_file(a + folder + "/" + name) == read_file(b + folder + "/" + name)) << name;
  }
  EXPECT_EQ(summary_of(a), summary_of(b));
}

/// A run of keeping_scene(), made once.
class KeptStates : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    scene_ = folder_->write("scene.toml", keeping_scene());
    const Finished run = run_quietly(scene_, whole());
    ASSERT_EQ(run.status, 0) << run.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  static const TemporaryFolder& folder() { return *folder_; }
  static const std::string& scene() { return scene_; }
  static std::string whole() { return folder_->path("whole"); }
  static std::string kept(const std::string& name) { return whole() + "/states/" + name; }
  static dem::State state(const std::string& name) { return dem::load_state(kept(name)); }
  /// A copy of the run.
  static std::string copy(const std::string& name) {
    const std::string out = folder_->path(name);
    fs::copy(whole(), out, fs::copy_options::recursive);
    return out;
  }

 private:
  static inline TemporaryFolder* folder_ = nullptr;
  static inline std::string scene_;
};

double axial_strain(const dem::State& state) { return -state.cell.logarithmic_strain()(2, 2); }

TEST_F(KeptStates, AreThoseThatTheStagesAskFor) {
  EXPECT_EQ(names_in(whole() + "/states"), kStates);
  EXPECT_EQ(state("place.state").cycle, 0);
  // An end is the next stage's start, which a scene with another next stage may go on from.
  const dem::State compressed = state("compress.state"), sheared = state("shear.state");
  EXPECT_EQ(compressed.stage, 2u);
  EXPECT_EQ(compressed.stage_cycle, 0);
  EXPECT_TRUE(read_file(kept("compress.state")) == read_file(kept("shear-A.state")));
  EXPECT_EQ(sheared.stage, 3u);
  EXPECT_TRUE(read_file(kept("shear.state")) == read_file(whole() + "/final.state"));
}

// By the rows of every cycle, which another run of the same scene has.
TEST_F(KeptStates, OfStrainsAreTheFirstThatAreStrainedSoMuch) {
  const std::string out = folder().path("rows");
  const std::string every = folder().write(
      "every.toml", with(keeping_scene(), "history_interval = 7", "history_interval = 1"));
  ASSERT_EQ(run_quietly(every, out).status, 0);
  const auto rows = rows_of(read_file(out + "/history.csv"));
  for (const std::string strain : {"0.05", "0.125"}) {
    const auto first = std::find_if(rows.begin(), rows.end(), [&](const auto& row) {
      return row.at("stage") == "shear" && std::stod(row.at("axial_strain")) >= std::stod(strain);
    });
    const dem::State at = state("shear-" + strain + ".state");
    EXPECT_EQ(at.cycle, std::stoll(first->at("cycle")));
    EXPECT_EQ(axial_strain(at), std::stod(first->at("axial_strain")));
    EXPECT_EQ(at.stage, 2u);
  }
}

TEST_F(KeptStates, OfPointsAreTheRowsOfTheRulesAndTheSummarySaysWhere) {
  const auto summary = summary_of(whole());
  std::vector<dem::ShearPointRow> rows;
  std::vector<std::int64_t> cycles;
  const dem::State start = state("shear-A.state");
  rows.push_back(
      {0.0, 0.0, 0.0,
       micromechanics::shear_stress_ratio(dem::stress_of(start.contacts, start.cell).tensor)});
  cycles.push_back(start.cycle);
  for (const auto& row : rows_of(read_file(whole() + "/history.csv"))) {
    if (row.at("stage") != "shear") continue;
    const auto value = [&](const char* name) { return std::stod(row.at(name)); };
    Mat3 stress;
    stress << value("s_xx"), value("s_xy"), value("s_zx"), value("s_xy"), value("s_yy"),
        value("s_yz"), value("s_zx"), value("s_yz"), value("s_zz");
    rows.push_back({value("axial_strain"), value("volumetric_strain"), value("friction_angle_deg"),
                    micromechanics::shear_stress_ratio(stress)});
    cycles.push_back(std::stoll(row.at("cycle")));
  }
  const dem::ShearPoints points = *dem::shear_points(rows);
  const std::map<char, std::size_t> all{
      {'A', points.a}, {'B', points.b}, {'C', points.c}, {'D', points.d}};
  for (const auto& [name, row] : all) {
    const std::string point(1, name);
    EXPECT_EQ(state("shear-" + point + ".state").cycle, cycles[row]) << point;
    EXPECT_EQ(summary["strain_at_" + point].get<double>(), rows[row].axial_strain) << point;
    if (name == 'A') continue;  // whose strain counts from the stage before
    EXPECT_EQ(axial_strain(state("shear-" + point + ".state")), rows[row].axial_strain) << point;
  }
  EXPECT_EQ(summary["D_is_last_row"].get<bool>(), points.d_is_last_row);
  EXPECT_NEAR(summary["strain_at_C"].get<double>(), summary["strain_at_peak_friction"], 0.001);
}

TEST_F(KeptStates, AreEachGoneOnFromBitForBit) {
  for (const std::string& name : kStates) {
    const std::string elsewhere = folder().path("from-" + name), here = copy("in-" + name);
    const Finished away = run_quietly(scene(), elsewhere, {"--resume", kept(name)});
    ASSERT_EQ(away.status, 0) << away.err;
    EXPECT_TRUE(read_file(elsewhere + "/final.state") == read_file(whole() + "/final.state"))
        << name;
    const Finished again = run_quietly(scene(), here, {"--resume", here + "/states/" + name});
    ASSERT_EQ(again.status, 0) << again.err;
    expect_same_results(whole(), here);
  }
}

// A file that cannot be written ends the run. Resumed where it can, the run makes up for it.
TEST_F(KeptStates, ThatCouldNotBeWrittenAreMadeUpForByTheResumedRun) {
  for (const std::string name :
       {"states/place.state", "states/compress.state", "states/shear-0.05.state",
        "states/shear-A.state", "states/shear-B.state", "states/shear.state", "contacts/300.csv"}) {
    const std::string out = folder().path("blocked");
    const std::string blocked = out + "/" + name + ".part";
    fs::create_directories(blocked);
    const Finished run = run_quietly(scene(), out);
    EXPECT_EQ(run.status, 2) << name;
    EXPECT_NE(run.err.find(name + ": cannot be written"), run.err.npos) << run.err;
    fs::remove(blocked);
    EXPECT_FALSE(fs::exists(out + "/" + name));
    const Finished again = run_quietly(scene(), out, {"--resume", out + "/checkpoint.state"});
    EXPECT_EQ(again.status, 0) << again.err;
    expect_same_results(whole(), out);
    fs::remove_all(out);
  }
}

TEST_F(KeptStates, WithoutAPlaceForTheirFolderEndTheRunWithACheckpoint) {
  std::string text = keeping_scene();
  text = with(text, "bounding_fraction = 0.3\nsave = true\n", "bounding_fraction = 0.3\n");
  for (const std::string taken : {"states", "contacts"}) {
    const std::string out = folder().path("no-" + taken);
    fs::create_directories(out);
    std::ofstream(out + "/" + taken) << "no folder";
    const Finished run = run_quietly(folder().write("late.toml", text), out);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, out + "/" + taken + ": cannot be written: Not a directory\n");
    EXPECT_EQ(fs::exists(out + "/checkpoint.state"), taken == "states");
  }
}

TEST_F(KeptStates, StayWhereTheRunIsRefusedForAnotherMicroCsv) {
  const std::string out = copy("other-micro");
  std::ofstream(out + "/micro.csv") << "cycle,time,stage,another\n";
  const auto states = names_in(out + "/states"), tables = names_in(out + "/contacts");
  const Finished run = run_quietly(scene(), out, {"--resume", out + "/states/shear-A.state"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("micro.csv: not as this program wrote it"), run.err.npos) << run.err;
  EXPECT_EQ(names_in(out + "/states"), states);
  EXPECT_EQ(names_in(out + "/contacts"), tables);
}

TEST_F(KeptStates, OfStrainsThatWerePassedBeforeAreNamed) {
  const std::string out = copy("late");
  const std::string more = folder().write(
      "more.toml", with(keeping_scene(), "save_strains = [0.05,", "save_strains = [0.02, 0.05,"));
  const Finished run = run_quietly(more, out, {"--resume", out + "/states/shear-0.05.state"});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("tangency-dem: stage shear passed the axial strain 0.02 of save_strains "
                         "before cycle "),
            run.err.npos)
      << run.err;
  EXPECT_FALSE(fs::exists(out + "/states/shear-0.02.state"));
}

// From the stage's start all points are found, and from within it none, which is said.
TEST_F(KeptStates, OfPointsAreFoundInAnotherDirectoryFromTheStagesStartAlone) {
  const std::string start = folder().path("start"), within = folder().path("within");
  ASSERT_EQ(run_quietly(scene(), start, {"--resume", kept("compress.state")}).status, 0);
  for (const char* point : {"A", "B", "C", "D"}) {
    const std::string name = std::string("/states/shear-") + point + ".state";
    EXPECT_TRUE(read_file(start + name) == read_file(whole() + name)) << point;
  }
  EXPECT_EQ(summary_of(start)["strain_at_D"], summary_of(whole())["strain_at_D"]);
  const Finished run = run_quietly(scene(), within, {"--resume", kept("shear-0.05.state")});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("tangency-dem: states B, C and D of stage shear are not kept: the state "
                         "at its start is not there\n"),
            run.err.npos)
      << run.err;
  EXPECT_EQ(names_in(within + "/states"),
            (std::vector<std::string>{"shear-0.125.state", "shear.state"}));
  EXPECT_FALSE(summary_of(within).contains("strain_at_A"));
}

TEST_F(KeptStates, OfPointsAreNotThoseOfAnotherRun) {
  const std::string out = copy("changed");
  const std::string changed =
      folder().write("changed.toml", with(keeping_scene(), "friction_coefficient = 0.1",
                                          "friction_coefficient = "
                                          "0.3"));
  const Finished run = run_quietly(changed, out, {"--resume", out + "/states/shear-0.05.state"});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("states B, C and D of stage shear are not kept: its start leads to other "
                         "rows than those of history.csv\n"),
            run.err.npos)
      << run.err;
  EXPECT_TRUE(fs::exists(out + "/states/shear-A.state"));
  for (const char* point : {"B", "C", "D"})
    EXPECT_FALSE(fs::exists(out + "/states/shear-" + point + ".state")) << point;
  EXPECT_FALSE(summary_of(out).contains("strain_at_A"));
}

// The resumed run adds none: what is left is what there was at its cycle.
TEST_F(KeptStates, OfLaterCyclesAreTakenAwayWithTheTablesOfContacts) {
  const std::string out = copy("earlier");
  std::string text = with(keeping_scene(), "contact_interval = 300\n", "");
  text = with(text, "save = true\nsave_strains = [0.05, 0.125]\nsave_points = true\n", "");
  const std::string plain = folder().write("plain.toml", text);
  const std::string from = out + "/states/shear-0.05.state";
  const std::int64_t cycle = dem::load_state(from).cycle;
  ASSERT_EQ(run_quietly(plain, out, {"--resume", from}).status, 0);
  std::vector<std::string> states;
  for (const std::string& name : kStates)
    if (state(name).cycle <= cycle) states.push_back(name);
  EXPECT_EQ(names_in(out + "/states"), states);
  EXPECT_LT(states.size(), kStates.size());
  for (const std::string& name : names_in(whole() + "/contacts"))
    EXPECT_EQ(fs::exists(out + "/contacts/" + name), std::atoll(name.c_str()) <= cycle) << name;
  EXPECT_FALSE(summary_of(out).contains("strain_at_A"));

  while (text.find("save = true\n") != text.npos) text = with(text, "save = true\n", "");
  const std::string none = folder().write("none.toml", text);
  ASSERT_EQ(run_quietly(none, out, {"--replace"}).status, 0);
  EXPECT_FALSE(fs::exists(out + "/states"));
  EXPECT_FALSE(fs::exists(out + "/contacts"));
}

TEST_F(KeptStates, AndTablesOfContactsAreResultsOfARun) {
  for (const std::string name : {"states/shear.state", "contacts/300.csv"}) {
    const std::string out = folder().path("alone-" + fs::path(name).filename().string());
    fs::create_directories(fs::path(out + "/" + name).parent_path());
    fs::copy(whole() + "/" + name, out + "/" + name);
    folder().write(fs::path(out).filename().string() + "/contacts.csv", "mine");
    const Finished run = run_quietly(scene(), out);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err.find("--out " + out + ": holds results of an earlier run, " + name + ": "),
              0u)
        << run.err;
    EXPECT_TRUE(fs::exists(out + "/" + name));
  }
  const std::string other = folder().path("other");  // files of no run
  fs::create_directories(other + "/contacts");
  folder().write("other/contacts/names.csv", "mine");
  EXPECT_EQ(run_quietly(scene(), other).status, 0);
  EXPECT_EQ(read_file(other + "/contacts/names.csv"), "mine");
}

TEST_F(KeptStates, TablesOfContactsAreOfTheIntervalAndOfStagesEnds) {
  const std::int64_t compressed = state("compress.state").cycle, end = state("shear.state").cycle;
  std::vector<std::string> wanted{std::to_string(compressed) + ".csv",
                                  std::to_string(end) + ".csv"};
  for (std::int64_t cycle = 0; cycle <= end; cycle += 300)
    wanted.push_back(std::to_string(cycle) + ".csv");
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  EXPECT_EQ(names_in(whole() + "/contacts"), wanted);
  for (const std::string name : {"compress.state", "shear.state"}) {
    const Finished table = run_tool({"contacts", kept(name)});
    EXPECT_EQ(table.status, 0) << table.err;
    EXPECT_TRUE(table.out ==
                read_file(whole() + "/contacts/" + std::to_string(state(name).cycle) + ".csv"))
        << name;
  }
}

// The moments are those of writes: in the middle of a write of each kind of file, each time resumed
// from the last checkpoint.
TEST_F(KeptStates, AfterKillsAtAnyMomentAreTheSame) {
  const std::string parts = folder().path("parts"), checkpoint = parts + "/checkpoint.state";
  fs::create_directories(parts + "/states");
  fs::create_directories(parts + "/contacts");
  const std::int64_t next = state("shear-0.05.state").cycle / 300 + 1;
  for (const std::string& file : std::vector<std::string>{
           "states/place.state", "contacts/300.csv", "checkpoint.state", "states/compress.state",
           "states/shear-A.state", "states/shear-0.05.state",
           "contacts/" + std::to_string(300 * next) + ".csv", "states/shear-0.125.state",
           "states/shear-B.state", "states/shear-C.state", "states/shear-D.state",
           "states/shear.state", "summary.json"}) {
    std::vector<std::string> arguments{"run", scene(), "--out", parts, "--quiet", "--threads", "1"};
    if (fs::exists(checkpoint))
      arguments.insert(arguments.end(), {"--resume", checkpoint});
    else
      arguments.push_back("--replace");
    const std::string part = parts + "/" + file + ".part";
    fs::create_directories(fs::path(part).parent_path());
    fs::remove(part);
    const FullPipe pipe(part);
    Process run(arguments);
    ASSERT_TRUE(pipe.is_met_by(run)) << file;
    run.send(SIGKILL);
    EXPECT_EQ(run.wait().signal, SIGKILL) << file;
    fs::remove(part);
  }
  ASSERT_EQ(run_quietly(scene(), parts, {"--resume", checkpoint}).status, 0);
  expect_same_results(whole(), parts);
}

// It finds the run in the write of B, in the second pass through the stage.
TEST_F(KeptStates, AfterASignalWhilePointsAreSoughtAreTheSame) {
  const std::string out = folder().path("signalled");
  fs::create_directories(out + "/states");
  const std::string part = make_pipe(out + "/states/shear-B.state.part");
  Process run({"run", scene(), "--out", out, "--quiet", "--threads", "1"});
  const int reader = run.meet_at(part, O_RDONLY);
  run.send(SIGINT);
  EXPECT_NE(read_to_end(reader), "");
  const Finished ended = run.wait();
  ASSERT_EQ(ended.status, 128 + SIGINT) << ended.err;
  EXPECT_EQ(ended.err.find("tangency-dem: interrupted in cycle "), 0u) << ended.err;
  EXPECT_FALSE(fs::exists(out + "/states/shear-C.state"));
  EXPECT_FALSE(fs::exists(out + "/states/shear.state"));
  const dem::State left = dem::load_state(out + "/checkpoint.state");
  EXPECT_EQ(left.stage, 2u) << "the stage's end";
  EXPECT_EQ(left.cycle, state("shear.state").cycle);
  ASSERT_EQ(run_quietly(scene(), out, {"--resume", out + "/checkpoint.state"}).status, 0);
  expect_same_results(whole(), out);
}

TEST(KeptStatesOfStages, ThatEndEarlyAreNone) {
  const TemporaryFolder folder;
  const std::string text =
      with(keeping_scene(), "axial_strain = 0.2\n", "axial_strain = 0.2\nmax_cycles = 100\n");
  const std::string out = folder.path("out");
  EXPECT_EQ(run_quietly(folder.write("scene.toml", text), out).status, 1);
  EXPECT_EQ(names_in(out + "/states"),
            (std::vector<std::string>{"compress.state", "place.state", "shear-A.state"}));
}

TEST(KeptStatesOfStages, ThatAskForNoneMakeNoFolder) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out");
  ASSERT_EQ(run_quietly(folder.write("scene.toml", small_scene()), out).status, 0);
  EXPECT_FALSE(fs::exists(out + "/states"));
  EXPECT_FALSE(fs::exists(out + "/contacts"));
}

}  // namespace
}  // namespace tangency::testing
