// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem export --lammps`: the script says what a run would do, number by number, and what
/// LAMMPS has not is refused. tests/lammps has LAMMPS do it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/scene.hpp>
#include <tangency/dem/simulation.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

constexpr const char* kScene = R"(schema = 1
[motion]
contacts = "global"
rotation = "simplified"
[particles.grain]
count = 20
mean_radius = 10.0
elongation = 1.4
[particles.stone]
count = 7
mean_radius = 13.0
density = 2650.0
[contact]
normal_stiffness = 1.5e10
shear_stiffness = 1.1e10
friction_coefficient = 0.3
restitution = 0.5
[[stage]]
kind = "place"
[[stage]]
kind = "compress"
mean_stress = 10e6
max_strain_rate = 0.05
friction_coefficient = 0.0
[[stage]]
kind = "relax"
mean_stress = 10e6
max_strain_rate = 0.05
[[stage]]
kind = "shear"
axial_strain_rate = 0.25
axial_strain = 0.1
lateral_stress = 9e6
max_strain_rate = 0.75
[[stage]]
kind = "servo"
name = "ring"
duration = 3000
shear_rate = [0.0, 0.0, 0.125]
plane_mean_stress = 8e6
major_direction = 30.0
max_strain_rate = 0.5
rotational_damping = 0.25
damping = 0.125
[output]
history_interval = 40
frame_interval = 0
checkpoint_interval = 900
)";

/// The lines that begin so, in order.
std::vector<std::string> lines_of(const std::string& script, const std::string& start) {
  std::istringstream lines(script);
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(start, 0) == 0) found.push_back(line);
  return found;
}

/// The number behind a word of a line.
double number_behind(const std::string& line, const std::string& word) {
  const std::size_t at = line.find(" " + word + " ");
  EXPECT_NE(at, line.npos) << line;
  return std::stod(line.substr(at + word.size() + 2));
}

class ExportLammps : public ::testing::Test {
 protected:
  Finished exported(const std::string& text, const std::string& state = "") {
    std::vector<std::string> words{"export", "--lammps", folder_.path("cluster"), "--scene",
                                   folder_.write("study.toml", text)};
    if (!state.empty()) words.push_back(state);
    return run_tool(words);
  }
  std::string script() const { return read_file(folder_.path("cluster/in.study")); }

  TemporaryFolder folder_;
};

TEST_F(ExportLammps, DoesEveryStageWithTheRatesStepsAndStressesOfTheRun) {
  const Finished ended = exported(kScene);
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.err, "");  // bodies that were placed lose nothing
  const std::string script = this->script();
  const auto steps = lines_of(script, "timestep "), loads = lines_of(script, "fix load ");
  const auto moves = lines_of(script, "fix motion "), runs = lines_of(script, "run ");
  ASSERT_EQ(lines_of(script, "# Stage ").size(), 4u);
  ASSERT_EQ(steps.size(), 4u);
  ASSERT_EQ(loads.size(), 4u);
  ASSERT_EQ(moves.size(), 4u);
  dem::Simulation run(dem::parse_scene(kScene, "study.toml"));
  for (std::size_t k = 0; k < 4; ++k, run.next_stage()) {
    EXPECT_EQ(std::stod(steps[k].substr(9)), run.time_step());
    const dem::Drive& drive = *run.stage().drive;
    EXPECT_EQ(number_behind(loads[k], "max"), drive.loading.servo.max_strain_rate);
    EXPECT_EQ(number_behind(loads[k], "gain"), drive.loading.servo.gain);
    EXPECT_NE(moves[k].find("rotation simplified"), moves[k].npos);
    if (!drive.damping) continue;
    const double time =
        dem::characteristic_time(run.state().particles, run.laws().largest_stiffness());
    EXPECT_EQ(number_behind(moves[k], "damping"), *drive.damping / time);
  }
  EXPECT_EQ(number_behind(loads[0], "mean"), 10e6);
  EXPECT_NE(loads[1].find("integral no"), loads[1].npos) << loads[1];
  EXPECT_NE(moves[1].find("damping fire"), moves[1].npos) << moves[1];
  EXPECT_EQ(number_behind(loads[2], "rate zz"), -0.25);
  EXPECT_EQ(number_behind(loads[2], "rate xx"), 0.125);
  EXPECT_EQ(number_behind(loads[2], "x"), 9e6);
  EXPECT_EQ(number_behind(loads[2], "y"), 9e6);
  // Compression is positive in a scene, and both halves of a shear rate are one simple shear.
  EXPECT_EQ(number_behind(loads[3], "rate xz"), -0.25);
  EXPECT_EQ(number_behind(loads[3], "plane"), 8e6);
  EXPECT_NEAR(number_behind(loads[3], "direction"), 30.0, 1e-12);
  EXPECT_EQ(lines_of(script, "change_box all triclinic").size(), 1u);
  EXPECT_EQ(runs.back(), "run 3000");
  EXPECT_EQ(lines_of(script, "thermo 40").size(), 1u);
  EXPECT_EQ(lines_of(script, "restart 900 study.a.restart study.b.restart").size(), 1u);
}

