// SPDX-License-Identifier: MIT
/// @file
/// The columns of an ellipsoid, in whichever form its owner has it. A form is known by its columns;
/// a body has one.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::tool {

/// How a quadric's D, E, F, G, H and J are written.
enum class MixedTerms {
  half,  ///< 2D xy and so on stand in the equation
  full,  ///< D xy does
};

/// "half" or "full".
MixedTerms mixed_terms_named(std::string_view name);

/// For a help text: the forms and their columns.
extern const char* const kBodyColumnsHelp;

class BodyColumns {
 public:
  /// @param body  "a" or "b", which stands before the names of its columns with a point; or
  ///              nothing, for a table of bodies
  /// @throws tables::Error  naming the columns that the header lacks, or that belong to two forms
  BodyColumns(const tables::Header& header, std::string_view body,
              MixedTerms mixed_terms = MixedTerms::half);

  /// Are the bodies those of semi-axes and a quaternion, without a matrix?
  bool has_axes() const noexcept { return form_ == Form::axes; }

  /// The body of a row; the identity where the file has no orientation.
  /// @throws tables::Error  naming the cell, or the matrix, that is refused
  MatrixEllipsoid read(const tables::RowCursor& row) const;

 private:
  enum class Form : std::size_t { axes, shape, precision, vectors, quadric };

  std::vector<double> numbers(const tables::RowCursor& row) const;
  double level(const tables::RowCursor& row) const;
  MatrixEllipsoid body_of(const std::vector<double>& numbers, const tables::RowCursor& row) const;
  tables::Error refused(const tables::RowCursor& row, const EllipsoidFault& fault) const;
  void find_level(const tables::Header& header);
  std::optional<tables::Column> column_of(std::string_view field) const;

  std::string file_, who_, prefix_;
  Form form_ = Form::axes;
  MixedTerms mixed_terms_;
  std::vector<std::string_view> fields_;  ///< of the form, in the order of columns_
  std::vector<tables::Column> columns_;
  std::optional<tables::Column> level_, confidence_;
};

}  // namespace tangency::tool
