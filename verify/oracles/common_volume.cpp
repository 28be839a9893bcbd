// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/common_volume.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tangency::inline v0::verify {
namespace {

using Digits80 = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<80, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;
using Matrix = std::array<Real3, 3>;
/// c_0 + c_1 z + ...
template <class T>
using Coefficients = std::vector<T>;

Real inner(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
const Real kPi = acos(Real(-1));

/// Eigenvectors in columns of a symmetric matrix, which becomes diagonal [Jacobi's method].
Matrix diagonalise(Matrix& m) {
  Matrix v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < 40; ++sweep) {
    for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
      if (m[p][q] == 0) continue;
      const Real theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
      const Real t = (theta < 0 ? -1 : 1) / (abs(theta) + sqrt(1 + theta * theta));
      const Real c = 1 / sqrt(1 + t * t), s = t * c;
      for (Real3& row : m) {
        const Real x = row[p], y = row[q];
        row[p] = c * x - s * y, row[q] = s * x + c * y;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const Real x = m[p][k], y = m[q][k];
        m[p][k] = c * x - s * y, m[q][k] = s * x + c * y;
        const Real u = v[k][p], w = v[k][q];
        v[k][p] = c * u - s * w, v[k][q] = s * u + c * w;
      }
      m[p][q] = m[q][p] = 0;
    }
  }
  return v;
}

Real value(const Coefficients<Real>& p, const Real& z) {
  Real sum = 0;
  for (std::size_t k = p.size(); k-- > 0;) sum = sum * z + p[k];
  return sum;
}

/// Real roots in [low, high], from those of the derivative: where the sign changes, by bisection
/// and Newton's method.
std::vector<Real> roots(const Coefficients<Real>& p, const Real& low, const Real& high) {
  if (p.size() < 2) return {};
  Coefficients<Real> slope;
  for (std::size_t k = 1; k < p.size(); ++k) slope.push_back(static_cast<int>(k) * p[k]);
  std::vector<Real> cuts{low}, found;
  for (const Real& z : roots(slope, low, high)) cuts.push_back(z);
  cuts.push_back(high);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    Real left = cuts[i], right = cuts[i + 1];
    const bool rises = value(p, left) < 0;
    if (rises == (value(p, right) < 0)) continue;
    Real z = (left + right) / 2;
    for (int step = 0; step < 600; ++step) {
      const Real v = value(p, z), s = value(slope, z);
      if (v == 0) break;
      ((v < 0) == rises ? left : right) = z;
      Real next = s == 0 ? left : Real(z - v / s);
      if (step % 3 == 2 || !(left < next && next < right)) next = (left + right) / 2;
      if (next == z || right - left < Real(1e-140) * (abs(z) + 1e-100)) break;
      z = next;
    }
    found.push_back(z);
  }
  return found;
}

/// The sections at height z, in circles: of the unit ball, and of the other body.
struct Circles {
  Coefficients<Real> ball, other, distance, difference;  ///< squares; D + r_1^2 - r_2^2
  Coefficients<Real> x;                                  ///< of the other's centre
  Real y, low, high;
  Matrix frame;  ///< unit vectors along x, y and z in its columns, in the ball's axes
};

Coefficients<Real> product(const Coefficients<Real>& a, const Coefficients<Real>& b) {
  Coefficients<Real> c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  }
  return c;
}

