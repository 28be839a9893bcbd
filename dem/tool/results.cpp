// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/results.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <variant>
#include <vector>

#include <tangency/dem/observe.hpp>
#include <tangency/dem/state_file.hpp>
#include <tangency/dem/tool/cycle_files.hpp>
#include <tangency/dem/tool/history.hpp>
#include <tangency/dem/tool/summary.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::dem {
namespace {

namespace fs = std::filesystem;

/// Makes the directory and sees that files can be made in it. Leaves nothing when not.
fs::path usable(const fs::path& directory) {
  std::error_code error;
  fs::path made;  // the uppermost directory that was not there; a link that leads nowhere was
  for (fs::path at = fs::absolute(directory).lexically_normal();
       !fs::exists(fs::symlink_status(at, error)); at = at.parent_path())
    made = at;
  fs::create_directories(directory, error);
  try {
    if (error) throw WriteError(directory, error.value());
    write_whole(directory / ".writable", ".");
    fs::remove(directory / ".writable");
    return directory;
  } catch (const WriteError& unusable) {
    if (!made.empty()) fs::remove_all(made, error);
    throw OutputError(std::string("--out ") + WriteError(directory, unusable.problem()).what());
  }
}

/// Held until it is closed, and by no second run meanwhile. No file is made for it.
tables::Descriptor locked(const fs::path& directory) {
  tables::Descriptor lock(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock.is_open() && ::flock(lock.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw OutputError("--out " + directory.string() +
                      ": another run is writing there: another directory, or wait for its end");
  return lock;
}

std::string header_line() {
  std::string line;
  for (const Field& field : history_fields(0, 0.0, "", 0, Observation{}))
    line += (line.empty() ? "" : ",") + field.name;
  return line + "\n";
}

std::string csv_line(const std::vector<Field>& fields) {
  std::string line;
  for (const Field& field : fields) {
    if (!line.empty()) line += ',';
    std::visit(
        [&](const auto& value) {
          if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
            line += value;
          else
            line += tables::to_text(value);
        },
        field.value);
  }
  return line + "\n";
}

/// The first result of a run in a directory.
std::optional<std::string> result_in(const fs::path& directory) {
  for (const char* name : {"history.csv", "summary.json", "final.state", "checkpoint.state",
                           "frames.pvd", "frames.xyz", "frames.xyz.part"})
    if (fs::exists(directory / name)) return name;
  for (const auto& file : {first_file(directory / "contacts", cycle_of_contact_table),
                           first_file(directory / "states", cycle_of_kept_state)})
    if (file) return file->lexically_relative(directory).string();
  return std::nullopt;
}

/// The rows of the history in a directory; none where there is no history.
std::vector<std::string> rows_in(const fs::path& directory) {
  const fs::path file = directory / "history.csv";
  std::ifstream in(file);
  if (!in) return {};
  std::vector<std::string> rows;
  std::string line;
  std::getline(in, line);
  if (line + "\n" != header_line())
    throw OutputError(file.string() +
                      ": not as this program wrote it, so that it cannot be carried on: that "
                      "file, none, or another --out");
  while (std::getline(in, line)) rows.push_back(line);
  return rows;
}

std::int64_t cycle_of(const std::string& row) { return std::atoll(row.c_str()); }

std::string stage_of(const std::string& row) {
  const std::size_t begin = row.find(',', row.find(',') + 1) + 1;  // cycle, time, stage
  return row.substr(begin, row.find(',', begin) - begin);
}

/// Is a row of the state's cycle one of its run? It has the numbers that the state keeps too, of
/// which two runs share hardly one.
bool is_of(const std::string& row, const Simulation& simulation) {
  const State& state = simulation.state();
  std::istringstream cells(row);
  std::string cell;
  for (const Field& field : history_fields(state.cycle, state.time, stage_of(row),
                                           state.stage_cycle, simulation.observe())) {
    std::getline(cells, cell, ',');
    const bool is_kept =
        field.name == "time" || field.name.ends_with("_work") || field.name.ends_with("_loss");
    if (is_kept && cell != tables::to_text(std::get<double>(field.value))) return false;
  }
  return true;
}

/// Is the directory's history, as far as it goes, that of the run which the state is of? A row of
/// its cycle tells; without one, and before the first cycle, where all runs are alike, its place
/// does.
bool is_history_of(const fs::path& directory, const fs::path& state, const Simulation& simulation) {
  const std::int64_t cycle = simulation.state().cycle;
  for (const std::string& row : rows_in(directory))
    if (cycle > 0 && cycle_of(row) == cycle) return is_of(row, simulation);
  std::error_code none;
  for (const char* file : {"checkpoint.state", "final.state"})
    if (fs::equivalent(directory / file, state, none)) return true;
  return fs::equivalent(directory / "states", fs::absolute(state).parent_path(), none);
}

/// Is the run to go on with what is in the directory?
/// @throws OutputError  where what is there is of another run
bool carries_on(const fs::path& directory, const RunOptions& options,
                const Simulation& simulation) {
  const auto found = result_in(directory);
  if (!found) return false;
  if (options.resume && is_history_of(directory, *options.resume, simulation)) return true;
  if (options.replace) return false;
  const std::string of_another =
      options.resume ? "not of the run of " + options.resume->string() : "of an earlier run";
  throw OutputError("--out " + directory.string() + ": holds results " + of_another + ", " +
                    *found + ": --replace takes them away; or " +
                    (options.resume ? "" : "--resume one of its states, or ") + "another --out");
}

}  // namespace

Results::Results(const RunOptions& options, const Simulation& simulation)
    : directory_(usable(options.out)),
      lock_(locked(directory_)),
      carries_on_(carries_on(directory_, options, simulation)),
      frames_(directory_, carries_on_ ? simulation.state().cycle : -1,
              simulation.scene().output.frame > 0),
      contacts_(directory_, carries_on_ ? simulation.state().cycle : -1,
                simulation.scene().output.contacts > 0),
      kept_(directory_, carries_on_ ? simulation.state().cycle : -1, simulation) {
  if (carries_on_) carry_on(simulation);
  for (const char* name : {"summary.json", "final.state"}) fs::remove(directory_ / name);
  if (carries_on_) return;
  for (const char* name : {"checkpoint.state", "history.csv"}) fs::remove(directory_ / name);
}

/// Keeps the rows that the run had written when it was at this state. Of the state's own cycle
/// there may be more: of the end of its stage and of stages after it that ended at once.
void Results::carry_on(const Simulation& simulation) {
  const State& state = simulation.state();
  const auto& stages = simulation.scene().stages;
  const auto is_called = [&](std::size_t first, std::size_t end, const std::string& name) {
    return std::any_of(stages.begin() + static_cast<std::ptrdiff_t>(first),
                       stages.begin() + static_cast<std::ptrdiff_t>(end),
                       [&](const Stage& stage) { return stage.name == name; });
  };
  const auto had = [&](const std::string& row) {
    if (state.stage_cycle > 0)
      return !last_row_ && state.cycle % simulation.scene().output.history == 0;
    return is_called(0, state.stage, stage_of(row)) ||
           !is_called(state.stage, stages.size(), stage_of(row));
  };
  for (const std::string& row : rows_in(directory_)) {
    if (cycle_of(row) > state.cycle) break;
    if (cycle_of(row) == state.cycle) {
      if (!had(row)) break;
      last_row_ = moment_of(simulation);
    }
    history_ += row + "\n";
  }
}

Results::Moment Results::moment_of(const Simulation& simulation) {
  const State& state = simulation.state();
  return {state.cycle, state.stage_cycle == 0 ? state.stage - 1 : state.stage};
}

void Results::add_row(const Simulation& simulation) { add_row(simulation, moment_of(simulation)); }

void Results::add_last_row_of_stage(const Simulation& simulation) {
  add_row(simulation, {simulation.state().cycle, simulation.state().stage});
}

void Results::add_row(const Simulation& simulation, const Moment& moment) {
  if (last_row_ == moment) return;
  last_row_ = moment;
  const State& state = simulation.state();
  Observation seen = simulation.observe();
  // Strains count from the first cycle of a stage.
  if (state.stage_cycle == 0 && moment.stage == state.stage)
    seen.axial_strain = seen.volumetric_strain = 0.0;
  const std::string& stage = simulation.scene().stages[moment.stage].name;
  history_ += csv_line(history_fields(state.cycle, state.time, stage, state.stage_cycle, seen));
}

void Results::checkpoint(const Simulation& simulation) const {
  // The history first: a resumed run drops rows after its state's cycle, and could not make up for
  // those before it.
  write_history();
  save_state(simulation.state(), directory_ / "checkpoint.state");
}

StateKeeper::Outcome Results::keep_points(const Simulation& simulation,
                                          const std::function<bool(double)>& goes_on) {
  if (!simulation.stage().kept.points) return {};
  write_history();
  return kept_.keep_points(simulation, History(directory_ / "history.csv"), goes_on);
}

void Results::write_history() const {
  write_whole(directory_ / "history.csv", header_line() + history_);
}

void Results::finish_incomplete(const Simulation& simulation) {
  checkpoint(simulation);
  frames_.finish();
}

void Results::finish_without_state() {
  write_history();
  frames_.finish();
}

void Results::finish(const Simulation& simulation, const RunCost& cost) {
  frames_.add(simulation);
  contacts_.add(simulation);
  finish_incomplete(simulation);
  // One state under two names: each is written beside its place and renamed, so that none of them
  // changes with the other.
  if (!link_whole(directory_ / "checkpoint.state", directory_ / "final.state"))
    save_state(simulation.state(), directory_ / "final.state");
  write_summary(directory_, simulation, cost);
}

}  // namespace tangency::dem
