// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstddef>
#include <sstream>
#include <string>

#include <tangency/dem/scene.hpp>
#include <tangency/dem/scene/scene_keys.hpp>
#include <tangency/tests/support/patterns.hpp>

#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using tangency::testing::has_pattern;
using tangency::testing::refusal;
using tangency::testing::small_scene;
using tangency::testing::with;

std::string refusal_with(const std::string& before, const std::string& after) {
  return refusal(with(small_scene(), before, after));
}

TEST(Scene, IsReadWithItsValuesAndDefaults) {
  const Scene scene = parse_scene(small_scene(), "scene.toml");
  ASSERT_EQ(scene.particle_types.size(), 1u);
  EXPECT_EQ(scene.particle_types[0].name, "grain");
  EXPECT_EQ(scene.particle_count(), 27u);
  EXPECT_EQ(scene.particle_types[0].batch.shape.elongation, 1.4);
  EXPECT_EQ(scene.particle_types[0].batch.shape.flatness, 1.0);
  EXPECT_EQ(scene.particle_types[0].batch.density, 1000.0);
  const ContactLaw& law = scene.laws.between(0, 0);
  EXPECT_EQ(law.normal_stiffness, 1.5e10);
  EXPECT_EQ(law.shear_stiffness, 1.5e10) << "that of the normal where it is not given";
  EXPECT_EQ(law.friction_coefficient, 0.5);
  ASSERT_EQ(scene.stages.size(), 3u);
  EXPECT_EQ(scene.stages[0].place->jitter, 1e-3);
  EXPECT_EQ(scene.stages[1].drive->loading.targets[0].wanted, 10e6);
  EXPECT_FALSE(scene.stages[1].drive->max_unbalanced_ratio);
  EXPECT_EQ(scene.stages[2].drive->max_unbalanced_ratio, 0.005);
  EXPECT_EQ(scene.stages[2].name, "relax");
  EXPECT_EQ(scene.output.frame, 1000000);
}

TEST(Scene, MayHaveALawForEveryTwoTypes) {
  const std::string two =
      with(small_scene(), "[contact]\nnormal_stiffness = 1.5e10\nfriction_coefficient = 0.5\n",
           "[particles.stone]\ncount = 3\nmean_radius = 4\n"
           "[contact]\nnormal_stiffness = 2e10\nfriction_coefficient = 0.1\n"
           "[contact.stone-grain]\nnormal_stiffness = 3e10\n");
  const Scene scene = parse_scene(two, "scene.toml");
  EXPECT_EQ(scene.laws.between(0, 0).normal_stiffness, 2e10);
  EXPECT_EQ(scene.laws.between(0, 1).normal_stiffness, 3e10);
  EXPECT_EQ(scene.laws.between(1, 0).normal_stiffness, 3e10);
  EXPECT_EQ(scene.laws.between(1, 0).friction_coefficient, 0.1) << "what a pair lacks is common";
}

TEST(Scene, OfSeveralTypesNeedsALawForEveryTwo) {
  EXPECT_EQ(refusal_with("[contact]",
                         "[particles.stone]\ncount = 3\nmean_radius = 4\n"
                         "[contact.stone-stone]"),
            "scene.toml:10: contact.grain-grain is missing: a law for every two types, or one in "
            "[contact] for all");
}

TEST(Scene, AValueOutOfRangeIsNamedWithFileLineKeyAndRange) {
  EXPECT_EQ(refusal_with("count = 27", "count = -1"),
            "scene.toml:4: particles.grain.count = -1: an integer from 1 to 1000000");
  EXPECT_EQ(
      refusal_with("1.5e10", "0.0"),
      "scene.toml:8: contact.normal_stiffness = 0.0: a finite number from 1e-30 to 1e+30 (N/m)");
  EXPECT_EQ(
      refusal_with("= 0.05", "= inf"),
      "scene.toml:15: stage[1].max_strain_rate = inf: a finite number from 1e-30 to 1e+30 (1/s)");
  EXPECT_EQ(refusal_with("mean_stress = 10e6", "mean_stress = nan"),
            "scene.toml:14: stage[1].mean_stress = nan: a finite number from 1e-30 to 1e+30 (Pa)");
  EXPECT_EQ(refusal_with("max_strain_rate", "time_step_factor = 0.31\nmax_strain_rate"),
            "scene.toml:15: stage[1].time_step_factor = 0.31: a finite number > 0 and <= 0.3 "
            "(sqrt(m_min/K_max))");
  EXPECT_EQ(refusal_with("schema = 1", "schema = 2"), "scene.toml:1: schema = 2: an integer 1");
}