/// @param larger, other  with d from the centre of the first to that of the second
Circles circles(const Shape<Real>& larger, const Shape<Real>& other, const Real3& d) {
  Matrix w, form{};
  Real3 centre;
  for (std::size_t k = 0; k < 3; ++k) {
    centre[k] = inner(larger.axes[k], d) / larger.semi_axes[k];
    for (std::size_t i = 0; i < 3; ++i) {
      w[i][k] = inner(other.axes[i], larger.axes[k]) * larger.semi_axes[k] / other.semi_axes[i];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) form[i][j] += w[k][i] * w[k][j];
    }
  }
  const Matrix v = diagonalise(form);
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return form[i][i] < form[j][j]; });
  const auto k = [&](std::size_t i) { return form[order[i]][order[i]]; };
  const auto axis = [&](std::size_t i) {
    return Real3{v[0][order[i]], v[1][order[i]], v[2][order[i]]};
  };
  const Real range = k(2) - k(0);
  const bool ball = range < Real(1e-120) * k(2);
  const Real n1 = ball ? Real(0) : Real(sqrt(abs(k(1) - k(0)) / range));
  const Real n3 = ball ? Real(1) : Real(sqrt(abs(k(2) - k(1)) / range));
  const Real s1 = inner(axis(0), centre), s2 = inner(axis(1), centre), s3 = inner(axis(2), centre);
  const Real tau = n1 * n3 * range / k(1), beta = 1 / k(1), mu = k(0) * k(2) / (k(1) * k(1));
  const Real z0 = n1 * s1 + n3 * s3, x0 = n3 * s1 - n1 * s3 - tau * z0;

  Circles c;
  c.ball = {1, 0, -1};
  c.other = {beta - mu * z0 * z0, 2 * mu * z0, -mu};
  c.x = {x0, tau}, c.y = s2;
  c.distance = product(c.x, c.x);
  c.distance[0] += s2 * s2;
  for (std::size_t i = 0; i < 3; ++i)
    c.difference.push_back(c.distance[i] + c.ball[i] - c.other[i]);
  const Real half = sqrt(beta / mu);
  c.low = std::max(Real(-1), Real(z0 - half)), c.high = std::min(Real(1), Real(z0 + half));
  const Real3 first = axis(0), middle = axis(1), last = axis(2);
  for (std::size_t i = 0; i < 3; ++i) {
    c.frame[i] = {n3 * first[i] - n1 * last[i], middle[i], n1 * first[i] + n3 * last[i]};
  }
  return c;
}

/// Area, z times the angle of the ball's arc, chord along the line of centres in x and in y.
using Section = std::array<Digits80, 4>;

/// In an arithmetic that is faster, near the heights where the circles cross.
struct FastCircles {
  std::array<Digits80, 3> ball, other, distance;
  std::array<Digits80, 2> x;
  Digits80 y;

  explicit FastCircles(const Circles& c) : y(c.y) {
    for (std::size_t k = 0; k < 3; ++k) {
      ball[k] = Digits80(c.ball[k]), other[k] = Digits80(c.other[k]);
      distance[k] = Digits80(c.distance[k]);
    }
    for (std::size_t k = 0; k < 2; ++k) x[k] = Digits80(c.x[k]);
  }
  Section at(const Digits80& z) const {
    const auto of = [&](const std::array<Digits80, 3>& p) -> Digits80 {
      return p[0] + z * (p[1] + z * p[2]);
    };
    const Digits80 r1 = of(ball), r2 = of(other), d = of(distance);
    const Digits80 q1 = d + r1 - r2, q2 = d + r2 - r1, p = 4 * d * r1 - q1 * q1;
    if (p <= 0) return {0, 0, 0, 0};  // rounding, beside an end
    const Digits80 root = sqrt(p), first = atan2(root, q1), second = atan2(root, q2);
    const Digits80 chord = root / d;
    return {r1 * first + r2 * second - root / 2, z * first, chord * (x[0] + x[1] * z), chord * y};
  }
};

/// Nodes of the tanh-sinh rule as distances from the nearer end of [0, 1], and weights.
struct DoubleExponential {
  struct Node {
    Digits80 from_end, weight;
  };
  static constexpr int kLevels = 9;
  std::array<std::vector<Node>, kLevels> added;  ///< by halving the step, from 1/2
  std::array<Digits80, kLevels> step;

  DoubleExponential() {
    const Digits80 half_pi = acos(Digits80(-1)) / 2;
    for (int level = 0; level < kLevels; ++level) {
      const auto k = static_cast<std::size_t>(level);
      step[k] = ldexp(Digits80(1), -(level + 1));
      for (int i = level == 0 ? 0 : 1;; i += level == 0 ? 1 : 2) {
        const Digits80 t = i * step[k];
        if (t > 4.6) break;
        const Digits80 u = half_pi * sinh(t), e = exp(-2 * u), c = cosh(u);
        added[k].push_back({e / (1 + e), half_pi * cosh(t) / (2 * c * c)});
      }
    }
  }
};

