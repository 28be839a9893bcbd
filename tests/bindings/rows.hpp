// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Rows of numbers for the tests of the interface in C, from fixed seeds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <tangency/geometry/bindings/c/tangency.h>
#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::testing {

using Row = std::array<double, 10>;

inline Ellipsoid ellipsoid_of(const Row& r) {
  return {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8], r[9]}};
}

/// Bodies of aspect ratios to 4 in a box where most meet some others.
inline std::vector<Row> drawn_rows(std::size_t count, std::uint64_t seed, double box = 3.0) {
  std::mt19937_64 draw(seed);
  std::uniform_real_distribution<double> place(-box, box), axis(0.5, 2.0), turn(-1.0, 1.0);
  std::vector<Row> rows(count);
  for (Row& row : rows) {
    for (std::size_t i = 0; i < 3; ++i) row[i] = place(draw);
    for (std::size_t i = 3; i < 6; ++i) row[i] = axis(draw);
    for (std::size_t i = 6; i < 10; ++i) row[i] = turn(draw);
  }
  return rows;
}

/// Bodies of the interface in C, which end with their scope.
class CBodies {
 public:
  CBodies(const std::vector<Row>& rows) {
    create(TANGENCY_FORM_AXES, rows.data(), rows.size(), sizeof(Row));
  }
  CBodies(int form, const double* rows, std::size_t count, std::size_t width) {
    create(form, rows, count, width * sizeof(double));
  }
  ~CBodies() { tangency_bodies_destroy(bodies_); }
  CBodies(const CBodies&) = delete;
  CBodies& operator=(const CBodies&) = delete;

  operator tangency_bodies*() const noexcept { return bodies_; }
  int code() const noexcept { return code_; }

 private:
  void create(int form, const void* rows, std::size_t count, std::size_t stride) {
    code_ = tangency_bodies_create(&bodies_, form, rows, TANGENCY_NUMBER_DOUBLE, count,
                                   static_cast<std::ptrdiff_t>(stride), 1.0);
  }

  tangency_bodies* bodies_ = nullptr;
  int code_;
};

/// A struct of columns with its size, and nothing asked for.
template <class Columns>
Columns empty_columns() {
  Columns columns{};
  columns.size = sizeof columns;
  return columns;
}

/// Pairs of each body and the next but k, as C has them.
inline std::vector<unsigned> pairs_of(std::size_t bodies) {
  std::vector<unsigned> pairs;
  for (std::size_t i = 0; i < bodies; ++i) {
    for (std::size_t step : {1U, 2U, 5U}) {
      pairs.push_back(static_cast<unsigned>(i));
      pairs.push_back(static_cast<unsigned>((i + step) % bodies));
    }
  }
  return pairs;
}

}  // namespace tangency::testing
