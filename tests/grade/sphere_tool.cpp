// SPDX-License-Identifier: GPL-3.0-or-later
// A tool to be graded: answers pairs of ellipsoids by their bounding spheres, blown by a factor if
// one is given.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <tangency/geometry/tables/csv.hpp>

int main(int argc, char** argv) {
  const double factor = argc > 1 ? std::atof(argv[1]) : 1;
  tangency::tables::Reader reader("-");
  std::array<tangency::tables::Column, 12> columns;
  constexpr std::array kNames{"a.x", "a.y", "a.z", "a.r1", "a.r2", "a.r3",
                              "b.x", "b.y", "b.z", "b.r1", "b.r2", "b.r3"};
  std::ranges::transform(kNames, columns.begin(),
                         [&](const char* name) { return reader.header().require(name); });
  std::puts("row,relation,gap,nx,ny,nz");
  tangency::tables::for_each_row(reader, [&](const tangency::tables::RowCursor& row) {
    std::array<double, 12> v;
    std::ranges::transform(columns, v.begin(),
                           [&](tangency::tables::Column c) { return row.number(c); });
    const double x = v[6] - v[0], y = v[7] - v[1], z = v[8] - v[2], d = std::hypot(x, y, z);
    const double gap = d - factor * (std::max({v[3], v[4], v[5]}) + std::max({v[9], v[10], v[11]}));
    std::printf("%zu,%s,%.17g,%.17g,%.17g,%.17g\n", row.index(), gap > 0 ? "separate" : "overlap",
                gap, d > 0 ? x / d : 1, d > 0 ? y / d : 0, d > 0 ? z / d : 0);
  });
}
