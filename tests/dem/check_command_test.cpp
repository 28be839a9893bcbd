// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem check`: what it advises of scenes that would go wrong, that following it puts them
/// right, and that its forecast is what a run then has.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

using nlohmann::json;

Finished checked(const std::string& scene, std::vector<std::string> more = {}) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"check", folder.write("scene.toml", scene)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_tool(arguments);
}

/// The advice about that; null where there is none.
json advice_about(const json& seen, const std::string& about) {
  for (const json& one : seen.at("advice"))
    if (one.at("about") == about) return one;
  return nullptr;
}

std::string sheared(const std::string& keys) {
  return small_scene() + "[[stage]]\nkind = \"shear\"\n" + keys;
}

/// Two balls that meet.
std::string impact(const std::string& law) {
  return "schema = 1\n[cell]\nsize = [9.0, 9.0, 9.0]\n[particles.ball]\ncount = 2\n"
         "mean_radius = 1.0\n[contact]\n" +
         law +
         "[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\n[[body]]\ntype = \"ball\"\n"
         "position = [3.0, 4.0, 4.0]\nvelocity = [2.0, 0.0, 0.0]\n[[body]]\ntype = \"ball\"\n"
         "position = [6.0, 4.0, 4.0]\n[[stage]]\nkind = \"servo\"\nduration = 10\ndamping = 0.0\n"
         "time_step_factor = 0.04\n";
}

TEST(Check, OfASoundSceneHasNothingToChange) {
  const Finished seen = checked(small_scene());
  EXPECT_EQ(seen.status, 0) << seen.out << seen.err;
  EXPECT_EQ(seen.err, "");
  EXPECT_NE(seen.out.find("\nnothing to change\n"), seen.out.npos) << seen.out;
  EXPECT_NE(seen.out.find("\ncompress "), seen.out.npos) << seen.out;
}

TEST(Check, RefusesWhatARunRefuses) {
  const Finished seen = checked(with(small_scene(), "count = 27", "count = 0"));
  EXPECT_EQ(seen.status, 2);
  EXPECT_EQ(seen.out, "");
  EXPECT_NE(seen.err.find("scene.toml:4: particles.grain.count = 0: an integer"), seen.err.npos);
  const Finished thin = checked("schema = 1\n[cell]\nsize = [21.0, 90.0, 90.0]\n" +
                                small_scene().substr(small_scene().find("[particles")));
  EXPECT_EQ(thin.status, 2) << thin.out;
}

struct Case {
  const char* about;
  std::string scene;
  const char* key;  ///< the first that the advice names
};

