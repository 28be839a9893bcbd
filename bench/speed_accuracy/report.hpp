// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What was measured, as CSV and JSON, and what the scripts beside this make of it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tangency/verify/grade/calls.hpp>

namespace tangency::speed_accuracy {

/// One method on one family.
struct Row {
  std::string family, method, option;
  std::optional<int> steps;
  std::string level;       ///< "single": one pair at a time; else the instruction set of a batch
  std::string definition;  ///< of the gap
  verify::CallGrade grade;
  double ns = 0;       ///< per pair
  double inverse = 0;  ///< ns of Eigen's 3x3 inverse, the yardstick, in the same run
  std::optional<double> instructions{};  ///< per pair
  /// Of a batch: pairs that its lanes leave to the single call, and those of them that overlap
  /// deeper than rho, of which no normal alone proves anything.
  std::optional<std::size_t> left{}, left_deep{};

  /// The same for no other row.
  std::string key() const;
};

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
/// @param methods, ahead  what to_csv() wrote
/// @throws std::runtime_error  awk cannot be started, or failed
std::string to_markdown(const std::string& methods, const std::string& ahead);

/// Error against time, an SVG drawn by gnuplot.
/// @throws std::runtime_error  gnuplot cannot be started, or failed; no family of the picture
std::string to_picture(const std::string& methods);

}  // namespace tangency::speed_accuracy
