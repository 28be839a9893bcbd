// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The corpus `hunt` of a folder, hunt.csv and hunt.truth.csv: what every hunt of the folder has
/// found. A row stays for ever, whether or not the tool still fails it.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <set>
#include <span>

#include <tangency/verify/corpus/corpus.hpp>

namespace tangency::inline v0::verify {

class FoundCorpus {
 public:
  /// Makes the folder where it is missing, and reads the rows that are there. Writes nothing.
  /// @throws tables::Error  the folder cannot be made or written to, one of the two files is
  ///     missing, bad, or has other columns than a hunt writes
  explicit FoundCorpus(const std::filesystem::path& folder);

  /// Appends the pairs that have no row, in this order; without one the files stay as they are.
  /// @returns how many
  /// @throws tables::Error  a failed write
  std::size_t add(std::span<const NamedPair> pairs);

  std::size_t rows() const { return rows_; }

 private:
  std::filesystem::path inputs_, truth_;
  CorpusText text_;  // empty without files
  std::size_t rows_ = 0;
  std::set<std::array<double, 20>> known_;
};

}  // namespace tangency::inline v0::verify
