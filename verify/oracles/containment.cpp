// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/containment.hpp>

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include <tangency/verify/oracles/jacobi.hpp>

namespace tangency::inline v0::verify {
namespace {

template <class T, std::size_t N>
using Vector = std::array<T, N>;
template <class T, std::size_t N>
using Matrix = std::array<Vector<T, N>, N>;  // by rows

template <class T, std::size_t N>
T dot(const Vector<T, N>& a, const Vector<T, N>& b) {
  T sum = a[0] * b[0];
  for (std::size_t i = 1; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

template <std::size_t N>
struct Solid {
  Vector<Real, N> semi_axes;
  Matrix<Real, N> axes;  // each unit
};

template <std::size_t N>
struct Nest {
  Solid<N> inner, outer;
  Vector<Real, N> e;  // c_inner - c_outer
};

Nest<3> nest(const RawEllipsoid& inner, const RawEllipsoid& outer) {
  const Separation<Real> pair = separation(real(outer), real(inner));
  return {{pair.b.semi_axes, pair.b.axes}, {pair.a.semi_axes, pair.a.axes}, pair.d};
}

Solid<2> solid(const RawEllipse& body) {
  const Real x = body.direction[0], y = body.direction[1], n = sqrt(x * x + y * y);
  if (!(body.semi_axes[0] > 0 && body.semi_axes[1] > 0 && n > 0))
    throw std::invalid_argument("oracle: semi-axes must be > 0 and a direction must not be zero");
  const Real c = x / n, s = y / n;
  return {{Real(body.semi_axes[0]), Real(body.semi_axes[1])}, {{{c, s}, {-s, c}}}};
}

Nest<2> nest(const RawEllipse& inner, const RawEllipse& outer) {
  return {solid(inner),
          solid(outer),
          {Real(inner.centre[0]) - outer.centre[0], Real(inner.centre[1]) - outer.centre[1]}};
}

// ---- phi and its descent

// Support function and point.
template <std::size_t N>
std::pair<Real, Vector<Real, N>> support(const Solid<N>& body, const Vector<Real, N>& n) {
  Real square = 0;
  Vector<Real, N> x{};
  for (std::size_t k = 0; k < N; ++k) {
    const Real along = body.semi_axes[k] * dot(body.axes[k], n);
    square += along * along;
    for (std::size_t i = 0; i < N; ++i) x[i] += body.semi_axes[k] * along * body.axes[k][i];
  }
  const Real h = sqrt(square);
  for (Real& v : x) v /= h;
  return {h, x};
}

template <std::size_t N>
Vector<Real, N> normalised(Vector<Real, N> n) {
  const Real length = sqrt(dot(n, n));
  for (Real& v : n) v /= length;
  return n;
}

template <std::size_t N>
Real phi(const Nest<N>& pair, const Vector<Real, N>& unit) {
  return support(pair.outer, unit).first - support(pair.inner, unit).first - dot(unit, pair.e);
}

// t' (Hess h) t = (sum of a_k^2 (r_k.t)^2 - (x.t)^2) / h.
template <std::size_t N>
Real bend(const Solid<N>& body, const std::pair<Real, Vector<Real, N>>& at,
          const Vector<Real, N>& s, const Vector<Real, N>& t) {
  Real sum = -dot(at.second, s) * dot(at.second, t);
  for (std::size_t k = 0; k < N; ++k) {
    const Real& a = body.semi_axes[k];
    sum += a * a * dot(body.axes[k], s) * dot(body.axes[k], t);
  }
  return sum / at.first;
}

Matrix<Real, 2> tangents(const Vector<Real, 2>& n) { return {{{-n[1], n[0]}, {-n[1], n[0]}}}; }
Matrix<Real, 3> tangents(const Vector<Real, 3>& n) {
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (abs(n[i]) < abs(n[k])) k = i;
  }
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  Vector<Real, 3> s{};
  s[i] = -n[j], s[j] = n[i];
  s = normalised(s);
  return {s, {n[1] * s[2] - n[2] * s[1], n[2] * s[0] - n[0] * s[2], n[0] * s[1] - n[1] * s[0]}, n};
}

// A step downhill: Newton's where phi is convex, else along the gradient.
template <std::size_t N>
Vector<Real, N> step(const Nest<N>& pair, const Vector<Real, N>& n) {
  const auto a = support(pair.outer, n), b = support(pair.inner, n);
  const Real value = a.first - b.first - dot(n, pair.e);
  const Matrix<Real, N> t = tangents(n);
  Vector<Real, N> rest;
  for (std::size_t i = 0; i < N; ++i) rest[i] = a.second[i] - b.second[i] - pair.e[i];
  Matrix<Real, N> k{};
  Vector<Real, N> r{}, move{};
  for (std::size_t i = 0; i + 1 < N; ++i) {
    r[i] = dot(t[i], rest);
    for (std::size_t j = 0; j + 1 < N; ++j)
      k[i][j] = bend(pair.outer, a, t[i], t[j]) - bend(pair.inner, b, t[i], t[j]);
    k[i][i] -= value;
  }
  if constexpr (N == 2) {
    const Real turn = k[0][0] > 0 ? Real(-r[0] / k[0][0]) : Real(-r[0] / abs(a.first));
    for (std::size_t i = 0; i < N; ++i) move[i] = turn * t[0][i];
  } else {
    const Real det = k[0][0] * k[1][1] - k[0][1] * k[1][0];
    const bool convex = det > 0 && k[0][0] > 0;
    const Real u = convex ? Real(-(k[1][1] * r[0] - k[0][1] * r[1]) / det) : Real(-r[0] / a.first);
    const Real v = convex ? Real(-(k[0][0] * r[1] - k[1][0] * r[0]) / det) : Real(-r[1] / a.first);
    for (std::size_t i = 0; i < N; ++i) move[i] = u * t[0][i] + v * t[1][i];
  }
  return move;
}

template <std::size_t N>
Real descend(const Nest<N>& pair, const Vector<Real, N>& start) {
  Vector<Real, N> n = normalised(start);
  Real value = phi(pair, n);
  for (int steps = 0; steps < 100; ++steps) {
    Vector<Real, N> move = step(pair, n);
    const Real length = sqrt(dot(move, move));
    if (length > 0.5) {
      for (Real& v : move) v *= 0.5 / length;
    }
    bool lower = false;
    for (int halving = 0; halving < 60 && !lower; ++halving) {
      Vector<Real, N> next;
      for (std::size_t i = 0; i < N; ++i) next[i] = n[i] + move[i];
      next = normalised(next);
      const Real there = phi(pair, next);
      if (there < value) value = there, n = next, lower = true;
      for (Real& v : move) v /= 2;
    }
    if (!lower || length < Real("1e-45")) break;
  }
  return value;
}

template <std::size_t N>
Vector<Real, N> exactly(const std::array<double, N>& n) {
  Vector<Real, N> result;
  std::ranges::copy(n, result.begin());
  return result;
}

// ---- (1): the distances of the inner body's points

using Interval = CGAL::Interval_nt<false>;

Interval around(const Real& v) {
  const Real error = abs(v) * Real("1e-130");
  const Real low = v - error, high = v + error;
  return Interval(mpfr_get_d(low.backend().data(), MPFR_RNDD),
                  mpfr_get_d(high.backend().data(), MPFR_RNDU));
}
double middle(const Interval& v) { return v.inf() + (v.sup() - v.inf()) / 2; }

// In the frame of the outer body's axes, in units of its smallest semi-axis: p = e + K y for the
// points of the inner body's boundary, |y| = 1.
template <std::size_t N>
struct Points {
  Vector<Interval, N> squares;  // a_i^2
  Vector<Interval, N> e;
  Matrix<Interval, N> k;
  Vector<Interval, N> rows;  // |k_i|^2

  Points(const Nest<N>& pair, const Real& unit) {
    for (std::size_t i = 0; i < N; ++i) {
      const Real a = pair.outer.semi_axes[i] / unit;
      squares[i] = around(a * a);
      e[i] = around(dot(pair.outer.axes[i], pair.e) / unit);
      rows[i] = 0;
      for (std::size_t j = 0; j < N; ++j) {
        k[i][j] =
            around(dot(pair.outer.axes[i], pair.inner.axes[j]) * pair.inner.semi_axes[j] / unit);
        rows[i] += square(k[i][j]);
      }
    }
  }
};

// A part of a face of the cube [-1, 1]^N, seen from its centre.
template <std::size_t N>
struct Box {
  std::size_t axis;
  double side;
  std::array<double, N - 1> at;
  double half;

  Vector<Interval, N> direction(std::size_t corner) const {
    Vector<Interval, N> y;
    y[axis] = side;
    for (std::size_t i = 0; i + 1 < N; ++i) {
      const double off = corner == 0 ? 0.0 : (((corner - 1) >> i) % 2 == 0 ? -half : half);
      y[(axis + 1 + i) % N] = Interval(at[i]) + off;
    }
    const Interval length = sqrt(dot(y, y));
    for (Interval& v : y) v /= length;
    return y;
  }
};

// The t that makes (1) greatest, less what keeps it below a_min^2 = 1, roughly.
template <std::size_t N>
double best_multiplier(const Points<N>& body, const Vector<Interval, N>& p) {
  double low = 0, high = 1 - 0x1p-20;
  for (int halving = 0; halving < 30; ++halving) {
    const double t = (low + high) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const double a2 = middle(body.squares[i]), x = middle(p[i]);
      sum += a2 * (x / (a2 - t)) * (x / (a2 - t));
    }
    (sum < 1 ? low : high) = t;
  }
  return low;
}

// Are all points of the box at least sqrt(least2) from the outer body's boundary? With y = y_0 +
// delta, y_0.delta = -|delta|^2 / 2 as both are unit.
template <std::size_t N>
bool is_far(const Points<N>& body, const Box<N>& box, const Interval& least2) {
  const Vector<Interval, N> y = box.direction(0);
  Interval reach2 = 0;
  for (std::size_t corner = 1; corner <= (std::size_t{1} << (N - 1)); ++corner) {
    const Vector<Interval, N> c = box.direction(corner);
    Interval chord2 = 0;
    for (std::size_t i = 0; i < N; ++i) chord2 += square(c[i] - y[i]);
    reach2 = std::max(reach2.sup(), chord2.sup());
  }
  Vector<Interval, N> p = body.e;
  for (std::size_t i = 0; i < N; ++i) p[i] += dot(body.k[i], y);
  const Interval t = best_multiplier(body, p);
  Interval level = 0, trace = 0, along = 0, across2 = 0;
  Vector<Interval, N> slope{};
  for (std::size_t i = 0; i < N; ++i) {
    const Interval weight = 1 / (body.squares[i] - t);
    level += weight * square(p[i]);
    trace += weight * body.rows[i];
    for (std::size_t j = 0; j < N; ++j) slope[j] += weight * p[i] * body.k[i][j];
  }
  along = dot(slope, y);
  for (std::size_t j = 0; j < N; ++j) across2 += square(slope[j] - along * y[j]);
  const Interval second = std::max(0.0, (trace - along).sup());
  const Interval most = level + 2 * sqrt(across2 * reach2) + second * reach2;
  return (t * (1 - most)).inf() >= least2.sup();
}

template <std::size_t N>
bool all_far(const Nest<N>& pair, double least, std::size_t most_boxes) {
  const Real unit = *std::ranges::min_element(pair.outer.semi_axes);
  const Real ratio = Real(least) / unit;
  const CGAL::Protect_FPU_rounding<true> rounding_up;
  const Points<N> body(pair, unit);
  const Interval least2 = square(around(ratio));
  std::vector<Box<N>> boxes;
  for (std::size_t axis = 0; axis < N; ++axis) {
    for (const double side : {-1.0, 1.0}) boxes.push_back({axis, side, {}, 1.0});
  }
  for (std::size_t spent = 0; !boxes.empty(); ++spent) {
    const Box<N> box = boxes.back();
    boxes.pop_back();
    if (box.half < 1 && is_far(body, box, least2)) continue;
    if (spent >= most_boxes || box.half < 0x1p-45) return false;
    for (std::size_t part = 0; part < (std::size_t{1} << (N - 1)); ++part) {
      Box<N> next = box;
      next.half /= 2;
      for (std::size_t i = 0; i + 1 < N; ++i)
        next.at[i] += (part >> i) % 2 == 0 ? -next.half : next.half;
      boxes.push_back(next);
    }
  }
  return true;
}

// ---- (2): the margin

template <std::size_t N>
MarginTruth margin(const Nest<N>& pair) {
  Matrix<Real, N> k, w{};
  Vector<Real, N> centre, e;
  for (std::size_t i = 0; i < N; ++i) {
    const Real& a = pair.outer.semi_axes[i];
    centre[i] = dot(pair.outer.axes[i], pair.e) / a;
    for (std::size_t j = 0; j < N; ++j)
      k[i][j] = dot(pair.outer.axes[i], pair.inner.axes[j]) * pair.inner.semi_axes[j] / a;
  }
  if (dot(centre, centre) >= 1) return {0, 0};
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) w[i][j] = dot(k[i], k[j]);
  }
  const auto [values, vectors] = jacobi_eigen(w);
  for (std::size_t i = 0; i < N; ++i) e[i] = dot(vectors[i], centre);
  const auto largest = static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
  const auto length2 = [&, &values = values](const Real& v) {
    Real sum = 0;
    for (std::size_t i = 0; i < N; ++i)
      sum += (e[i] * v / (v - values[i])) * (e[i] * v / (v - values[i]));
    return sum;
  };
  Real low = values[largest], high = 2 * low;
  while (length2(high) > 1) low = high, high *= 4;
  for (int halving = 0; halving < 440; ++halving) {
    const Real v = (low + high) / 2;
    (v > values[largest] && length2(v) <= 1 ? high : low) = v;
  }
  MarginTruth truth;
  Real square = 1 / high, rest = 0;
  Vector<Real, N> m;
  for (std::size_t i = 0; i < N; ++i) {
    square -= e[i] * e[i] / (high - values[i]);
    m[i] = e[i] * high / (high - values[i]);
    if (i != largest) rest += m[i] * m[i];
  }
  truth.low = square > 0 ? Real(sqrt(square)) : Real(0);
  m[largest] = rest < 1 ? Real(sqrt(1 - rest)) : Real(0);
  if (e[largest] < 0) m[largest] = -m[largest];
  Real form = 0;
  for (std::size_t i = 0; i < N; ++i) form += values[i] * m[i] * m[i];
  truth.high = (sqrt(dot(m, m)) - dot(e, m)) / sqrt(form);
  return truth;
}

}  // namespace

