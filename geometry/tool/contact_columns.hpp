// SPDX-License-Identifier: MIT
/// @file
/// What --columns of `tangency contact` and `tangency ellipse` may add at the end of a row. A new
/// column is a row of a table in contact_columns.cpp.
#pragma once

#include <span>

#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/matrix_ellipse.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tool/further_columns.hpp>

namespace tangency::inline v0::tool {

/// What a row of `contact` has to say before its further columns.
struct ContactRow {
  const MatrixEllipsoid& a;
  const MatrixEllipsoid& b;
  const RelationAnswer& relation;
  const Vec3* normal = nullptr;  ///< that of the row; null where it has no numbers
  const Gap* gap = nullptr;      ///< null where the row is not of the common normal
};

/// The same of a row of `ellipse`.
struct EllipseRow {
  const MatrixEllipse& a;
  const MatrixEllipse& b;
  const EllipseRelation& relation;
};

std::span<const ColumnGroup<ContactRow>> contact_column_groups();
std::span<const ColumnGroup<EllipseRow>> ellipse_column_groups();

}  // namespace tangency::inline v0::tool
