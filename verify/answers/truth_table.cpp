// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/answers/truth_table.hpp>

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tangency/verify/oracles/classification.hpp>

namespace tangency::inline v0::verify {
namespace {

using tables::Column;
using tables::RowCursor;
using Columns3 = std::array<Column, 3>;

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

// What all kinds have in common, and the order of rows.
class TableReader {
 public:
  TableReader(const tables::Header& header, CorpusKind kind)
      : row_(header.require("row")), family_(header.require("family")), table_{kind, {}, {}, {}} {}

  // The row of the table that this line is about; `again` where it has been seen.
  TruthRow& enter(const RowCursor& line, bool& again) {
    const double number = line.number(row_);
    const auto count = static_cast<double>(table_.rows.size());
    again = table_.kind != CorpusKind::quadrics && count > 0 && number == count - 1;
    if (!again && number != count) {
      throw line.error(row_, "rows must be numbered from 0 in order");
    }
    if (!again) table_.rows.emplace_back().family = family(line);
    return table_.rows.back();
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

class PairReader {
 public:
  PairReader(const tables::Header& header, Definition definition)
      : definition_(definition),
        relation_(header.require("relation")),
        size_(header.require("size")),
        gap_(header.require(gap_column(definition))),
        set_(header.require("normals")),
        axis_(require3(header, {"ax", "ay", "az"})) {
    const bool common = definition == Definition::common_normal;
    normal_ = common ? require3(header, {"nx", "ny", "nz"})
                     : require3(header, {"pw.nx", "pw.ny", "pw.nz"});
  }

  void read(const RowCursor& line, bool again, TruthTable& table) const {
    TruthRow& row = table.rows.back();
    const bool common = definition_ == Definition::common_normal;
    if (!again) {
      row.relation = read_relation(line, relation_);
      row.size = line.number(size_);
      if (!(row.size > 0)) throw line.error(size_, "a size must be > 0");
      if (!line.text(gap_).empty()) row.gap = two_doubles(line, gap_);
      row.first_normal = table.maximisers.size();
    } else {
      require_same(line, relation_, read_relation(line, relation_) == row.relation);
      require_same(line, gap_,
                   line.text(gap_).empty() ? !row.gap : two_doubles(line, gap_) == row.gap);
    }
    if (!row.gap || !table.has_normals || (again && !common)) return;
    const std::string_view set = common ? line.text(set_) : "point";
    if (set == "all") {
      row.every_normal = true;
      return;
    }
    if (set != "point" && set != "circle") throw line.error(set_, "this is not a set of normals");
    Maximiser one{unit_vector(line, normal_), std::nullopt};
    if (set == "circle") one.axis = unit_vector(line, axis_);
    table.maximisers.push_back(one);
    ++row.normals;
  }

 private:
  static const char* gap_column(Definition definition) {
    switch (definition) {
      case Definition::common_normal:
        return "gap";
      case Definition::perram_wertheim:
        return "pw.gap";
      case Definition::midpoint_potential:
        return "mp.gap";
      case Definition::centre_line:
        break;
    }
    return "cl.gap";
  }

  Definition definition_;
  Column relation_, size_, gap_, set_;
  Columns3 axis_, normal_;
};

class EllipseReader {
 public:
  explicit EllipseReader(const tables::Header& header)
      : relation_(header.require("relation")),
        crossings_(header.require("crossings")),
        size_(header.require("size")),
        area_(header.require("area")),
        smaller_area_(header.require("smaller_area")),
        gap_(header.require("gap")),
        set_(header.find("normals")) {
    if (set_) normal_ = {header.require("nx"), header.require("ny")};
  }

  // Tables of before there were normals have none.
  bool has_normals() const { return set_.has_value(); }

  void read(const RowCursor& line, bool again, TruthTable& table) const {
    TruthRow& row = table.rows.back();
    if (!again) read_row(line, row, table.maximisers.size());
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
    table.maximisers.push_back({unit_vector(line, normal_[0], {x, y, 0}), std::nullopt});
    ++row.normals;
  }

 private:
  void read_row(const RowCursor& line, TruthRow& row, std::size_t first_normal) const {
    row.first_normal = first_normal;
    row.relation = read_relation(line, relation_);
    row.crossings = line.text(crossings_).empty() ? -1 : small_count(line, crossings_);
    row.size = line.number(size_);
    row.area = line.number(area_);
    row.smaller_area = line.number(smaller_area_);
    row.gap = two_doubles(line, gap_);
    if (!(row.size > 0)) throw line.error(size_, "a size must be > 0");
    if (!(row.smaller_area > 0)) throw line.error(smaller_area_, "an area must be > 0");
  }

  Column relation_, crossings_, size_, area_, smaller_area_, gap_;
  std::optional<Column> set_;
  std::array<Column, 2> normal_{};
};

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
  if (header.find("type")) return CorpusKind::quadrics;
  return header.find("crossings") ? CorpusKind::ellipses : CorpusKind::pairs;
}

TruthTable read_truth(tables::Reader&& file, Definition definition) {
  const tables::Header& header = file.header();
  TableReader reader(header, kind_of_truth(header));
  TruthTable& table = reader.table();
  bool again = false;
  switch (table.kind) {
    case CorpusKind::pairs: {
      table.has_normals = definition != Definition::centre_line;
      const PairReader pairs(header, definition);
      tables::for_each_row(file, [&](const RowCursor& line) {
        reader.enter(line, again);
        pairs.read(line, again, table);
      });
      break;
    }
    case CorpusKind::ellipses: {
      const EllipseReader ellipses(header);
      table.has_normals = ellipses.has_normals();
      tables::for_each_row(file, [&](const RowCursor& line) {
        reader.enter(line, again);
        ellipses.read(line, again, table);
      });
      break;
    }
    case CorpusKind::quadrics: {
      const Column type = header.require("type");
      tables::for_each_row(file, [&](const RowCursor& line) {
        reader.enter(line, again).type = read_type(line, type);
      });
      break;
    }
  }
  return std::move(table);
}

}  // namespace tangency::inline v0::verify
