// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/bodies/exact_quadric_type.hpp>
#include <tangency/geometry/classify.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/tool/columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>

namespace tangency::inline v0::tool {
namespace {

constexpr std::array<std::string_view, 5> kOutputColumns{"row", "type", "rank4", "rank3", "tier"};
constexpr std::array<std::string_view, 10> kCoefficients{"A", "B", "C", "D", "E",
                                                         "F", "G", "H", "J", "K"};

constexpr const char* kHelp = R"(
Input columns, in any order; others are ignored:
  A B C D E F G H J K   the coefficients of
                        A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx
                          + 2G x + 2H y + 2J z + K = 0,
                        so that D to J are half of what stands before their terms; or, with
                        --mixed-terms full, all of it, as in radiation transport codes:
                        A x^2 + B y^2 + C z^2 + D xy + E yz + F zx
                          + G x + H y + J z + K = 0

Output columns, in this order:
  row              number of the data row, from 0
  type             real_ellipsoid, imaginary_ellipsoid, hyperboloid_one_sheet,
                   hyperboloid_two_sheets, elliptic_paraboloid, hyperbolic_paraboloid,
                   real_elliptic_cone, imaginary_elliptic_cone, real_elliptic_cylinder,
                   imaginary_elliptic_cylinder, hyperbolic_cylinder, parabolic_cylinder,
                   real_intersecting_planes, imaginary_intersecting_planes,
                   real_parallel_planes, imaginary_parallel_planes, coincident_planes;
                   plane, no_points and all_space for what is no quadric;
                   invalid for a refused row (only with --keep-going)
  rank4, rank3     ranks of the discriminant matrix and of its upper-left 3 x 3 block
  tier             filter: proven in floating point; exact: decided in exact integers
  The answer is exact for the numbers as they are read, whatever their size.

Exit status: 0 every row is answered; 1 some row is invalid; 2 refused command line or
input, or a failed read or write.

Example, a sphere and a cone:
  $ cat quadrics.csv
  A,B,C,D,E,F,G,H,J,K
  1,1,1,0,0,0,0,0,0,-1
  1,1,-1,0,0,0,0,0,0,0
  $ tangency classify quadrics.csv
  row,type,rank4,rank3,tier
  0,real_ellipsoid,4,3,filter
  1,real_elliptic_cone,3,3,exact
)";

using Coefficients = Quadric::Coefficients;
using Classify = Classification (*)(const Coefficients&);

Classification by_half_terms(const Coefficients& c) { return classify(Quadric(c)); }

/// Twice the equation has half terms, and all its doubles where none overflows; else integers.
Classification by_full_terms(const Coefficients& c) {
  constexpr std::array<std::size_t, 4> kSquares{0, 1, 2, 9};  // A, B, C and K
  constexpr double kLargest = std::numeric_limits<double>::max() / 2;
  if (std::ranges::all_of(kSquares, [&](std::size_t i) { return std::abs(c[i]) <= kLargest; })) {
    Coefficients twice = c;
    for (const std::size_t i : kSquares) twice[i] *= 2;
    return by_half_terms(twice);
  }
  exact::IntegerForm<4> form = exact::quadric_form(c, exact::common_exponent(c));
  for (std::size_t i = 0; i < form.size(); ++i) form[i][i] *= 2;
  return exact::classify_form(form);
}

tables::RowFunction bind(const tables::Header& header, Classify classify_row) {
  std::vector<std::string> missing;
  const auto columns = find_columns(header, "", kCoefficients, missing);
  if (!missing.empty()) {
    throw lacking(header, "quadric", missing,
                  "a quadric has the columns A, B, C, D, E, F, G, H, J and K");
  }
  return [columns, classify_row](const tables::RowCursor& row, tables::RowText& out) {
    Coefficients c{};
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = row.number(columns[i]);
    const Classification answer = classify_row(c);
    out.text(to_string(answer.type));
    out.text(std::to_string(answer.rank4));
    out.text(std::to_string(answer.rank3));
    out.text(to_string(answer.tier));
    return tables::RowOutcome::answered;
  };
}

}  // namespace

void add_classify(tables::Program& program) {
  add_row_command<QuadricOptions>(
      program, {.name = "classify",
                .description = "Exact types of quadrics",
                .help = kHelp,
                .task = [](const QuadricOptions& options) {
                  const bool full = options.mixed_terms == "full";
                  const Classify one = full ? by_full_terms : by_half_terms;
                  return row_task(kOutputColumns, "type",
                                  [one](const auto& header) { return bind(header, one); });
                }});
}

}  // namespace tangency::inline v0::tool
