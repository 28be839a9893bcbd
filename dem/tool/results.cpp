// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/results.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <tangency/dem/observe.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/tool/cycle_files.hpp>
#include <tangency/dem/tool/history.hpp>
#include <tangency/dem/tool/micro_fields.hpp>
#include <tangency/dem/tool/micro_summary.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/dem/tool/summary.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
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

/// Of history.csv.
std::vector<Field> history_columns() { return history_fields(0, 0.0, "", 0, Observation{}); }

/// Of micro.csv.
std::vector<Field> micro_columns(const Simulation& simulation, const std::string& stage,
                                 const Observation& seen, const MicroSummary& summary) {
  const State& state = simulation.state();
  std::vector<Field> row{{"cycle", state.cycle},
                         {"time", state.time},
                         {"stage", stage},
                         {"stage_cycle", state.stage_cycle},
                         {"axial_strain", seen.axial_strain}};
  for (Field& field : micro_fields(summary)) row.push_back(std::move(field));
  row.push_back({"shear_strain_xy", seen.shear_strain[0]});
  row.push_back({"shear_strain_yz", seen.shear_strain[1]});
  row.push_back({"shear_strain_zx", seen.shear_strain[2]});
  return row;
}

micromechanics::Classes classes_of(const OutputIntervals& output) {
  using Kind = micromechanics::Classes::Kind;
  return {output.polar ? Kind::polar : Kind::near_uniform, output.classes};
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
  const RunTable history(directory / "history.csv", history_columns());
  for (const std::string& row : history.rows_in_file())
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
  const auto found = first_result_in(directory);
  if (!found) return false;
  if (options.resume && is_history_of(directory, *options.resume, simulation)) {
    // Read before anything is taken away: it may be of another version.
    RunTable(directory / "micro.csv", micro_columns(simulation, "", {}, MicroSummary()))
        .rows_in_file();
    return true;
  }
  if (options.replace) return false;
  const std::string of_another =
      options.resume ? "not of the run of " + options.resume->string() : "of an earlier run";
  throw OutputError("--out " + directory.string() + ": holds results " + of_another + ", " +
                    *found + ": --replace takes them away; or " +
                    (options.resume ? "" : "--resume one of its states, or ") + "another --out");
}

}  // namespace

std::optional<std::string> first_result_in(const fs::path& directory) {
  for (const char* name :
       {"history.csv", "summary.json", "final.state", "checkpoint.state", "fault.state",
        "frames.pvd", "frames.xyz", "frames.xyz.part", "micro.csv"})
    if (fs::exists(directory / name)) return name;
  for (const auto& file : {first_file(directory / "contacts", cycle_of_contact_table),
                           first_file(directory / "states", cycle_of_kept_state)})
    if (file) return file->lexically_relative(directory).string();
  return std::nullopt;
}

Results::Results(const RunOptions& options, const Simulation& simulation)
    : directory_(usable(options.out)),
      lock_(locked(directory_)),
      carries_on_(carries_on(directory_, options, simulation)),
      history_(directory_ / "history.csv", history_columns()),
      micro_(directory_ / "micro.csv", micro_columns(simulation, "", {}, MicroSummary())),
      frames_(directory_, carries_on_ ? simulation.state().cycle : -1,
              simulation.scene().output.frame > 0, simulation.scene().output.contact_frames),
      contacts_(directory_, carries_on_ ? simulation.state().cycle : -1,
                simulation.scene().output.contacts > 0),
      kept_(directory_, carries_on_ ? simulation.state().cycle : -1, simulation) {
  if (carries_on_) {
    const OutputIntervals& output = simulation.scene().output;
    history_.carry_on(simulation, is_due(simulation, output.history, output.history_strain));
    micro_.carry_on(simulation, is_due(simulation, output.micro));
  }
  for (const char* name : {"summary.json", "final.state"}) fs::remove(directory_ / name);
  if (carries_on_) return;
  for (const char* name : {"checkpoint.state", "fault.state", "history.csv", "micro.csv"})
    fs::remove(directory_ / name);
}

void Results::add_row(const Simulation& simulation) { add_row(simulation, moment_of(simulation)); }

void Results::add_micro(const Simulation& simulation) {
  add_micro(simulation, moment_of(simulation));
}

void Results::add_last_row_of_stage(const Simulation& simulation) {
  const Moment end{simulation.state().cycle, simulation.state().stage};
  add_row(simulation, end);
  if (simulation.scene().output.micro > 0) add_micro(simulation, end);
}

namespace {

/// What a row tells: strains count from the first cycle of a stage.
Observation observed_at(const Simulation& simulation, const Moment& moment) {
  Observation seen = simulation.observe();
  if (simulation.state().stage_cycle > 0 || moment.stage != simulation.state().stage) return seen;
  seen.axial_strain = seen.volumetric_strain = 0.0;
  seen.shear_strain.setZero();
  return seen;
}

}  // namespace

void Results::add_row(const Simulation& simulation, const Moment& moment) {
  if (history_.has(moment)) return;
  const State& state = simulation.state();
  const Observation seen = observed_at(simulation, moment);
  const std::string& stage = simulation.scene().stages[moment.stage].name;
  history_.add(moment, history_fields(state.cycle, state.time, stage, state.stage_cycle, seen));
}

void Results::add_micro(const Simulation& simulation, const Moment& moment) {
  if (micro_.has(moment)) return;
  const MicroSummary summary = micro_summary(packing_of(simulation.state(), simulation.laws()),
                                             classes_of(simulation.scene().output));
  const std::string& stage = simulation.scene().stages[moment.stage].name;
  micro_.add(moment, micro_columns(simulation, stage, observed_at(simulation, moment), summary));
}

void Results::make_up(const Simulation& simulation) {
  const State& state = simulation.state();
  if (!carries_on_ || state.stage_cycle == 0) return;  // a stage's end has what is due there
  const OutputIntervals& every = simulation.scene().output;
  if (is_due(simulation, every.frame, every.frame_strain)) frames_.add(simulation);
  if (is_due(simulation, every.contacts)) contacts_.add(simulation);
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
  history_.write();
  if (micro_.has_rows()) micro_.write();
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

}  // namespace tangency::inline v0::dem
