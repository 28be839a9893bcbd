// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/shape_matrix.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <tangency/verify/oracles/inertia.hpp>
#include <tangency/verify/oracles/jacobi.hpp>

namespace tangency::inline v0::verify {
namespace {

using Matrix = std::array<Real3, 3>;

// The place of the entry (i, j) among xx yy zz xy yz zx.
std::size_t place(std::size_t i, std::size_t j) {
  if (i == j) return i;
  return i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

void require_definite(const RawShapeMatrix& body) {
  const auto m = to_integers(body.entries).m;
  IntegerMatrix matrix;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) matrix[i][j] = m[place(i, j)];
  }
  if (inertia(matrix, 3) != Inertia{3, 0, 0})
    throw std::invalid_argument("oracle: a shape matrix must be positive definite");
}

// Lengths in units of 2^unit, areas in units of 2^(2 unit): integers then.
int common_unit(const RawShapeMatrix& a, const RawShapeMatrix& b) {
  std::array<double, 6> centres;
  std::ranges::copy(b.centre, std::ranges::copy(a.centre, centres.begin()).out);
  int unit = to_integers(centres).exponent;
  for (const RawShapeMatrix* body : {&a, &b}) {
    const int square = to_integers(body->entries).exponent;
    unit = std::min(unit, square >= 0 ? square / 2 : (square - 1) / 2);
  }
  return unit;
}

// value / 2^unit, an integer.
mpz_class integer(double value, int unit) {
  ScaledIntegers one = to_integers(std::array{value});
  if (one.m[0] == 0) return 0;
  return one.m[0] << static_cast<mp_bitcnt_t>(one.exponent - unit);
}

// Of adj(M) about the centre, level det(M): negative inside.
IntegerMatrix form(const RawShapeMatrix& body, const std::array<mpz_class, 3>& centre, int unit) {
  std::array<std::array<mpz_class, 3>, 3> m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = integer(body.entries[place(i, j)], 2 * unit);
  }
  IntegerMatrix q;
  mpz_class level = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      q[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
    }
  }
  for (std::size_t j = 0; j < 3; ++j) level += m[0][j] * q[0][j];
  q[3][3] = -level;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_class entry = 0;
    for (std::size_t j = 0; j < 3; ++j) entry -= q[i][j] * centre[j];
    q[i][3] = q[3][i] = entry;
    q[3][3] -= entry * centre[i];
  }
  return q;
}

// w x y z of the rotation whose columns are the axes, by the largest of the four.
std::array<Real, 4> quaternion(const Matrix& axes) {
  const auto r = [&](std::size_t i, std::size_t j) -> const Real& { return axes[j][i]; };
  const Real trace = r(0, 0) + r(1, 1) + r(2, 2);
  if (trace > 0) return {1 + trace, r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
  std::size_t i = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (r(k, k) > r(i, i)) i = k;
  }
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  std::array<Real, 4> q;
  q[0] = r(k, j) - r(j, k);
  q[i + 1] = 1 + r(i, i) - r(j, j) - r(k, k);
  q[j + 1] = r(i, j) + r(j, i);
  q[k + 1] = r(i, k) + r(k, i);
  return q;
}

void make_equal_what_agrees(Real3& values) {
  const Real kSame("1e-100");
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i + 1; j < 3; ++j) {
      if (abs(values[i] - values[j]) <= kSame * values[i]) values[j] = values[i];
    }
  }
}

}  // namespace

ExactRelation exact_relation(const RawShapeMatrix& a, const RawShapeMatrix& b) {
  require_definite(a);
  require_definite(b);
  const int unit = common_unit(a, b);
  std::array<mpz_class, 3> between;
  for (std::size_t i = 0; i < 3; ++i)
    between[i] = integer(b.centre[i], unit) - integer(a.centre[i], unit);
  return exact_relation_by_pencil(form(a, {}, unit), form(b, between, unit));
}

RealEllipsoid real(const RawShapeMatrix& body) {
  require_definite(body);
  Matrix m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = body.entries[place(i, j)];
  }
  auto [values, axes] = jacobi_eigen(m);
  make_equal_what_agrees(values);
  const Real3 third{axes[0][1] * axes[1][2] - axes[0][2] * axes[1][1],
                    axes[0][2] * axes[1][0] - axes[0][0] * axes[1][2],
                    axes[0][0] * axes[1][1] - axes[0][1] * axes[1][0]};
  axes[2] = third;  // right-handed
  RealEllipsoid result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.centre[i] = body.centre[i];
    result.semi_axes[i] = sqrt(values[i]);
  }
  result.orientation = quaternion(axes);
  return result;
}

}  // namespace tangency::inline v0::verify
