// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/show/shown_row.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace tangency::inline v0::verify {
namespace {

Cells cells_of(const tables::Header& header, const tables::RowCursor& line) {
  Cells cells;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const tables::Column column{i};
    if (!line.text(column).empty()) cells.emplace_back(header.name(column), line.text(column));
  }
  return cells;
}

// The numbers of the columns with these names behind `body`; nothing where one is missing.
template <std::size_t Count>
std::optional<std::array<double, Count>> numbers(const Cells& cells, const std::string& body,
                                                 const std::array<const char*, Count>& names) {
  std::array<double, Count> found{};
  for (std::size_t i = 0; i < Count; ++i) {
    const auto cell = std::ranges::find(cells, body + names[i], &Cells::value_type::first);
    if (cell == cells.end() || tables::parse_number(cell->second, found[i])) return std::nullopt;
  }
  return found;
}

std::optional<RawEllipsoid> solid(const Cells& cells, const std::string& body) {
  const auto v =
      numbers<10>(cells, body, {"x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz"});
  if (v) {
    const auto& n = *v;
    return RawEllipsoid{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8], n[9]}};
  }
  const auto plane = numbers<6>(cells, body, {"x", "y", "r1", "r2", "ux", "uy"});
  if (!plane) return std::nullopt;
  const auto& n = *plane;
  // Half the angle of the direction; a direction along -x is a half turn.
  const double length = std::hypot(n[4], n[5]);
  const bool is_half_turn = n[5] == 0 && n[4] < 0;
  return RawEllipsoid{{n[0], n[1], 0},
                      {n[2], n[3], std::min(n[2], n[3])},
                      {is_half_turn ? 0 : length + n[4], 0, 0, is_half_turn ? 1 : n[5]}};
}

bool is_body(const RawEllipsoid& body) {
  const auto is_positive = [](double r) { return r > 0; };
  const auto is_zero = [](double q) { return q == 0; };
  return std::ranges::all_of(body.semi_axes, is_positive) &&
         !std::ranges::all_of(body.orientation, is_zero);
}

}  // namespace

std::optional<InputRow> input_row(const tables::NamedText& inputs, std::size_t row) {
  tables::Reader reader(inputs);
  std::optional<InputRow> found;
  tables::for_each_row(reader, [&](const tables::RowCursor& line) {
    if (line.index() == row) found = InputRow{cells_of(reader.header(), line), line.line()};
  });
  return found;
}

std::vector<Cells> lines_about(tables::Reader&& table, std::size_t row,
                               const std::vector<std::string>& columns) {
  std::vector<Cells> lines;
  std::vector<tables::Column> found;
  for (const std::string& name : columns) {
    if (const auto column = table.header().find(name)) found.push_back(*column);
  }
  tables::Block block;
  tables::RowCursor line(table.header());
  while (table.read(block)) {
    line.enter(block);
    for (;;) {
      try {
        if (!line.next()) break;
        const auto says_it = [&](tables::Column column) {
          double number = 0;
          return !tables::parse_number(line.text(column), number) &&
                 number == static_cast<double>(row);
        };
        if (std::ranges::any_of(found, says_it)) lines.push_back(cells_of(table.header(), line));
      } catch (const tables::Error&) {  // a line of a wrong length: next() goes on after it
      }
    }
  }
  return lines;
}

std::optional<Solids> solids_of(const Cells& inputs) {
  const auto a = solid(inputs, "a."), b = solid(inputs, "b.");
  if (!a || !b || !is_body(*a) || !is_body(*b)) return std::nullopt;
  return Solids{*a, *b};
}

}  // namespace tangency::inline v0::verify
