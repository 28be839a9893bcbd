// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>

namespace tangency::inline v0::tool {
namespace {

constexpr std::array<std::string_view, 15> kOutputColumns{
    "row",  "relation", "gap",  "nx",   "ny",        "nz",     "pa.x", "pa.y",
    "pa.z", "pb.x",     "pb.y", "pb.z", "gap_error", "status", "inner"};

constexpr const char* kHelp = R"(
and of the wall, body b, the solid half-space n . x <= offset:
  w.nx w.ny w.nz   n, which points out of the wall; not all 0, of any length
  w.offset         in units of n . x: the distance from the origin times the length of n

Output columns, in this order, those of `tangency contact`:
  row              number of the data row, from 0
  relation         separate, external_touch, overlap, internal_touch (the body lies in the
                   wall and touches its face) or a_in_b: exact for the numbers as they are
                   read
  gap              > 0: the distance; < 0: minus the length of the shortest translation that
                   brings the body out of the wall
  nx ny nz         unit normal, from the body to the wall: against n
  pa.x pa.y pa.z   the point of the body that reaches furthest
  pb.x pb.y pb.z   the point of the wall's face opposite to it; pb - pa = gap (nx, ny, nz)
  gap_error        proven: the true gap is this near to gap
  status           ok: the global answer; not_applicable: some number is beyond the range
                   of a double; invalid: the row was refused (only with --keep-going). The
                   numbers of these two are empty
  inner            a for internal_touch, else empty

With --two-sided the wall is the plane n . x = offset alone, without thickness, both of
whose sides are free. Then
  relation         separate, external_touch, or overlap where the plane cuts the body
  gap              > 0: the distance from the plane, whichever side the body is on; < 0:
                   minus the length of the shortest translation that brings the whole body
                   to one side, the nearer one: where its centre is
  nx ny nz         from the body's centre to the plane; against n where the centre lies in
                   the plane, up to rounding

Exit status: 0 every row is ok; 1 some row is not; 2 refused command line or input, or a
failed read or write.

Example, a body above a floor, through it, and below:
  $ cat bodies.csv
  a.x,a.y,a.z,a.r1,a.r2,a.r3,w.nx,w.ny,w.nz,w.offset
  0,0,4,3,2,1,0,0,1,1
  0,0,1.5,3,2,1,0,0,1,1
  0,0,-4,3,2,1,0,0,1,1
  $ tangency wall bodies.csv
  row,relation,gap,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z,gap_error,status,inner
  0,separate,2,0,0,-1,0,0,3,0,0,1,4.440892148131621e-16,ok,
  1,overlap,-0.5,0,0,-1,0,0,0.5,0,0,1,1.1102230535765569e-16,ok,
  2,a_in_b,-6,0,0,-1,0,0,-5,0,0,1,1.3322676361676485e-15,ok,
  $ tangency wall --two-sided bodies.csv
  row,relation,gap,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z,gap_error,status,inner
  0,separate,2,0,0,-1,0,0,3,0,0,1,4.440892148131621e-16,ok,
  1,overlap,-0.5,0,0,-1,0,0,0.5,0,0,1,1.1102230535765569e-16,ok,
  2,separate,4,0,0,1,0,0,-3,0,0,1,8.88178426317586e-16,ok,
)";

struct WallAnswer {
  RelationAnswer relation;
  WallGap gap;
};

template <class Wall>
WallAnswer answer(const MatrixEllipsoid& body, const Wall& wall) {
  return {relation(body, wall), signed_gap(body, wall)};
}

tables::RowOutcome write(const WallAnswer& answer, const Vec3& centre, tables::RowText& out) {
  const auto& [relation, gap] = answer;
  const Vec3 on_body = centre + gap.arm_body, on_wall = centre + gap.arm_wall;
  const bool representable = std::isfinite(gap.gap) && std::isfinite(gap.gap_error) &&
                             on_body.allFinite() && on_wall.allFinite();
  out.text(to_string(relation.relation));
  if (representable) {
    out.number(gap.gap);
    for (const Vec3* vector : {&gap.normal, &on_body, &on_wall}) {
      for (const double component : *vector) out.number(component + 0.0);  // 0 for -0
    }
    out.number(gap.gap_error);
  } else {
    out.empty(11);
  }
  out.text(representable ? "ok" : "not_applicable");
  write_inner(relation.inner, out);
  return representable ? tables::RowOutcome::answered : tables::RowOutcome::unanswered;
}

tables::RowFunction bind(const tables::Header& header, MixedTerms mixed_terms, bool two_sided) {
  return [two_sided, a = BodyColumns(header, "a", mixed_terms),
          w = NumberColumns<4>(header, "the wall", "w.", {"nx", "ny", "nz", "offset"},
                               "a wall has the columns w.nx, w.ny, w.nz and w.offset")](
             const tables::RowCursor& row, tables::RowText& out) {
    const MatrixEllipsoid body = a.read(row);
    const auto [nx, ny, nz, offset] = w.read(row);
    const Vec3 normal(nx, ny, nz);
    if (normal == Vec3::Zero()) throw row.error(w[0], "a wall's normal must not be all 0");
    const WallAnswer found =
        two_sided ? answer(body, Sheet{normal, offset}) : answer(body, Plane{normal, offset});
    return write(found, body.ellipsoid().centre(), out);
  };
}

}  // namespace

void add_wall(tables::Program& program) {
  struct Options : QuadricOptions {
    bool two_sided = false;
  };
  add_row_command<Options>(
      program,
      {.name = "wall",
       .description = "Signed gap, normal and points of ellipsoids and plane walls",
       .help = std::string(kBodyColumnsHelp) + kHelp,
       .describe =
           [](auto& command, auto& own) {
             command.flag("--two-sided", own.two_sided,
                          "The wall is a plane without thickness, both of whose sides are free");
           },
       .task =
           [](const Options& options) {
             const MixedTerms terms = mixed_terms_named(options.mixed_terms);
             const bool two_sided = options.two_sided;
             return row_task(kOutputColumns, "status", [terms, two_sided](const auto& header) {
               return bind(header, terms, two_sided);
             });
           }});
}

}  // namespace tangency::inline v0::tool
