// SPDX-License-Identifier: MIT
/// @file
/// Rows of a shear test that lie within a width of axial strain, and the slope of what they hold: a
/// derivative that the noise of single rows does not reach. A row is any struct with a member
/// `axial_strain`; rows stand in their order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

namespace tangency::inline v0::dem {

/// Relative slack of a window's width: rows at equal steps of strain lie on its end.
inline constexpr double kWindowSlack = 1e-9;

/// Shows `look` the rows within a width from each row on, or three where they are further apart.
/// Windows reach over the full width, except that of rows whose strain is less than it in all.
template <class Row, class Look>
void for_each_window(std::span<const Row> rows, double width, Look&& look) {
  constexpr std::size_t fewest = 3;
  for (std::size_t first = 0, end = 0; first < rows.size(); ++first) {
    const double reach = rows[first].axial_strain + width * (1.0 + kWindowSlack);
    end = std::max(end, first);
    while (end < rows.size() && rows[end].axial_strain <= reach) ++end;
    const std::size_t last = std::min(std::max(end, first + fewest), rows.size());
    // What is left at the end is part of the windows before.
    const bool is_short = rows.back().axial_strain < reach - 2.0 * kWindowSlack * width;
    if (first > 0 && (is_short || last - first < fewest)) break;
    look(rows.subspan(first, last - first));
  }
}

struct Slope {
  double rate;    ///< d value / d axial strain
  double strain;  ///< mean axial strain of the rows
};

/// Of the line through a value of the rows, by least squares; nothing where the strains are all the
/// same.
template <class Row>
std::optional<Slope> slope_of(std::span<const Row> rows, double Row::*value) {
  const auto count = static_cast<double>(rows.size());
  double strain = 0.0, mean = 0.0;
  for (const Row& row : rows) {
    strain += row.axial_strain / count;
    mean += row.*value / count;
  }
  double square = 0.0, product = 0.0;
  for (const Row& row : rows) {
    const double off = row.axial_strain - strain;
    square += off * off;
    product += off * (row.*value - mean);
  }
  if (!(square > 0.0)) return std::nullopt;
  return Slope{product / square, strain};
}

}  // namespace tangency::inline v0::dem
