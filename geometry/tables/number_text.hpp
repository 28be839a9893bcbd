// SPDX-License-Identifier: MIT
/// @file
/// Numbers as text: the one way for tables, scenes, messages and pages. All of it is here, so that
/// a library which links no table uses it too.
#pragma once

#include <array>
#include <charconv>
#include <cstdio>
#include <string>

namespace tangency::inline v0::tables {

/// Appends the shortest text that reads back to the same number, in that std::chars_format if any.
template <class Number, class... Format>
void append_text(std::string& text, Number x, Format... format) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x, format...).ptr;
  text.append(digits.data(), end);
}

template <class Number, class... Format>
std::string to_text(Number x, Format... format) {
  std::string text;
  append_text(text, x, format...);
  return text;
}

/// As std::printf; up to 511 characters.
template <class... Values>
std::string formatted(const char* pattern, Values... values) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

/// So many significant digits, fewer where the last are 0, as an ostream shows them.
inline std::string rounded_text(double x, int digits) { return formatted("%.*g", digits, x); }

}  // namespace tangency::inline v0::tables
