// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run says when something is wrong: by which keys of that stage it can be put right, and
/// that it then is; and what it says of a stage that cannot end.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/scene/scene_keys.hpp>
#include <tangency/tests/support/patterns.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

Finished run_of(const TemporaryFolder& folder, const std::string& scene,
                const Process::Place& place = {}, bool quiet = true) {
  const std::string file = folder.write("scene.toml", scene), out = folder.path("out");
  std::vector<std::string> arguments{"run", file, "--out", out, "--replace", "--threads", "1"};
  if (quiet) arguments.push_back("--quiet");
  return run_tool(arguments, "", place);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string line_with(const std::string& text, const std::string& part) {
  for (const std::string& line : lines_of(text))
    if (line.find(part) != line.npos) return line;
  return "";
}

/// Every word of a line's advice, what stands after its last semicolon, that is a key of a scene
/// has to be one that this kind of stage, or a section but the stages, has.
void expect_keys_of(const std::string& kind, const std::string& line) {
  ASSERT_NE(line.rfind(';'), line.npos) << line;
  std::string advice = line.substr(line.rfind(';'));
  std::replace_if(
      advice.begin(), advice.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_'; },
      ' ');
  std::istringstream words(advice);
  int named = 0;
  for (std::string word; words >> word;) {
    bool is_key = false, is_of_kind = false;
    for (const dem::Key& key : dem::scene_keys())
      if (key.name == word) {
        is_key = true;
        is_of_kind = is_of_kind || key.section != "stage" || dem::is_among(kind, key.kinds);
      }
    if (is_key) {
      EXPECT_TRUE(is_of_kind) << word << " in: " << line;
      ++named;
    }
  }
  EXPECT_GT(named, 0) << line;
}

std::string test_scene(const std::string& name) {
  return read_file(std::string(TANGENCY_TEST_DATA) + "/scenes/" + name);
}

TEST(RestUnderGravity, IsInBalanceAndGivesNoWarning) {
  const TemporaryFolder folder;
  const Finished run = run_of(folder, test_scene("rest-under-gravity.toml"));
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  const auto summary = nlohmann::json::parse(read_file(folder.path("out/summary.json")));
  EXPECT_LT(summary["inertial_fraction"].get<double>(), 1e-6);
  EXPECT_LT(summary["largest_unbalanced_ratio"].get<double>(), 1e-6);
  EXPECT_EQ(summary["rattlers"], 0);
  const auto rows = lines_of(read_file(folder.path("out/history.csv")));
  std::istringstream names(rows.front()), last(rows.back());
  std::string name, value;
  while (std::getline(names, name, ',') && std::getline(last, value, ','))
    if (name == "inertial_fraction") {
      EXPECT_LT(std::stod(value), 1e-6);
    }
}

/// A ball that falls by twice its radius, and bounces without losses.
std::string bouncing(int duration) {
  return "schema = 1\n[cell]\nsize = [4.0, 4.0, 8.0]\nwalls = \"xyz\"\n[motion]\n"
         "gravity = [0.0, 0.0, -9.81]\n[particles.ball]\ncount = 1\nmean_radius = 0.5\n"
         "[contact]\nnormal_stiffness = 1e8\n[[stage]]\nkind = \"place\"\n"
         "arrangement = \"explicit\"\n[[body]]\ntype = \"ball\"\nposition = [2.0, 2.0, 1.5]\n"
         "[[stage]]\nkind = \"servo\"\ndamping = 0.0\nduration = " +
         std::to_string(duration) + "\n[output]\nframe_interval = 0\nhistory_interval = 1\n";
}

// The work of gravity is next to nothing at the top, and the forces are far from balance on the
// floor: both are as the scene wants them.
TEST(FreeMotion, OfABallThatBouncesGivesNoWarning) {
  for (const int duration : {990, 1980}) {
    const TemporaryFolder folder;
    const Finished run = run_of(folder, bouncing(duration));
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.err, "") << duration;
  }
}

