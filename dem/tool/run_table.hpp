// SPDX-License-Identifier: MIT
/// @file
/// A table that a run writes row by row, as history.csv and micro.csv: each row is of a cycle and a
/// stage, and begins with the columns cycle, time and stage. A run that is resumed carries it on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/dem/observe.hpp>
#include <tangency/dem/simulation.hpp>

namespace tangency::inline v0::dem {

/// --out DIR that cannot be used, or is being written to; what() is one line.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a row is of.
struct Moment {
  std::int64_t cycle;
  std::size_t stage;
  bool operator==(const Moment&) const = default;
};
/// Of the simulation as it is: at the start of a stage that of the end of the one before.
Moment moment_of(const Simulation& simulation);

/// Is something due after the last cycle: by the strain where that is > 0 and the stage has a rate,
/// else by cycles?
/// @param interval  cycles between two; 0: none is due by them
bool is_due(const Simulation& simulation, std::int64_t interval, double strain = 0.0);

/// The cycle and the stage's name of a row as it stands in a file.
std::int64_t cycle_of(const std::string& row);
std::string stage_of(const std::string& row);

class RunTable {
 public:
  /// @param columns  whose names are the header
  RunTable(std::filesystem::path file, const std::vector<Field>& columns);

  /// The rows of the file; none where there is no file.
  /// @throws OutputError  where its header is another
  std::vector<std::string> rows_in_file() const;

  /// Keeps the rows of the file that the run had written when it was at this state.
  /// @param due  whether a row within its stage was due there
  void carry_on(const Simulation& simulation, bool due);

  bool has_rows() const { return !rows_.empty(); }
  /// Whether a row of that moment is there, as its last one.
  bool has(const Moment& moment) const { return last_ == moment; }
  /// Numbers that are NaN become empty cells.
  void add(const Moment& moment, const std::vector<Field>& row);

  /// Writes the file as far as it goes.
  /// @throws WriteError
  void write() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::string header_, rows_;
  std::optional<Moment> last_;  ///< nothing where it is of no moment that this run may come to
};

}  // namespace tangency::inline v0::dem
