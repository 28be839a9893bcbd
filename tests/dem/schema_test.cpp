// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem schema`: its forms against the table that checks scenes, and the page made of it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <string>

#include <tangency/dem/scene/scene_keys.hpp>

#include "../tool/process.hpp"

namespace tangency::testing {
namespace {

TEST(Schema, AsJsonHasEachKeyOfTheTableThatChecks) {
  const Finished printed = run_tool({"schema", "--json"});
  ASSERT_EQ(printed.status, 0) << printed.err;
  const auto json = nlohmann::json::parse(printed.out);
  EXPECT_EQ(json.at("schema"), 1);
  const auto& keys = json.at("keys");
  ASSERT_EQ(keys.size(), dem::scene_keys().size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const dem::Key& key = dem::scene_keys()[k];
    const auto& seen = keys[k];
    EXPECT_EQ(seen.at("key"), key.name);
    EXPECT_EQ(seen.at("section"), key.section);
    EXPECT_EQ(seen.at("unit"), key.unit);
    EXPECT_EQ(seen.at("meaning"), key.meaning);
    EXPECT_EQ(seen.at("required"), key.required());
    EXPECT_EQ(seen.at("default").is_null(), !key.has_default()) << key.name;
    EXPECT_EQ(seen.at("default_rule").is_null(), key.required() || key.has_default());
    // The default of a number is within its own bounds.
    if (const auto& value = seen.at("default"); value.is_number()) {
      EXPECT_TRUE(key.range.holds(value.get<double>())) << key.name;
    }
    if (std::isfinite(key.range.high) && !seen.at("maximum").is_null()) {
      EXPECT_EQ(seen.at("maximum").get<double>(), key.range.high);
    }
  }
}

// Where the table changes: tangency-dem schema --markdown > docs/scene-keys.md
TEST(Schema, AsAPageIsTheCommittedOne) {
  const Finished printed = run_tool({"schema", "--markdown"});
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_TRUE(printed.out == read_file(TANGENCY_SCENE_KEYS))
      << "make docs/scene-keys.md again: tangency-dem schema --markdown > docs/scene-keys.md";
  EXPECT_EQ(run_tool({"schema", "--markdown", "--json"}).status, 2);
}

}  // namespace
}  // namespace tangency::testing
