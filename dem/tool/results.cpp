// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <tangency/dem/files.hpp>
#include <tangency/dem/state_file.hpp>
#include <tangency/dem/tool/history.hpp>
#include <tangency/dem/tool/numbers.hpp>
#include <tangency/dem/tool/results.hpp>

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
  const fs::path probe = directory / ".writable";
  const bool writable = !error && std::ofstream(probe).put('.').flush().good();
  fs::remove(probe, error);
  if (writable) return directory;
  if (!made.empty()) fs::remove_all(made, error);
  throw OutputError("--out " + directory.string() +
                    ": cannot be written: a directory, or a place for one");
}

/// Held until it is closed, and by no second run meanwhile. No file is made for it.
csv::Descriptor locked(const fs::path& directory) {
  csv::Descriptor lock(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
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
            line += to_text(value);
        },
        field.value);
  }
  return line + "\n";
}

std::vector<Field> row_of(const Simulation& simulation) {
  const State& state = simulation.state();
  const auto& stages = simulation.scene().stages;
  const std::string& stage = state.cycle == 0 ? stages.front().name : simulation.stage().name;
  return history_fields(state.cycle, state.time, stage, state.stage_cycle, simulation.observe());
}

/// The peaks of the scene's last stage of kind shear, if the history has it.
void add_peaks(nlohmann::ordered_json& summary, const fs::path& history, const Scene& scene) {
  const auto shears = [](const Stage& stage) { return stage.drive && stage.drive->axial_strain; };
  const auto last = std::find_if(scene.stages.rbegin(), scene.stages.rend(), shears);
  if (last == scene.stages.rend()) return;
  const auto peaks = peaks_of_stage(History(history), last->name);
  if (!peaks) return;
  summary["peak_friction_angle_deg"] = peaks->friction_angle_deg;
  summary["strain_at_peak_friction"] = peaks->strain_at_friction;
  summary["peak_dilation_rate"] = peaks->dilation_rate;
  summary["strain_at_peak_dilation"] = peaks->strain_at_dilation;
}

/// Rows of the history in a directory up to those of `cycle`; none where there is no history.
std::string earlier_rows(const fs::path& directory, std::int64_t cycle) {
  const fs::path file = directory / "history.csv";
  std::ifstream in(file);
  if (!in) return {};
  std::string rows, line;
  std::getline(in, line);
  if (line + "\n" != header_line())
    throw OutputError(file.string() +
                      ": not as this program wrote it, so that it cannot be carried on: that "
                      "file, none, or another --out");
  while (std::getline(in, line) && std::atoll(line.c_str()) <= cycle) rows += line + "\n";
  return rows;
}

}  // namespace

Results::Results(const fs::path& directory, const Simulation& simulation, bool resumed)
    : directory_(usable(directory)),
      lock_(locked(directory_)),
      history_(resumed ? earlier_rows(directory_, simulation.state().cycle) : std::string()),
      last_cycle_(resumed ? simulation.state().cycle : -1),
      frames_(directory_, last_cycle_) {
  for (const char* name : {"summary.json", "final.state"}) fs::remove(directory_ / name);
  if (resumed) return;
  for (const char* name : {"checkpoint.state", "history.csv"}) fs::remove(directory_ / name);
}

void Results::add_row(const Simulation& simulation) {
  const State& state = simulation.state();
  if (state.cycle == last_cycle_) return;
  last_cycle_ = state.cycle;
  history_ += csv_line(row_of(simulation));
}

void Results::checkpoint(const Simulation& simulation) const {
  // The history first: a resumed run drops rows after its state's cycle, and could not make up for
  // those before it.
  write_history();
  save_state(simulation.state(), directory_ / "checkpoint.state");
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
  finish_incomplete(simulation);
  save_state(simulation.state(), directory_ / "final.state");
  write_summary(simulation, cost);
}

void Results::write_summary(const Simulation& simulation, const RunCost& cost) const {
  const State& state = simulation.state();
  const Balance balance = simulation.observe().balance;
  nlohmann::ordered_json summary;
  for (const Field& field : row_of(simulation))
    std::visit([&](const auto& value) { summary[field.name] = value; }, field.value);
  // The state has gone on to the stage after the last: the last row's last cell.
  summary["stage_cycle"] = std::stoll(history_.substr(history_.rfind(',') + 1));
  add_peaks(summary, directory_ / "history.csv", simulation.scene());
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
  write_whole(directory_ / "summary.json", summary.dump(2) + "\n");
}

}  // namespace tangency::dem
