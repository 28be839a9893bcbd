// SPDX-License-Identifier: MIT
/// @file
/// What a run leaves in its directory: history.csv, summary.json, the states and the frames.
/// Every file is written beside its place and renamed, so that none is ever half written.
#pragma once

#include <filesystem>
#include <string>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/frames.hpp>
#include <tangency/geometry/tool/descriptor.hpp>

namespace tangency::dem {

/// What it took.
struct RunCost {
  /// Of this process, output included: what ran before a resumption is not in it.
  double wall_seconds = 0.0;
  double cycle_seconds = 0.0;       ///< of the cycles alone
  std::int64_t cycles = 0;          ///< of this process
  double listed_pair_cycles = 0.0;  ///< sum over this run's cycles of the pairs listed
  int threads = 1;
};

/// --out DIR that cannot be used, or is being written to; what() is one line.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Results {
 public:
  /// Makes the directory and takes away what an earlier run there left. Where a run is resumed in
  /// its own directory, history and frames up to its cycle stay and are carried on.
  /// @throws OutputError  leaving nothing behind
  /// @throws WriteError   what was there is still there
  Results(const std::filesystem::path& directory, const Simulation& simulation, bool resumed);

  /// A row of history.csv and a frame of the simulation as it is now, each at most one a cycle.
  void add_row(const Simulation& simulation);
  void add_frame(const Simulation& simulation) { frames_.add(simulation); }

  /// checkpoint.state, and history.csv as far as it goes.
  void checkpoint(const Simulation& simulation) const;

  /// Ends a run that is not complete: history, frames and checkpoint.
  void finish_incomplete(const Simulation& simulation);

  /// Ends a run whose state is of no use: history and frames. An earlier checkpoint stays.
  void finish_without_state();

  /// Ends a complete run: history, frames, checkpoint, final.state and summary.json.
  void finish(const Simulation& simulation, const RunCost& cost);

 private:
  void write_history() const;
  void write_summary(const Simulation& simulation, const RunCost& cost) const;

  std::filesystem::path directory_;
  csv::Descriptor lock_;
  std::string history_;      ///< rows after the header
  std::int64_t last_cycle_;  ///< of the last row; -1: none yet
  Frames frames_;
};

}  // namespace tangency::dem
