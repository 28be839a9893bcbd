// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What was measured, as CSV, JSON, Markdown and a picture.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/bench/speed_accuracy/score.hpp>

namespace tangency::speed_accuracy {

/// One method on one family.
struct Row {
  std::string family, method, option;
  std::optional<int> steps;
  std::string level;       ///< "single": one pair at a time; else the instruction set of a batch
  std::string definition;  ///< of the gap
  Score score;
  double ns = 0;       ///< per pair
  double inverse = 0;  ///< ns of Eigen's 3x3 inverse, the yardstick, in the same run
  std::optional<double> instructions{};  ///< per pair

  /// The same for no other row.
  std::string key() const;
};

/// Levels of the batch calls in these rows, in order: the best first.
std::vector<std::string> levels_of(const std::vector<Row>& rows);

/// Contacts of the touching pairs of a list: one share, one way to call.
struct AheadRow {
  std::string family, method, level;
  int touching;                     ///< percent
  double ns_all = 0, ns_ahead = 0;  ///< per listed pair: all pairs; overlaps() first
};

/// Names and meanings of the columns of the table of rows, for --help.
std::string describe_columns();

std::string to_csv(const std::vector<Row>& rows);
/// An array of objects with the keys of the CSV; null for an empty cell.
std::string to_json(const std::vector<Row>& rows);
std::string to_csv(const std::vector<AheadRow>& rows);

/// The short tables of docs/speed-accuracy.md.
std::string to_markdown(const std::vector<Row>& rows, const std::vector<AheadRow>& ahead);

}  // namespace tangency::speed_accuracy
