// SPDX-License-Identifier: GPL-3.0-or-later
// Types of particles that are not all alike, as scenes have them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/samples/sample.hpp>
#include <tangency/dem/scene.hpp>
#include <tangency/dem/simulation.hpp>

#include "scenes.hpp"

namespace tangency::testing {
namespace {

/// The small scene with these keys in place of the mean radius.
std::string with_sizes(const std::string& keys) {
  return with(small_scene(), "mean_radius = 10.0\n", keys);
}
std::string with_ratios(const std::string& keys) {
  return with(small_scene(), "elongation = 1.4\n", keys);
}

struct Refused {
  const char* what;
  std::string scene, message;
};

TEST(ParticleSizes, ThatCannotBeAreRefusedWithLineAndKey) {
  const std::string sieve = "sizes = \"sieve\"\nsieve_openings = [1.0, 2.0]\n";
  const std::vector<Refused> all{
      {"no radius", with_sizes(""),
       "scene.toml:3: particles.grain.mean_radius is missing: a finite number from 1e-30 to 1e+30 "
       "(m)"},
      {"no spread", with_sizes("mean_radius = 1.0\nsizes = \"normal\"\n"),
       "scene.toml:3: particles.grain.size_spread is missing: a finite number > 0 and <= 2"},
      {"an unknown rule", with_sizes("mean_radius = 1.0\nsizes = \"weibull\"\n"),
       "scene.toml:6: particles.grain.sizes = 'weibull': one of equal, uniform, normal, lognormal, "
       "sieve"},
      {"a spread of equal ones", with_sizes("mean_radius = 1.0\nsize_spread = 0.1\n"),
       "scene.toml:6: particles.grain.size_spread = 0.1: with sizes = uniform, normal or lognormal "
       "alone"},
      {"tails of uniform ones",
       with_sizes("mean_radius = 1.0\nsizes = \"uniform\"\nsize_spread = 0.1\nsize_tails = 0.1\n"),
       "scene.toml:8: particles.grain.size_tails = 0.1: with sizes = normal or lognormal alone"},
      {"a width to below 0",
       with_sizes("mean_radius = 1.0\nsizes = \"uniform\"\nsize_spread = 1.0\n"),
       "scene.toml:7: particles.grain.size_spread = 1.0: below 1 with sizes = \"uniform\""},
      {"a deviation to below 0",
       with_sizes("mean_radius = 1.0\nsizes = \"normal\"\nsize_spread = 0.5\n"),
       "scene.toml:7: particles.grain.size_spread = 0.5: below 0.487 with sizes = \"normal\" and "
       "size_tails = 0.02: radii are > 0"},
      {"a sieve curve without shares", with_sizes(sieve),
       "scene.toml:3: particles.grain.sieve_passing is missing: a list of finite numbers from 0 to "
       "1"},
      {"a radius of a sieve curve",
       with_sizes("mean_radius = 1.0\n" + sieve + "sieve_passing = [0.0, 1.0]\n"),
       "scene.toml:5: particles.grain.mean_radius = 1.0: not with sizes = \"sieve\""},
      {"a curve that does not end at 1", with_sizes(sieve + "sieve_passing = [0.0, 0.9]\n"),
       "scene.toml:7: particles.grain.sieve_passing = [ 0.0, 0.9 ]: one number an opening, "
       "ascending from 0 to 1"},
      {"openings that do not ascend",
       with_sizes("sizes = \"sieve\"\nsieve_openings = [2.0, 1.0]\nsieve_passing = [0.0, 1.0]\n"),
       "scene.toml:6: particles.grain.sieve_openings = [ 2.0, 1.0 ]: 2 numbers or more, ascending "
       "(m)"},
      {"a curve of equal ones", with_sizes("mean_radius = 1.0\nsieve_passing = [0.0, 1.0]\n"),
       "scene.toml:6: particles.grain.sieve_passing = [ 0.0, 1.0 ]: with sizes = \"sieve\" alone"},
      {"two elongations", with_ratios("elongation = 1.4\nelongations = [1.0, 2.0]\n"),
       "scene.toml:6: particles.grain.elongation = 1.4: not together with elongations"},
      {"three ends", with_ratios("flatnesses = [1.0, 2.0, 3.0]\n"),
       "scene.toml:6: particles.grain.flatnesses = [ 1.0, 2.0, 3.0 ]: 2 numbers, ascending"},
      {"a layer of a lattice", with_ratios("layer = [0.0, 0.5]\n"),
       "scene.toml:11: stage[0].kind = 'place': arrangement = \"insertion\" with "
       "particles.grain.layer"},
      {"a layer upside down", with_ratios("layer = [0.5, 0.1]\n"),
       "scene.toml:6: particles.grain.layer = [ 0.5, 0.1 ]: 2 numbers, ascending"},
  };
  for (const Refused& one : all) EXPECT_EQ(refusal(one.scene), one.message) << one.what;
}

TEST(Insertion, KeysThatDoNotGoTogetherAreRefused) {
  const std::string place = "kind = \"place\"\n";
  EXPECT_EQ(
      refusal(with(small_scene(), place, place + "volume_fraction = 0.2\n")),
      "scene.toml:12: stage[0].volume_fraction = 0.2: with arrangement = \"insertion\" alone");
  const std::string inserted = with(small_scene(), place, place + "arrangement = \"insertion\"\n");
  EXPECT_EQ(refusal(inserted), "");
  EXPECT_EQ(
      refusal(with(with(inserted, "\"insertion\"\n", "\"insertion\"\nvolume_fraction = 0.3\n"),
                   "[cell]\n", "[cell]\nsize = [90.0, 90.0, 90.0]\n")),
      "scene.toml:14: stage[0].volume_fraction = 0.3: without cell.size alone");
  EXPECT_EQ(refusal(with(inserted, "\"insertion\"\n", "\"insertion\"\nvolume_fraction = 0.6\n")),
            "scene.toml:13: stage[0].volume_fraction = 0.6: a finite number > 0 and <= 0.5");
  EXPECT_EQ(refusal(with(inserted, "[cell]\n", "[cell]\nsize = [50.0, 50.0, 50.0]\n")),
            "scene.toml:3: cell.size = [ 50.0, 50.0, 50.0 ]: the particles would fill 0.904779 of "
            "it, more than 0.5");
}

TEST(ParticleSizes, ThatDifferDoNotGrow) {
  const std::string grow =
      "[[stage]]\nkind = \"grow\"\nelongation = 2.0\nmean_stress = 1e6\nmax_strain_rate = 0.05\n"
      "[output]\n";
  const std::string scene =
      with_sizes("mean_radius = 1.0\nsizes = \"uniform\"\nsize_spread = 0.1\n");
  EXPECT_EQ(refusal(scene), "");
  EXPECT_NE(
      refusal(with(scene, "[output]\n", grow))
          .find("kind = 'grow': none that grows: the bodies of particles.grain are not alike"),
      std::string::npos);
}

/// The small scene of a sieve curve, inserted.
std::string sieved() {
  return with(with_sizes("sizes = \"sieve\"\nsieve_openings = [8.0, 12.0, 24.0]\n"
                         "sieve_passing = [0.0, 0.4, 1.0]\n"),
              "kind = \"place\"\n", "kind = \"place\"\narrangement = \"insertion\"\n");
}

TEST(ParticleSizes, OfASceneAreThoseOfTheSimulationInAnyOrder) {
  const dem::Scene scene = dem::parse_scene(sieved(), "scene.toml");
  const dem::Batch& batch = scene.particle_types.front().batch;
  ASSERT_EQ(batch.shapes.size(), 27u);
  const dem::Simulation simulation(scene);
  std::vector<double> wanted, found;
  for (const dem::Shape& shape : batch.shapes) wanted.push_back(shape.mean_radius);
  for (const Vec3& axes : simulation.state().particles.semi_axes)
    found.push_back(dem::mean_radius_of(axes));
  std::sort(found.begin(), found.end());
  std::sort(wanted.begin(), wanted.end());
  EXPECT_LT(wanted.front(), 0.7 * wanted.back());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-13);
}

TEST(ParticleSizes, OfAStateAreHeldAgainstTheScenes) {
  const dem::Scene scene = dem::parse_scene(sieved(), "scene.toml");
  const dem::Simulation simulation(scene);
  EXPECT_NO_THROW(dem::Simulation(scene, simulation.state()));
  const dem::Scene other = dem::parse_scene(with(sieved(), "24.0", "25.0"), "scene.toml");
  EXPECT_THROW(dem::Simulation(other, simulation.state()), std::invalid_argument);
}

// The step goes by the lightest body and, by Hertz, by the stiffest contact: that of the largest.
TEST(ParticleSizes, OfHertzContactsMakeTheLargestStiffness) {
  const std::string hertz = "law = \"hertz\"\nyoung_modulus = 1e9\n";
  const auto stiffness = [&](const std::string& sizes) {
    return dem::parse_scene(with(with_sizes(sizes), "normal_stiffness = 1.5e10\n", hertz),
                            "scene.toml")
        .laws.largest_stiffness();
  };
  const double spread = stiffness("mean_radius = 10.0\nsizes = \"uniform\"\nsize_spread = 0.5\n");
  const double largest = 10.0 * (1.0 + 0.5 * (2.0 * 26.5 / 27.0 - 1.0));
  EXPECT_NEAR(spread, stiffness("mean_radius = " + std::to_string(largest) + "\n"), 1e-6 * spread);
}

}  // namespace
}  // namespace tangency::testing
