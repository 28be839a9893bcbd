// SPDX-License-Identifier: GPL-3.0-or-later
//
// The classification oracle against the canonical form of every type, its exact affine images, and
// the neighbours of its borders.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <random>
#include <set>
#include <stdexcept>

#include <tangency/verify/oracles/classification.hpp>

namespace tangency::verify {

void PrintTo(const Classification& c, std::ostream* out) {
  *out << name(c.type) << " rank4 " << c.rank4 << " rank3 " << c.rank3;
}

namespace {

using enum QuadricType;

struct Canonical {
  RawQuadric quadric;
  Classification expected;
};

// A B C D E F G H J K
constexpr std::array<Canonical, 21> kCanonical{{
    {{1, 2, 3, 0, 0, 0, 0, 0, 0, -4}, {real_ellipsoid, 4, 3}},
    {{1, 2, 3, 0, 0, 0, 0, 0, 0, 4}, {imaginary_ellipsoid, 4, 3}},
    {{1, 2, -3, 0, 0, 0, 0, 0, 0, -4}, {hyperboloid_one_sheet, 4, 3}},
    {{1, 2, -3, 0, 0, 0, 0, 0, 0, 4}, {hyperboloid_two_sheets, 4, 3}},
    {{1, 2, 0, 0, 0, 0, 0, 0, 3, 0}, {elliptic_paraboloid, 4, 2}},
    {{1, -2, 0, 0, 0, 0, 0, 0, 3, 0}, {hyperbolic_paraboloid, 4, 2}},
    {{1, 2, -3, 0, 0, 0, 0, 0, 0, 0}, {real_elliptic_cone, 3, 3}},
    {{1, 2, 3, 0, 0, 0, 0, 0, 0, 0}, {imaginary_elliptic_cone, 3, 3}},
    {{1, 2, 0, 0, 0, 0, 0, 0, 0, -3}, {real_elliptic_cylinder, 3, 2}},
    {{1, 2, 0, 0, 0, 0, 0, 0, 0, 3}, {imaginary_elliptic_cylinder, 3, 2}},
    {{1, -2, 0, 0, 0, 0, 0, 0, 0, 3}, {hyperbolic_cylinder, 3, 2}},
    {{0, 0, 0, 1, 0, 0, 0, 0, 0, -1}, {hyperbolic_cylinder, 3, 2}},  // 2 xy = 1: no diagonal pivot
    {{1, 0, 0, 0, 0, 0, 0, 2, 0, 0}, {parabolic_cylinder, 3, 1}},
    {{0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, {real_intersecting_planes, 2, 2}},  // 2 yz = 0
    {{1, 2, 0, 0, 0, 0, 0, 0, 0, 0}, {imaginary_intersecting_planes, 2, 2}},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, -2}, {real_parallel_planes, 2, 1}},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, 2}, {imaginary_parallel_planes, 2, 1}},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, {coincident_planes, 1, 1}},
    {{0, 0, 0, 0, 0, 0, 1, 0, -2, 3}, {plane, 2, 0}},
    {{0, 0, 0, 0, 0, 0, 0, 0, 0, 5}, {no_points, 1, 0}},
    {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, {all_space, 0, 0}},
}};

using Matrix = std::array<std::array<double, 4>, 4>;

Matrix matrix(const RawQuadric& q) {
  return {{{q.A, q.D, q.F, q.G}, {q.D, q.B, q.E, q.H}, {q.F, q.E, q.C, q.J}, {q.G, q.H, q.J, q.K}}};
}

RawQuadric quadric(const Matrix& m) {
  return {m[0][0], m[1][1], m[2][2], m[0][1], m[1][2], m[0][2], m[0][3], m[1][3], m[2][3], m[3][3]};
}

RawQuadric times(RawQuadric q, double k) {
  for (double* v : {&q.A, &q.B, &q.C, &q.D, &q.E, &q.F, &q.G, &q.H, &q.J, &q.K}) *v *= k;
  return q;
}

Matrix product(const Matrix& a, const Matrix& b, bool transpose_a) {
  Matrix c{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) c[i][j] += (transpose_a ? a[k][i] : a[i][k]) * b[k][j];
    }
  }
  return c;
}

TEST(ClassificationOracle, KnowsEveryTypeAndItsRanks) {
  std::set<QuadricType> seen;
  for (const auto& [q, expected] : kCanonical) {
    EXPECT_EQ(classify(q), expected);
    seen.insert(classify(q).type);
  }
  EXPECT_EQ(seen.size(), 20U);
}

