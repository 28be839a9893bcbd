// SPDX-License-Identifier: MIT
/// @file
/// Rows of a table as text, cell by cell. What is not defined, NaN, is an empty cell.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

class CsvText {
 public:
  void add(double x) {
    if (std::isnan(x))
      row_.empty();
    else
      row_.text(tables::to_text(x));
  }
  /// Three cells.
  void add(const Vec3& v) {
    for (const double x : v) add(x);
  }
  void add(std::int64_t x) { row_.text(tables::to_text(x)); }
  /// Without comma, quote or line end (asserted).
  void add(std::string_view text) { row_.text(text); }
  void end_row() { row_.end_row(); }

  std::string_view view() const { return row_.view(); }

 private:
  tables::RowText row_;
};

}  // namespace tangency::inline v0::dem
