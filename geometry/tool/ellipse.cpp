// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>
#include <tangency/geometry/tool/contact_columns.hpp>
#include <tangency/geometry/tool/further_columns.hpp>

namespace tangency::inline v0::tool {
namespace {

using Further = FurtherColumns<EllipseRow>;

constexpr std::array<std::string_view, 13> kOutputColumns{
    "row",         "relation", "crossings", "area",   "gap",   "nx",       "ny",
    "chord_depth", "chord_nx", "chord_ny",  "status", "inner", "gap_error"};
constexpr std::array<std::string_view, 4> kPointColumns{"row", "x", "y", "multiplicity"};

constexpr const char* kHelp = R"(
The same columns with b. are those of ellipse b. Lengths are in any one unit. Numbers are
decimal or hex floats (0x1.8p+3). Lines that begin with # and blank lines are skipped.

Output columns, in this order:
  row              number of the data row, from 0
  relation         separate, external_touch, overlap, internal_touch, a_in_b, b_in_a or
                   equal, as point sets: exact for the numbers as they are read
  crossings        number of distinct points in which the boundaries meet, 0 to 4: exact;
                   empty where the ellipses are equal
  area             of the common region
  gap              > 0: the distance; < 0: minus the penetration depth, the length of the
                   shortest translation that separates the ellipses
  nx ny            unit normal, from a to b
  chord_depth      thickness of the common region along the line through the midpoint of
                   the two crossings, perpendicular to the chord between them
  chord_nx chord_ny
                   unit normal of the chord, to the side where a's boundary is inside b;
                   these three are empty unless the boundaries cross in exactly two points
  status           see below
  inner            a or b, the ellipse inside, for internal_touch; else empty
  gap_error        proven: the true gap is this near to gap; on a local row it bounds the
                   distance to the local value, and the true gap is at least
                   gap - gap_error
  Numbers read back to the same double.

and those that --columns names, in the order of the names; empty where a row has none:
)";

constexpr const char* kStatusHelp = R"(
Status of a row:
  ok               the global answer
  local            a stationary answer; that no shorter penetration exists elsewhere is
                   not proven
  not_applicable   some number is beyond the range of a double; numbers are empty but for
                   crossings
  invalid          the row was refused (only with --keep-going); numbers are empty

With --points there is a line for each point in which the boundaries meet, by increasing x
and then y, and none for ellipses that meet nowhere:
  row              number of the data row
  x y              the point
  multiplicity     1 for a crossing, 2 for a touch, 3 for a crossing of third order, 4 for a
                   touch of fourth order: exact. Or a word, and x and y are empty: equal for
                   equal ellipses, which meet everywhere; not_applicable for a point beyond
                   the range of a double; invalid (only with --keep-going)

Exit status: 0 every row is ok or local; 1 some row is not; 2 refused command line or
input, or a failed read or write. A refusal is one line on standard error:
  ellipses.csv:17: a.r2 = -1: a semi-axis must be finite and > 0
Rows before a refused row may have reached standard output, none for it or after it;
a file named by --out is left as it was.

Example, a unit circle and an ellipse of half its width, and an ellipse within another:
  $ cat ellipses.csv
  a.x,a.y,a.r1,a.r2,a.angle,b.x,b.y,b.r1,b.r2,b.ux,b.uy
  0,0,1,1,0,1.25,0,0.5,2,1,0
  $ tangency ellipse ellipses.csv
  row,relation,crossings,area,gap,nx,ny,chord_depth,chord_nx,chord_ny,status,inner,gap_error
  0,overlap,2,0.21523012977701694,-0.25,1,0,0.25,1,0,ok,,3.4972025275692463e-15
  $ tangency ellipse --points ellipses.csv
  row,x,y,multiplicity
  0,0.7755599823106163,-0.6312738817964486,1
  0,0.7755599823106163,0.6312738817964486,1
  $ cat nested.csv
  a.x,a.y,a.r1,a.r2,a.angle,b.x,b.y,b.r1,b.r2,b.angle
  0,0,3,1,0,0,0,5,2.5,0
  $ tangency ellipse --columns clearance,clearance_error,margin,margin_error nested.csv
  row,relation,crossings,area,gap,nx,ny,chord_depth,chord_nx,chord_ny,status,inner,gap_error,clearance,clearance_error,margin,margin_error
  0,a_in_b,0,9.42477796076938,-3.5,-5.478392645771908e-42,1,,,,ok,,4.44089209850063e-16,1.496523749672331,2.220446049250315e-16,1.6666666666666667,7.529984927364556e-17
)";

void write_crossings(const EllipseRelation& exact, tables::RowText& out) {
  if (exact.crossings) {
    out.integer(static_cast<std::uint64_t>(*exact.crossings));
  } else {
    out.empty();
  }
}