Real clearance_at(const RawEllipsoid& inner, const RawEllipsoid& outer,
                  const std::array<double, 3>& n) {
  return phi(nest(inner, outer), normalised(exactly(n)));
}
Real clearance_at(const RawEllipse& inner, const RawEllipse& outer,
                  const std::array<double, 2>& n) {
  return phi(nest(inner, outer), normalised(exactly(n)));
}

Real clearance_near(const RawEllipsoid& inner, const RawEllipsoid& outer,
                    const std::array<double, 3>& n) {
  return descend(nest(inner, outer), exactly(n));
}
Real clearance_near(const RawEllipse& inner, const RawEllipse& outer,
                    const std::array<double, 2>& n) {
  return descend(nest(inner, outer), exactly(n));
}

bool clearance_is_at_least(const RawEllipsoid& inner, const RawEllipsoid& outer, double least,
                           std::size_t most_boxes) {
  return all_far(nest(inner, outer), least, most_boxes);
}
bool clearance_is_at_least(const RawEllipse& inner, const RawEllipse& outer, double least,
                           std::size_t most_boxes) {
  return all_far(nest(inner, outer), least, most_boxes);
}

MarginTruth margin_truth(const RawEllipsoid& inner, const RawEllipsoid& outer) {
  return margin(nest(inner, outer));
}
MarginTruth margin_truth(const RawEllipse& inner, const RawEllipse& outer) {
  return margin(nest(inner, outer));
}

}  // namespace tangency::inline v0::verify
