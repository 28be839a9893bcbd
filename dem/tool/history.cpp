// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/history.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>

#include <tangency/dem/observe.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::inline v0::dem {
History::History(const std::filesystem::path& file) {
  tables::Reader reader(file.string());
  const tables::Column stage = reader.header().require("stage");
  std::vector<tables::Column> places;
  for (const Field& field : history_fields(0, 0.0, "", 0, Observation{})) {
    if (field.name == "stage") continue;
    places.push_back(reader.header().require(field.name));
    columns_.emplace_back(field.name, std::vector<double>());
  }
  tables::for_each_row(reader, [&](const tables::RowCursor& row) {
    stage_.emplace_back(row.text(stage));
    for (std::size_t k = 0; k < places.size(); ++k)
      columns_[k].second.push_back(row.number(places[k]));
  });
}

std::span<const double> History::column(std::string_view name) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(),
                                  [&](const auto& one) { return one.first == name; });
  assert(found != columns_.end());
  return found->second;
}

std::vector<StageRows> stages_of(const History& history) {
  const auto cycle = history.column("cycle"), of_stage = history.column("stage_cycle");
  const auto start = [&](std::size_t row) { return cycle[row] - of_stage[row]; };
  std::vector<StageRows> stages;
  for (std::size_t row = 0; row < history.size(); ++row) {
    if (stages.empty() || stages.back().name != history.stage(row) || start(row) != start(row - 1))
      stages.push_back({history.stage(row), row, row});
    stages.back().end = row + 1;
  }
  return stages;
}

std::optional<ShearPeaks> peaks_of_stage(const History& history, const std::string& name) {
  const std::vector<StageRows> stages = stages_of(history);
  const auto found = std::find_if(stages.rbegin(), stages.rend(),
                                  [&](const StageRows& stage) { return stage.name == name; });
  if (found == stages.rend()) return std::nullopt;
  const auto axial = history.column("axial_strain"), volume = history.column("volumetric_strain");
  const auto angle = history.column("friction_angle_deg");
  std::vector<ShearRow> rows;
  for (std::size_t row = found->first; row < found->end; ++row)
    rows.push_back({axial[row], volume[row], angle[row]});
  return shear_peaks(rows);
}

}  // namespace tangency::inline v0::dem
