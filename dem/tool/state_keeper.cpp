// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/state_keeper.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include <tangency/dem/observe.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/tool/cycle_files.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;

double axial_strain_of(const State& state) {
  const int axial = state.cell.dimensions - 1;
  return -state.cell.logarithmic_strain()(axial, axial);
}

/// A cycle ago, or a little before that.
double axial_strain_before(const Simulation& simulation) {
  constexpr double kMore = 1.01;  // of the step's strain: logarithms and products differ by less
  const State& state = simulation.state();
  const int axial = state.cell.dimensions - 1;
  const double shortening = -state.cell.rate(axial, axial) * simulation.time_step();
  return axial_strain_of(state) - kMore * std::max(shortening, 0.0);
}

double stress_ratio(double deviator, double mean) { return mean > 0.0 ? deviator / mean : 0.0; }

std::vector<ShearPointRow> rows_of(const History& history, const StageRows& stage,
                                   const State& start) {
  const auto axial = history.column("axial_strain"), volume = history.column("volumetric_strain"),
             angle = history.column("friction_angle_deg"), p = history.column("p"),
             q = history.column("q");
  const Stress stress = stress_of(start.contacts, start.cell);
  const double deviator = deviator_of(stress.tensor, stress.dimensions);
  std::vector<ShearPointRow> rows{{0.0, 0.0, 0.0, stress_ratio(deviator, stress.mean())}};
  for (std::size_t row = stage.first; row < stage.end; ++row)
    rows.push_back({axial[row], volume[row], angle[row], stress_ratio(q[row], p[row])});
  return rows;
}

/// Is the state that of the row, by every number of it?
bool is_of_row(const Simulation& simulation, const History& history, std::size_t row) {
  const State& state = simulation.state();
  for (const Field& field : history_fields(state.cycle, state.time, simulation.stage().name,
                                           state.stage_cycle, simulation.observe())) {
    if (field.name == "stage") continue;
    const double value = std::visit(
        [](const auto& x) -> double {
          if constexpr (std::is_arithmetic_v<std::decay_t<decltype(x)>>)
            return static_cast<double>(x);
          else
            return 0.0;
        },
        field.value);
    const double in_row = history.column(field.name)[row];
    if (in_row != value && (std::isfinite(in_row) || std::isfinite(value))) return false;
  }
  return true;
}

/// The cause for which points_of_stage() has nothing.
std::string why_no_points(const Simulation& simulation, const fs::path& folder) {
  const fs::path file = file_of_point(folder, simulation.stage().name, 0);
  if (!fs::exists(file)) return "the state at its start is not there";
  const State& end = simulation.state();
  return load_state(file).cycle == end.cycle - end.stage_cycle
             ? "history.csv has no row of it"
             : "the state at its start is of another run";
}

}  // namespace

fs::path file_of_point(const fs::path& folder, const std::string& stage, std::size_t point) {
  return folder / (stage + "-" + kPointNames[point] + ".state");
}

std::optional<StagePoints> points_of_stage(const History& history, const std::string& stage,
                                           const fs::path& folder) {
  const std::vector<StageRows> stages = stages_of(history);
  const auto found = std::find_if(stages.rbegin(), stages.rend(),
                                  [&](const StageRows& one) { return one.name == stage; });
  const fs::path file = file_of_point(folder, stage, 0);
  if (found == stages.rend() || !fs::exists(file)) return std::nullopt;
  const auto cycle = history.column("cycle"), of_stage = history.column("stage_cycle");
  const State start = load_state(file);
  if (static_cast<double>(start.cycle) != cycle[found->first] - of_stage[found->first])
    return std::nullopt;
  const std::vector<ShearPointRow> rows = rows_of(history, *found, start);
  const auto points = shear_points(rows);
  if (!points) return std::nullopt;
  const auto point_of = [&](std::size_t k) -> StagePoints::Point {
    if (k == 0) return {start.cycle, 0.0, std::nullopt};
    const std::size_t row = found->first + k - 1;
    return {static_cast<std::int64_t>(cycle[row]), rows[k].axial_strain, row};
  };
  return StagePoints{
      {point_of(points->a), point_of(points->b), point_of(points->c), point_of(points->d)},
      points->d_is_last_row};
}

StateKeeper::StateKeeper(const fs::path& directory, std::int64_t last_cycle,
                         const Simulation& simulation)
    : folder_(directory / "states"), carries_on_(last_cycle >= 0) {
  remove_later_files(folder_, last_cycle, cycle_of_kept_state);
  if (simulation.state().stage_cycle == 0 || simulation.finished()) return;
  // A servo may take a strain back that was passed before: then its file tells.
  const Stage& stage = simulation.stage();
  const std::vector<double>& strains = stage.kept.strains;
  const double passed =
      carries_on_ ? axial_strain_before(simulation) : axial_strain_of(simulation.state());
  for (; next_strain_ < strains.size(); ++next_strain_) {
    const bool is_there = cycle_of_kept_state(file_of_strain(stage, next_strain_)).has_value();
    if (!is_there && strains[next_strain_] > passed) break;
    if (!is_there && carries_on_) missed_.push_back(strains[next_strain_]);
  }
}

