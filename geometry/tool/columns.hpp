// SPDX-License-Identifier: MIT
/// @file
/// The columns that a subcommand reads: those of ellipses, each behind the name of its body, and any
/// others by their names. body_columns.hpp has those of ellipsoids.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::tool {

/// The columns that were found; the names of the others, prefix and field, are added to `missing`.
template <std::size_t N>
std::array<tables::Column, N> find_columns(const tables::Header& header, std::string_view prefix,
                                           const std::array<std::string_view, N>& fields,
                                           std::vector<std::string>& missing) {
  std::array<tables::Column, N> columns{};
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
tables::Error lacking(const tables::Header& header, std::string_view who,
                      const std::vector<std::string>& missing, std::string_view rule);

/// An ellipse: x y r1 r2 and the direction of its first axis, as ux uy or as angle.
class EllipseColumns {
 public:
  /// @param body  "a" or "b"
  /// @throws tables::Error  naming the columns that the header lacks, or has too many of
  EllipseColumns(const tables::Header& header, std::string_view body);

  /// @throws tables::Error  naming the cell that Ellipse or parse_number() refuses
  Ellipse read(const tables::RowCursor& row) const;

 private:
  using Direction = std::array<tables::Column, 2>;

  tables::Column column_of(std::string_view field) const;

  std::array<tables::Column, 4> place_and_axes_{};
  std::variant<Direction, tables::Column> direction_;  ///< ux uy, or angle
};

}  // namespace tangency::tool
