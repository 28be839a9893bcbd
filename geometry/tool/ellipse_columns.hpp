// SPDX-License-Identifier: MIT
/// @file
/// The columns that describe an ellipse: x y r1 r2 and the direction of its first axis, as ux uy or
/// as angle, each behind the name of the body: a.x.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::tool {

class EllipseColumns {
 public:
  /// @param body  "a" or "b"
  /// @throws csv::Error  naming the columns that the header lacks, or has too many of
  EllipseColumns(const csv::Header& header, std::string_view body);

  /// The body of a row.
  /// @throws csv::Error  naming the cell that Ellipse or parse_number() refuses
  Ellipse read(const csv::RowCursor& row) const;

 private:
  using Direction = std::array<csv::Column, 2>;

  csv::Column column_of(std::string_view field) const;

  std::array<csv::Column, 4> place_and_axes_{};
  std::variant<Direction, csv::Column> direction_;  ///< ux uy, or angle
};

}  // namespace tangency::tool