fs::path StateKeeper::file_of(const std::string& stage, const std::string& suffix) const {
  return folder_ / (stage + suffix + ".state");
}

fs::path StateKeeper::file_of_strain(const Stage& stage, std::size_t k) const {
  return file_of(stage.name, "-" + tables::to_text(stage.kept.strains[k]));
}

void StateKeeper::keep(const Simulation& simulation, const fs::path& file) const {
  make_folder(folder_);
  save_state(simulation.state(), file);
}

void StateKeeper::begin(const Simulation& simulation) {
  if (simulation.state().cycle == 0)
    after_stage(simulation);
  else if (simulation.state().stage_cycle == 0)
    make_up_for_stage(simulation);
  else if (carries_on_ && !simulation.finished())
    after_cycle(simulation);
}

/// The end's state may be what could not be written before.
void StateKeeper::make_up_for_stage(const Simulation& simulation) {
  const Stage& before = simulation.scene().stages[simulation.state().stage - 1];
  const fs::path file = file_of(before.name);
  if (carries_on_ && before.kept.end && cycle_of_kept_state(file) != simulation.state().cycle)
    keep(simulation, file);
  keep_start(simulation);
}

void StateKeeper::after_stage(const Simulation& simulation) {
  const Stage& before = simulation.scene().stages[simulation.state().stage - 1];
  if (before.kept.end) keep(simulation, file_of(before.name));
  next_strain_ = 0;
  keep_start(simulation);
}

void StateKeeper::keep_start(const Simulation& simulation) const {
  if (!simulation.finished() && simulation.stage().kept.points)
    keep(simulation, file_of_point(folder_, simulation.stage().name, 0));
}

void StateKeeper::after_cycle(const Simulation& simulation) {
  const Stage& stage = simulation.stage();
  const std::vector<double>& strains = stage.kept.strains;
  if (next_strain_ == strains.size()) return;
  const double strain = axial_strain_of(simulation.state());
  for (; next_strain_ < strains.size() && strains[next_strain_] <= strain; ++next_strain_)
    keep(simulation, file_of_strain(stage, next_strain_));
}

StateKeeper::Outcome StateKeeper::keep_points(const Simulation& simulation, const History& history,
                                              const std::function<bool(double)>& goes_on) {
  const std::string& stage = simulation.stage().name;
  Outcome outcome;
  try {
    const auto points = points_of_stage(history, stage, folder_);
    outcome = points ? run_again(simulation, history, *points, goes_on)
                     : Outcome{false, why_no_points(simulation, folder_)};
  } catch (const WriteError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {  // what a changed scene or a damaged file may lead to
    outcome.problem = error.what();
  }
  if (!outcome.problem.empty())
    for (const std::size_t point : {1u, 2u, 3u}) fs::remove(file_of_point(folder_, stage, point));
  return outcome;
}

StateKeeper::Outcome StateKeeper::run_again(const Simulation& simulation, const History& history,
                                            const StagePoints& points,
                                            const std::function<bool(double)>& goes_on) {
  const std::string& stage = simulation.stage().name;
  const State& end = simulation.state();
  // Points at the stage's end need no second run, as D often does not.
  std::int64_t last = 0;
  for (const StagePoints::Point& point : points.points)
    if (point.cycle < end.cycle) last = std::max(last, point.cycle);
  Simulation again(simulation.scene(), load_state(file_of_point(folder_, stage, 0)));
  const std::int64_t first = again.state().cycle;
  const auto keep_here = [&](const Simulation& at) {
    for (std::size_t k = 1; k < points.points.size(); ++k) {
      const StagePoints::Point& point = points.points[k];
      if (point.cycle != at.state().cycle) continue;
      if (point.row && !is_of_row(at, history, *point.row)) return false;
      keep(at, file_of_point(folder_, stage, k));
    }
    return true;
  };
  const Outcome of_another{false, "its start leads to other rows than those of history.csv"};
  if (!keep_here(again)) return of_another;
  while (again.state().cycle < last) {
    if (!goes_on(static_cast<double>(again.state().cycle - first) /
                 static_cast<double>(last - first)))
      return {true, {}};
    again.step();
    if (!keep_here(again)) return of_another;
  }
  return keep_here(simulation) ? Outcome{} : of_another;
}

}  // namespace tangency::inline v0::dem
