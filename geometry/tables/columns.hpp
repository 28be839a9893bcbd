// SPDX-License-Identifier: MIT
/// @file
/// Looking up the columns that a subcommand reads.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>

namespace tangency::tool {

/// The columns that were found; the names of the others, prefix and field, are added to `missing`.
template <std::size_t N>
std::array<csv::Column, N> find_columns(const csv::Header& header, std::string_view prefix,
                                        const std::array<std::string_view, N>& fields,
                                        std::vector<std::string>& missing) {
  std::array<csv::Column, N> columns{};
  for (std::size_t i = 0; i < N; ++i) {
    const std::string name = std::string(prefix) + std::string(fields[i]);
    if (const auto column = header.find(name)) {
      columns[i] = *column;
    } else {
      missing.push_back(name);
    }
  }
  return columns;
}

/// "pairs.csv:1: body a without a.r1, a.r2: rule"
inline csv::Error lacking(const csv::Header& header, std::string_view who,
                          const std::vector<std::string>& missing, std::string_view rule) {
  std::string what = std::string(who) + " without ";
  for (const std::string& name : missing) what += (&name == &missing.front() ? "" : ", ") + name;
  return csv::Error(
      {.file = header.file(), .line = header.line(), .value = what, .rule = std::string(rule)});
}

}  // namespace tangency::tool
