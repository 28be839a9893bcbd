// SPDX-License-Identifier: GPL-3.0-or-later
// Tools to be hunted: the kernel with one fault, of which the corpora show little or nothing.
//
// faulty_tool tolerance   overlaps 1 for gaps up to 1e-9
// faulty_tool float       every number is rounded to float first
// faulty_tool equal-axes  where the first two semi-axes are equal, the second and third change
// places faulty_tool bound       claims half of gap_error faulty_tool far         ends by a signal
// where a centre is more than 1e6 from the origin
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace {

using tangency::Ellipsoid;

using Numbers = std::array<double, 20>;

void spoil(std::string_view fault, Numbers& v) {
  if (fault == "float") {
    for (double& x : v) x = static_cast<double>(static_cast<float>(x));
  }
  for (const std::size_t first : {std::size_t{3}, std::size_t{13}}) {
    if (fault == "equal-axes" && v[first] == v[first + 1]) std::swap(v[first + 1], v[first + 2]);
  }
  const auto far = [](double x) { return std::abs(x) > 1e6; };
  if (fault == "far" && (std::any_of(v.begin(), v.begin() + 3, far) ||
                         std::any_of(v.begin() + 10, v.begin() + 13, far))) {
    std::raise(SIGKILL);
  }
}

Ellipsoid body(const Numbers& v, std::size_t i) {
  return {{v[i], v[i + 1], v[i + 2]},
          {v[i + 3], v[i + 4], v[i + 5]},
          tangency::Quaternion(v[i + 6], v[i + 7], v[i + 8], v[i + 9])};
}

void answer(std::string_view fault, std::size_t row, const Numbers& v) {
  // Of floats that leave the range a body may be none.
  const bool is_body =
      std::ranges::all_of(v, [](double x) { return std::isfinite(x); }) &&
      std::min({v[3], v[4], v[5], v[13], v[14], v[15]}) > 0 &&
      std::any_of(v.begin() + 6, v.begin() + 10, [](double q) { return q != 0; }) &&
      std::any_of(v.begin() + 16, v.end(), [](double q) { return q != 0; });
  if (!is_body) return;
  const Ellipsoid a = body(v, 0), b = body(v, 10);
  const tangency::Gap gap = tangency::signed_gap(a, b);
  const std::string status(gap.status == tangency::GapStatus::local ? "local" : "ok");
  if (fault == "tolerance") {
    std::printf("%zu,,%d,%.17g,%.17g,%s\n", row, gap.gap < 1e-9, gap.gap, gap.gap_error,
                status.c_str());
    return;
  }
  const std::string relation(to_string(tangency::relation(a, b).relation));
  std::printf("%zu,%s,,%.17g,%.17g,%s\n", row, relation.c_str(), gap.gap,
              fault == "bound" ? gap.gap_error / 2 : gap.gap_error, status.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view fault = argc > 1 ? argv[1] : "";
  tangency::tables::Reader reader("-");
  std::array<tangency::tables::Column, 20> columns{};
  std::size_t at = 0;
  for (const char* who : {"a", "b"}) {
    for (const char* field : {".x", ".y", ".z", ".r1", ".r2", ".r3", ".qw", ".qx", ".qy", ".qz"}) {
      columns[at++] = reader.header().require(std::string(who) + field);
    }
  }
  std::printf("row,%s,gap,gap_error,status\n",
              fault == "tolerance" ? "ignored,overlaps" : "relation,ignored");
  tangency::tables::for_each_row(reader, [&](const tangency::tables::RowCursor& row) {
    Numbers v{};
    std::ranges::transform(columns, v.begin(),
                           [&](tangency::tables::Column c) { return row.number(c); });
    spoil(fault, v);
    answer(fault, row.index(), v);
  });
}
