// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/answers/truth_table.hpp>

#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <tangency/verify/oracles/classification.hpp>

namespace tangency::inline v0::verify {
namespace {

using tables::Column;
using tables::RowCursor;
using Columns3 = std::array<Column, 3>;

// The column that only truths of this kind have; pairs are those that have none of these.
constexpr std::array<std::pair<const char*, CorpusKind>, 9> kOwnColumns{
    {{"type", CorpusKind::quadrics},
     {"crossings", CorpusKind::ellipses},
     {"p.size", CorpusKind::points},
     {"w.size", CorpusKind::walls},
     {"r.size", CorpusKind::rays},
     {"tolerance", CorpusKind::times},
     {"m.size", CorpusKind::matrices},
     {"float.size", CorpusKind::floats},
     {"ix", CorpusKind::neighbours}}};

TwoDoubles two_doubles(const RowCursor& row, Column column) {
  const double high = row.number(column);
  const std::string text(row.text(column));
  if (text.find_first_of("xX") != std::string::npos) return {high, 0};
  mpfr_t number;
  mpfr_init2(number, 256);  // chosen: 40 digits and their exponent with 100 bits to spare
  mpfr_set_str(number, text.c_str(), 10, MPFR_RNDN);
  mpfr_sub_d(number, number, high, MPFR_RNDN);
  const double low = mpfr_get_d(number, MPFR_RNDN);
  mpfr_clear(number);
  return {high, low};
}

std::array<double, 3> unit_vector(const RowCursor& row, Column first,
                                  const std::array<double, 3>& v) {
  constexpr double kRounding = 1e-12;  // chosen: far above what 40 digits read as doubles lose
  if (!(std::abs(std::hypot(v[0], v[1], v[2]) - 1) <= kRounding)) {
    throw row.error(first, "the vector that begins here must have length 1");
  }
  return v;
}

std::array<double, 3> unit_vector(const RowCursor& row, const Columns3& columns) {
  return unit_vector(row, columns[0],
                     {row.number(columns[0]), row.number(columns[1]), row.number(columns[2])});
}

// Of the lines about one row, each with a maximiser.
void require_same(const RowCursor& line, Column column, bool same) {
  if (!same) throw line.error(column, "another line about this row says otherwise");
}

Columns3 require3(const tables::Header& header, const std::array<const char*, 3>& names) {
  return {header.require(names[0]), header.require(names[1]), header.require(names[2])};
}

int small_count(const RowCursor& row, Column column) {
  const double count = row.number(column);
  if (count >= 0 && count <= 4 && count == static_cast<int>(count)) return static_cast<int>(count);
  throw row.error(column, "two ellipses have 0 to 4 crossings");
}

// A line a true normal, or a line a neighbour.
bool has_several_lines(CorpusKind kind) {
  using enum CorpusKind;
  return kind != quadrics && kind != rays && kind != times;
}

// What all kinds have in common, and the order of rows.
class TableReader {
 public:
  TableReader(const tables::Header& header, CorpusKind kind)
      : row_(header.require("row")), family_(header.require("family")), table_{kind, {}, {},
                                                                               {},   {}, false} {}

  // The last row of the table is then the one that this line is about: has it been seen before?
  bool enter(const RowCursor& line) {
    const double number = line.number(row_);
    const auto count = static_cast<double>(table_.rows.size());
    const bool again = has_several_lines(table_.kind) && count > 0 && number == count - 1;
    if (!again && number != count) {
      throw line.error(row_, "rows must be numbered from 0 in order");
    }
    if (!again) table_.rows.emplace_back().family = family(line);
    return again;
  }
  TruthTable& table() { return table_; }

 private:
  std::size_t family(const RowCursor& line) {
    auto& names = table_.families;
    const std::string_view name = line.text(family_);
    if (names.empty() || names.back() != name) {
      const auto found = std::ranges::find(names, name);
      if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
      names.emplace_back(name);
    }
    return names.size() - 1;
  }