tables::RowOutcome write(const MatrixEllipse& a, const MatrixEllipse& b, const Further& further,
                         tables::RowText& out) {
  const EllipseRelation exact = relation(a, b);
  const PlaneGap found = signed_gap(a, b);
  const double area = common_area(a.ellipse(), b.ellipse());
  const ChordContact chord = chord_contact(a.ellipse(), b.ellipse());
  out.text(to_string(exact.relation));
  write_crossings(exact, out);
  const bool has_chord = chord.status == ChordStatus::ok;
  if (!std::isfinite(area) || !std::isfinite(found.gap) || !found.normal.allFinite() ||
      (has_chord && !std::isfinite(chord.depth)) || !std::isfinite(found.gap_error)) {
    out.empty(7);
    out.text("not_applicable");
    write_inner(exact.inner, out);
    out.empty();
    further.write({a, b, exact}, out);
    return tables::RowOutcome::unanswered;
  }
  out.number(area);
  out.number(found.gap);
  for (const double component : found.normal) out.number(component);
  if (has_chord) {
    out.number(chord.depth);
    for (const double component : chord.normal) out.number(component);
  } else {
    out.empty(3);
  }
  out.text(found.status == GapStatus::ok ? "ok" : "local");
  write_inner(exact.inner, out);
  out.number(found.gap_error);
  further.write({a, b, exact}, out);
  return tables::RowOutcome::answered;
}

tables::RowFunction bind(const tables::Header& header, MixedTerms terms, const Further& further) {
  return [a = EllipseColumns(header, "a", terms), b = EllipseColumns(header, "b", terms), further](
             const tables::RowCursor& row, tables::RowText& out) {
    return write(a.read(row), b.read(row), further, out);
  };
}

/// The points in which the boundaries meet, a line each.
class PointLines : public tables::Rows {
 public:
  PointLines(const EllipseColumns& a, const EllipseColumns& b) : columns_a_(a), columns_b_(b) {}

  void read(const tables::RowCursor& row) override {
    const MatrixEllipse a = columns_a_.read(row), b = columns_b_.read(row);
    found_.push_back({row.index(), a.ellipse().centre(), crossings(a, b)});
  }
  void answer() override {}
  tables::RowOutcome write(std::size_t i, tables::RowText& out) const override {
    const auto& [row, centre, found] = found_[i];
    // clang 14 takes no structured binding into a function by reference.
    const auto word = [&out, row = row](std::string_view multiplicity) {
      out.integer(row), out.empty(2), out.text(multiplicity), out.end_row();
    };
    if (found.equal) word("equal");
    bool all_written = true;
    for (int k = 0; k < found.count; ++k) {
      const Crossing& crossing = found.at[static_cast<std::size_t>(k)];
      const Vec2 point = centre + crossing.arm_a;
      if (point.allFinite()) {
        out.integer(row), out.number(point[0]), out.number(point[1]);
        out.integer(static_cast<std::uint64_t>(crossing.multiplicity)), out.end_row();
      } else {
        word("not_applicable"), all_written = false;
      }
    }
    return all_written ? tables::RowOutcome::answered : tables::RowOutcome::unanswered;
  }
  void clear() override { found_.clear(); }

 private:
  struct Found {
    std::uint64_t row;
    Vec2 centre;
    Crossings crossings;
  };

  EllipseColumns columns_a_, columns_b_;
  std::vector<Found> found_;
};

tables::MakeRows bind_points(const tables::Header& header, MixedTerms terms) {
  return [a = EllipseColumns(header, "a", terms), b = EllipseColumns(header, "b", terms)] {
    return std::make_unique<PointLines>(a, b);
  };
}

}  // namespace

void add_ellipse(tables::Program& program) {
  struct Options : ConicOptions {
    bool points = false;
    std::string columns;
  };
  const auto describe = [](tables::Command& command, Options& own) {
    command.flag("--points", own.points,
                 "A line for each point in which the boundaries meet, in place of one a row");
    add_columns_option(command, own.columns, ellipse_column_groups());
  };
  const auto task = [](const Options& options) -> tables::RowTask {
    const MixedTerms terms = mixed_terms_named(options.mixed_terms);
    if (options.points) {
      return {.output_columns = {kPointColumns.begin(), kPointColumns.end()},
              .verdict_column = "multiplicity",
              .bind = [terms](const tables::Header& header) { return bind_points(header, terms); },
              .writes_lines = true};
    }
    const Further further(ellipse_column_groups(), options.columns);
    tables::RowTask rows = row_task(kOutputColumns, "status", [terms, further](const auto& header) {
      return bind(header, terms, further);
    });
    further.append_names(rows.output_columns);
    return rows;
  };
  add_row_command<Options>(
      program,
      {.name = "ellipse",
       .description =
           "Relation, crossings, common area and contact of pairs of ellipses in the plane",
       .help = std::string(kEllipseColumnsHelp) + kHelp +
               further_columns_help(ellipse_column_groups()) + kStatusHelp,
       .describe = describe,
       .task = task});
}

}  // namespace tangency::inline v0::tool
