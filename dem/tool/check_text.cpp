// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/scene/scene_keys.hpp>
#include <tangency/dem/tool/check.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using Json = nlohmann::ordered_json;
using Cells = std::array<std::string, 9>;

std::string cell_of(const std::optional<double>& x) {
  return x ? tables::rounded_text(*x, 3) : "-";
}

std::optional<double> stress_of(const StageForecast& seen) {
  return seen.pressed ? std::optional(seen.pressed->stress) : std::nullopt;
}

Cells cells_of(const StageForecast& seen, const Scene& scene) {
  const Stage& stage = scene.stages[seen.stage];
  const std::string least = seen.least.cycles > 0.0 ? tables::formatted("%.0f", seen.least.cycles) +
                                                          " (" + seen.least.key + ")"
                                                    : "-";
  return {stage.name,
          least,
          std::to_string(stage.drive->max_cycles),
          tables::rounded_text(seen.time_step, 3),
          tables::rounded_text(seen.steps_a_contact, 3),
          cell_of(stress_of(seen)),
          cell_of(seen.inertial_number ? seen.inertial_number : seen.servo_inertial_number) +
              (seen.inertial_number || !seen.servo_inertial_number ? "" : " (servo)"),
          cell_of(seen.overlap),
          cell_of(seen.cell_over_least)};
}

Json json_of(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

Json json_of(const StageForecast& seen, const Scene& scene) {
  const Stage& stage = scene.stages[seen.stage];
  const bool is_known = seen.least.cycles > 0.0;
  return {{"stage", stage.name},
          {"time_step", seen.time_step},
          {"steps_a_contact", seen.steps_a_contact},
          {"cycles_at_least", is_known ? Json(seen.least.cycles) : Json(nullptr)},
          {"cycles_key", is_known ? Json(seen.least.key) : Json(nullptr)},
          {"max_cycles", stage.drive->max_cycles},
          {"stress", json_of(stress_of(seen))},
          {"inertial_number", json_of(seen.inertial_number)},
          {"servo_inertial_number", json_of(seen.servo_inertial_number)},
          {"overlap", json_of(seen.overlap)},
          {"cell_over_least", json_of(seen.cell_over_least)}};
}

/// Those of the advice that the key `intended` of that section takes, each once, as TOML writes
/// them.
std::string may_be_intended(const std::vector<Advice>& advice, std::string_view section) {
  const auto keys = scene_keys();
  const Key& key = *std::find_if(keys.begin(), keys.end(), [&](const Key& one) {
    return one.name == "intended" && one.section == section;
  });
  std::string names;
  for (const Advice& one : advice) {
    const std::string name = '"' + one.about + '"';
    if (is_among(one.about, key.choices) && names.find(name) == names.npos)
      names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

}  // namespace

std::string text_of(const SceneCheck& check, const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  std::vector<Cells> lines{{"stage", "cycles at least", "max_cycles", "time step",
                            "steps a contact", "stress", "inertial number", "overlap",
                            "cell / least"}};
  for (const StageForecast& stage : check.stages) lines.push_back(cells_of(stage, scene));
  std::array<std::size_t, std::tuple_size_v<Cells>> wide{};
  for (const Cells& line : lines)
    for (std::size_t k = 0; k < wide.size(); ++k) wide[k] = std::max(wide[k], line[k].size());
  std::string text;
  for (const Cells& line : lines) {
    for (std::size_t k = 0; k < wide.size(); ++k)
      text += line[k] + (k + 1 < wide.size() ? std::string(wide[k] - line[k].size() + 2, ' ') : "");
    text += '\n';
  }
  text += std::to_string(scene.particle_count()) + " particles, some " +
          tables::rounded_text(1e-6 * check.memory, 2) + " MB\n";
  for (const Advice& one : check.advice) text += "advice: " + one.text() + '\n';
  if (const std::string meant = may_be_intended(check.advice, ""); !meant.empty())
    text += std::string("if it is meant so, write ") +
            (may_be_intended(check.advice, "stage") == meant ? "in the stage or " : "") +
            "at the head of the scene: intended = [" + meant + "]\n";
  const std::size_t count = check.advice.size();
  return text + (count == 0 ? "nothing to change\n" : std::to_string(count) + " to change\n");
}

std::string json_of(const SceneCheck& check, const Simulation& simulation,
                    const std::string& scene) {
  Json stages = Json::array(), advice = Json::array();
  for (const StageForecast& stage : check.stages)
    stages.push_back(json_of(stage, simulation.scene()));
  for (const Advice& one : check.advice) {
    Json changes = Json::array();
    for (const auto& [key, from, to] : one.changes)
      changes.push_back({{"key", key}, {"from", from}, {"to", to}});
    advice.push_back(
        {{"stage", one.stage}, {"about", one.about}, {"reason", one.reason}, {"changes", changes}});
  }
  return Json{{"scene", scene},
              {"particles", simulation.scene().particle_count()},
              {"memory_bytes", check.memory},
              {"stages", stages},
              {"advice", advice}}
             .dump(1) +
         "\n";
}

}  // namespace tangency::inline v0::dem
