// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/ray.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>

namespace tangency::inline v0::tool {
namespace {

constexpr std::array<std::string_view, 4> kOutputColumns{"row", "result", "t1", "t2"};

constexpr const char* kHelp = R"(
and of the ray o + t d, t0 <= t <= t1:
  r.ox r.oy r.oz   o
  r.dx r.dy r.dz   d, of any length, not all 0
  r.t0 r.t1        where the ray begins and ends; 0 and no end without these columns

Output columns, in this order:
  row              number of the data row, from 0
  result           hit: the ray meets the surface; miss: it does not; grazing: its line
                   touches the surface in one point, which is on the ray. Exact for the
                   numbers as they are read. not_applicable: hits of which some t is beyond
                   the range of a double; invalid: the row was refused (only with
                   --keep-going)
  t1 t2            where it does, by increasing t, which is within [r.t0, r.t1]; t2 is
                   empty where only one point is, t1 where none is. An origin inside has
                   one hit, where the ray leaves; one on the surface is itself a hit

Exit status: 0 every row is answered; 1 some row is invalid or not_applicable; 2 refused
command line or input, or a failed read or write.

Example, through a sphere, from inside, along its top, and past it:
  $ cat rays.csv
  a.x,a.y,a.z,a.r1,a.r2,a.r3,r.ox,r.oy,r.oz,r.dx,r.dy,r.dz
  0,0,0,1,1,1,-3,0,0,1,0,0
  0,0,0,1,1,1,0.5,0,0,1,0,0
  0,0,0,1,1,1,-3,0,1,2,0,0
  0,0,0,1,1,1,-3,0,1.5,1,0,0
  $ tangency ray rays.csv
  row,result,t1,t2
  0,hit,2,4
  1,hit,0.5,
  2,grazing,1.5,
  3,miss,,
)";

/// The columns of a ray, and its ends, of which each may be missing.
class RayColumns {
 public:
  explicit RayColumns(const tables::Header& header)
      : line_(header, "the ray", "r.", {"ox", "oy", "oz", "dx", "dy", "dz"},
              "a ray has the columns r.ox, r.oy, r.oz, r.dx, r.dy and r.dz"),
        begin_(header.find("r.t0")),
        end_(header.find("r.t1")) {}

  struct Ends {
    double begin, end;
  };

  Ray ray(const tables::RowCursor& row) const {
    const std::array<double, 6> p = line_.read(row);
    const Vec3 direction(p[3], p[4], p[5]);
    if (direction == Vec3::Zero()) throw row.error(line_[3], "a ray's direction must not be all 0");
    return {Vec3(p[0], p[1], p[2]), direction};
  }
  Ends ends(const tables::RowCursor& row) const {
    const double begin = begin_ ? row.number(*begin_) : 0.0;
    const double end = end_ ? row.number(*end_) : std::numeric_limits<double>::infinity();
    if (!(begin <= end)) throw row.error(end_ ? *end_ : *begin_, "a ray ends at or after r.t0");
    return {begin, end};
  }

 private:
  NumberColumns<6> line_;
  std::optional<tables::Column> begin_, end_;
};

tables::RowOutcome write(const RayHit& hit, tables::RowText& out) {
  for (int i = 0; i < hit.count; ++i) {
    if (std::isfinite(hit.points[i].t)) continue;
    out.text("not_applicable");
    out.empty(2);
    return tables::RowOutcome::unanswered;
  }
  switch (hit.status) {
    case RayStatus::miss:
      out.text("miss");
      break;
    case RayStatus::hit:
      out.text("hit");
      break;
    case RayStatus::grazing:
      out.text("grazing");
      break;
  }
  for (int i = 0; i < hit.count; ++i) out.number(hit.points[i].t);
  if (hit.count < 2) out.empty(static_cast<std::size_t>(2 - hit.count));
  return tables::RowOutcome::answered;
}

tables::RowFunction bind(const tables::Header& header, MixedTerms mixed_terms) {
  return [a = BodyColumns(header, "a", mixed_terms), r = RayColumns(header)](
             const tables::RowCursor& row, tables::RowText& out) {
    const MatrixEllipsoid body = a.read(row);
    const Ray ray = r.ray(row);
    const auto [begin, end] = r.ends(row);
    return write(intersect(body, ray, begin, end), out);
  };
}

}  // namespace

void add_ray(tables::Program& program) {
  add_row_command<QuadricOptions>(
      program, {.name = "ray",
                .description = "Where rays meet the surfaces of ellipsoids",
                .help = std::string(kBodyColumnsHelp) + kHelp,
                .task = [](const QuadricOptions& options) {
                  const MixedTerms terms = mixed_terms_named(options.mixed_terms);
                  return row_task(kOutputColumns, "result",
                                  [terms](const auto& header) { return bind(header, terms); });
                }});
}

}  // namespace tangency::inline v0::tool
