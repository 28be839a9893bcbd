// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes of several files, keys that are set from outside, and sweeps, before anything runs: what
/// they come to, and what is refused in which words.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/scene/scene_file.hpp>
#include <tangency/dem/simulation.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

using dem::Scene;
using dem::SceneError;
using dem::SceneFile;

/// The message of what is refused; "" where nothing is.
template <class Call>
std::string refused(const Call& call) {
  try {
    call();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

Scene scene_with(const std::vector<std::string>& assignments) {
  SceneFile file(small_scene(), "scene.toml");
  for (const std::string& one : assignments) file.set(one);
  return file.scene();
}

std::string refused_setting(const std::string& assignment) {
  return refused([&] { scene_with({assignment}); });
}

TEST(Setting, HoldsInPlaceOfTheFilesKey) {
  const Scene scene =
      scene_with({"particles.grain.count=64", "contact.friction_coefficient=0.25",
                  "stage.compress.mean_stress=2e6", "stage[2].max_strain_rate=0.125",
                  "stage.place.arrangement=random", "cell.walls=\"z\"",
                  "contact.grain-wall.normal_stiffness=3e9", "motion.gravity=[0, 0, -9.5]"});
  EXPECT_EQ(scene.particle_types[0].batch.count, 64u);
  EXPECT_EQ(scene.laws.law[0].friction_coefficient, 0.25);
  EXPECT_EQ(scene.laws.law[1].normal_stiffness, 3e9);
  EXPECT_EQ(scene.stages[1].drive->loading.targets[0].wanted, 2e6);
  EXPECT_EQ(scene.stages[2].drive->loading.targets[0].wanted, 10e6);
  EXPECT_EQ(scene.stages[2].drive->loading.servo.max_strain_rate, 0.125);
  EXPECT_EQ(scene.stages[0].place->arrangement, dem::Arrangement::random);
  EXPECT_TRUE(scene.walled[2]);
  EXPECT_EQ(scene.gravity[2], -9.5);
}

TEST(Setting, GivesSeveralKeysOneValue) {
  const Scene scene = scene_with({"stage.compress.mean_stress, stage.relax.mean_stress=3e6"});
  for (const std::size_t k : {1u, 2u})
    EXPECT_EQ(scene.stages[k].drive->loading.targets[0].wanted, 3e6) << k;
}

// dem/scene/scene_file.hpp (1)
TEST(Setting, IsCheckedByTheTableOfKeysAndNamedAsItWasGiven) {
  EXPECT_EQ(refused_setting("particles.grain.count=-1"),
            "--set particles.grain.count=-1: particles.grain.count = -1: an integer from 1 to "
            "1000000");
  EXPECT_EQ(refused_setting("stage.compress.mean_stress=many"),
            "--set stage.compress.mean_stress=many: stage[1].mean_stress = 'many': a finite number "
            "from 1e-30 to 1e+30 (Pa)");
  EXPECT_EQ(refused_setting("output.frames=3").substr(0, 45),
            "--set output.frames=3: output.frames: no such");
  EXPECT_EQ(refused_setting("motion.gravity=[1, nan, 0]"),
            "--set motion.gravity=[1, nan, 0]: motion.gravity = [ 1, nan, 0 ]: 3 finite numbers "
            "from -1e+30 to 1e+30 (m/s^2)");
}

TEST(Setting, OfWhatIsNotThereIsRefusedWithWhatIs) {
  EXPECT_EQ(refused_setting("stage.shear.duration=3"),
            "--set stage.shear.duration=3: stage.shear: no such stage; there are place, compress, "
            "relax");
  EXPECT_EQ(refused_setting("stage[3].duration=3"),
            "--set stage[3].duration=3: stage[3]: stage[N], wall[N] or body[N] with N from 0 to "
            "less than their number");
  EXPECT_EQ(refused_setting("particles.stone.count=3"),
            "--set particles.stone.count=3: particles.stone: no such particle type in the scene");
  for (const char* wrong : {"friction=3", "contact=3", "a.b.c.d=3", "=3", "stage.place.seed", ""})
    EXPECT_EQ(refused_setting(wrong).find(std::string("--set ") + wrong + ": "), 0u)
        << refused_setting(wrong);
  SceneFile twice(with(small_scene(), "kind = \"relax\"", "kind = \"compress\""), "scene.toml");
  EXPECT_EQ(refused([&] { twice.set("stage.compress.mean_stress=1e6"); }),
            "--set stage.compress.mean_stress=1e6: stage.compress: two stages have this name; "
            "stage[N].KEY, N from 0");
}

TEST(Setting, OfATextWithQuotesIsTheTextAndOfNoTextIsRefused) {
  EXPECT_EQ(refused_setting("cell.walls=it's"),
            "--set cell.walls=it's: cell.walls = \"it's\": one of none, x, y, z, xy, xz, yz, xyz");
  EXPECT_EQ(refused_setting("cell.walls=\xff"),
            "--set cell.walls=\xff: a value as TOML writes it, or a line of UTF-8");
  EXPECT_EQ(refused_setting("cell.walls=a\x01").find("--set cell.walls=a?: cell.walls = "), 0u)
      << refused_setting("cell.walls=a\x01");
}

// A text may hold no second line that would be another key.
TEST(Setting, CannotBringMoreThanOneKey) {
  EXPECT_NE(refused_setting("particles.grain.count=3\nmean_radius = 4.0"), "");
  EXPECT_NE(refused_setting("stage.place.name=a\nb"), "");
}

TEST(Include, JoinsTablesKeyByKeyAndListsInOrder) {
  const TemporaryFolder folder;
  folder.write("base.toml", small_scene());
  folder.write("rough.toml", "[contact]\nfriction_coefficient = 0.75\n");
  const std::string file = folder.write(
      "scene.toml",
      "include = [\"base.toml\", \"rough.toml\"]\nschema = 1\n[particles.grain]\ncount = 8\n"
      "[[stage]]\nkind = \"shear\"\naxial_strain_rate = 0.01\naxial_strain = 0.1\n");
  const Scene scene = SceneFile(file).scene();
  EXPECT_EQ(scene.particle_types[0].batch.count, 8u);
  EXPECT_EQ(scene.particle_types[0].batch.shape.elongation, 1.4);
  EXPECT_EQ(scene.laws.law[0].friction_coefficient, 0.75);
  EXPECT_EQ(scene.laws.law[0].normal_stiffness, 1.5e10);
  ASSERT_EQ(scene.stages.size(), 4u);
  EXPECT_EQ(scene.stages[1].name, "compress");
  EXPECT_EQ(scene.stages[3].name, "shear");
}

TEST(Include, NamesTheFileThatAKeyStandsIn) {
  const TemporaryFolder folder;
  const std::string base =
      folder.write("base.toml", with(small_scene(), "count = 27", "count = 0"));
  const std::string file = folder.write("scene.toml", "schema = 1\ninclude = \"base.toml\"\n");
  EXPECT_EQ(refused([&] { SceneFile(file).scene(); }),
            base + ":4: particles.grain.count = 0: an integer from 1 to 1000000");
}

TEST(Include, RefusesACircleAndAMissingFile) {
  const TemporaryFolder folder;
  const std::string one = folder.write("one.toml", "schema = 1\ninclude = \"two.toml\"\n");
  const std::string two = folder.write("two.toml", "include = \"one.toml\"\n");
  EXPECT_EQ(refused([&] { SceneFile file(one); }),
            two + ":1: include = 'one.toml': a file that does not lead back to this one");
  const std::string lost = folder.write("lost.toml", "schema = 1\ninclude = \"none.toml\"\n");
  EXPECT_EQ(refused([&] { SceneFile file(lost); }),
            lost + ":2: include = 'none.toml': a file that can be read; " +
                folder.path("none.toml") + ": cannot be read: No such file or directory");
  std::filesystem::create_symlink("loop.toml", folder.path("loop.toml"));
  const std::string round = folder.write("round.toml", "schema = 1\ninclude = \"loop.toml\"\n");
  EXPECT_EQ(refused([&] { SceneFile file(round); }),
            round + ":2: include = 'loop.toml': a file that can be read; " +
                folder.path("loop.toml") + ": cannot be read: Too many levels of symbolic links");
}

TEST(Include, OfAFileOverTwoWaysTakesItOnceWhereItIsFirst) {
  const TemporaryFolder folder;
  folder.write("base.toml", small_scene());
  folder.write("rough.toml", "include = \"base.toml\"\n[contact]\nfriction_coefficient = 0.75\n");
  folder.write("soft.toml", "include = \"./base.toml\"\n[contact]\nnormal_stiffness = 1e9\n");
  const std::string file = folder.write(
      "scene.toml", "schema = 1\ninclude = [\"rough.toml\", \"soft.toml\", \"rough.toml\"]\n");
  const Scene scene = SceneFile(file).scene();
  EXPECT_EQ(scene.stages.size(), 3u);
  EXPECT_EQ(scene.laws.law[0].friction_coefficient, 0.75) << "base.toml comes before rough.toml";
  EXPECT_EQ(scene.laws.law[0].normal_stiffness, 1e9);
}

// Each of thirty files names the next twice: by their ways there are 2^30.
TEST(Include, CountsFilesAndNotTheWaysToThem) {
  const TemporaryFolder folder;
  for (int k = 0; k < 30; ++k) {
    const std::string next = "\"f" + std::to_string(k + 1) + ".toml\"";
    folder.write("f" + std::to_string(k) + ".toml", "include = [" + next + ", " + next + "]\n");
  }
  folder.write("f30.toml", small_scene());
  EXPECT_EQ(SceneFile(folder.path("f0.toml")).scene().stages.size(), 3u);
}

TEST(Include, OfMoreFilesThanAnyoneKeepsIsRefused) {
  const TemporaryFolder folder;
  std::string list;
  for (int k = 0; k <= 1000; ++k) {
    const std::string name = "f" + std::to_string(k) + ".toml";
    folder.write(name, "schema = 1\n");
    list += "\"" + name + "\", ";
  }
  const std::string file = folder.write("scene.toml", "include = [" + list + "]\n");
  EXPECT_NE(refused([&] { SceneFile all(file); }).find(": at most 1000 files in all"),
            std::string::npos);
}

std::string sweeping(const std::string& table) { return small_scene() + "[sweep]\n" + table; }

TEST(Sweep, HasTheProductOfItsValuesTheLastKeyFirst) {
  const SceneFile file(sweeping("\"stage.place.seed\" = [1, 2]\n"
                                "contact.friction_coefficient = [0.1, 0.25, 0.5]\n"),
                       "scene.toml");
  const auto sweep = file.sweep();
  ASSERT_TRUE(sweep);
  ASSERT_EQ(sweep->combinations(), 6u);
  const auto fifth = sweep->combination(4);
  ASSERT_EQ(fifth.size(), 2u);
  EXPECT_EQ(fifth[0].keys, "stage.place.seed");
  EXPECT_EQ(fifth[0].value, "2");
  EXPECT_EQ(fifth[1].keys, "contact.friction_coefficient");
  EXPECT_EQ(fifth[1].value, "0.25");
  EXPECT_EQ(sweep->axes[1].line, 24u);
}

TEST(Sweep, RefusesWhatIsNoListAndAKeyTwice) {
  const auto of = [](const std::string& table) {
    return refused([&] { SceneFile(sweeping(table), "scene.toml").scene(); });
  };
  EXPECT_EQ(of("\"a.b\" = 3\n"), "scene.toml:23: sweep.a.b = 3: a list of values");
  EXPECT_EQ(of("\"a.b\" = []\n"), "scene.toml:23: sweep.a.b = []: a list of values");
  EXPECT_EQ(of("\"a.b\" = [{c = 1}]\n").substr(0, 23), "scene.toml:23: sweep.a.");
  EXPECT_EQ(of("\"a.b, a.c\" = [1]\n\"a.c\" = [2]\n"),
            "scene.toml:24: sweep.a.c: each key once; a.c stands in it twice");
  EXPECT_EQ(of(""), "scene.toml:22: sweep: a list of values for one key or more");
  EXPECT_EQ(of("after = 3\n"),
            "scene.toml:23: sweep.after = 3: a name of letters, digits and underscores");
}

// dem/scene/scene_file.hpp (2)
TEST(SceneText, ReadsBackToTheSameSample) {
  SceneFile file(sweeping("\"stage.place.seed\" = [1, 2]\n"), "scene.toml");
  file.set("stage.place.jitter=0.1");
  const std::string text = file.text(".");
  EXPECT_EQ(text.find("sweep"), text.npos);
  const SceneFile again(text, "again.toml");
  EXPECT_EQ(again.text("."), text);
  const auto hash = [](const SceneFile& one) {
    return state_hash(dem::Simulation(one.scene()).state());
  };
  EXPECT_EQ(hash(again), hash(file));
  EXPECT_NE(hash(again), hash(SceneFile(small_scene(), "scene.toml")));
}

TEST(SceneText, LeadsToTheSameFilesFromAnotherFolder) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "scene.toml", with(small_scene(), "kind = \"place\"\n",
                         "kind = \"place\"\narrangement = \"explicit\"\nfile = \"grains.csv\"\n"));
  const std::string text = SceneFile(scene).text(folder.path("out/a=1"));
  EXPECT_NE(text.find("file = '../../grains.csv'"), text.npos) << text;
}

}  // namespace
}  // namespace tangency::testing