Section integrated(const FastCircles& circles, const Digits80& low, const Digits80& high) {
  static const DoubleExponential rule;
  const Digits80 width = high - low;
  Section sum{}, before{};
  for (std::size_t level = 0; level < DoubleExponential::kLevels; ++level) {
    for (const auto& [from_end, weight] : rule.added[level]) {
      for (const bool left : {true, false}) {
        if (!left && from_end == Digits80(0.5)) continue;
        const Digits80 away = width * from_end;
        const Section here = circles.at(left ? Digits80(low + away) : Digits80(high - away));
        for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * here[k];
      }
    }
    Section now;
    bool settled = level > 2;
    for (std::size_t k = 0; k < 4; ++k) {
      now[k] = sum[k] * rule.step[level] * width;
      const Digits80 scale =
          k == 0 ? abs(now[0]) : Digits80(abs(now[1]) + abs(now[2]) + abs(now[3]));
      settled = settled && abs(now[k] - before[k]) <= Digits80(1e-18) * scale;
    }
    if (settled) return now;
    before = now;
  }
  return before;
}

/// Volume over that of the ball's cube of semi-axes, and its gradient by the other's centre.
struct InBall {
  Real volume;
  Real3 gradient;
};
InBall in_ball(const Circles& c) {
  InBall result{0, {0, 0, 0}};
  if (!(c.low < c.high)) return result;
  Coefficients<Real> p = product(c.distance, c.ball);
  const Coefficients<Real> square = product(c.difference, c.difference);
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = 4 * p[k] - square[k];
  Coefficients<Real> slope;
  for (std::size_t k = 1; k < p.size(); ++k) slope.push_back(static_cast<int>(k) * p[k]);
  std::vector<Real> cuts{c.low, c.high};
  for (const auto& more :
       {roots(p, c.low, c.high), roots(slope, c.low, c.high), roots(c.difference, c.low, c.high),
        roots({c.distance[1], 2 * c.distance[2]}, c.low, c.high)}) {
    cuts.insert(cuts.end(), more.begin(), more.end());
  }
  std::sort(cuts.begin(), cuts.end());
  const FastCircles fast(c);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Real &low = cuts[i], &high = cuts[i + 1], middle = (low + high) / 2;
    if (!(high > low)) continue;
    if (value(p, middle) > 0) {
      const Section s = integrated(fast, Digits80(low), Digits80(high));
      result.volume += Real(s[0]);
      result.gradient[0] -= Real(s[2]), result.gradient[1] -= Real(s[3]);
      result.gradient[2] -= 2 * Real(s[1]);
      continue;
    }
    const Real q1 = value(c.difference, middle);
    const bool ball_inside = q1 <= 0,  // = 0: equal
        other_inside = 2 * value(c.distance, middle) < q1;
    if (!ball_inside && !other_inside) continue;
    const Coefficients<Real>& r = ball_inside ? c.ball : c.other;
    const auto primitive = [&](const Real& z) -> Real {
      return z * (r[0] + z * (r[1] / 2 + z * r[2] / 3));
    };
    result.volume += kPi * (primitive(high) - primitive(low));
    if (ball_inside) result.gradient[2] -= kPi * (high * high - low * low);
  }
  return result;
}

Real product_of(const Real3& v) { return v[0] * v[1] * v[2]; }

}  // namespace

CommonVolumeTruth common_volume(const RawEllipsoid& a, const RawEllipsoid& b) {
  const Separation<Real> pair = separation(real(a), real(b));
  const bool a_larger = product_of(pair.a.semi_axes) >= product_of(pair.b.semi_axes);
  const Shape<Real>&larger = a_larger ? pair.a : pair.b, &other = a_larger ? pair.b : pair.a;
  const Real sign = a_larger ? 1 : -1;
  const Circles c = circles(larger, other, {sign * pair.d[0], sign * pair.d[1], sign * pair.d[2]});
  const InBall found = in_ball(c);
  const Real cube = product_of(larger.semi_axes);
  CommonVolumeTruth truth{cube * found.volume, {0, 0, 0}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Real along = inner(c.frame[k], found.gradient) * cube / larger.semi_axes[k];
    for (std::size_t i = 0; i < 3; ++i) truth.gradient[i] += sign * along * larger.axes[k][i];
  }
  return truth;
}

