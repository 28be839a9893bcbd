// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families of quadrics: every type, and what lies beside its borders.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/families.hpp>

namespace tangency::inline v0::verify {
namespace {

using Matrix = std::array<std::array<std::int64_t, 4>, 4>;

// A B C D E F G H J K of a surface of each of the 17 types and of the three sets that are none.
constexpr std::array<std::array<std::int64_t, 10>, 20> kForms{{
    {1, 2, 3, 0, 0, 0, 0, 0, 0, -4},   // real ellipsoid
    {1, 2, 3, 0, 0, 0, 0, 0, 0, 4},    // imaginary ellipsoid
    {1, 2, -3, 0, 0, 0, 0, 0, 0, -4},  // hyperboloid of one sheet
    {1, 2, -3, 0, 0, 0, 0, 0, 0, 4},   // and of two
    {1, 2, 0, 0, 0, 0, 0, 0, 3, 0},    // elliptic paraboloid
    {1, -2, 0, 0, 0, 0, 0, 0, 3, 0},   // hyperbolic paraboloid
    {1, 2, -3, 0, 0, 0, 0, 0, 0, 0},   // real elliptic cone
    {1, 2, 3, 0, 0, 0, 0, 0, 0, 0},    // imaginary elliptic cone
    {1, 2, 0, 0, 0, 0, 0, 0, 0, -3},   // real elliptic cylinder
    {1, 2, 0, 0, 0, 0, 0, 0, 0, 3},    // imaginary elliptic cylinder
    {1, -2, 0, 0, 0, 0, 0, 0, 0, 3},   // hyperbolic cylinder
    {1, 0, 0, 0, 0, 0, 0, 2, 0, 0},    // parabolic cylinder
    {1, -2, 0, 0, 0, 0, 0, 0, 0, 0},   // real intersecting planes
    {1, 2, 0, 0, 0, 0, 0, 0, 0, 0},    // imaginary intersecting planes
    {1, 0, 0, 0, 0, 0, 0, 0, 0, -2},   // real parallel planes
    {1, 0, 0, 0, 0, 0, 0, 0, 0, 2},    // imaginary parallel planes
    {1, 0, 0, 0, 0, 0, 0, 0, 0, 0},    // coincident planes
    {0, 0, 0, 0, 0, 0, 1, 0, 0, 0},    // a plane
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 1},    // no points
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},    // all of space
}};

std::int64_t determinant3(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// x -> L x + t in small integers, L regular.
Matrix affine_map(Draw& draw, int size) {
  Matrix m{};
  do {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) m[i][j] = draw.integer(-size, size);
    }
  } while (determinant3(m) == 0);
  m[3][3] = 1;
  return m;
}

// The surface of all points that the map takes to the form; its entries are small integers.
RawQuadric pulled_back(const std::array<std::int64_t, 10>& form, const Matrix& map) {
  const auto& [A, B, C, D, E, F, G, H, J, K] = form;
  const Matrix q{{{A, D, F, G}, {D, B, E, H}, {F, E, C, J}, {G, H, J, K}}};
  const auto entry = [&](std::size_t i, std::size_t j) {
    std::int64_t sum = 0;
    for (std::size_t m = 0; m < 4; ++m) {
      for (std::size_t n = 0; n < 4; ++n) sum += map[m][i] * q[m][n] * map[n][j];
    }
    return static_cast<double>(sum);
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2),
          entry(2, 0), entry(0, 3), entry(1, 3), entry(2, 3), entry(3, 3)};
}

std::array<double*, 10> coefficients(RawQuadric& q) {
  return {&q.A, &q.B, &q.C, &q.D, &q.E, &q.F, &q.G, &q.H, &q.J, &q.K};
}

// The forms take turns.
struct Turns {
  std::size_t next = 0;
  const std::array<std::int64_t, 10>& form() { return kForms[next++ % kForms.size()]; }
};

RawQuadric image(Draw& draw, Turns& turns) {
  return pulled_back(turns.form(), affine_map(draw, 4));
}

RawQuadric scaled(Draw& draw, Turns& turns) {
  RawQuadric q = pulled_back(turns.form(), affine_map(draw, 4));
  const int exponent = draw.integer(-900, 900);
  const double factor = std::ldexp(draw.coin() ? 1.0 : -1.0, exponent);
  for (double* v : coefficients(q)) *v *= factor;
  return q;
}

// One coefficient moved to the next double, or a zero to the least one.
RawQuadric beside_a_border(Draw& draw, Turns& turns) {
  RawQuadric q = pulled_back(turns.form(), affine_map(draw, 2));
  double& v = *coefficients(q)[static_cast<std::size_t>(draw.integer(0, 9))];
  const double most = std::numeric_limits<double>::max();
  v = std::nextafter(v, draw.coin() ? most : -most);
  return q;
}

// Multiples of a common factor that no double holds exactly.
RawQuadric rounded_image(Draw& draw, Turns& turns) {
  RawQuadric q = pulled_back(turns.form(), affine_map(draw, 4));
  const double factor = draw.real(0.1, 1);
  for (double* v : coefficients(q)) *v *= factor;
  return q;
}

}  // namespace

std::vector<InputFamily<RawQuadric>> quadric_families() {
  using Next = RawQuadric (*)(Draw&, Turns&);
  const auto family = [](const char* name, std::size_t count, Next next) {
    return drawn_family(name, count,
                        [next, turns = Turns()](Draw& draw) mutable { return next(draw, turns); });
  };
  return {family("images", 200, image), family("scaled", 100, scaled),
          family("beside a border", 200, beside_a_border), family("rounded", 100, rounded_image)};
}

}  // namespace tangency::inline v0::verify
