// SPDX-License-Identifier: MIT
#include <array>
#include <string>
#include <string_view>

#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>

namespace tangency::inline v0::tool {
namespace {

constexpr std::array<std::string_view, 4> kOutputColumns{"row", "relation", "overlaps", "tier"};

constexpr const char* kHelp = R"(
The same columns with b. are those of body b.

Output columns, in this order:
  row              number of the data row, from 0
  relation         separate, external_touch, overlap, internal_touch, a_in_b, b_in_a or
                   equal, as point sets; invalid for a refused row (only with --keep-going)
  overlaps         1 where the interiors meet, else 0
  tier             filter: proven in floating point; exact: decided in exact integers
  The answer is exact for the numbers as they are read, whatever their size.

Exit status: 0 every row is answered; 1 some row is invalid; 2 refused command line or
input, or a failed read or write.

Example, two unit spheres that touch:
  $ cat pairs.csv
  a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3
  0,0,0,1,1,1,2,0,0,1,1,1
  $ tangency overlap pairs.csv
  row,relation,overlaps,tier
  0,external_touch,0,exact
)";

tables::RowFunction bind(const tables::Header& header, MixedTerms mixed_terms) {
  return [a = BodyColumns(header, "a", mixed_terms), b = BodyColumns(header, "b", mixed_terms)](
             const tables::RowCursor& row, tables::RowText& out) {
    const RelationAnswer answer = relation(a.read(row), b.read(row));
    const bool meet =
        answer.relation != Relation::separate && answer.relation != Relation::external_touch;
    out.text(to_string(answer.relation));
    out.text(meet ? "1" : "0");
    out.text(to_string(answer.tier));
    return tables::RowOutcome::answered;
  };
}

}  // namespace

void add_overlap(tables::Program& program) {
  add_row_command<QuadricOptions>(
      program, {.name = "overlap",
                .description = "Exact relation of pairs of ellipsoids: do they overlap?",
                .help = std::string(kBodyColumnsHelp) + kHelp,
                .task = [](const QuadricOptions& options) {
                  const MixedTerms terms = mixed_terms_named(options.mixed_terms);
                  return row_task(kOutputColumns, "relation",
                                  [terms](const auto& header) { return bind(header, terms); });
                }});
}

}  // namespace tangency::inline v0::tool