TEST(ClassificationOracle, IgnoresSignAndScale) {
  for (const auto& [q, expected] : kCanonical) {
    for (const double k : {-1.0, -3.0, 7.0, 1e300, -std::ldexp(1, -1070)}) {
      EXPECT_EQ(classify(times(q, k)), expected) << k;
    }
  }
}

// Integer maps x -> S x + t with det S != 0: exact in doubles.
TEST(ClassificationOracle, IsInvariantUnderExactAffineMaps) {
  std::mt19937_64 bits(3);
  const auto entry = [&] { return static_cast<double>(bits() % 19) - 9; };
  for (int i = 0; i < 2000; ++i) {
    Matrix map{};
    map[3][3] = 1;
    double det = 0;
    while (det == 0) {
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 4; ++c) map[r][c] = entry();
      }
      const auto& [x, y, z, last] = map;
      det = x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) +
            x[2] * (y[0] * z[1] - y[1] * z[0]);
    }
    for (const auto& [q, expected] : kCanonical) {
      const RawQuadric image = quadric(product(map, product(matrix(q), map, false), true));
      ASSERT_EQ(classify(image), expected) << name(expected.type);
    }
  }
}

TEST(ClassificationOracle, SeesTheSmallestDoubleAtABorder) {
  const double least = std::numeric_limits<double>::denorm_min();
  const auto with = [](double a, double b, double c, double j, double k) {
    return classify({a, b, c, 0, 0, 0, 0, 0, j, k}).type;
  };
  EXPECT_EQ(with(1, 1, 1, 0, -least), real_ellipsoid);
  EXPECT_EQ(with(1, 1, 1, 0, least), imaginary_ellipsoid);
  EXPECT_EQ(with(1, 1, -1, 0, -least), hyperboloid_one_sheet);
  EXPECT_EQ(with(1, 1, -1, 0, least), hyperboloid_two_sheets);
  EXPECT_EQ(with(1, 1, least, 0, -1), real_ellipsoid);
  EXPECT_EQ(with(1, 1, -least, 0, -1), hyperboloid_one_sheet);
  EXPECT_EQ(with(1, 1, 0, least, -1), elliptic_paraboloid);
  EXPECT_EQ(with(1, 1, 0, 0, least), imaginary_elliptic_cylinder);
  EXPECT_EQ(with(1, 0, 0, least, 1), parabolic_cylinder);
  EXPECT_EQ(with(1, 0, 0, 0, -least), real_parallel_planes);
  EXPECT_EQ(with(1, least, 0, 0, 0), imaginary_intersecting_planes);
  EXPECT_EQ(with(1, -least, 0, 0, 0), real_intersecting_planes);
  EXPECT_EQ(with(0, 0, 0, least, 1e300), plane);
  EXPECT_EQ(with(0, 0, 0, 0, least), no_points);
}

// x^2 + 2D xy + y^2 = 1 is degenerate for D = 1 only.
TEST(ClassificationOracle, SeesTheLastBitOfASingularBlock) {
  const auto with = [](double d) { return classify({1, 1, 0, d, 0, 0, 0, 0, 0, -1}).type; };
  EXPECT_EQ(with(std::nextafter(1, 0)), real_elliptic_cylinder);
  EXPECT_EQ(with(1), real_parallel_planes);
  EXPECT_EQ(with(std::nextafter(1, 2)), hyperbolic_cylinder);
}

// The unit sphere moved along x: D3 of the thesis is -2, -1, +7, the type stays.
TEST(ClassificationOracle, DoesNotDependOnTheOrigin) {
  for (const double x : {0.0, 1.0, 3.0, 67108864.0}) {
    EXPECT_EQ(classify({1, 1, 1, 0, 0, 0, -x, 0, 0, x * x - 1}),
              (Classification{real_ellipsoid, 4, 3}));
  }
}

TEST(ClassificationOracle, RefusesNumbersThatAreNotFinite) {
  EXPECT_THROW(classify({1, 1, 1, 0, 0, 0, 0, 0, 0, std::nan("")}), std::invalid_argument);
  EXPECT_THROW(classify({1, 1, 1, 0, std::numeric_limits<double>::infinity(), 0, 0, 0, 0, -1}),
               std::invalid_argument);
}

}  // namespace
}  // namespace tangency::verify