TEST(ShippedScene, OfImpactAndSlopeRunsToItsEndWithoutAWord) {
  for (const char* name : {"impact", "slope"}) {
    const TemporaryFolder folder;
    const Finished run =
        run_of(folder, read_file(std::string(TANGENCY_SCENES) + "/" + name + ".toml"));
    EXPECT_EQ(run.status, 0) << name;
    EXPECT_EQ(run.err, "") << name;
  }
}

TEST(GoingOn, UnderAnotherVelocityOfAWallSaysSo) {
  const TemporaryFolder folder;
  const std::string slope = with(read_file(std::string(TANGENCY_SCENES) + "/slope.toml"),
                                 "duration = 8000", "duration = 10");
  ASSERT_EQ(run_of(folder, slope).status, 0);
  const std::string wall = "normal = [1.0, 0.0, 2.0]\n";
  const std::string moving =
      folder.write("moving.toml", with(slope, wall, wall + "velocity = [0.0, 1.0, 0.0]\n"));
  const Finished resumed = run_tool({"run", moving, "--out", folder.path("again"), "--quiet",
                                     "--resume", folder.path("out/final.state")});
  EXPECT_EQ(resumed.status, 0);
  EXPECT_EQ(resumed.err,
            "tangency-dem: goes on with other walls: the state was made with wall[0].velocity = "
            "[ 0, 0, 0 ], and here [ 0, 1, 0 ]\n");
}

TEST(GoingOn, UnderAnotherStressOfAWallSaysSo) {
  const TemporaryFolder folder;
  const std::string wall = "normal = [1.0, 0.0, 2.0]\n";
  const std::string held = with(with(read_file(std::string(TANGENCY_SCENES) + "/slope.toml"),
                                     "duration = 8000", "duration = 10"),
                                wall, wall + "stress = 50.0\nmax_speed = 0.1\n");
  ASSERT_EQ(run_of(folder, held).status, 0);
  const std::string other = folder.write("other.toml", with(held, "= 50.0", "= 60.0"));
  const Finished resumed = run_tool({"run", other, "--out", folder.path("again"), "--quiet",
                                     "--resume", folder.path("out/final.state")});
  EXPECT_EQ(resumed.status, 0);
  EXPECT_EQ(resumed.err,
            "tangency-dem: goes on with other walls: the state was made with wall[0].stress = 50, "
            "and here 60\n");
}

// It falls by half a radius, and is given the time that the advice names.
TEST(Advice, OnABodyThatStillMovesIsADurationThatIsLongEnough) {
  const TemporaryFolder folder;
  const std::string scene =
      with(with(test_scene("rest-under-gravity.toml"), "5.0, 1.0]\n", "5.0, 1.5]\n"),
           "duration = 20000", "duration = 700");
  const Finished moving = run_of(folder, scene);
  EXPECT_EQ(moving.status, 0);
  const std::string line = line_with(moving.err, "inertial fraction");
  expect_keys_of("servo", line);
  const auto found =
      captured(line, "particles still move though nothing strains them; raise duration to (\\d+)$");
  ASSERT_TRUE(found) << line;
  const Finished longer = run_of(folder, with(scene, "duration = 700", "duration = " + *found));
  EXPECT_EQ(longer.err, "");
}

/// small_scene() without its relaxation, and a last stage.
std::string pressed_then(const std::string& stage) {
  return with(small_scene(),
              "[[stage]]\nkind = \"relax\"\nmean_stress = 10e6\n"
              "max_strain_rate = 0.05\n",
              stage);
}

