// SPDX-License-Identifier: MIT
/// @file
/// Columns that a subcommand adds at the end of a row where --columns asks for them, by a table of
/// groups. One that is asked for costs what its group costs; one that is not costs nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::inline v0::tool {

/// As many as the group has columns; nothing where the row has no such number.
using Cells = std::span<std::optional<double>>;

/// Columns that are found together.
/// @tparam Row  what a row has to say before its further columns
template <class Row>
struct ColumnGroup {
  std::span<const std::string_view> names;
  std::string_view help;  ///< lines, each with its end
  void (*answer)(const Row& row, Cells cells);
};

namespace further {

/// The parts between the commas.
std::vector<std::string_view> split(std::string_view text);

/// What is wrong with the names that are asked for, and which are allowed; nothing where nothing.
std::string refused(std::string_view asked, const std::vector<std::string_view>& allowed);

}  // namespace further

/// A table of groups, and the columns of it that were asked for, in that order.
template <class Row>
class FurtherColumns {
 public:
  using Groups = std::span<const ColumnGroup<Row>>;

  /// @param names  separated by commas; nothing for none. Those that add_columns_option() accepts.
  FurtherColumns(Groups groups, const std::string& names) : groups_(groups) {
    if (names.empty()) return;
    const std::vector<std::string_view> all = all_names(groups);
    for (const std::string_view name : further::split(names)) {
      const auto at = std::ranges::find(all, name);
      names_.push_back(*at);
      places_.push_back(static_cast<std::size_t>(at - all.begin()));
    }
  }

  bool empty() const noexcept { return names_.empty(); }
  /// Behind the columns that every row has.
  void append_names(std::vector<std::string_view>& columns) const {
    columns.insert(columns.end(), names_.begin(), names_.end());
  }

  /// Their cells: empty where the row has no such number, or where it is beyond the range of a
  /// double.
  void write(const Row& row, tables::RowText& out) const {
    if (names_.empty()) return;
    std::vector<std::optional<double>> cells;
    for (const ColumnGroup<Row>& group : groups_) {
      const std::size_t first = cells.size(), end = first + group.names.size();
      cells.resize(end);
      const bool asked = std::ranges::any_of(
          places_, [&](std::size_t place) { return first <= place && place < end; });
      if (asked) group.answer(row, Cells(cells).subspan(first));
    }
    for (const std::size_t place : places_) {
      const std::optional<double>& cell = cells[place];
      if (cell && std::isfinite(*cell)) {
        out.number(*cell);
      } else {
        out.empty();
      }
    }
  }

  static std::vector<std::string_view> all_names(Groups groups) {
    std::vector<std::string_view> names;
    for (const ColumnGroup<Row>& group : groups)
      names.insert(names.end(), group.names.begin(), group.names.end());
    return names;
  }

 private:
  Groups groups_;
  std::vector<std::string_view> names_;
  std::vector<std::size_t> places_;  ///< in the order of all_names()
};

/// For the help: every name and what it means.
template <class Row>
std::string further_columns_help(std::span<const ColumnGroup<Row>> groups) {
  std::string help;
  for (const ColumnGroup<Row>& group : groups) help += group.help;
  return help;
}

/// Adds --columns NAME,...
template <class Row>
tables::Option add_columns_option(tables::Command& command, std::string& columns,
                                  std::span<const ColumnGroup<Row>> groups) {
  return command
      .option("--columns", columns,
              "Add these columns at the end of each row; their names are below")
      .check([groups](const std::string& names) {
        return further::refused(names, FurtherColumns<Row>::all_names(groups));
      })
      .type_name("NAME,...");
}

}  // namespace tangency::inline v0::tool
