// SPDX-License-Identifier: MIT
#include <cstdint>
#include <optional>
#include <string>

#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>
#include <tangency/geometry/tool/contact_answers.hpp>
#include <tangency/geometry/tool/contact_columns.hpp>
#include <tangency/geometry/tool/contact_view.hpp>

namespace tangency::inline v0::tool {
namespace {

/// Of --view. Chosen: no table has more rows; and what stands where it was not given.
constexpr std::uint64_t kLastRow = 1'000'000'000'000, kNoView = kLastRow + 1;

constexpr const char* kHelp = R"(
The same columns with b. are those of body b. Lengths are in any one unit. Numbers are
decimal or hex floats (0x1.8p+3). Lines that begin with # and blank lines are skipped.

Output columns, in this order:
  row              number of the data row, from 0
  relation         separate, external_touch, overlap, internal_touch, a_in_b, b_in_a or
                   equal, as point sets: exact for the numbers as they are read
  gap              > 0: the distance; < 0: minus the penetration depth, the length of the
                   shortest translation that separates the bodies; or by another method
  nx ny nz         unit normal, from a to b
  pa.x pa.y pa.z   witness point on a
  pb.x pb.y pb.z   witness point on b; pb - pa = gap n
  gap_error        proven: the true gap is this near to gap; on a local row it bounds the
                   distance to the local value, and the true gap is at least
                   gap - gap_error. Of perram-wertheim and midpoint-potential it bounds the
                   distance to the gap by that definition, and is empty where a body is given
                   by a matrix; empty for trace
  status           see below
  inner            a or b, the body inside, for internal_touch; else empty
and those that --columns names, in the order of the names; empty where a row has none:
)";

constexpr const char* kStatusHelp = R"(
  Numbers read back to the same double. Their last digits may depend on the processor,
  within gap_error, but never on the number of threads.

Status of a row:
  ok               the global answer
  local            a stationary answer; that no shorter penetration exists elsewhere is
                   not proven
  not_applicable   the method has no answer, or some number is beyond the range of a
                   double; numbers are empty
  not_converged    no answer was found; numbers are empty
  invalid          the row was refused (only with --keep-going); numbers are empty

Methods, definitions of gap, normal and points; the relation is the same for all:
  common-normal    the gap as defined above
  perram-wertheim  at the best s of s (1-s) d'((1-s) Ma + s Mb)^-1 d, d from centre to
                   centre, M the shape matrices: n along ((1-s) Ma + s Mb)^-1 d, gap the
                   distance between the tangent planes with this normal, pa and pb where
                   they touch; pb - pa is in general not along n. Not applicable to
                   coinciding centres
  midpoint-potential
                   with the same n, along the line through the point where both level
                   functions agree, from the last point in a to the first in b. Not
                   applicable to coinciding centres and where the line misses a body
  trace            the published scheme of curves on a, an approximation that depends on
                   which body is a: n across four corners of the region of a in b, gap
                   minus the depth along n through their centroid. Applicable only where
                   relation is overlap, and not where the scheme finds no region

Exit status: 0 every row is ok or local; 1 some row is not; 2 refused command line or
input, or a failed read or write. A refusal is one line on standard error:
  pairs.csv:17: a.r2 = -1: a semi-axis must be finite and > 0
Rows before a refused row may have reached standard output, none for it or after it;
a file named by --out is left as it was.

With --view ROW there is no table but a page, for any browser and without a network: the
bodies of that row, which turn under the hand, witness points and normal, and beside one
another what all methods say. Its exit status is that of the row by common-normal. Rows
behind it are not read.

Example, a unit sphere and an ellipsoid that it touches:
  $ cat pairs.csv
  a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3
  0,0,0,1,1,1,3,0,0,2,1,1
  $ tangency contact pairs.csv
  row,relation,gap,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z,gap_error,status,inner
  0,external_touch,0,1,0,0,1,0,0,1,0,0,0,ok,
  $ tangency contact --columns mu,curvature_min,curvature_max pairs.csv
  row,relation,gap,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z,gap_error,status,inner,mu,curvature_min,curvature_max
  0,external_touch,0,1,0,0,1,0,0,1,0,0,0,ok,,1,3,3
)";

}  // namespace

void add_contact(tables::Program& program) {
  struct Options : QuadricOptions {
    std::string method{contact_methods().front()};
    std::string columns;
    std::uint64_t view = kNoView;
  };
  const auto describe = [](tables::Command& command, Options& own) {
    const tables::Option method =
        command.option("--method", own.method, "How contact is defined (default: common-normal)")
            .one_of(contact_methods());
    const tables::Option columns =
        add_columns_option(command, own.columns, contact_column_groups());
    command
        .option("--view", own.view,
                "Write this row alone, counted from 0, as a page for a browser: both bodies, and "
                "what all methods say of them; --out names it (default: pair-ROW.html)")
        .type_name("ROW")
        .between(std::uint64_t{0}, kLastRow)
        .excludes(method)
        .excludes(columns);
  };
  const auto task = [](const Options& options) {
    const ContactColumns further(contact_column_groups(), options.columns);
    tables::RowTask rows{
        .output_columns = {kContactColumns.begin(), kContactColumns.end()},
        .verdict_column = "status",
        .bind = bind_contact(options.method, mixed_terms_named(options.mixed_terms), further)};
    further.append_names(rows.output_columns);
    return rows;
  };
  const auto instead = [](const Options& options) -> std::optional<int> {
    if (options.view == kNoView) return std::nullopt;
    if (options.keep_going) throw tables::UsageError("--view takes no --keep-going");
    return write_contact_view(
        {options.input, options.output, options.view, mixed_terms_named(options.mixed_terms)});
  };
  add_row_command<Options>(
      program, {.name = "contact",
                .description = "Signed gap, normal and witness points of pairs of ellipsoids",
                .help = std::string(kBodyColumnsHelp) + kHelp +
                        further_columns_help(contact_column_groups()) + kStatusHelp,
                .describe = describe,
                .task = task,
                .instead = instead});
}

}  // namespace tangency::inline v0::tool