TEST(Advice, OnFastMotionNamesTheRatesOfTheStage) {
  struct Case {
    const char* kind;
    std::string stage, advice;
  };
  const std::vector<Case> cases{
      {"shear", "axial_strain_rate = 0.5\naxial_strain = 0.02\n",
       "; lower axial_strain_rate to 0."},
      {"shear",
       "axial_strain_rate = 0.5\naxial_strain = 0.02\nmean_stress = 10e6\nmax_strain_rate = 0.3\n",
       " and max_strain_rate to 0."},
      {"servo", "duration = 100\nstrain_rate = [0.0, 0.5, -0.25]\n",
       "; lower strain_rate to [ 0, 0."},
      {"servo", "duration = 100\nshear_rate = [0.5, 0.0, 0.0]\n", "; lower shear_rate to [ 0."},
      {"servo", "duration = 100\nsimple_shear_rate = [0.0, 0.0, 0.5]\n",
       "; lower simple_shear_rate to [ 0, 0, 0."},
      {"servo", "duration = 20\nmean_stress = 30e6\nmax_strain_rate = 0.5\n",
       "; lower max_strain_rate to 0."}};
  for (const Case& one : cases) {
    const TemporaryFolder folder;
    const Finished run =
        run_of(folder, pressed_then(std::string("[[stage]]\nkind = \"") + one.kind +
                                    "\"\nname = \"last\"\n" + one.stage));
    const std::string line = line_with(run.err, "stage last ended with inertial fraction");
    EXPECT_NE(line.find(one.advice), line.npos) << run.err;
    expect_keys_of(one.kind, line);
  }
}

TEST(Advice, OnGravityThatNoWallBearsNamesTheWallsThatWould) {
  const TemporaryFolder folder;
  const Finished run =
      run_of(folder, with(with(small_scene(), "[cell]\n",
                               "[cell]\nwalls = \"x\"\n[motion]\ngravity = [0.0, 0.0, -3e6]\n"),
                          "kind = \"relax\"", "kind = \"relax\"\nmax_cycles = 300"));
  EXPECT_EQ(run.status, 1);
  const std::string line = line_with(run.err, "stage relax did not end");
  EXPECT_NE(line.find("; gravity along z acts where no wall bears it; set cell.walls to \"xz\", or "
                      "motion.gravity to 0 along z"),
            line.npos)
      << run.err;
}

TEST(Advice, OnSoftParticlesIsAStiffnessThatIsEnough) {
  const std::string linear = with(small_scene(), "stiffness = 1.5e10", "stiffness = 1e9");
  const std::string hertz =
      with(linear, "normal_stiffness = 1e9", "law = \"hertz\"\nyoung_modulus = 5e8");
  for (const auto& [scene, key] :
       {std::pair(linear, "normal_stiffness"), std::pair(hertz, "young_modulus")}) {
    const TemporaryFolder folder;
    const Finished soft = run_of(folder, scene);
    const std::string line = line_with(soft.err, "stage relax ended with mean overlap");
    ASSERT_NE(line, "") << soft.err;
    expect_keys_of("relax", line);
    const auto found = captured(
        line, "too soft for what they bear; raise " + std::string(key) + " to ([0-9.e+]+)$");
    ASSERT_TRUE(found) << line;
    const Finished stiff = run_of(folder, replaced(scene, std::string(key) + " = [0-9.e+]+",
                                                   std::string(key) + " = " + *found));
    EXPECT_EQ(line_with(stiff.err, "stage relax ended with mean overlap"), "") << stiff.err;
  }
}

/// A ball held by twenty heavy ones all around it.
TEST(Advice, OnALongStepIsAShorterOne) {
  std::string scene =
      "schema = 1\n[cell]\nsize = [9.0, 9.0, 9.0]\n[particles.ball]\ncount = 1\n"
      "mean_radius = 1.0\n[particles.stone]\ncount = 20\nmean_radius = 1.0\ndensity = 1e12\n"
      "[contact]\nnormal_stiffness = 1e6\nfriction_coefficient = 1.0\n"
      "[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\n"
      "[[body]]\ntype = \"ball\"\nposition = [4.0, 4.0, 4.0]\n";
  for (int k = 0; k < 20; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / 20.0, across = std::sqrt(1.0 - z * z);
    scene += "[[body]]\ntype = \"stone\"\nposition = [" +
             std::to_string(4.0 + 1.9 * across * std::cos(2.4 * k)) + ", " +
             std::to_string(4.0 + 1.9 * across * std::sin(2.4 * k)) + ", " +
             std::to_string(4.0 + 1.9 * z) + "]\n";
  }
  scene += "[[stage]]\nkind = \"servo\"\nduration = 1\ntime_step_factor = 0.3\n";
  const TemporaryFolder folder;
  const std::string line = line_with(run_of(folder, scene).err, "of the critical one");
  const auto found = captured(line, "; lower time_step_factor to (0[0-9.]+)$");
  ASSERT_TRUE(found) << line;
  expect_keys_of("servo", line);
  const Finished shorter = run_of(folder, with(scene, "factor = 0.3", "factor = " + *found));
  EXPECT_EQ(line_with(shorter.err, "of the critical one"), "") << shorter.err;
}