TEST_F(ExportLammps, SetsTheLawsOfEachStageBetweenAllTypes) {
  ASSERT_EQ(exported(kScene).status, 0);
  const auto laws = lines_of(script(), "pair_coeff ");
  ASSERT_EQ(laws.size(), 15u);  // three pairs of types, at the head and of four stages
  const std::string compress =
      "pair_coeff 1 2 hooke 1.5e+10 tangential linear 1.1e+10 0 restitution ";
  EXPECT_EQ(laws[4].rfind(compress, 0), 0u) << laws[4];
  EXPECT_NEAR(number_behind(laws[4], "restitution"), 0.5, 1e-12);
  EXPECT_EQ(laws[8],
            "pair_coeff 2 2 hooke 1.5e+10 tangential linear 1.1e+10 0.3");  // relax: no damper
  EXPECT_EQ(lines_of(script(), "pair_style tangency branch global").size(), 1u);
}

TEST_F(ExportLammps, GoesOnFromAStateAndSaysWhatItLoses) {
  const std::string scene = with(kScene, "name = \"ring\"", "name = \"ring\"\nsave = true");
  const std::string shear = scene.substr(0, scene.find("[[stage]]\nkind = \"relax\""));
  const std::string first = with(shear, "friction_coefficient = 0.0\n", "save = true\n");
  ASSERT_EQ(
      run_tool({"run", folder_.write("first.toml", first), "--out", folder_.path("out"), "--quiet"})
          .status,
      0);
  const std::string whole = with(scene, "friction_coefficient = 0.0\n", "save = true\n");
  const Finished ended = exported(whole, folder_.path("out/final.state"));
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("contacts bear shear forces"), ended.err.npos) << ended.err;
  EXPECT_EQ(lines_of(script(), "# Stage ").size(), 3u);
  EXPECT_EQ(lines_of(script(), "reset_timestep 0").size(), 0u);
}

TEST_F(ExportLammps, RefusesWhatLammpsHasNot) {
  const std::string scene = kScene;
  const std::string unsheared = scene.substr(0, scene.find("[[stage]]\nkind = \"servo\""));
  const std::vector<std::pair<std::string, std::string>> cases{
      {with(unsheared, "[motion]", "[cell]\nwalls = \"z\"\n[motion]"), "cell.walls"},
      {with(scene, "\"global\"", "\"trace\""), "contact.branch"},
      {with(scene, "kind = \"compress\"", "kind = \"grow\"\nelongation = 1.6\nname = \"compress\""),
       "grow"},
      {with(scene, "kind = \"compress\"", "kind = \"compress\"\nramp_cycles = 9"), "ramps"},
      {with(scene, "count = 20", "count = 20\nweight = 3"), "weight"}};
  for (const auto& [text, message] : cases) {
    const Finished ended = exported(text);
    EXPECT_EQ(ended.status, 2) << message;
    EXPECT_NE(ended.err.find(message), ended.err.npos) << ended.err;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  }
  const std::string study = folder_.write("study.toml", scene);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"export"},
           {"export", "--lammps", folder_.path("c")},
           {"export", "--scene", study, "--format", "xyz", study},
           {"export", "--lammps", folder_.path("c"), "--scene", study, "--format", "xyz"}})
    EXPECT_EQ(run_tool(words).status, 2) << words.back();
}

TEST_F(ExportLammps, NamesTheFolderThatCannotBeMade) {
  const std::string taken = folder_.write("taken", "a file\n");
  const Finished ended =
      run_tool({"export", "--lammps", taken, "--scene", folder_.write("study.toml", kScene)});
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.err.find(taken + ": cannot be written: "), 0u) << ended.err;
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_EQ(read_file(taken), "a file\n");
}

}  // namespace
}  // namespace tangency::testing
