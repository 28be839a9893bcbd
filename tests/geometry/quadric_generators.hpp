// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Quadrics whose type is known by construction: a normal form of each type, taken through affine
/// maps with integer coefficients. All entries stay small integers, so nothing rounds.
#pragma once

#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <cstdint>

#include <tangency/geometry/classify.hpp>

namespace tangency::testing {

/// A B C D E F G H J K
using IntegerQuadric = std::array<std::int64_t, 10>;

struct NormalForm {
  QuadricType type;
  int rank4;
  int rank3;
  IntegerQuadric quadric;
};

/// From the textbook equations, one for each type.
inline constexpr std::array<NormalForm, 20> kNormalForms{{
    {QuadricType::real_ellipsoid, 4, 3, {1, 1, 1, 0, 0, 0, 0, 0, 0, -1}},
    {QuadricType::imaginary_ellipsoid, 4, 3, {1, 1, 1, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::hyperboloid_one_sheet, 4, 3, {1, 1, -1, 0, 0, 0, 0, 0, 0, -1}},
    {QuadricType::hyperboloid_two_sheets, 4, 3, {1, 1, -1, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::elliptic_paraboloid, 4, 2, {1, 1, 0, 0, 0, 0, 0, 0, 1, 0}},
    {QuadricType::hyperbolic_paraboloid, 4, 2, {1, -1, 0, 0, 0, 0, 0, 0, 1, 0}},
    {QuadricType::real_elliptic_cone, 3, 3, {1, 1, -1, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::imaginary_elliptic_cone, 3, 3, {1, 1, 1, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::real_elliptic_cylinder, 3, 2, {1, 1, 0, 0, 0, 0, 0, 0, 0, -1}},
    {QuadricType::imaginary_elliptic_cylinder, 3, 2, {1, 1, 0, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::hyperbolic_cylinder, 3, 2, {1, -1, 0, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::parabolic_cylinder, 3, 1, {1, 0, 0, 0, 0, 0, 0, 1, 0, 0}},
    {QuadricType::real_intersecting_planes, 2, 2, {1, -1, 0, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::imaginary_intersecting_planes, 2, 2, {1, 1, 0, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::real_parallel_planes, 2, 1, {1, 0, 0, 0, 0, 0, 0, 0, 0, -1}},
    {QuadricType::imaginary_parallel_planes, 2, 1, {1, 0, 0, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::coincident_planes, 1, 1, {1, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::plane, 2, 0, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0}},
    {QuadricType::no_points, 1, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::all_space, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
}};

/// Affine map x -> L x + t, L regular.
struct IntegerMap {
  std::array<std::array<std::int64_t, 3>, 3> l;
  std::array<std::int64_t, 3> t;

  std::int64_t determinant() const {
    return l[0][0] * (l[1][1] * l[2][2] - l[1][2] * l[2][1]) -
           l[0][1] * (l[1][0] * l[2][2] - l[1][2] * l[2][0]) +
           l[0][2] * (l[1][0] * l[2][1] - l[1][1] * l[2][0]);
  }
};

/// S' Q S, S = [L t; 0 1]: the surface of all x whose image lies on the given one.
inline IntegerQuadric pulled_back(const IntegerQuadric& c, const IntegerMap& map) {
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

inline rc::Gen<IntegerMap> integer_map() {
  const auto entry = rc::gen::inRange<std::int64_t>(-4, 5);
  return rc::gen::suchThat(
      rc::gen::construct<IntegerMap>(rc::gen::container<std::array<std::array<std::int64_t, 3>, 3>>(
                                         rc::gen::container<std::array<std::int64_t, 3>>(entry)),
                                     rc::gen::container<std::array<std::int64_t, 3>>(entry)),
      [](const IntegerMap& map) { return map.determinant() != 0; });
}

/// factor times the integers: exact where the factor is a power of two in a moderate range.
inline Quadric to_quadric(const IntegerQuadric& integers, double factor = 1.0) {
  Quadric::Coefficients c;
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = factor * static_cast<double>(integers[i]);
  return Quadric(c);
}

}  // namespace tangency::testing

namespace rc {
inline void showValue(const tangency::Quadric& q, std::ostream& os) {
  os << std::hexfloat;
  for (const double c : q.coefficients()) os << c << ' ';
}
}  // namespace rc
