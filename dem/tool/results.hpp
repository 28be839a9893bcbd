// SPDX-License-Identifier: MIT
/// @file
/// What a run leaves in its directory: history.csv, micro.csv, summary.json, the states, the frames
/// and the tables of contacts.
/// Every file is written beside its place and renamed, so that none is ever half written. A row of
/// the history is of a cycle and a stage; a stage that ends at once has one too. summary.json
/// begins with the last row's values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/contact_tables.hpp>
#include <tangency/dem/tool/frames.hpp>
#include <tangency/dem/tool/run_options.hpp>
#include <tangency/dem/tool/run_table.hpp>
#include <tangency/dem/tool/state_keeper.hpp>
#include <tangency/dem/tool/summary.hpp>
#include <tangency/geometry/tables/descriptor.hpp>

namespace tangency::inline v0::dem {

/// A result of a run in a directory, by its path there; nothing where it has none.
std::optional<std::string> first_result_in(const std::filesystem::path& directory);

class Results {
 public:
  /// Makes the directory. Where a run is resumed in its own directory, history and frames up to its
  /// cycle stay and are carried on; what another run left there is taken away if that is asked for.
  /// @throws OutputError  leaving nothing behind, and the results of another run as they are
  /// @throws WriteError   what was there is still there
  Results(const RunOptions& options, const Simulation& simulation);

  bool has_rows() const { return history_.has_rows(); }
  /// A row of history.csv and a frame of the simulation as it is now, each at most one a cycle and
  /// stage. At the start of a stage the row is that of the end of the one before.
  void add_row(const Simulation& simulation);
  /// A row of micro.csv, alike.
  void add_micro(const Simulation& simulation);
  void add_frame(const Simulation& simulation) { frames_.add(simulation); }
  /// A table of contacts, at most one a cycle.
  void add_contacts(const Simulation& simulation) { contacts_.add(simulation); }
  /// The row of a stage that is at its end, which may be its start; of micro.csv too, where the
  /// scene has one.
  void add_last_row_of_stage(const Simulation& simulation);

  /// When a run begins in its own directory: what is due at its cycle and could not be written.
  void make_up(const Simulation& simulation);

  /// The states that stages keep.
  StateKeeper& kept() { return kept_; }
  /// Those that are known only at a stage's end, where the simulation is: StateKeeper::keep_points.
  StateKeeper::Outcome keep_points(const Simulation& simulation,
                                   const std::function<bool(double share)>& goes_on);

  /// checkpoint.state, and history.csv as far as it goes.
  void checkpoint(const Simulation& simulation) const;

  /// Ends a run that is not complete: history, frames and checkpoint.
  void finish_incomplete(const Simulation& simulation);

  /// Ends a run whose state is of no use: history and frames. An earlier checkpoint stays.
  void finish_without_state();

  /// Ends a complete run: history, frames, checkpoint, final.state and summary.json.
  void finish(const Simulation& simulation, const RunCost& cost);

 private:
  void add_row(const Simulation& simulation, const Moment& moment);
  void add_micro(const Simulation& simulation, const Moment& moment);
  void write_history() const;

  std::filesystem::path directory_;
  tables::Descriptor lock_;
  bool carries_on_;
  RunTable history_, micro_;
  Frames frames_;
  ContactTables contacts_;
  StateKeeper kept_;
};

}  // namespace tangency::inline v0::dem