// dem/tool/check.hpp (1) (2)
TEST(Check, AdvisesKeysAndValuesWithWhichTheAdviceIsGone) {
  const std::string soft = with(small_scene(), "1.5e10", "1e9");
  const std::string hertz =
      with(small_scene(), "normal_stiffness = 1.5e10", "law = \"hertz\"\nyoung_modulus = 6e9");
  const std::string servo = "[[stage]]\nkind = \"servo\"\nduration = 1000\n";
  const std::string flow =
      "simple_shear_rate = [0.5, 0.0, 0.0]\nstress_yy = 10e6\nmax_strain_rate = 5.0\n"
      "intended = [\"inertial_number\"]\n";
  const std::vector<Case> cases{
      {"cycles", sheared("axial_strain_rate = 1e-5\naxial_strain = 0.1\n"),
       "stage.shear.max_cycles"},
      {"cycles",
       with(sheared("inertial_number = 1e-3\naxial_strain = 0.1\nmean_stress = 10e6\n"),
            "normal_stiffness = 1.5e10", "law = \"hertz\"\nyoung_modulus = 1e14"),
       "contact.young_modulus"},
      {"inertial_number",
       sheared("axial_strain_rate = 0.5\naxial_strain = 0.1\nmean_stress = 10e6\n"),
       "stage.shear.axial_strain_rate"},
      {"inertial_number", small_scene() + servo + "simple_shear_rate = [0.5, 0.0, 0.0]\n",
       "stage.servo.simple_shear_rate"},
      {"servo_gain", small_scene() + servo + flow, "stage.servo.servo_gain"},
      {"servo_gain",
       with(sheared("inertial_number = 1e-3\naxial_strain = 0.02\nlateral_stress = 10e6\n"),
            "[contact]\n", "[contact]\nrestitution = 0.3\n"),
       "stage.shear.servo_gain"},
      {"servo_inertial_number",
       with(small_scene(), "max_strain_rate = 0.05", "max_strain_rate = 5"),
       "stage.compress.max_strain_rate"},
      {"overlap", soft, "contact.normal_stiffness"},
      {"largest_overlap", hertz, "contact.largest_overlap"},
      {"time_step",
       with(small_scene(), "[contact]\n", "[contact]\nrestitution = 0.5\n") + servo +
           "damping = 0.0\ntime_step_factor = 0.3\n",
       "stage.servo.time_step_factor"},
      {"cell",
       with(sheared("axial_strain_rate = 0.001\naxial_strain = 0.9\nmean_stress = 10e6\n"),
            "count = 27", "count = 8"),
       "particles.grain.count"},
      {"gravity", with(small_scene(), "[cell]\n", "[cell]\n[motion]\ngravity = [0, 0, -9.81]\n"),
       "motion.gravity"},
      {"impact", impact("normal_stiffness = 1e5\n"), "contact.normal_stiffness"},
      {"impact", impact("law = \"hertz\"\nyoung_modulus = 1e5\n"), "contact.young_modulus"},
      {"largest_overlap", impact("law = \"hertz\"\nyoung_modulus = 6e7\n"),
       "contact.largest_overlap"},
  };
  for (const Case& one : cases) {
    const Finished first = checked(one.scene, {"--json"});
    ASSERT_EQ(first.status, 1) << one.about << first.out << first.err;
    const json advice = advice_about(json::parse(first.out), one.about);
    ASSERT_FALSE(advice.is_null()) << one.about << first.out;
    EXPECT_EQ(advice.at("changes").at(0).at("key"), one.key);
    std::vector<std::string> followed{"--json"};
    for (const json& change : advice.at("changes")) {
      followed.push_back("--set");
      followed.push_back(change.at("key").get<std::string>() + "=" +
                         change.at("to").get<std::string>());
    }
    const Finished second = checked(one.scene, followed);
    ASSERT_LT(second.status, 2) << one.about << second.err;
    EXPECT_TRUE(advice_about(json::parse(second.out), one.about).is_null())
        << one.about << second.out;
  }
}

// Of the first stage the run itself says it when it begins that stage.
TEST(Check, IsSaidByARunBeforeItBegins) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "scene.toml", sheared("axial_strain_rate = 0.5\naxial_strain = 0.001\nmean_stress = 10e6\n"));
  const Finished run = run_tool({"run", scene, "--out", folder.path("out"), "--threads", "1"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err.find("tangency-dem: check: stage shear: an inertial number of 0.1 is above "
                         "0.001: stresses depend on the rate; set stage.shear.axial_strain_rate "
                         "from 0.5 to 0.0049\n"),
            0u)
      << run.err;
  const Finished quiet =
      run_tool({"run", scene, "--out", folder.path("quiet"), "--quiet", "--threads", "1"});
  EXPECT_EQ(quiet.err.find("check: "), quiet.err.npos) << quiet.err;
}

TEST(Check, TellsTheOverlapThatARunThenHasWithinHalfOfIt) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene());
  const json seen = json::parse(run_tool({"check", scene, "--json"}).out);
  EXPECT_EQ(seen.at("memory_bytes"), 10e6 + 27 * 2000.0);
  ASSERT_EQ(run_tool({"run", scene, "--out", folder.path("out"), "--quiet"}).status, 0);
  const json summary = json::parse(read_file(folder.path("out/summary.json")));
  const double was = summary.at("mean_overlap").get<double>() / 10.0;
  const double told = seen.at("stages").at(1).at("overlap").get<double>();
  EXPECT_GT(told, was / 1.5) << was;
  EXPECT_LT(told, was * 1.5) << was;
}

TEST(Check, OfEveryCommittedSceneHasNothingToChange) {
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TANGENCY_SCENES)) {
    const Finished seen = run_tool({"check", entry.path().string()});
    EXPECT_EQ(seen.status, 0) << entry.path() << seen.out << seen.err;
    ++scenes;
  }
  EXPECT_GE(scenes, 16u);
}

/// The scene with a line more in each stage that moves.
std::string in_stages(std::string scene, const std::string& line) {
  for (const char* kind : {"compress", "relax", "shear"}) {
    const std::string head = std::string("kind = \"") + kind + "\"\n";
    if (const std::size_t at = scene.find(head); at != scene.npos)
      scene.insert(at + head.size(), line + "\n");
  }
  return scene;
}

