// SPDX-License-Identifier: MIT
/// @file
/// summary.json of a complete run: the values of the last row of history.csv, what followed from
/// all rows, and what the run took.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/profile.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/verification.hpp>

namespace tangency::inline v0::dem {

/// What it took.
struct RunCost {
  /// Of this process, output included: what ran before a resumption is not in it.
  double wall_seconds = 0.0;
  double cycle_seconds = 0.0;       ///< of the cycles alone
  std::int64_t cycles = 0;          ///< of this process
  double listed_pair_cycles = 0.0;  ///< sum over this run's cycles of the pairs listed
  int threads = 1;
  std::optional<Profile> profile;    ///< of the cycles of this process
  std::optional<Verified> verified;  ///< by --verify, of this process
};

/// Of the run whose history is in the directory.
/// @throws WriteError
void write_summary(const std::filesystem::path& directory, const Simulation& simulation,
                   const RunCost& cost);

/// Keys and values in their order, numbers with six digits.
using SummaryLines = std::vector<std::pair<std::string, std::string>>;

/// Nothing where there is none, as of a run that is not complete.
std::optional<SummaryLines> read_summary(const std::filesystem::path& directory);

}  // namespace tangency::inline v0::dem
