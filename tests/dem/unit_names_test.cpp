// SPDX-License-Identifier: GPL-3.0-or-later
/// [units] of a scene: names alone. They stand in summary.json and in the report; without them no
/// unit is named anywhere, and with them the run is the same to the bit.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/scene/units.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

std::string in_millimetres() {
  return with(small_scene(), "[cell]\n", "[units]\nlength = \"mm\"\nstress = \"kPa\"\n[cell]\n");
}

/// The state's hash, the table of the report, and its page without the view's program.
struct Reported {
  nlohmann::json summary;
  std::string table, page;

  Reported(const TemporaryFolder& folder, const std::string& name, const std::string& scene) {
    const std::string out = folder.path(name);
    const Finished run =
        run_tool({"run", folder.write(name + ".toml", scene), "--out", out, "--quiet"});
    EXPECT_EQ(run.status, 0) << run.err;
    summary = nlohmann::json::parse(read_file(out + "/summary.json"));
    const Finished report = run_tool({"report", out});
    EXPECT_EQ(report.status, 0) << report.err;
    table = report.out;
    page = read_file(out + "/report.html");
    for (std::size_t at = 0; (at = page.find("<script", at)) != page.npos;)
      page.erase(at, page.find("</script>", at) + 9 - at);
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

// What a prefix is worth: force = stress length^2, energy = stress length^3.
TEST(UnitNames, OfForceAndEnergyFollowFromLengthAndStress) {
  const std::vector<std::pair<std::string, double>> lengths{
      {"um", -6}, {"mm", -3}, {"m", 0}, {"km", 3}};
  const std::vector<std::pair<std::string, double>> stresses{
      {"Pa", 0}, {"kPa", 3}, {"MPa", 6}, {"GPa", 9}};
  const std::string prefixes = "afpnum kMG";
  int named = 0;
  for (const auto& [length, l] : lengths)
    for (const auto& [stress, s] : stresses) {
      const auto units = dem::units_of(length, stress, "s");
      const double energy = s + 3 * l;
      EXPECT_EQ(units.has_value(), energy <= 9) << length << " " << stress;
      if (!units) continue;
      ++named;
      const auto power = [&](const std::string& name, char unit) {
        EXPECT_EQ(name.back(), unit) << name;
        return 3.0 * (double(prefixes.find(name.size() == 2 ? name[0] : ' ')) - 6.0);
      };
      EXPECT_EQ(power(units->force, 'N'), s + 2 * l) << length << " " << stress;
      EXPECT_EQ(power(units->energy, 'J'), energy) << length << " " << stress;
    }
  EXPECT_EQ(named, 13);
  EXPECT_FALSE(dem::units_of("inch", "Pa", "s"));
  EXPECT_FALSE(dem::units_of("m", "psi", "s"));
  EXPECT_FALSE(dem::units_of("m", "Pa", "h"));
}

/// "NAME unit" of each array of a .vtp file that has a key UNITS_LABEL.
std::set<std::string> labelled(const std::string& file) {
  const std::string key = "<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">";
  std::set<std::string> found;
  for (std::size_t at = file.find(key); at != file.npos; at = file.find(key, at + 1)) {
    const std::size_t name = file.rfind("Name=\"", at) + 6, unit = at + key.size();
    found.insert(file.substr(name, file.find('"', name) - name) + " " +
                 file.substr(unit, file.find('<', unit) - unit));
  }
  return found;
}

TEST(UnitNames, OfTheSceneStandAtTheArraysOfFrames) {
  const TemporaryFolder folder;
  const auto frame = [&](const std::string& scene, const std::string& ending) {
    const std::string out = folder.path("out");
    const Finished run = run_tool(
        {"run",
         folder.write("scene.toml", with(scene, "[output]\n", "[output]\ncontact_frames = true\n")),
         "--out", out, "--quiet", "--replace"});
    EXPECT_EQ(run.status, 0) << run.err;
    const nlohmann::json summary = nlohmann::json::parse(read_file(out + "/summary.json"));
    return labelled(
        read_file(out + "/frames/" + std::to_string(summary.at("cycle").get<int>()) + ending));
  };
  using Labels = std::set<std::string>;
  const std::string named = in_millimetres();
  EXPECT_EQ(frame(named, ".vtp"),
            (Labels{"Points mm", "axes mm", "cell mm", "semi_axes mm", "velocity mm/s"}));
  EXPECT_EQ(frame(named, ".contacts.vtp"),
            (Labels{"Points mm", "normal_force mN", "force mN", "shear_force mN", "velocity mm/s",
                    "gap mm", "curvature 1/mm"}));
  EXPECT_EQ(frame(named, ".chains.vtp"),
            (Labels{"Points mm", "normal_force mN", "force_size mN", "shear_size mN"}));
  for (const char* ending : {".vtp", ".contacts.vtp", ".chains.vtp"})
    EXPECT_EQ(frame(small_scene(), ending), Labels()) << ending;
}

TEST(UnitNames, OfTheSceneStandInSummaryTableAndPageAndChangeNoBit) {
  const TemporaryFolder folder;
  const Reported with_names(folder, "with", in_millimetres());
  const nlohmann::json expected{
      {"length", "mm"}, {"stress", "kPa"}, {"time", "s"}, {"force", "mN"}, {"energy", "uJ"}};
  EXPECT_EQ(with_names.summary.at("units"), expected);
  EXPECT_TRUE(has(with_names.table, "mean stress (kPa)")) << with_names.table;
  for (const char* part : {"<br>kPa<", "kPa)</text>", "uJ)</text>", "time (s)</text>", "force mN",
                           "data-force=\"mN\""})
    EXPECT_TRUE(has(with_names.page, part)) << part;
  const Reported without(folder, "without", small_scene());
  EXPECT_EQ(with_names.summary.at("state_hash"), without.summary.at("state_hash"));
}

TEST(UnitNames, AreNotMadeUpWhereTheSceneHasNone) {
  const TemporaryFolder folder;
  const Reported without(folder, "without", small_scene());
  EXPECT_FALSE(without.summary.contains("units"));
  EXPECT_FALSE(has(without.table, "Pa")) << without.table;
  for (const char* part : {"Pa)", "Pa<", "J)", "(s)", "(N)"})
    EXPECT_FALSE(has(without.page, part)) << part;
  EXPECT_TRUE(has(without.page, "The scene names no units")) << "and says so";
  EXPECT_TRUE(has(without.page, "data-force=\"\""));
}

TEST(UnitNames, ThatAreNoneAreRefusedInALine) {
  const auto of = [](const std::string& table) {
    return refusal(with(small_scene(), "[cell]\n", table + "[cell]\n"));
  };
  EXPECT_EQ(of("[units]\nlength = \"inch\"\nstress = \"kPa\"\n"),
            "scene.toml:3: units.length = 'inch': one of um, mm, m, km");
  EXPECT_EQ(of("[units]\nlength = \"mm\"\n"),
            "scene.toml:2: units.stress is missing: one of Pa, kPa, MPa, GPa");
  EXPECT_EQ(of("[units]\nlength = \"km\"\nstress = \"GPa\"\n"),
            "scene.toml:3: units.length = 'km': with stress = \"GPa\" one whose force and energy "
            "have a prefix from a to G");
  EXPECT_EQ(of("units = \"SI\"\n"), "scene.toml:2: units = 'SI': a table");
}

}  // namespace
}  // namespace tangency::testing