TEST(Scene, AWrongTypeIsNamed) {
  EXPECT_EQ(refusal_with("count = 27", "count = 'many'"),
            "scene.toml:4: particles.grain.count = 'many': an integer from 1 to 1000000");
  EXPECT_EQ(refusal_with("count = 27", "count = 27.0"),
            "scene.toml:4: particles.grain.count = 27.0: an integer from 1 to 1000000");
  EXPECT_EQ(refusal_with("[cell]", "[cell]\nsize = [1.0, 2.0]"),
            "scene.toml:3: cell.size = [ 1.0, 2.0 ]: 3 finite numbers from 1e-30 to 1e+30 (m)");
  EXPECT_EQ(refusal_with("[cell]", "cell = 3"), "scene.toml:2: cell = 3: a table");
  EXPECT_EQ(refusal_with("\"compress\"", "7"),
            "scene.toml:13: stage[1].kind = 7: one of place, compress, grow, relax, unload, shear, "
            "servo");
}

TEST(Scene, AnUnknownKeyIsNamedWithThoseThatAreAllowed) {
  EXPECT_EQ(refusal_with("elongation", "colour"),
            "scene.toml:6: particles.grain.colour: no such key; allowed are count, mean_radius, "
            "elongation, flatness, elongations, flatnesses, sizes, size_spread, size_tails, "
            "sieve_openings, sieve_passing, layer, density");
  EXPECT_EQ(refusal_with("[cell]", "[sell]"),
            "scene.toml:2: sell: no such key; allowed are schema, include, intended, units, cell, "
            "motion, particles, wall, body, contact, stage, output, sweep");
  EXPECT_EQ(refusal_with("kind = \"place\"", "kind = \"place\"\nmean_stress = 1.0"),
            "scene.toml:12: stage[0].mean_stress: no such key in a stage of this kind; allowed are "
            "kind, name, save, arrangement, file, seed, jitter, bounding_fraction, "
            "volume_fraction, axes, axes_direction, axes_cone_deg");
  EXPECT_EQ(refusal_with("[contact]", "[contact.grain-stone]"),
            "scene.toml:7: contact.grain-stone: NAME-NAME of two of the scene's particle types");
}

TEST(Scene, AMissingKeyIsNamedWithItsTable) {
  EXPECT_EQ(refusal_with("count = 27\n", ""),
            "scene.toml:3: particles.grain.count is missing: an integer from 1 to 1000000");
  EXPECT_EQ(refusal_with("schema = 1\n", ""), "scene.toml:1: schema is missing: an integer 1");
  EXPECT_EQ(refusal_with("kind = \"place\"\n", ""),
            "scene.toml:10: stage[0].kind is missing: one of place, compress, grow, relax, unload, "
            "shear, servo");
}

TEST(Scene, AMissingSectionIsNamed) {
  EXPECT_EQ(refusal_with("[cell]\n", ""), "") << "all of its keys are optional";
  EXPECT_EQ(refusal("schema = 1\n"),
            "scene.toml:1: particles is missing: at least one table [particles.NAME]");
  EXPECT_EQ(refusal("schema = 1\n[particles]\n"),
            "scene.toml:2: particles = {}: at least one table [particles.NAME]");
  const std::string grain = "schema = 1\n[particles.grain]\ncount = 1\nmean_radius = 1.0\n";
  EXPECT_EQ(refusal(grain),
            "scene.toml:1: contact is missing: a table [contact] for all pairs, or "
            "[contact.NAME-NAME] for each");
  EXPECT_EQ(refusal(grain + "[contact]\nnormal_stiffness = 1.0\n"),
            "scene.toml:1: stage is missing: a list of [[stage]] tables, the first of kind place");
}

TEST(Scene, ASecondLawForTwoTypesIsRefused) {
  const std::string types = "[particles.stone]\ncount = 3\nmean_radius = 4\n";
  const auto pair = [](const std::string& names) {
    return "[contact." + names + "]\nnormal_stiffness = 3e10\n";
  };
  EXPECT_EQ(
      refusal_with("[contact]", types + pair("grain-stone") + pair("stone-grain") + "[contact]"),
      "scene.toml:12: contact.stone-grain: a second law for the two types of "
      "contact.grain-stone; one is allowed");
  EXPECT_EQ(
      refusal_with("[contact]", types + pair("stone-grain") + pair("grain-stone") + "[contact]"),
      "scene.toml:12: contact.grain-stone: a second law for the two types of "
      "contact.stone-grain; one is allowed");
  EXPECT_EQ(refusal_with("[contact]", types + pair("stone-stone") + "[contact]"), "");
}

