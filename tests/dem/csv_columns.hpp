// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// CSV without quotes, by the names of its columns.
#pragma once

#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace tangency::testing {

/// The cells of a line; the last may be empty.
inline std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line + ",");
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

using Columns = std::map<std::string, std::vector<std::string>>;

/// By the names of the first line; a row that is too short has empty cells.
inline Columns columns_of(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = cells_of(line);
  Columns columns;
  for (const std::string& name : names) columns[name];
  while (std::getline(in, line)) {
    std::vector<std::string> cells = cells_of(line);
    cells.resize(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) columns[names[k]].push_back(cells[k]);
  }
  return columns;
}

using Rows = std::vector<std::map<std::string, std::string>>;

/// The same row by row.
inline Rows rows_of(const std::string& text) {
  Rows rows;
  for (const auto& [name, cells] : columns_of(text)) {
    rows.resize(cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k) rows[k][name] = cells[k];
  }
  return rows;
}

}  // namespace tangency::testing
