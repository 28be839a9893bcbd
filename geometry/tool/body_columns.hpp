// SPDX-License-Identifier: MIT
/// @file
/// The columns of ellipsoids and ellipses, in whichever form their owner has them.
#pragma once

#include <string_view>

#include <tangency/geometry/matrix_ellipse.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tool/columns.hpp>

namespace tangency::inline v0::tool {

/// How a quadric's D, E, F, G, H and J are written, and a conic's B, D and E.
enum class MixedTerms {
  half,  ///< 2D xy and so on stand in the equation
  full,  ///< D xy does
};
/// "half" or "full".
MixedTerms mixed_terms_named(std::string_view name);

/// For help texts: the forms and their columns, of body a.
extern const char* const kBodyColumnsHelp;
extern const char* const kEllipseColumnsHelp;

/// An ellipsoid: by semi-axes and, if so wanted, a quaternion; by a shape or precision matrix; by
/// axis vectors; or by a quadric.
class BodyColumns {
 public:
  /// @param body  "a" or "b", or nothing: as FormColumns
  /// @throws tables::Error  as FormColumns
  BodyColumns(const tables::Header& header, std::string_view body,
              MixedTerms mixed_terms = MixedTerms::half);

  /// Are the bodies those of semi-axes and a quaternion, without a matrix?
  bool has_axes() const noexcept { return columns_.form() == 0; }

  /// The body of a row; not turned where the file has no orientation.
  /// @throws tables::Error  naming the cell, or the matrix, that is refused
  MatrixEllipsoid read(const tables::RowCursor& row) const;

 private:
  MatrixEllipsoid body_of(const tables::RowCursor& row) const;

  FormColumns columns_;
  MixedTerms mixed_terms_;
};

/// An ellipse: by semi-axes and the direction of the first, a vector or an angle; by a shape or
/// precision matrix; or by a conic.
class EllipseColumns {
 public:
  EllipseColumns(const tables::Header& header, std::string_view body,
                 MixedTerms mixed_terms = MixedTerms::full);

  MatrixEllipse read(const tables::RowCursor& row) const;

 private:
  MatrixEllipse body_of(const tables::RowCursor& row) const;

  FormColumns columns_;
  MixedTerms mixed_terms_;
};

/// The cell of the column inner: a, b or nothing.
void write_inner(Inner inner, tables::RowText& out);

}  // namespace tangency::inline v0::tool