/// A scene of which nothing but that is advised.
struct Meant {
  const char* about;
  std::string scene;
};

// Scene::intends(): at the head for all stages, or in the stage alone.
TEST(Check, DoesNotAdviseAgainstWhatIsIntended) {
  const std::string fast = "axial_strain_rate = 0.5\naxial_strain = 0.1\nmean_stress = 10e6\n";
  const std::vector<Meant> cases{
      {"inertial_number", sheared(fast)},
      {"servo_inertial_number",
       with(small_scene(), "max_strain_rate = 0.05", "max_strain_rate = 5")},
      {"overlap", with(small_scene(), "1.5e10", "1e9")}};
  for (const auto& [about, scene] : cases) {
    const std::string intended = std::string("intended = [\"") + about + "\"]";
    const Finished before = checked(scene);
    EXPECT_EQ(before.status, 1) << about << before.out;
    EXPECT_NE(
        before.out.find("if it is meant so, write in the stage or at the head of the scene: " +
                        intended + "\n1 to change\n"),
        before.out.npos)
        << before.out;
    const Finished at_head = checked(with(scene, "schema = 1\n", "schema = 1\n" + intended + "\n"));
    EXPECT_EQ(at_head.status, 0) << about << at_head.out << at_head.err;
    const Finished in_stage = checked(in_stages(scene, intended));
    EXPECT_EQ(in_stage.status, 0) << about << in_stage.out << in_stage.err;
  }
  // In other stages, or of something else, it does not count.
  EXPECT_EQ(checked(in_stages(small_scene(), "intended = [\"inertial_number\"]") +
                    sheared(fast).substr(small_scene().size()))
                .status,
            1);
  EXPECT_EQ(checked(sheared(fast + "intended = [\"overlap\"]\n")).status, 1);
}

TEST(Check, SaysWhereASceneMayCallItsAdviceIntended) {
  const Finished seen = checked(small_scene(), {"--set", "motion.gravity=[0.0, 0.0, -9.8]"});
  const std::string line =
      "if it is meant so, write at the head of the scene: intended = [\"gravity\"]\n";
  EXPECT_NE(seen.out.find(line), seen.out.npos) << seen.out;
}

TEST(Check, AdvisesTheStepOfContactsThatAreSoftOnPurpose) {
  const std::string soft =
      with(with(small_scene(), "schema = 1\n", "schema = 1\nintended = [\"overlap\"]\n"),
           "normal_stiffness = 1.5e10", "law = \"hertz\"\nyoung_modulus = 1e8");
  const json seen = json::parse(checked(soft, {"--json"}).out);
  EXPECT_TRUE(advice_about(seen, "overlap").is_null()) << seen;
  EXPECT_FALSE(advice_about(seen, "largest_overlap").is_null()) << seen;
  EXPECT_EQ(checked(soft, {"--set", "contact.largest_overlap=0.2"}).status, 0);
}

TEST(Check, ARunDoesNotWarnOfWhatIsIntended) {
  const TemporaryFolder folder;
  const std::string fast =
      sheared("name = \"flow\"\naxial_strain_rate = 0.5\naxial_strain = 0.05\n");
  const auto warnings = [&](const std::string& name, const std::string& scene) {
    return run_tool({"run", folder.write(name + ".toml", scene), "--out", folder.path(name),
                     "--threads", "1"})
        .err;
  };
  for (const auto& [name, more] : {std::pair<std::string, std::string>{"slow", ""},
                                   {"flow", "intended = [\"inertial_number\"]\n"}}) {
    const std::string said = warnings(name, fast + more);
    EXPECT_EQ(said.find("check: stage flow: an inertial number") == said.npos, !more.empty())
        << said;
    EXPECT_EQ(said.find("stage flow ended with inertial fraction") == said.npos, !more.empty())
        << said;
  }
}

TEST(Check, LooksAtEachCombinationOfASweep) {
  const std::string sweep =
      small_scene() + "[sweep]\n\"contact.normal_stiffness\" = [1.5e10, 1e9]\n";
  const Finished seen = checked(sweep);
  EXPECT_EQ(seen.status, 1) << seen.err;
  EXPECT_EQ(seen.out.find("with contact.normal_stiffness = 1e+09\n"), 0u) << seen.out;
  EXPECT_EQ(checked(with(sweep, ", 1e9", ", 1e11")).status, 0);
}

}  // namespace
}  // namespace tangency::testing
