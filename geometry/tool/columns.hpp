// SPDX-License-Identifier: MIT
/// @file
/// The columns that a subcommand reads, by their names; and those of a body that may be given in
/// one of several forms, each known by its columns. body_columns.hpp has the forms.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>

namespace tangency::inline v0::tool {

/// The columns that were found; the names of the others, prefix and field, are added to `missing`.
template <std::size_t N>
std::array<tables::Column, N> find_columns(const tables::Header& header, std::string_view prefix,
                                           const std::array<std::string_view, N>& fields,
                                           std::vector<std::string>& missing) {
  std::array<tables::Column, N> columns{};
  for (std::size_t i = 0; i < N; ++i) {
    const std::string name = std::string(prefix) + std::string(fields[i]);
    if (const auto column = header.find(name)) {
      columns[i] = *column;
    } else {
      missing.push_back(name);
    }
  }
  return columns;
}

/// "pairs.csv:1: body a without a.r1, a.r2: rule"
tables::Error lacking(const tables::Header& header, std::string_view who,
                      const std::vector<std::string>& missing, std::string_view rule);

/// Columns of numbers that a table must have: a point, a wall, a line, a motion.
template <std::size_t N>
class NumberColumns {
 public:
  /// @param who   "the point", in messages
  /// @param rule  which columns there have to be
  /// @throws tables::Error  naming the columns that the header lacks
  NumberColumns(const tables::Header& header, std::string_view who, std::string_view prefix,
                const std::array<std::string_view, N>& fields, std::string_view rule) {
    std::vector<std::string> missing;
    columns_ = find_columns(header, prefix, fields, missing);
    if (!missing.empty()) throw lacking(header, who, missing, rule);
  }

  std::array<double, N> read(const tables::RowCursor& row) const {
    std::array<double, N> numbers{};
    for (std::size_t i = 0; i < N; ++i) numbers[i] = row.number(columns_[i]);
    return numbers;
  }
  tables::Column operator[](std::size_t i) const noexcept { return columns_[i]; }

 private:
  std::array<tables::Column, N> columns_{};
};

/// One way to give a body.
struct BodyForm {
  std::string_view name;                   ///< in messages: "a shape matrix"
  std::vector<std::string_view> place;     ///< columns that other forms have too
  std::vector<std::string_view> own;       ///< columns by which it is known
  std::vector<std::string_view> optional;  ///< all or none of them
  bool has_level = false;                  ///< may level or confidence stand beside it?
};

/// The columns of one body, whose form is found from the header.
class FormColumns {
 public:
  /// @param body   "a" or "b", which stands before the names of its columns with a point; or
  ///               nothing, for a table of bodies
  /// @param forms  must outlive this; the first is asked for where none is there
  /// @param rule   what is allowed, where two forms are there
  /// @throws tables::Error  naming the columns that the header lacks, or that belong to two forms
  FormColumns(const tables::Header& header, std::string_view body, std::span<const BodyForm> forms,
              std::string_view rule);

  std::size_t form() const noexcept { return form_; }
  /// The cells of a row: place, own, and the optional ones where they are there.
  std::vector<double> numbers(const tables::RowCursor& row) const;
  /// Of the columns level or confidence; 1 without them.
  double level(const tables::RowCursor& row, int dimensions) const;
  /// A fault of the field: of its cell or, where it has none, of a matrix as a whole.
  tables::Error refused(const tables::RowCursor& row, std::string_view field, double value,
                        std::string_view rule) const;

 private:
  void find_form(const tables::Header& header, std::span<const BodyForm> forms,
                 std::string_view rule);
  void find_level(const tables::Header& header, bool has_level);

  std::string file_, who_, prefix_;
  std::size_t form_ = 0;
  std::vector<std::string_view> fields_;  ///< in the order of columns_
  std::vector<tables::Column> columns_;
  std::optional<tables::Column> level_, confidence_;
};

}  // namespace tangency::inline v0::tool
