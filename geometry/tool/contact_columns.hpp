// SPDX-License-Identifier: MIT
/// @file
/// Columns that `tangency contact` adds at the end of a row where it is asked for them.
///
/// One that is asked for costs what its group of columns costs; one that is not costs nothing. A
/// new column is a row of the table in contact_columns.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::tool {

/// What a row of `contact` has to say before its further columns.
struct ContactRow {
  const MatrixEllipsoid& a;
  const MatrixEllipsoid& b;
  const RelationAnswer& relation;
  const Vec3* normal = nullptr;  ///< that of the row; null where it has no numbers
  const Gap* gap = nullptr;      ///< null where the row is not of the common normal
};

/// The further columns that were asked for, in that order.
class ContactColumns {
 public:
  /// @param names  separated by commas; nothing for none. Those that refused_columns() accepts.
  explicit ContactColumns(const std::string& names);

  const std::vector<std::string_view>& names() const noexcept { return names_; }
  /// Their cells: empty where the row has no such number, or where it is beyond the range of a
  /// double.
  void write(const ContactRow& row, tables::RowText& out) const;

 private:
  struct Place {
    std::size_t group, column;
  };
  std::vector<std::string_view> names_;
  std::vector<Place> places_;
  std::vector<std::size_t> groups_;  ///< each once
};

/// For a command line: what is wrong with the names, and which are allowed; nothing where nothing.
std::string refused_columns(const std::string& names);

/// For the help: every name and what it means.
std::string contact_columns_help();

}  // namespace tangency::tool