/// Two balls far from each other, and a stage of its own length.
std::string far_apart(const std::string& stage) {
  return "schema = 1\n[cell]\nsize = [40.0, 40.0, 40.0]\n[particles.ball]\ncount = 2\n"
         "mean_radius = 1.0\n[contact]\nnormal_stiffness = 1e6\n[[stage]]\nkind = \"place\"\n"
         "[[stage]]\n" +
         stage + "[output]\nframe_interval = 0\n";
}

TEST(StageThatCannotEnd, SaysSoAtItsFirstCycleWithWhatItNeeds) {
  struct Case {
    std::string stage, says, enough;
    bool ends = true;
  };
  const std::vector<Case> cases{
      {"kind = \"servo\"\nduration = 201\nmax_cycles = 200\n",
       "stage servo cannot end within max_cycles = 200: it needs 201 cycles for its duration; "
       "raise "
       "max_cycles to 210\n",
       "210"},
      {"kind = \"shear\"\naxial_strain_rate = 0.025\naxial_strain = 0.1\nmax_cycles = 200\n",
       "stage shear cannot end within max_cycles = 200: it needs 309 cycles for its axial_strain; "
       "raise max_cycles to 310\n",
       "310"},
      {"kind = \"grow\"\nelongation = 1.5\nincrements = 900\nmean_stress = 1e3\n"
       "max_strain_rate = 0.5\nmax_cycles = 200\n",
       "stage grow cannot end within max_cycles = 200: it needs 900 cycles for its increments; "
       "raise max_cycles to 900\n",
       "900", false},
      {"kind = \"compress\"\nmean_stress = 1e3\nmax_strain_rate = 0.05\nmax_cycles = 200\n",
       "stage compress cannot end within max_cycles = 200: it needs 4247 cycles for its "
       "mean_stress; "
       "raise max_cycles to 4300\n",
       "4300", false}};
  for (const Case& one : cases) {
    const TemporaryFolder folder;
    const Finished run = run_of(folder, far_apart(one.stage));
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err.find("tangency-dem: " + one.says), 0u) << run.err;
    const auto lines = lines_of(run.err);
    ASSERT_EQ(lines.size(), 2u) << run.err;
    EXPECT_NE(lines[1].find(" did not end within max_cycles = 200"), lines[1].npos);
    EXPECT_NE(lines[1].find("; raise max_cycles to "), lines[1].npos) << lines[1];
    const Finished more = run_of(
        folder, far_apart(with(one.stage, "max_cycles = 200", "max_cycles = " + one.enough)));
    EXPECT_EQ(more.err.find("cannot end"), more.err.npos) << more.err;
    if (one.ends) {
      EXPECT_EQ(more.status, 0) << more.err;
    }
  }
}

// A stage of 1e12 cycles ends with its 40,000: it was said to take thousands of hours. On a machine
// that takes 9 s a cycle the right answer would have three digits too.
TEST(TimeLeft, IsAtMostWhatMaxCyclesLeaves) {
  const TemporaryFolder folder;
  Process::Place terminal;
  terminal.error_is_terminal = true;
  const Finished run =
      run_of(folder,
             far_apart("kind = \"servo\"\nduration = 1000000000000\nmax_cycles = 40000\n") +
                 "history_interval = 100000\n",
             terminal, false);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("\r[  "), run.err.npos);
  EXPECT_FALSE(has_pattern(run.err, "[0-9]{3,}\\.[0-9] h left")) << run.err;
}

}  // namespace
}  // namespace tangency::testing
