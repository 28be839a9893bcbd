// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/schema.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>
#include <string_view>
#include <vector>

#include <tangency/dem/scene/scene_keys.hpp>

namespace tangency::inline v0::dem {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool is_number(KeyType type) { return type <= KeyType::reals; }

Json bound(const Key& key, double value) {
  return is_number(key.type) && std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// As TOML reads the text.
Json default_of(const Key& key) {
  if (!key.has_default()) return nullptr;
  const std::string text(key.fallback);
  if (key.type == KeyType::boolean) return text == "true";
  if (key.type == KeyType::integer) return std::stoll(text);
  if (is_number(key.type)) return std::stod(text);
  return text;
}

Json json_of(const Key& key) {
  return {
      {"section", key.section},
      {"key", key.name},
      {"type", type_text(key.type)},
      {"unit", key.unit},
      {"required", key.required()},
      {"default", default_of(key)},
      {"default_rule", key.required() || key.has_default() ? Json(nullptr) : Json(key.fallback)},
      {"minimum", bound(key, key.range.low)},
      {"minimum_included", is_number(key.type) && key.range.low_included},
      {"maximum", bound(key, key.range.high)},
      {"maximum_included", is_number(key.type) && key.range.high_included},
      {"choices", words_of(key.choices)},
      {"stages", words_of(key.kinds)},
      {"meaning", key.meaning}};
}

/// A cell of a table of Markdown.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_' || c == '[') out += '\\';
    out += c;
  }
  return out;
}

void add_row(std::string& page, const Key& key) {
  page += "| `" + std::string(key.name) + "` | " + std::string(type_text(key.type)) + " | " +
          cell(key.unit) + " | " +
          (key.required()      ? "required"
           : key.has_default() ? "`" + std::string(key.fallback) + "`"
                               : cell(key.fallback)) +
          " | " + cell(allowed_values(key)) + " | " + cell(key.meaning) + " |\n";
}

constexpr const char* kHead =
    "| key | type | unit | default | allowed | meaning |\n|---|---|---|---|---|---|\n";

std::string title_of(std::string_view section) {
  if (section.empty()) return "Top level";
  if (section == "particles") return "`[particles.NAME]`: a type of particles";
  if (section == "contact") return "`[contact]` for all pairs, `[contact.NAME-NAME]` for one";
  if (section == "body") return "`[[body]]`: a body of an explicit arrangement";
  if (section == "wall") return "`[[wall]]`: a plane wall";
  if (section == "units") return "`[units]`: names of units, which may be left out";
  if (section == "sweep")
    return "`[sweep]`: a run for each combination of values, `\"KEY\" = [VALUE, ...]` with keys by "
           "their path, as `--set` has them";
  return "`[" + std::string(section) + "]`";
}

}  // namespace

std::string schema_json() {
  Json keys = Json::array();
  for (const Key& key : scene_keys()) keys.push_back(json_of(key));
  return Json{{"schema", 1}, {"keys", keys}}.dump(1) + "\n";
}

std::string schema_markdown() {
  std::string page =
      "<!-- SPDX-License-Identifier: MIT -->\n# Keys of a scene\n\nMade by `tangency-dem schema "
      "--markdown` of the table that checks scenes. `--json` prints the same for programs. A scene "
      "is\nTOML. Compression is positive in stress and in axial strain; volumetric strain is "
      "positive in dilation. Units are those of SI, or any\nconsistent set. Runs, their files and "
      "how to stop and resume them: [runs](runs.md).\n";
  std::vector<std::string> kinds;
  std::string_view section = "none";
  for (const Key& key : scene_keys()) {
    if (key.section == "stage") {
      if (key.name == "kind") kinds = words_of(key.choices);
      continue;
    }
    if (key.section != section) page += "\n## " + title_of(key.section) + "\n\n" + kHead;
    section = key.section;
    add_row(page, key);
  }
  page +=
      "\nThe run is a list of `[[stage]]` tables, one after the other; the first, and no other, "
      "places the particles. When to use which, what ends it, and an example of each: [the stages "
      "of a run](stages.md).\n";
  for (const std::string& kind : kinds) {
    page += "\n## Stage `" + kind + "`\n\n" + kHead;
    for (const Key& key : scene_keys())
      if (key.section == "stage" && is_among(kind, key.kinds)) add_row(page, key);
  }
  return page;
}

}  // namespace tangency::inline v0::dem
