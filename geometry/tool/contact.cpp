// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>

namespace tangency::tool {
namespace {

constexpr std::array<std::string_view, 15> kOutputColumns{
    "row",  "relation", "gap",  "nx",   "ny",        "nz",     "pa.x", "pa.y",
    "pa.z", "pb.x",     "pb.y", "pb.z", "gap_error", "status", "inner"};

constexpr std::string_view kCommonNormal = "common-normal";
constexpr std::array<std::string_view, 3> kLaterMethods{"trace", "perram-wertheim",
                                                        "midpoint-potential"};

constexpr const char* kHelp = R"(
Input columns, in any order; others are ignored:
  a.x a.y a.z      centre of body a
  a.r1 a.r2 a.r3   its semi-axes, > 0
  a.qw a.qx a.qy a.qz
                   its orientation, a quaternion other than 0 of any length that turns
                   body axes into space axes; all four or none (no rotation)
  and the same with b. for body b. Lengths are in any one unit. Numbers are decimal or
  hex floats (0x1.8p+3). Lines that begin with # and blank lines are skipped.

Output columns, in this order:
  row              number of the data row, from 0
  relation         separate, external_touch, overlap, internal_touch, a_in_b, b_in_a or
                   equal, as point sets: exact for the numbers as they are read
  gap              > 0: the distance; < 0: minus the penetration depth, the length of the
                   shortest translation that separates the bodies
  nx ny nz         unit normal, from a to b
  pa.x pa.y pa.z   witness point on a
  pb.x pb.y pb.z   witness point on b; pb - pa = gap n
  gap_error        a proven bound on |gap - true gap| for the numbers as they are read; where
                   local on the distance to the value of that stationary answer
  status           see below
  inner            a or b, the body inside, for internal_touch; else empty
  Numbers read back to the same double.

Status of a row:
  ok               the global answer
  local            a stationary answer; that no shorter penetration exists elsewhere is
                   not proven
  not_applicable   the method has no answer: some number is beyond the range of a double;
                   numbers are empty
  not_converged    no answer was found; numbers are empty
  invalid          the row was refused (only with --keep-going); numbers are empty

Methods:
  common-normal    the gap as defined above
  trace, perram-wertheim, midpoint-potential
                   not available in this version

Exit status: 0 every row is ok or local; 1 some row is not; 2 refused command line or
input, or a failed read or write. A refusal is one line on standard error:
  pairs.csv:17: a.r2 = -1: a semi-axis must be finite and > 0
Rows before a refused row may have reached standard output, none for it or after it;
a file named by --out is left as it was.

Example, a unit sphere and an ellipsoid 0.5 away from it:
  $ cat pairs.csv
  a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3
  0,0,0,1,1,1,3.5,0,0,2,1,1
  $ tangency contact pairs.csv
  row,relation,gap,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z,gap_error,status,inner
  0,separate,0.5,1,0,0,1,0,0,1.5,0,0,5.2180482157382405e-15,ok,
)";

/// What is known about a pair: one row of the output.
struct Answer {
  RelationAnswer relation;
  std::string_view status;
  bool has_numbers;
  double gap;
  Vec3 normal;
  Vec3 point_a;
  Vec3 point_b;
  double gap_error;
};

/// The answer that says nothing but why it is empty.
Answer without_numbers(const RelationAnswer& relation, std::string_view status) {
  return {relation, status, false, 0, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0};
}

Answer find_common_normal(const Ellipsoid& a, const Ellipsoid& b) {
  const RelationAnswer exact = relation(a, b);
  const Gap found = signed_gap(a, b);
  if (found.status == GapStatus::not_converged) return without_numbers(exact, "not_converged");
  const Vec3 point_a = a.centre() + found.arm_a;
  const Vec3 point_b = b.centre() + found.arm_b;
  const bool representable = std::isfinite(found.gap) && found.normal.allFinite() &&
                             point_a.allFinite() && point_b.allFinite();
  if (!representable) return without_numbers(exact, "not_applicable");
  return {exact,        found.status == GapStatus::ok ? "ok" : "local",
          true,         found.gap,
          found.normal, point_a,
          point_b,      found.gap_error};
}

RowOutcome write(const Answer& answer, csv::RowText& out) {
  out.text(to_string(answer.relation.relation));
  if (answer.has_numbers) {
    out.number(answer.gap);
    for (const Vec3* vector : {&answer.normal, &answer.point_a, &answer.point_b}) {
      for (const double component : *vector) out.number(component);
    }
    out.number(answer.gap_error);
  } else {
    out.empty(11);
  }
  out.text(answer.status);
  switch (answer.relation.inner) {
    case Inner::none:
      out.empty();
      break;
    case Inner::a:
      out.text("a");
      break;
    case Inner::b:
      out.text("b");
      break;
  }
  return answer.has_numbers ? RowOutcome::answered : RowOutcome::unanswered;
}

RowFunction bind(const csv::Header& header) {
  return [a = BodyColumns(header, "a"), b = BodyColumns(header, "b")](const csv::RowCursor& row,
                                                                      csv::RowText& out) {
    return write(find_common_normal(a.read(row), b.read(row)), out);
  };
}

std::string check_method(const std::string& method) {
  if (method == kCommonNormal) return {};
  for (const std::string_view later : kLaterMethods) {
    if (method == later) return method + " is not available in this version; common-normal is";
  }
  return method + " is not a method; common-normal is the one available";
}

}  // namespace

Subcommand add_contact(CLI::App& program) {
  struct Options {
    std::string method{kCommonNormal};
    RowStreamOptions rows;
  };
  const auto options = std::make_shared<Options>();
  CLI::App& app = *program.add_subcommand(
      "contact", "Signed gap, normal and witness points of pairs of ellipsoids");
  app.add_option("--method", options->method,
                 "How contact is defined: common-normal (default); trace, perram-wertheim and "
                 "midpoint-potential are not available in this version")
      ->check(CLI::Validator(check_method, ""))
      ->type_name("M");
  add_row_stream_options(app, options->rows);
  app.footer(kHelp);
  return {&app, [options] {
            const RowTask task{.output_columns = {kOutputColumns.begin(), kOutputColumns.end()},
                               .verdict_column = "status",
                               .bind = bind};
            return run_row_stream(task, options->rows);
          }};
}

}  // namespace tangency::tool