  Column row_, family_;
  TruthTable table_;
};

std::string read_type(const RowCursor& line, Column column) {
  const std::string_view text = line.text(column);
  for (int k = 0; k <= static_cast<int>(QuadricType::all_space); ++k) {
    if (text == name(static_cast<QuadricType>(k))) return std::string(text);
  }
  throw line.error(column, "this is not a type");
}

Relation read_relation(const RowCursor& line, Column column) {
  if (const auto relation = relation_named(line.text(column))) return *relation;
  throw line.error(column, "this is not a relation");
}

double positive(const RowCursor& line, Column column, std::string_view rule) {
  const double value = line.number(column);
  if (!(value > 0)) throw line.error(column, rule);
  return value;
}

// What a gap is called by each definition, and its normal.
struct GapColumns {
  const char* gap;
  std::array<const char*, 3> normal;
};

GapColumns gap_columns(Definition definition) {
  constexpr std::array kOwn{"nx", "ny", "nz"}, kPerramWertheim{"pw.nx", "pw.ny", "pw.nz"};
  switch (definition) {
    case Definition::common_normal:
      return {"gap", kOwn};
    case Definition::perram_wertheim:
      return {"pw.gap", kPerramWertheim};
    case Definition::midpoint_potential:
      return {"mp.gap", kPerramWertheim};
    case Definition::centre_line:
      break;
  }
  return {"cl.gap", kPerramWertheim};
}

// Of pairs, matrices, floats, points and walls: points have no relation, and points and walls one
// definition.
class GapReader {
 public:
  GapReader(const tables::Header& header, CorpusKind kind, Definition definition, TruthTable& table)
      : table_(table),
        common_(definition == Definition::common_normal || has_one_definition(kind)),
        columns_(gap_columns(common_ ? Definition::common_normal : definition)),
        size_(header.require(size_column(kind))),
        gap_(header.require(columns_.gap)),
        set_(header.require("normals")),
        axis_(require3(header, {"ax", "ay", "az"})),
        normal_(require3(header, columns_.normal)) {
    if (kind != CorpusKind::points) relation_ = header.require("relation");
    table.has_normals = common_ || definition != Definition::centre_line;
  }

  void operator()(const RowCursor& line, bool again) const {
    TruthRow& row = table_.rows.back();
    std::optional<TwoDoubles> gap;
    if (!line.text(gap_).empty()) gap = two_doubles(line, gap_);
    if (!again) {
      if (relation_) row.relation = read_relation(line, *relation_);
      row.size = positive(line, size_, "a size must be > 0");
      row.gap = gap;
      row.first_normal = table_.maximisers.size();
    } else {
      if (relation_)
        require_same(line, *relation_, read_relation(line, *relation_) == row.relation);
      require_same(line, gap_, gap == row.gap);
    }
    if (!row.gap || !table_.has_normals || (again && !common_)) return;
    const std::string_view set = common_ ? line.text(set_) : "point";
    if (set == "all") {
      row.every_normal = true;
      return;
    }
    if (set != "point" && set != "circle") throw line.error(set_, "this is not a set of normals");
    Maximiser one{unit_vector(line, normal_), std::nullopt};
    if (set == "circle") one.axis = unit_vector(line, axis_);
    table_.maximisers.push_back(one);
    ++row.normals;
  }

 private:
  static bool has_one_definition(CorpusKind kind) {
    return kind == CorpusKind::points || kind == CorpusKind::walls;
  }
  static const char* size_column(CorpusKind kind) {
    const auto* const own =
        std::ranges::find(kOwnColumns, kind, &decltype(kOwnColumns)::value_type::second);
    return own == kOwnColumns.end() ? "size" : own->first;
  }

  TruthTable& table_;
  bool common_;
  GapColumns columns_;
  std::optional<Column> relation_;
  Column size_, gap_, set_;
  Columns3 axis_, normal_;
};

class EllipseReader {
 public:
  EllipseReader(const tables::Header& header, TruthTable& table)
      : table_(table),
        relation_(header.require("relation")),
        crossings_(header.require("crossings")),
        size_(header.require("size")),
        area_(header.require("area")),
        smaller_area_(header.require("smaller_area")),
        gap_(header.require("gap")),
        set_(header.find("normals")) {
    // Tables of before there were normals have none.
    table.has_normals = set_.has_value();
    if (set_) normal_ = {header.require("nx"), header.require("ny")};
  }

  void operator()(const RowCursor& line, bool again) const {
    TruthRow& row = table_.rows.back();
    if (!again) read_row(line, row, table_.maximisers.size());
    require_same(line, relation_, read_relation(line, relation_) == row.relation);
    require_same(line, gap_, two_doubles(line, gap_) == row.gap);
    if (!set_) return;
    const std::string_view set = line.text(*set_);
    if (set == "all") {
      row.every_normal = true;
      return;
    }
    if (set != "point") throw line.error(*set_, "this is not a set of normals");
    const double x = line.number(normal_[0]), y = line.number(normal_[1]);
    table_.maximisers.push_back({unit_vector(line, normal_[0], {x, y, 0}), std::nullopt});
    ++row.normals;
  }

 private:
  void read_row(const RowCursor& line, TruthRow& row, std::size_t first_normal) const {
    row.first_normal = first_normal;
    row.relation = read_relation(line, relation_);
    row.crossings = line.text(crossings_).empty() ? -1 : small_count(line, crossings_);
    row.size = positive(line, size_, "a size must be > 0");
    row.area = line.number(area_);
    row.smaller_area = positive(line, smaller_area_, "an area must be > 0");
    row.gap = two_doubles(line, gap_);
  }

