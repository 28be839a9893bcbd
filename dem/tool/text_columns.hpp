// SPDX-License-Identifier: MIT
/// @file
/// Columns of the tables that are printed as text: a name at the left, numbers at the right.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {

/// Characters. Chosen: a name and six columns of numbers have 92, within a terminal's 100.
inline constexpr std::size_t kNameWidth = 26, kCellWidth = 11;

/// Longer text is left as it is.
inline std::string left(std::string text, std::size_t width = kNameWidth) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

/// Longer text is parted from what stands before it by one space.
inline std::string right(const std::string& text, std::size_t width = kCellWidth) {
  return std::string(text.size() < width ? width - text.size() : 1, ' ') + text;
}

/// To four digits; - where it is not defined.
inline std::string cell(double x, std::size_t width = kCellWidth) {
  return right(std::isfinite(x) ? tables::rounded_text(x, 4) : "-", width);
}

}  // namespace tangency::inline v0::dem
