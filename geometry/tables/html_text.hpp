// SPDX-License-Identifier: MIT
/// @file
/// Text in pages.
#pragma once

#include <string>
#include <string_view>

namespace tangency::inline v0::tables {

/// Text that HTML and SVG show as it is, between tags and between double quotes.
inline std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

}  // namespace tangency::inline v0::tables
