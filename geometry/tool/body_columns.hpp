// SPDX-License-Identifier: MIT
/// @file
/// The columns that describe an ellipsoid: x y z r1 r2 r3 and, all four or none, qw qx qy qz, each
/// behind the name of the body: a.x.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::tool {

class BodyColumns {
 public:
  /// @param body  "a" or "b"
  /// @throws csv::Error  naming the columns that the header lacks
  BodyColumns(const csv::Header& header, std::string_view body);

  /// The body of a row; the identity where the file has no orientation.
  /// @throws csv::Error  naming the cell that Ellipsoid or parse_number() refuses
  Ellipsoid read(const csv::RowCursor& row) const;

 private:
  std::array<csv::Column, 6> place_and_axes_{};
  std::optional<std::array<csv::Column, 4>> orientation_;
};

}  // namespace tangency::tool
