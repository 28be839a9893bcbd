// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families of ellipsoids by shape matrices.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/verify/families/families.hpp>
#include <tangency/verify/families/placing.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

using Entries = std::array<double, 6>;  // xx yy zz xy yz zx

// R diag(a^2) R', each entry rounded once.
Entries rounded_matrix(Draw& draw, const std::array<double, 3>& axes) {
  const RealEllipsoid turned = real(turned_body(draw, axes));
  const Shape<Real> shape = separation(turned, turned).a;
  const auto entry = [&](std::size_t i, std::size_t j) {
    Real sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += shape.semi_axes[k] * shape.semi_axes[k] * shape.axes[k][i] * shape.axes[k][j];
    return rounded(sum);
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

// B against A at a drawn normal, its centre rounded.
MatrixPair placed(Draw& draw, const Entries& a, const Entries& b, const Real& gap,
                  const Real& share = 1) {
  MatrixPair pair{{{}, a}, {{}, b}};
  for (double& v : pair.a.centre) v = draw.real(-1, 1);
  const Separation<Real> shapes = separation(real(pair.a), real(pair.b));
  const Real3 n = drawn_direction(draw);
  const Real3 reach = ascent::combined(ascent::support_point(shapes.a, n), Real(1),
                                       ascent::support_point(shapes.b, n), Real(0), n);
  for (std::size_t i = 0; i < 3; ++i)
    pair.b.centre[i] = rounded(pair.a.centre[i] + share * reach[i] + gap * n[i]);
  return pair;
}

std::array<double, 3> axes(Draw& draw, double aspect, double size = 1) {
  const double ratio = draw.log_uniform(1, aspect);
  return triaxial_axes(draw, size, ratio);
}

// Shallow contacts and gaps of either sign.
MatrixPair shallow(Draw& draw) {
  const Entries a = rounded_matrix(draw, axes(draw, 5)),
                b = rounded_matrix(draw, axes(draw, 5, draw.real(0.5, 2)));
  return placed(draw, a, b, draw.real(-0.02, 0.02));
}

MatrixPair near_pair(Draw& draw) {
  const Entries a = rounded_matrix(draw, axes(draw, 5)), b = rounded_matrix(draw, axes(draw, 5));
  const double gap = draw.log_uniform(1e-16, 1e-4);
  return placed(draw, a, b, draw.coin() ? gap : -gap);
}

MatrixPair deep_pair(Draw& draw) {
  const Entries a = rounded_matrix(draw, axes(draw, 5)), b = rounded_matrix(draw, axes(draw, 5));
  return placed(draw, a, b, 0, draw.real(0, 0.9));
}

MatrixPair flat_pair(Draw& draw) {
  const double aspect = draw.log_uniform(10, 1e4);
  const Entries a = rounded_matrix(draw, triaxial_axes(draw, 1, aspect)),
                b = rounded_matrix(draw, triaxial_axes(draw, 1, aspect));
  return placed(draw, a, b, draw.real(-1e-3, 1) / aspect);
}

MatrixPair scaled_pair(Draw& draw) {
  MatrixPair pair = shallow(draw);
  const int exponent = draw.coin() ? 200 : -200;
  for (RawShapeMatrix* body : {&pair.a, &pair.b}) {
    for (double& v : body->centre) v = std::ldexp(v, exponent);
    for (double& v : body->entries) v = std::ldexp(v, 2 * exponent);
  }
  return pair;
}

using Whole3 = std::array<std::array<std::int64_t, 3>, 3>;

std::int64_t determinant(const Whole3& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// M = r^2 A A' of whole numbers, where row k of A has the whole length r: the point of the surface
// with the normal along axis k is A A' e_k.
struct WholeShape {
  Entries entries;
  std::array<double, 3> point;
};

WholeShape whole_shape(Draw& draw, std::size_t k) {
  static constexpr std::array<std::array<int, 4>, 4> kRows{
      {{3, 4, 0, 5}, {1, 2, 2, 3}, {2, 3, 6, 7}, {1, 4, 8, 9}}};
  const auto row = draw.one_of(kRows);
  Whole3 a{};
  do {
    for (auto& entries : a) {
      for (std::int64_t& v : entries) v = draw.integer(-9, 9);
    }
    a[k] = {row[0], row[1], row[2]};
  } while (determinant(a) == 0);
  const auto product = [&](std::size_t i, std::size_t j) {
    return static_cast<double>(a[i][0] * a[j][0] + a[i][1] * a[j][1] + a[i][2] * a[j][2]);
  };
  const double square = row[3] * row[3];
  WholeShape shape{
      {product(0, 0), product(1, 1), product(2, 2), product(0, 1), product(1, 2), product(2, 0)},
      {product(0, k), product(1, k), product(2, k)}};
  for (double& v : shape.entries) v *= square;
  return shape;
}

// From outside, from inside where the curvature lets it, and one or a unit of the last place
// beside.
MatrixPair touching(Draw& draw) {
  const auto k = static_cast<std::size_t>(draw.integer(0, 2));
  const WholeShape a = whole_shape(draw, k);
  WholeShape b = whole_shape(draw, k);
  const bool inside = draw.integer(0, 2) == 0;
  if (inside) {  // of the same shape, a quarter or a half of the size: it touches from inside
    const double part = draw.coin() ? 0.5 : 0.25;
    b = a;
    for (double& v : b.entries) v *= part * part;
    for (double& v : b.point) v *= part;
  }
  MatrixPair pair{{{}, a.entries}, {{}, b.entries}};
  for (std::size_t i = 0; i < 3; ++i) {
    pair.a.centre[i] = draw.integer(-9, 9);
    pair.b.centre[i] = pair.a.centre[i] + a.point[i] + (inside ? -b.point[i] : b.point[i]);
  }
  double& v = pair.b.centre[k];
  switch (draw.integer(0, 5)) {
    case 0:
      v += draw.coin() ? 1 : -1;
      break;
    case 1:
      v = std::nextafter(v, draw.coin() ? HUGE_VAL : -HUGE_VAL);
      break;
    default:
      break;
  }
  return exchanged_by_chance(draw, pair);
}

// One entry of B is a unit of the last place beside that of A; or B is A, moved or not.
MatrixPair nearly_equal(Draw& draw) {
  const Entries a = rounded_matrix(draw, axes(draw, 5));
  MatrixPair pair{{{}, a}, {{}, a}};
  const int kind = draw.integer(0, 2);
  double& v = pair.b.entries[static_cast<std::size_t>(draw.integer(0, 5))];
  if (kind == 0) v = std::nextafter(v, HUGE_VAL);
  if (kind == 1) pair.b.centre[static_cast<std::size_t>(draw.integer(0, 2))] = 0x1p-40;
  return pair;
}

MatrixPair diagonal(Draw& draw) {
  const auto body = [&](double most) {
    const double x = draw.real(0.1, most), y = draw.coin() ? x : draw.real(0.1, most);
    return Entries{x, y, draw.real(0.1, most), 0, 0, 0};
  };
  const Entries a = body(4), b = body(4);
  return placed(draw, a, b, 0, draw.real(0.2, 1.2));
}

}  // namespace

std::vector<InputFamily<MatrixPair>> matrix_families() {
  return {drawn_family("shallow", 50, shallow),
          drawn_family("near", 50, near_pair),
          drawn_family("deep", 40, deep_pair),
          drawn_family("aspect to 1e4", 40, flat_pair),
          drawn_family("scale 2^+-200", 20, scaled_pair),
          drawn_family("touching", 60, touching),
          drawn_family("nearly equal", 20, nearly_equal),
          drawn_family("diagonal", 30, diagonal)};
}

}  // namespace tangency::inline v0::verify
