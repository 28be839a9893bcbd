// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/geometry/quadric_generators.hpp>

#include <cstddef>
#include <ios>
#include <ostream>

namespace tangency::testing {

IntegerQuadric pulled_back(const IntegerQuadric& c, const IntegerMap& map) {
  const std::int64_t q[4][4] = {{c[0], c[3], c[5], c[6]},
                                {c[3], c[1], c[4], c[7]},
                                {c[5], c[4], c[2], c[8]},
                                {c[6], c[7], c[8], c[9]}};
  std::int64_t s[4][4] = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) s[i][j] = map.l[i][j];
    s[i][3] = map.t[i];
  }
  const auto entry = [&](int i, int j) {
    std::int64_t sum = 0;
    for (int m = 0; m < 4; ++m) {
      for (int n = 0; n < 4; ++n) sum += s[m][i] * q[m][n] * s[n][j];
    }
    return sum;
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2),
          entry(2, 0), entry(0, 3), entry(1, 3), entry(2, 3), entry(3, 3)};
}

rc::Gen<IntegerMap> integer_map() {
  const auto entry = rc::gen::inRange<std::int64_t>(-4, 5);
  return rc::gen::suchThat(
      rc::gen::construct<IntegerMap>(rc::gen::container<std::array<std::array<std::int64_t, 3>, 3>>(
                                         rc::gen::container<std::array<std::int64_t, 3>>(entry)),
                                     rc::gen::container<std::array<std::int64_t, 3>>(entry)),
      [](const IntegerMap& map) { return map.determinant() != 0; });
}

Quadric to_quadric(const IntegerQuadric& integers, double factor) {
  Quadric::Coefficients c;
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = factor * static_cast<double>(integers[i]);
  return Quadric(c);
}

}  // namespace tangency::testing

namespace rc {

void showValue(const tangency::Quadric& q, std::ostream& os) {
  os << std::hexfloat;
  for (const double c : q.coefficients()) os << c << ' ';
}

}  // namespace rc
