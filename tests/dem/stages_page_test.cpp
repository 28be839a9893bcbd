// SPDX-License-Identifier: GPL-3.0-or-later
/// docs/stages.md: a chapter for each kind of stage that the table of keys knows, whose example
/// runs, ends with a stage of that kind, and leaves what the chapter says.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <tangency/dem/scene/scene_keys.hpp>

#include "../tool/process.hpp"

namespace tangency::testing {
namespace {

std::vector<std::string> kinds() {
  for (const dem::Key& key : dem::scene_keys()) {
    if (key.section != "stage" || key.name != "kind") continue;
    std::vector<std::string> words{""};
    for (const char c : key.choices) {
      if (c == ' ')
        words.emplace_back();
      else
        words.back().push_back(c);
    }
    return words;
  }
  return {};
}

/// What stands between ```toml and ``` after a place.
std::string example_after(const std::string& page, std::size_t at) {
  const std::string open = "```toml\n";
  const std::size_t begin = page.find(open, at) + open.size();
  return page.substr(begin, page.find("```", begin) - begin);
}

/// The examples by the kinds that their chapters are of.
std::map<std::string, std::string> examples() {
  const std::string page = read_file(TANGENCY_STAGES_PAGE), mark = "\n## `";
  const std::string head = example_after(page, 0);
  std::map<std::string, std::string> all;
  for (std::size_t at = 0; (at = page.find(mark, at)) != page.npos; ++at) {
    const std::size_t begin = at + mark.size();
    all[page.substr(begin, page.find('`', begin) - begin)] = head + example_after(page, begin);
  }
  return all;
}

nlohmann::json summary_of(const TemporaryFolder& folder, const std::string& kind,
                          const std::string& scene) {
  const std::string out = folder.path(kind);
  const Finished run =
      run_tool({"run", folder.write(kind + ".toml", scene), "--out", out, "--quiet"});
  EXPECT_EQ(run.status, 0) << kind;
  EXPECT_EQ(run.err, "") << kind;
  return nlohmann::json::parse(read_file(out + "/summary.json"));
}

/// The last table of a scene.
std::string last_stage(const std::string& scene) { return scene.substr(scene.rfind("[[stage]]")); }

TEST(StagesPage, HasAChapterForEachKindAndForNothingElse) {
  std::vector<std::string> found;
  for (const auto& [kind, example] : examples()) found.push_back(kind);
  std::vector<std::string> expected = kinds();
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
}

TEST(StagesPage, ItsExamplesEndWithAStageOfTheirKindAndLeaveWhatItsChaptersSay) {
  const TemporaryFolder folder;
  const auto all = examples();
  const auto of = [&](const char* kind) { return summary_of(folder, kind, all.at(kind)); };
  for (const auto& [kind, scene] : all)
    EXPECT_NE(last_stage(scene).find("kind = \"" + kind + "\""), std::string::npos) << kind;
  const auto place = of("place");
  EXPECT_EQ(place.at("cycle"), 0);
  EXPECT_EQ(place.at("mean_stress"), 0.0);
  EXPECT_NEAR(of("compress").at("mean_stress").get<double>(), 100.0, 0.2);
  const auto relax = of("relax");
  for (const char* stress : {"s_xx", "s_yy", "s_zz"})
    EXPECT_NEAR(relax.at(stress).get<double>(), 100.0, 0.2) << stress;
  EXPECT_LT(relax.at("largest_unbalanced_ratio").get<double>(), 0.005);
  const auto grow = of("grow");
  EXPECT_NEAR(grow.at("elongation").get<double>(), 1.5, 1e-12);
  EXPECT_TRUE(grow.contains("relaxation_share"));
  EXPECT_NEAR(of("unload").at("mean_stress").get<double>(), 50.0, 0.1);
  const auto shear = of("shear");
  EXPECT_GE(shear.at("axial_strain").get<double>(), 0.02);
  EXPECT_TRUE(shear.contains("peak_friction_angle_deg"));
  EXPECT_EQ(of("servo").at("stage_cycle"), 1500);
}

}  // namespace
}  // namespace tangency::testing
