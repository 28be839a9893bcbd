// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/inner_ellipsoid.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace tangency::inline v0::verify {
namespace {

using Rows = std::array<Ball3, 3>;

Ball3 times(const Rows& m, const Ball3& v) {
  return {inner(m[0], v), inner(m[1], v), inner(m[2], v)};
}

Ball3 scaled(const Ball& s, const Ball3& v) { return {s * v[0], s * v[1], s * v[2]}; }

Ball3 difference(const Ball3& a, const Ball3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// Unit, and exactly so up to the errors, along v.
Ball3 unit(const Ball3& v) { return scaled(Ball(1) / sqrt(inner(v, v)), v); }

Ball3 middle(const Ball3& v) { return {v[0].middle(), v[1].middle(), v[2].middle()}; }

// Three orthogonal unit vectors, the first along v.
Rows frame_along(const Ball3& v) {
  const Ball3 first = unit(middle(v));
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(first[i].value()) < std::abs(first[k].value())) k = i;
  }
  Ball3 axis{};
  axis[k] = Ball(1);
  const Ball3 second = unit(cross(first, axis));
  return {first, second, cross(first, second)};
}

// O turns B's frame into A's: the first axes, P_B n and P_A n, onto each other, and the others by
// that turn or reflection for which the trace of O P_B P_A', and so that of T'T, is greatest. Any
// one is right.
struct Turn {
  Rows from, to;
  Ball cosine, sine, side;

  Ball3 operator()(const Ball3& v) const {
    const Ball x = inner(from[0], v), y = inner(from[1], v), z = side * inner(from[2], v);
    const Ball y_turned = cosine * y - sine * z, z_turned = sine * y + cosine * z;
    Ball3 result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = to[0][i] * x + to[1][i] * y_turned + to[2][i] * z_turned;
    }
    return result;
  }
};

Turn best_turn(const Rows& a, const Rows& b, const Ball3& n) {
  Turn turn{frame_along(times(b, n)), frame_along(times(a, n)), {}, {}, Ball(1)};
  // w[i][j] = s_j' P_B P_A' p_i, s of B's frame, p of A's.
  std::array<std::array<double, 2>, 2> w{};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      Ball sum;
      for (std::size_t column = 0; column < 3; ++column) {
        const Ball3 of_a{a[0][column], a[1][column], a[2][column]};
        const Ball3 of_b{b[0][column], b[1][column], b[2][column]};
        sum = sum + inner(turn.to[i + 1], of_a) * inner(turn.from[j + 1], of_b);
      }
      w[i][j] = static_cast<double>(sum.value());
    }
  }
  double c = w[0][0] + w[1][1], s = w[1][0] - w[0][1];
  if (std::hypot(w[0][0] - w[1][1], w[1][0] + w[0][1]) > std::hypot(c, s)) {
    c = w[0][0] - w[1][1], s = w[1][0] + w[0][1];
    turn.side = Ball(-1);
  }
  if (!(std::hypot(c, s) > 0)) c = 1, s = 0;
  const Ball per = Ball(1) / sqrt(Ball(c) * Ball(c) + Ball(s) * Ball(s));
  turn.cosine = per * Ball(c);
  turn.sine = per * Ball(s);
  return turn;
}

// T'T of T = P_A + O P_B.
Rows squared(const Rows& a, const Rows& b, const Turn& turn) {
  Rows columns;  // of T
  for (std::size_t i = 0; i < 3; ++i) {
    columns[i] = turn({b[0][i], b[1][i], b[2][i]});
    for (std::size_t k = 0; k < 3; ++k) columns[i][k] = columns[i][k] + a[k][i];
  }
  Rows m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) m[i][j] = m[j][i] = inner(columns[i], columns[j]);
  }
  return m;
}

}  // namespace

// For any v, with r = d - K v, d'K^-1 d is v.d + v.r + r'K^-1 r, and the least eigenvalue of K is
// at least 4 det K / (tr K)^2.
std::optional<Ball> inverse_form(const Rows& k, const Ball3& d, const Ball3& v) {
  const Ball minor = k[0][0] * k[1][1] - k[0][1] * k[0][1];
  const Ball determinant = inner(k[0], cross(k[1], k[2]));
  if (!(k[0][0].least() > 0 && minor.least() > 0 && determinant.least() > 0)) return std::nullopt;
  const Ball trace = k[0][0] + k[1][1] + k[2][2];
  const Ball3 r = difference(d, times(k, v));
  return inner(v, d) + inner(v, r) + inner(r, r) * trace * trace / (Ball(4) * determinant);
}

std::optional<Ball> depth_by_inner_ellipsoid(const ProvenBody& a, const ProvenBody& b,
                                             const Ball3& d, const Ball3& n, const Ball& depth) {
  if (!(depth.value() > 0)) return std::nullopt;
  const Rows rows_a = a.rows(), rows_b = b.rows();
  Rows k = squared(rows_a, rows_b, best_turn(rows_a, rows_b, n));
  const Ball reach = sqrt(inner(n, times(k, n)));  // |T n|
  // At a stationary n of E with that depth, m = t |T n| and K^-1 d = n / |T n|. Chosen: a little
  // less, so that K is definite also where two opposite normals tie.
  const Ball m = (depth * reach * Ball(1 - 0x1p-60L)).middle();
  for (std::size_t i = 0; i < 3; ++i) k[i][i] = k[i][i] - m;
  const auto form = inverse_form(k, d, middle(scaled(Ball(1) / reach, n)));
  if (!form) return std::nullopt;
  const Ball least = sqrt(m * (Ball(1) - *form));
  if (!(least.least() > 0)) return std::nullopt;
  return least;
}

}  // namespace tangency::inline v0::verify