  TruthTable& table_;
  Column relation_, crossings_, size_, area_, smaller_area_, gap_;
  std::optional<Column> set_;
  std::array<Column, 2> normal_{};
};

// Of rays and times: a word and up to two numbers.
class TimesReader {
 public:
  struct Names {
    const char *word, *size, *first, *second;
    std::span<const std::string_view> words;
  };
  TimesReader(const tables::Header& header, const Names& names, TruthTable& table)
      : table_(table),
        words_(names.words),
        word_(header.require(names.word)),
        size_(header.require(names.size)),
        numbers_{header.require(names.first), header.require(names.second)} {}

  void operator()(const RowCursor& line, bool /*again*/) const {
    TruthRow& row = table_.rows.back();
    row.word = line.text(word_);
    if (std::ranges::find(words_, row.word) == words_.end())
      throw line.error(word_, "this is not a word of this column");
    row.size = positive(line, size_, "a size must be > 0");
    for (std::size_t k = 0; k < 2; ++k) {
      if (!line.text(numbers_[k]).empty()) row.times[k] = two_doubles(line, numbers_[k]);
    }
  }

 private:
  TruthTable& table_;
  std::span<const std::string_view> words_;
  Column word_, size_;
  std::array<Column, 2> numbers_;
};

constexpr std::array<std::string_view, 3> kResults{"hit", "miss", "grazing"};
constexpr std::array<std::string_view, 4> kStatuses{"none", "contact", "touching_at_start",
                                                    "grazing"};

class NeighbourReader {
 public:
  NeighbourReader(const tables::Header& header, TruthTable& table)
      : table_(table), j_(header.require("j")), image_(require3(header, {"ix", "iy", "iz"})) {}

  void operator()(const RowCursor& line, bool again) const {
    TruthRow& row = table_.rows.back();
    if (!again) row.first_neighbour = table_.neighbours.size();
    if (line.text(j_).empty()) return;
    TrueNeighbour one{whole(line, j_), {}};
    for (std::size_t k = 0; k < 3; ++k) one.image[k] = edges(line, image_[k]);
    if (again && row.neighbours == 0)
      throw line.error(j_, "the first line of this row says that it has no neighbour");
    if (again && !(table_.neighbours.back() < one))
      throw line.error(j_, "neighbours must be in order");
    table_.neighbours.push_back(one);
    ++row.neighbours;
  }

 private:
  static std::size_t whole(const RowCursor& line, Column column) {
    constexpr double kMost = 1e9;  // chosen: far above what a table has
    const double value = line.number(column);
    if (value >= 0 && value < kMost && value == std::floor(value))
      return static_cast<std::size_t>(value);
    throw line.error(column, "this must be the number of a body");
  }
  static int edges(const RowCursor& line, Column column) {
    constexpr double kMost = 1e6;  // as of answers: grade.cpp
    const double value = line.number(column);
    if (std::abs(value) <= kMost && value == std::floor(value)) return static_cast<int>(value);
    throw line.error(column, "an image is given by whole numbers");
  }

  TruthTable& table_;
  Column j_;
  Columns3 image_;
};

// What reads a line into the last row of the table.
using LineReader = std::function<void(const RowCursor& line, bool again)>;

LineReader line_reader(const tables::Header& header, Definition definition, TruthTable& table) {
  using enum CorpusKind;
  switch (table.kind) {
    case ellipses:
      return EllipseReader(header, table);
    case quadrics:
      return [&table, type = header.require("type")](const RowCursor& line, bool) {
        table.rows.back().word = read_type(line, type);
      };
    case rays:
      return TimesReader(header, {"result", "r.size", "t1", "t2", kResults}, table);
    case times:
      return TimesReader(header, {"status", "tolerance", "earliest", "latest", kStatuses}, table);
    case neighbours:
      return NeighbourReader(header, table);
    case pairs:
    case points:
    case walls:
    case matrices:
    case floats:
      break;
  }
  return GapReader(header, table.kind, definition, table);
}

}  // namespace

std::optional<Relation> relation_named(std::string_view word) {
  using enum Relation;
  for (const Relation relation :
       {separate, external_touch, overlap, internal_touch, a_in_b, b_in_a, equal}) {
    if (word == name(relation)) return relation;
  }
  return std::nullopt;
}

CorpusKind kind_of_truth(const tables::Header& header) {
  const auto* const own = std::ranges::find_if(
      kOwnColumns, [&](const auto& column) { return header.find(column.first).has_value(); });
  return own == kOwnColumns.end() ? CorpusKind::pairs : own->second;
}

TruthTable read_truth(tables::Reader&& file, Definition definition) {
  TableReader reader(file.header(), kind_of_truth(file.header()));
  const LineReader read = line_reader(file.header(), definition, reader.table());
  tables::for_each_row(file, [&](const RowCursor& line) {
    const bool again = reader.enter(line);
    read(line, again);
  });
  return std::move(reader.table());
}

}  // namespace tangency::inline v0::verify
