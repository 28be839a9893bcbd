// SPDX-License-Identifier: MIT
/// @file
/// Rows and cells with the quotes of RFC 4180. Internal to csv.cpp.
///
/// RowEnds and take_cell() agree on what a quote opens: only one that is the first of its cell,
/// blanks aside.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace tangency::inline v0::tables {

inline bool is_space(char c) noexcept { return c <= ' ' && (c == ' ' || c == '\t' || c == '\r'); }

inline std::string_view trimmed(std::string_view text) noexcept {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// Cuts the text at the first mark: returns what is before it and leaves what is after it.
inline std::string_view take_until(std::string_view& text, char mark) noexcept {
  const std::size_t end = text.find(mark);
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return taken;
}

inline bool is_data(std::string_view row) noexcept {
  for (const char c : row) {
    if (!is_space(c)) return c != '#';
  }
  return false;
}

inline bool has_quotes(std::string_view text) noexcept {
  return text.find('"') != std::string_view::npos;
}

/// Tells where rows end, character by character; the one place that knows what a quote opens. What
/// it takes for the end of a row with a stray quote is the first line's end outside quotes.
class RowEnds {
 public:
  /// Does a row, a comment or a blank line end with this character?
  bool ends_with(char c) noexcept {
    if (c == '\n' && state_ != State::quoted) {
      state_ = State::row_start;
      return true;
    }
    switch (state_) {
      case State::row_start:
      case State::cell_start:
        if (is_space(c)) break;
        state_ = c == '"'                                 ? State::quoted
                 : c == ','                               ? State::cell_start
                 : c == '#' && state_ == State::row_start ? State::comment
                                                          : State::plain;
        break;
      case State::plain:
        if (c == ',') state_ = State::cell_start;
        break;
      case State::quoted:
        if (c == '"') state_ = State::closed;
        break;
      case State::closed:
        state_ = c == '"' ? State::quoted : c == ',' ? State::cell_start : State::plain;
        break;
      case State::comment:
        break;
    }
    return false;
  }

 private:
  // closed: after a quote inside quotes, which either ends them or is the first of two.
  enum class State { row_start, cell_start, plain, quoted, closed, comment };
  State state_ = State::row_start;
};

/// Cuts off the first row, comment or blank line; without its end.
inline std::string_view take_row(std::string_view& text, bool quotes) noexcept {
  if (!quotes) return take_until(text, '\n');
  RowEnds ends;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!ends.ends_with(text[i])) continue;
    const std::string_view row = text.substr(0, i);
    text.remove_prefix(i + 1);
    return row;
  }
  return std::exchange(text, {});
}

inline std::size_t line_breaks(std::string_view text) noexcept {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// A cell of a row that may have quotes.
struct Cell {
  std::string_view text;       ///< between the quotes, or without the spaces around
  bool has_doubles = false;    ///< two quotes stand for one
  bool is_last = false;        ///< no comma is behind it
  const char* rule = nullptr;  ///< that it breaks
};

/// Cuts off the first cell, with its comma.
inline Cell take_cell(std::string_view& row) noexcept {
  Cell cell;
  const auto up_to_the_comma = [&] {
    const std::size_t left = row.size();
    const std::string_view taken = take_until(row, ',');
    cell.is_last = taken.size() == left;
    return trimmed(taken);
  };
  std::size_t end = 0;
  while (end < row.size() && is_space(row[end])) ++end;
  if (end == row.size() || row[end] != '"') {
    cell.text = up_to_the_comma();
    if (has_quotes(cell.text))
      cell.rule = "a quote stands around a whole cell, and inside it twice";
    return cell;
  }
  row.remove_prefix(end + 1);
  for (end = 0; end < row.size(); ++end) {
    if (row[end] != '"') continue;
    if (!row.substr(end + 1).starts_with('"')) break;
    cell.has_doubles = true;
    ++end;
  }
  cell.text = row.substr(0, end);
  cell.is_last = end == row.size();
  if (cell.is_last) cell.rule = "a quote that is opened must be closed";
  row.remove_prefix(std::min(end + 1, row.size()));
  if (!cell.is_last && !up_to_the_comma().empty()) {
    cell.rule = "a closing quote must be followed by a comma or the end of the row";
  }
  return cell;
}

/// The text of a cell without its doubled quotes.
inline std::string without_doubles(std::string_view text) {
  std::string single;
  for (std::size_t i = 0; i < text.size(); ++i) {
    single += text[i];
    if (text[i] == '"') ++i;
  }
  return single;
}

}  // namespace tangency::inline v0::tables