TEST(Scene, AnAbsurdValueIsRefusedWithWhatIsAllowed) {
  for (const char* absurd : {"1e200", "1e308", "1e-300"}) {
    EXPECT_NE(refusal_with("elongation = 1.4", "elongation = " + std::string(absurd))
                  .find(": a finite number from 1 to 10000"),
              std::string::npos);
    for (const char* given :
         {"stiffness = 1.5e10", "mean_stress = 10e6", "strain_rate = 0.05", "mean_radius = 10.0"}) {
      const std::string key(given, std::string(given).find('=') + 2);
      EXPECT_NE(refusal_with(given, key + absurd).find(": a finite number from 1e-30 to 1e+30 ("),
                std::string::npos)
          << key << absurd;
    }
  }
  EXPECT_NE(refusal_with("[contact]", "[contact]\nshear_stiffness = 1e200")
                .find("scene.toml:8: contact.shear_stiffness = "),
            std::string::npos);
}

TEST(Scene, AStrainRateThatCrushesTheCellInAStepIsRefused) {
  // m = 1000 4/3 pi 10^3, K = 1.5e10: a step of 0.2 sqrt(m/K) is 0.00334 s.
  EXPECT_EQ(refusal_with("strain_rate = 0.05", "strain_rate = 30.0"),
            "scene.toml:15: stage[1].max_strain_rate = 30.0: a finite number < 29.9 (1/s), a "
            "strain of 0.1 a time step");
  EXPECT_EQ(refusal_with("strain_rate = 0.05", "strain_rate = 29.0"), "");
  EXPECT_EQ(refusal_with("strain_rate = 0.05", "strain_rate = 30.05")
                .find("scene.toml:15: stage[1].max_strain_rate = 30.05: "),
            0u);
}

TEST(Scene, ADampingThatTurnsVelocitiesRoundIsRefused) {
  const std::string both = "kind = \"compress\"\ntime_step_factor = 0.25\ndamping = ";
  EXPECT_EQ(refusal_with("kind = \"compress\"", both + "8.5"),
            "scene.toml:15: stage[1].damping = 8.5: with time_step_factor = 0.25 a finite number "
            "<= 8: a step that damps more would turn velocities round");
  EXPECT_EQ(refusal_with("kind = \"compress\"", both + "8.0"), "");
}

TEST(Scene, AStageOfAnotherKindOrOutOfPlaceIsRefused) {
  EXPECT_EQ(refusal_with("\"compress\"", "\"melt\""),
            "scene.toml:13: stage[1].kind = 'melt': one of place, compress, grow, relax, unload, "
            "shear, servo");
  EXPECT_EQ(refusal_with("\"compress\"", "\"place\""),
            "scene.toml:13: stage[1].kind = 'place': only the first stage may be of kind place");
  EXPECT_EQ(refusal_with("kind = \"place\"\n[[stage]]\n", ""),
            "scene.toml:11: stage[0].kind = 'compress': the first stage must be of kind place");
}

TEST(Scene, OfThePlaneHasNeitherFlatnessNorAThirdEdge) {
  const std::string plane = with(small_scene(), "[cell]", "[cell]\ndimensions = 2");
  EXPECT_EQ(refusal(plane), "");
  EXPECT_EQ(parse_scene(plane, "scene.toml").dimensions, 2);
  EXPECT_EQ(refusal_with("[cell]", "[cell]\ndimensions = 4"),
            "scene.toml:3: cell.dimensions = 4: an integer from 2 to 3");
  EXPECT_EQ(
      refusal(with(plane, "dimensions = 2", "dimensions = 2\nsize = [900, 900, 900]")),
      "scene.toml:4: cell.size = [ 900, 900, 900 ]: with dimensions = 2 the third edge is the "
      "unit thickness, 1");
  EXPECT_EQ(refusal(with(plane, "dimensions = 2", "dimensions = 2\nsize = [90, 90, 1]")),
            "scene.toml:4: cell.size = [ 90, 90, 1 ]: a square lattice in it has 9 sites, fewer "
            "than the 27 particles");
  EXPECT_EQ(refusal(with(plane, "elongation = 1.4", "flatness = 1.1")),
            "scene.toml:7: particles.grain.flatness = 1.1: with dimensions = 2 it is 1");
}

