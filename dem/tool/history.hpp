// SPDX-License-Identifier: MIT
/// @file
/// history.csv read back.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/dem/tool/shear_peaks.hpp>

namespace tangency::inline v0::dem {

/// A history's columns, one entry a row; they are those of history_fields().
class History {
 public:
  /// @throws tables::Error  a file that cannot be read, lacks a column, or holds what is no number
  explicit History(const std::filesystem::path& file);

  std::size_t size() const { return stage_.size(); }
  /// A column by its name; requires that there is one, of numbers.
  std::span<const double> column(std::string_view name) const;
  const std::string& stage(std::size_t row) const { return stage_[row]; }

 private:
  std::vector<std::string> stage_;
  std::vector<std::pair<std::string, std::vector<double>>> columns_;
};

/// The rows of one stage: [first, end).
struct StageRows {
  std::string name;
  std::size_t first, end;
};

/// The stages that have rows, in their order. Two in a row that have one name are told apart by the
/// cycle in which they began.
std::vector<StageRows> stages_of(const History& history);

/// The peaks of the last stage of that name; nothing where it has no row.
std::optional<ShearPeaks> peaks_of_stage(const History& history, const std::string& name);

}  // namespace tangency::inline v0::dem