namespace {

using Vector = std::array<double, 3>;

/// A body as the form (x - c)' Q (x - c) in double.
struct PlainForm {
  Vector centre;
  std::array<Vector, 3> q, shape;

  PlainForm(const Shape<Real>& s, const Real3& c) : q{}, shape{} {
    for (std::size_t i = 0; i < 3; ++i) {
      centre[i] = static_cast<double>(c[i]);
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Real product = s.axes[k][i] * s.axes[k][j],
                     square = s.semi_axes[k] * s.semi_axes[k];
          q[i][j] += static_cast<double>(Real(product / square));
          shape[i][j] += static_cast<double>(Real(product * square));
        }
      }
    }
  }
};
double plain(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector times(const std::array<Vector, 3>& m, const Vector& v) {
  return {plain(m[0], v), plain(m[1], v), plain(m[2], v)};
}
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double level(const PlainForm& f, const Vector& x) {
  const Vector from = minus(x, f.centre);
  return plain(from, times(f.q, from));
}

/// The solution of m x = v by Cramer's rule.
Vector solved(const std::array<Vector, 3>& m, const Vector& v) {
  const auto determinant = [](const Vector& x, const Vector& y, const Vector& z) {
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) +
           x[2] * (y[0] * z[1] - y[1] * z[0]);
  };
  const double whole = determinant(m[0], m[1], m[2]);  // m is symmetric: its rows are its columns
  return {determinant(v, m[1], m[2]) / whole, determinant(m[0], v, m[2]) / whole,
          determinant(m[0], m[1], v) / whole};
}

/// Where both levels are the same and least.
Vector inner_point(const PlainForm& a, const PlainForm& b) {
  double low = 0.0, high = 1.0;
  Vector x{};
  for (int step = 0; step < 60; ++step) {
    const double s = 0.5 * (low + high);
    std::array<Vector, 3> mixed{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) mixed[i][j] = (1 - s) * a.shape[i][j] + s * b.shape[i][j];
    }
    const Vector to = times(a.shape, solved(mixed, minus(b.centre, a.centre)));
    for (std::size_t i = 0; i < 3; ++i) x[i] = a.centre[i] + (1 - s) * to[i];
    (level(a, x) > level(b, x) ? low : high) = s;
  }
  return x;
}

/// From a point inside, along a unit vector.
double distance_to_boundary(const PlainForm& f, const Vector& from, const Vector& along) {
  const Vector r = minus(from, f.centre), q = times(f.q, along);
  const double a = plain(along, q), b = plain(r, q), c = level(f, from) - 1.0;
  const double root = std::sqrt(b * b - a * c);
  return b > 0.0 ? -c / (b + root) : (root - b) / a;
}

}  // namespace

double common_volume_by_rays(const RawEllipsoid& a, const RawEllipsoid& b, int steps) {
  const Separation<Real> pair = separation(real(a), real(b));
  const PlainForm first(pair.a, {0, 0, 0}), second(pair.b, pair.d);
  const Vector from = inner_point(first, second);
  const double half_turn = std::acos(-1.0), step = half_turn / steps;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double polar = (i + 0.5) * step, cosine = std::cos(polar), sine = std::sin(polar);
    for (int j = 0; j < 2 * steps; ++j) {
      const double around = (j + 0.5) * step;
      const Vector along{sine * std::cos(around), sine * std::sin(around), cosine};
      const double reach = std::min(distance_to_boundary(first, from, along),
                                    distance_to_boundary(second, from, along));
      sum += sine * reach * reach * reach;
    }
  }
  return sum * step * step / 3.0;
}

}  // namespace tangency::inline v0::verify
