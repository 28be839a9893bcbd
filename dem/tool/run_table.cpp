// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/run_table.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <type_traits>
#include <utility>
#include <variant>

#include <tangency/dem/tool/csv_text.hpp>
#include <tangency/dem/whole_file.hpp>

namespace tangency::inline v0::dem {
namespace {

std::string header_line(const std::vector<Field>& columns) {
  CsvText line;
  for (const Field& field : columns) line.add(field.name);
  line.end_row();
  return std::string(line.view());
}

}  // namespace

Moment moment_of(const Simulation& simulation) {
  const State& state = simulation.state();
  return {state.cycle, state.stage_cycle == 0 ? state.stage - 1 : state.stage};
}

bool is_due(const Simulation& simulation, std::int64_t interval, double strain) {
  const State& state = simulation.state();
  const auto& drive = simulation.stage().drive;
  const bool by_strain = strain > 0.0 && drive && !drive->loading.strain_rate.isZero(0.0);
  return by_strain ? simulation.has_passed(strain) : interval > 0 && state.cycle % interval == 0;
}

std::int64_t cycle_of(const std::string& row) { return std::atoll(row.c_str()); }

std::string stage_of(const std::string& row) {
  const std::size_t begin = row.find(',', row.find(',') + 1) + 1;  // cycle, time, stage
  return row.substr(begin, row.find(',', begin) - begin);
}

RunTable::RunTable(std::filesystem::path file, const std::vector<Field>& columns)
    : file_(std::move(file)), header_(header_line(columns)) {}

std::vector<std::string> RunTable::rows_in_file() const {
  std::ifstream in(file_);
  if (!in) return {};
  std::vector<std::string> rows;
  std::string line;
  std::getline(in, line);
  if (line + "\n" != header_)
    throw OutputError(file_.string() +
                      ": not as this program wrote it, so that it cannot be carried on: that "
                      "file, none, or another --out");
  while (std::getline(in, line)) rows.push_back(line);
  return rows;
}

/// Of the state's own cycle there may be more rows than the run had written: of the end of its
/// stage and of stages after it that ended at once.
void RunTable::carry_on(const Simulation& simulation, bool due) {
  const State& state = simulation.state();
  const auto& stages = simulation.scene().stages;
  const auto is_called = [&](std::size_t first, std::size_t end, const std::string& name) {
    return std::any_of(stages.begin() + static_cast<std::ptrdiff_t>(first),
                       stages.begin() + static_cast<std::ptrdiff_t>(end),
                       [&](const Stage& stage) { return stage.name == name; });
  };
  const auto had = [&](const std::string& row) {
    if (state.stage_cycle > 0) return !last_ && due;
    return is_called(0, state.stage, stage_of(row)) ||
           !is_called(state.stage, stages.size(), stage_of(row));
  };
  for (const std::string& row : rows_in_file()) {
    if (cycle_of(row) > state.cycle) break;
    if (cycle_of(row) == state.cycle) {
      if (!had(row)) break;
      last_ = moment_of(simulation);
    }
    rows_ += row + "\n";
  }
}

void RunTable::add(const Moment& moment, const std::vector<Field>& row) {
  last_ = moment;
  CsvText line;
  for (const Field& field : row)
    std::visit([&](const auto& value) { line.add(value); }, field.value);
  line.end_row();
  rows_ += line.view();
}

void RunTable::write() const { write_whole(file_, header_ + rows_); }

}  // namespace tangency::inline v0::dem
