// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/summary.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

#include <tangency/dem/lanes/instruction_set.hpp>
#include <tangency/dem/observe.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/tool/history.hpp>
#include <tangency/dem/tool/state_keeper.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;

void put_fields(nlohmann::ordered_json& summary, const History& history) {
  const std::size_t last = history.size() - 1;
  for (const Field& field : history_fields(0, 0.0, "", 0, Observation{})) {
    if (field.name == "stage")
      summary[field.name] = history.stage(last);
    else if (std::holds_alternative<std::int64_t>(field.value))
      summary[field.name] = static_cast<std::int64_t>(history.column(field.name)[last]);
    else
      summary[field.name] = history.column(field.name)[last];
  }
}

/// The peaks of the scene's last stage of kind shear, if the history has it.
void add_peaks(nlohmann::ordered_json& summary, const History& history, const Scene& scene) {
  const auto shears = [](const Stage& stage) { return stage.drive && stage.drive->axial_strain; };
  const auto last = std::find_if(scene.stages.rbegin(), scene.stages.rend(), shears);
  if (last == scene.stages.rend()) return;
  const auto peaks = peaks_of_stage(history, last->name);
  if (!peaks) return;
  summary["peak_friction_angle_deg"] = peaks->friction_angle_deg;
  summary["strain_at_peak_friction"] = peaks->strain_at_friction;
  summary["peak_dilation_rate"] = peaks->dilation_rate;
  summary["strain_at_peak_dilation"] = peaks->strain_at_dilation;
}

/// Of the scene's last stage of kind grow, if the history has it. An increment takes a cycle, and
/// no cycle makes two.
void add_relaxation_share(nlohmann::ordered_json& summary, const History& history,
                          const Scene& scene) {
  const auto last = std::find_if(scene.stages.rbegin(), scene.stages.rend(),
                                 [](const Stage& stage) { return stage.growth.has_value(); });
  if (last == scene.stages.rend()) return;
  const auto is_namesake = [&](const auto& other) { return other.name == last->name; };
  const auto later = std::count_if(scene.stages.rbegin(), last, is_namesake);
  std::vector<StageRows> rows = stages_of(history);
  std::erase_if(rows, [&](const StageRows& stage) { return !is_namesake(stage); });
  if (std::ssize(rows) <= later) return;
  const std::size_t end = rows[rows.size() - 1 - static_cast<std::size_t>(later)].end;
  const double cycles = history.column("stage_cycle")[end - 1];
  // A run that is over and was resumed elsewhere has the row of its end alone, without cycles.
  if (!(cycles > 0.0)) return;
  summary["relaxation_share"] = 1.0 - static_cast<double>(last->growth->increments) / cycles;
}

/// The points of the scene's last stage that keeps them, if their states are there.
void add_points(nlohmann::ordered_json& summary, const History& history, const Scene& scene,
                const fs::path& folder) {
  const auto last = std::find_if(scene.stages.rbegin(), scene.stages.rend(),
                                 [](const Stage& stage) { return stage.kept.points; });
  if (last == scene.stages.rend()) return;
  for (std::size_t k = 0; k < kPointNames.size(); ++k)
    if (!fs::exists(file_of_point(folder, last->name, k))) return;
  const auto found = points_of_stage(history, last->name, folder);
  if (!found) return;
  for (std::size_t k = 0; k < kPointNames.size(); ++k)
    summary[std::string("strain_at_") + kPointNames[k]] = found->points[k].axial_strain;
  summary["D_is_last_row"] = found->d_is_last_row;
}

std::string text_of(const nlohmann::ordered_json& value) {
  if (value.is_number_float()) return tables::rounded_text(value.get<double>(), 6);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

void write_summary(const fs::path& directory, const Simulation& simulation, const RunCost& cost) {
  const State& state = simulation.state();
  const Balance balance = simulation.observe().balance;
  const History history(directory / "history.csv");
  nlohmann::ordered_json summary;
  put_fields(summary, history);
  add_peaks(summary, history, simulation.scene());
  add_relaxation_share(summary, history, simulation.scene());
  summary["particles"] = state.particles.size();
  summary["cycles"] = state.cycle;
  summary["wall_seconds"] = cost.wall_seconds;
  summary["ns_per_listed_pair_per_cycle"] =
      cost.listed_pair_cycles > 0.0 ? 1e9 * cost.cycle_seconds / cost.listed_pair_cycles : 0.0;
  summary["listed_pairs"] = state.list.pairs().size();
  summary["threads"] = cost.threads;
  summary["state_hash"] = state_hash(state);
  summary["rattlers"] = balance.rattlers;
  summary["largest_unbalanced_ratio"] = balance.largest_unbalanced_ratio;
  summary["largest_unbalanced_moment_ratio"] = balance.largest_unbalanced_moment_ratio;
  if (simulation.scene().branch == Branch::trace)
    summary["unanswered_contacts"] =
        state.contacts.unanswered(state.particles, state.cell, state.list);
  summary["instruction_set"] = instruction_set();
  summary["reproducible"] = uses_reproducible_arithmetic();
  if (cost.profile)
    for (const auto& [name, value] : entries_of(*cost.profile))
      std::visit([&, &key = name](auto number) { summary["profile"][key] = number; }, value);
  if (cost.verified)
    for (const auto& [name, count] : entries_of(*cost.verified))
      std::visit([&, &key = name](auto number) { summary["verified"][key] = number; }, count);
  add_points(summary, history, simulation.scene(), directory / "states");
  if (simulation.scene().units)
    for (const auto& [what, name] : simulation.scene().units->entries())
      summary["units"][std::string(what)] = name;
  for (const std::string& setting : cost.settings) {
    const std::size_t equals = setting.find('=');
    const auto value = nlohmann::ordered_json::parse(setting.substr(equals + 1), nullptr, false);
    summary["set"][setting.substr(0, equals)] =
        value.is_discarded() ? nlohmann::ordered_json(setting.substr(equals + 1)) : value;
  }
  write_whole(directory / "summary.json", summary.dump(2) + "\n");
}

std::optional<SummaryLines> read_summary(const fs::path& directory) {
  const auto text = read_whole(directory / "summary.json");
  if (!text) return std::nullopt;
  const auto summary = nlohmann::ordered_json::parse(*text, nullptr, false);
  if (!summary.is_object()) return std::nullopt;
  SummaryLines lines;
  for (const auto& [name, value] : summary.items()) {
    if (value.is_object()) {
      for (const auto& [part, number] : value.items())
        lines.emplace_back(name + "." + part, text_of(number));
    } else {
      lines.emplace_back(name, text_of(value));
    }
  }
  return lines;
}

}  // namespace tangency::inline v0::dem
