// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/ellipse_closest_point.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>

namespace tangency::inline v0::tool {
namespace {

constexpr std::array<std::string_view, 10> kOutputColumns{
    "row", "gap", "nx", "ny", "nz", "pa.x", "pa.y", "pa.z", "gap_error", "status"};
constexpr std::array<std::string_view, 8> kPlaneOutputColumns{
    "row", "gap", "nx", "ny", "pa.x", "pa.y", "gap_error", "status"};

constexpr const char* kHelp = R"(
and of the point:
  p.x p.y p.z      finite

Output columns, in this order:
  row              number of the data row, from 0
  gap              signed distance of the point from the body's surface: < 0 inside
  nx ny nz         unit, the outer normal of the surface at the closest point
  pa.x pa.y pa.z   the point of the surface that is closest: p - pa = gap n
  gap_error        proven: the true distance is this near to gap
  status           ok: the least distance; not_applicable: some number is beyond the range
                   of a double; invalid: the row was refused (only with --keep-going). The
                   numbers of these two are empty
  Where several points of the surface are closest, inside the body, it is the one on the
  positive side of the smallest semi-axis.

Exit status: 0 every row is ok; 1 some row is not; 2 refused command line or input, or a
failed read or write.

Example, a point outside an ellipsoid and its centre:
  $ cat points.csv
  a.x,a.y,a.z,a.r1,a.r2,a.r3,p.x,p.y,p.z
  0,0,0,3,2,1,0,0,4
  0,0,0,3,2,1,0,0,0
  $ tangency point points.csv
  row,gap,nx,ny,nz,pa.x,pa.y,pa.z,gap_error,status
  0,3,0,0,1,0,0,1,6.661338205653588e-16,ok
  1,-1,0,0,1,0,0,1,2.2204460740657334e-16,ok
)";

constexpr const char* kPlaneHelp = R"(
and of the point:
  p.x p.y          finite

Output columns, in this order:
  row              number of the data row, from 0
  gap              signed distance of the point from the ellipse: < 0 inside
  nx ny            unit, the outer normal of the ellipse at the closest point
  pa.x pa.y        the point of the ellipse that is closest: p - pa = gap n
  gap_error        proven: the true distance is this near to gap
  status           ok: the least distance; not_applicable: some number is beyond the range
                   of a double; invalid: the row was refused (only with --keep-going). The
                   numbers of these two are empty
  Where two points of the ellipse are closest, inside it, it is the one on the positive
  side of the shorter semi-axis.

Exit status: 0 every row is ok; 1 some row is not; 2 refused command line or input, or a
failed read or write.

Example, a point outside an ellipse and one on its longer axis:
  $ cat points.csv
  a.x,a.y,a.r1,a.r2,a.angle,p.x,p.y
  0,0,5,3,0,0,7
  0,0,5,3,0,1,0
  $ tangency ellipse-point points.csv
  row,gap,nx,ny,pa.x,pa.y,gap_error,status
  0,4,0,1,0,3,8.881784296262934e-16,ok
  1,-2.9047375096555625,0.19364916731037085,0.9810708435174291,1.5625,2.8497532787944992,6.44981297705473e-16,ok
)";

/// Cells of an answer in space or in the plane.
template <class Closest, class Vector>
tables::RowOutcome write(const Closest& found, const Vector& centre, tables::RowText& out) {
  const Vector point = centre + found.arm;
  if (!std::isfinite(found.distance) || !std::isfinite(found.distance_error) ||
      !point.allFinite()) {
    out.empty(2 + 2 * Vector::SizeAtCompileTime);
    out.text("not_applicable");
    return tables::RowOutcome::unanswered;
  }
  out.number(found.distance);
  for (const double component : found.normal) out.number(component);
  for (const double component : point) out.number(component);
  out.number(found.distance_error);
  out.text("ok");
  return tables::RowOutcome::answered;
}

tables::RowFunction bind(const tables::Header& header, MixedTerms mixed_terms) {
  return [a = BodyColumns(header, "a", mixed_terms),
          p = NumberColumns<3>(header, "the point", "p.", {"x", "y", "z"},
                               "a point has the columns p.x, p.y and p.z")](
             const tables::RowCursor& row, tables::RowText& out) {
    const MatrixEllipsoid body = a.read(row);
    const auto at = p.read(row);
    return write(closest_point(body, Vec3(at[0], at[1], at[2])), body.ellipsoid().centre(), out);
  };
}

tables::RowFunction bind_in_plane(const tables::Header& header, MixedTerms mixed_terms) {
  return [a = EllipseColumns(header, "a", mixed_terms),
          p = NumberColumns<2>(header, "the point", "p.", {"x", "y"},
                               "a point has the columns p.x and p.y")](const tables::RowCursor& row,
                                                                       tables::RowText& out) {
    const MatrixEllipse body = a.read(row);
    const auto at = p.read(row);
    return write(closest_point(body, Vec2(at[0], at[1])), body.ellipse().centre(), out);
  };
}

}  // namespace

void add_point(tables::Program& program) {
  add_row_command<QuadricOptions>(
      program,
      {.name = "point",
       .description = "Signed distance of points from ellipsoids, and the closest points of these",
       .help = std::string(kBodyColumnsHelp) + kHelp,
       .task = [](const QuadricOptions& options) {
         const MixedTerms terms = mixed_terms_named(options.mixed_terms);
         return row_task(kOutputColumns, "status",
                         [terms](const auto& header) { return bind(header, terms); });
       }});
}

void add_ellipse_point(tables::Program& program) {
  add_row_command<ConicOptions>(
      program, {.name = "ellipse-point",
                .description = "The same of points and ellipses in the plane",
                .help = std::string(kEllipseColumnsHelp) + kPlaneHelp,
                .task = [](const ConicOptions& options) {
                  const MixedTerms terms = mixed_terms_named(options.mixed_terms);
                  return row_task(kPlaneOutputColumns, "status", [terms](const auto& header) {
                    return bind_in_plane(header, terms);
                  });
                }});
}

}  // namespace tangency::inline v0::tool