TEST(Scene, WithoutRoomForARandomPlacementIsRefused) {
  const std::string place = "kind = \"place\"\narrangement = \"random\"";
  const std::string random = with(small_scene(), "kind = \"place\"", place);
  EXPECT_EQ(refusal(random), "");
  EXPECT_EQ(refusal(with(random, "\"random\"", "\"random\"\nbounding_fraction = 0.4")),
            "scene.toml:13: stage[0].bounding_fraction = 0.4: a finite number > 0 and <= 0.3 with "
            "dimensions = 3");
  EXPECT_EQ(refusal(with(random, "[cell]", "[cell]\nsize = [80, 80, 80]"))
                .find("scene.toml:3: cell.size = [ 80, 80, 80 ]: bounding spheres would fill 0."),
            0u);
  EXPECT_EQ(
      refusal(with(random, "[cell]", "[cell]\nsize = [800, 800, 20]"))
          .find("scene.toml:3: cell.size = [ 800, 800, 20 ]: an edge of it is shorter than the "
                "largest particle, 2"),
      0u);
  EXPECT_EQ(
      refusal(with(random, "random", "heap")),
      "scene.toml:12: stage[0].arrangement = 'heap': one of lattice, random, insertion, explicit");
}

TEST(Scene, ThatGrowsNeedsAShapeAndIncrementsThatAreSmall) {
  const auto growing = [](const std::string& keys) {
    return refusal_with("kind = \"compress\"\n", "kind = \"grow\"\n" + keys);
  };
  EXPECT_EQ(growing("elongation = 1.5\n"), "");
  EXPECT_EQ(growing(""),
            "scene.toml:12: stage[1].elongation is missing: a finite number from 1 to 10000");
  EXPECT_EQ(growing("elongation = 0.7\n"),
            "scene.toml:14: stage[1].elongation = 0.7: a finite number from 1 to 10000");
  EXPECT_EQ(
      growing("elongation = 1.5\nincrements = 2\n"),
      "scene.toml:15: stage[1].increments = 2: 5 or more: an increment would change a semi-axis "
      "by 0.0237 of itself, and at most 0.01 is allowed");
  EXPECT_TRUE(has_pattern(growing("elongation = 9000.0\n"),
                          "^scene.toml:12: stage\\[1\\].increments = 200: [0-9]+ or more: "))
      << growing("elongation = 9000.0\n");
  EXPECT_EQ(refusal_with("kind = \"compress\"", "kind = \"compress\"\nelongation = 1.5")
                .find("scene.toml:14: stage[1].elongation: no such key in a stage of this kind"),
            0u);
}

TEST(Scene, ThatDoesNotFitItsCellIsRefused) {
  EXPECT_EQ(refusal_with("[cell]", "[cell]\nsize = [50, 50, 50]"),
            "scene.toml:3: cell.size = [ 50, 50, 50 ]: a cubic lattice in it has 1 sites, fewer "
            "than the 27 particles");
}

TEST(Scene, ThatIsNoTomlIsRefusedWithItsLine) {
  const std::string message = refusal_with("count = 27", "count = = 27");
  EXPECT_EQ(message.substr(0, 24), "scene.toml:4: not TOML: ") << message;
  EXPECT_EQ(message.find('\n'), message.npos);
}

TEST(Scene, PassesItsOwnTableOfKeys) {
  for (const char* name :
       {"assembly-27", "assembly-125", "assembly-1000", "plane-1000", "impact", "slope",
        "settle-1000", "packing-1000", "isotropic-packing", "triaxial-drained",
        "triaxial-undrained", "oedometer", "simple-shear", "plane-shear"})
    EXPECT_NO_THROW(load_scene(std::string(TANGENCY_SCENES) + "/" + name + ".toml")) << name;
}

TEST(SceneKeys, ThatHaveADefaultHaveOneThatTheyAllow) {
  for (const Key& key : scene_keys())
    if (key.has_default() && key.type == KeyType::text) {
      EXPECT_TRUE(is_among(key.fallback, key.choices)) << key.name;
    } else if (key.has_default() && key.type == KeyType::boolean) {
      EXPECT_TRUE(key.fallback == "true" || key.fallback == "false") << key.name;
    } else if (key.has_default()) {
      EXPECT_TRUE(key.range.holds(std::stod(std::string(key.fallback)))) << key.name;
    }
}

TEST(SceneKeys, AreAllPrintedWithUnitAndDefault) {
  std::ostringstream out;
  print_schema(out);
  std::istringstream lines(out.str());
  std::size_t found = 0;
  std::string line;
  for (const Key& key : scene_keys()) {
    while (std::getline(lines, line) && line.find("  " + std::string(key.name) + " ") != 0) {
    }
    ASSERT_TRUE(lines) << key.name;
    EXPECT_NE(line.find(key.unit), line.npos);
    EXPECT_NE(line.find(key.required() ? "required" : key.fallback), line.npos) << line;
    EXPECT_NE(line.find(key.meaning), line.npos);
    ++found;
  }
  EXPECT_EQ(found, scene_keys().size());
}

}  // namespace
