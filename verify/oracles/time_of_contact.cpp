// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/time_of_contact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tangency::inline v0::verify {
namespace {

using Triple = std::array<double, 3>;

// ---- intervals: each operation is done to nearest and widened by one number on either side, which
// holds the exact result; sine and cosine, which the library gives within one unit, by four.

constexpr double kInfinite = std::numeric_limits<double>::infinity();
double below(double x) { return std::nextafter(x, -kInfinite); }
double above(double x) { return std::nextafter(x, kInfinite); }

struct Interval {
  double low = 0, high = 0;
  Interval() = default;
  Interval(double x) : low(x), high(x) {}  // NOLINT: exact, so implicit
  Interval(double l, double h) : low(l), high(h) {}
};
Interval operator+(const Interval& a, const Interval& b) {
  return {below(a.low + b.low), above(a.high + b.high)};
}
Interval operator-(const Interval& a, const Interval& b) {
  return {below(a.low - b.high), above(a.high - b.low)};
}
Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
Interval operator*(const Interval& a, const Interval& b) {
  const auto [least, greatest] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {below(least), above(greatest)};
}
// Requires b > 0.
Interval operator/(const Interval& a, const Interval& b) {
  const auto [least, greatest] =
      std::minmax({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
  return {below(least), above(greatest)};
}
Interval square(const Interval& a) {
  const double l = std::abs(a.low), h = std::abs(a.high);
  const bool around_zero = a.low <= 0 && a.high >= 0;
  const double least = around_zero ? 0 : std::min(l, h), greatest = std::max(l, h);
  return {std::max(0.0, below(least * least)), above(greatest * greatest)};
}
Interval root(const Interval& a) {
  return {std::max(0.0, below(std::sqrt(std::max(0.0, a.low)))), above(std::sqrt(a.high))};
}

Interval widened(double value, double by) {
  return {std::max(-1.0, below(value - by)), std::min(1.0, above(value + by))};
}
// Sine and cosine change no faster than the angle.
struct SineCosine {
  Interval sine, cosine;
};
SineCosine sine_cosine(const Interval& angle) {
  const double middle = 0.5 * angle.low + 0.5 * angle.high;
  const double by = above(std::max(angle.high - middle, middle - angle.low)) + 0x1p-51;
  return {widened(std::sin(middle), by), widened(std::cos(middle), by)};
}

using Vector = std::array<Interval, 3>;
using Matrix = std::array<Vector, 3>;  // rows

Vector vector(const Triple& v) { return {v[0], v[1], v[2]}; }
Interval dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector operator*(const Interval& s, const Vector& v) { return {s * v[0], s * v[1], s * v[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector transposed_times(const Matrix& m, const Vector& v) {
  return v[0] * m[0] + v[1] * m[1] + v[2] * m[2];
}
Interval norm(const Vector& v) { return root(square(v[0]) + square(v[1]) + square(v[2])); }

Matrix rotation(const std::array<double, 4>& q) {
  const Interval w = q[0], x = q[1], y = q[2], z = q[3];
  const Interval s = Interval(2) / (square(w) + square(x) + square(y) + square(z));
  return {{{Interval(1) - s * (square(y) + square(z)), s * (x * y - w * z), s * (z * x + w * y)},
           {s * (x * y + w * z), Interval(1) - s * (square(z) + square(x)), s * (y * z - w * x)},
           {s * (z * x - w * y), s * (y * z + w * x), Interval(1) - s * (square(x) + square(y))}}};
}

// ---- bodies in motion

// A body over a span of time. E v = cos v + sin (k x v) + (1 - cos) k (k.v), k the axis.
class Span {
 public:
  Span(const MovingBody& moving, const Matrix& start, const Interval& time)
      : moving_(moving), start_(start), time_(time) {
    const Vector w = vector(moving.motion.angular_velocity);
    const Interval speed = norm(w);
    turns_ = speed.low > 0;
    if (!turns_) return;
    axis_ = Interval(1) / speed * w;
    turn_ = sine_cosine(speed * time);
  }

  Vector forward(const Vector& v) const { return turned(v, turn_.sine); }
  Vector back(const Vector& v) const { return turned(v, -turn_.sine); }

  // Of the centre, less that of t = 0; and its velocity.
  Vector displacement() const {
    const Vector r = vector(moving_.motion.pivot_arm);
    return time_ * vector(moving_.motion.velocity) + (turns_ ? forward(r) - r : Vector{});
  }
  Vector velocity() const {
    const Vector r = forward(vector(moving_.motion.pivot_arm));
    return vector(moving_.motion.velocity) + cross(vector(moving_.motion.angular_velocity), r);
  }

  // diag(a) R(t)' v
  Vector stretched(const Vector& v) const {
    Vector y = transposed_times(start_, back(v));
    for (std::size_t i = 0; i < 3; ++i) y[i] = Interval(moving_.body.semi_axes[i]) * y[i];
    return y;
  }
  Interval support(const Vector& n) const { return norm(stretched(n)); }
  // dh(n, t)/dt = y.y'/|y|, y' = -diag(a) R(t)' (w x n)
  Interval support_rate(const Vector& n) const {
    if (!turns_) return {};
    const Vector y = stretched(n);
    const Vector rate = stretched(cross(n, vector(moving_.motion.angular_velocity)));
    const Interval h = norm(y), bound = norm(rate);
    if (!(h.low > 0)) return {-bound.high, bound.high};
    const Interval quotient = dot(y, rate) / h;
    return {std::max(quotient.low, -bound.high), std::min(quotient.high, bound.high)};
  }
  // Level at a point relative to the centre.
  Interval level(const Vector& x) const {
    Vector y = transposed_times(start_, back(x));
    for (std::size_t i = 0; i < 3; ++i) y[i] = y[i] / Interval(moving_.body.semi_axes[i]);
    return square(y[0]) + square(y[1]) + square(y[2]);
  }

 private:
  Vector turned(const Vector& v, const Interval& sine) const {
    if (!turns_) return v;
    return turn_.cosine * v + sine * cross(axis_, v) +
           ((Interval(1) - turn_.cosine) * dot(axis_, v)) * axis_;
  }

  const MovingBody& moving_;
  const Matrix& start_;
  Interval time_;
  bool turns_ = false;
  Vector axis_;
  SineCosine turn_;
};

// ---- guesses, in plain floating point

using Square = std::array<Triple, 3>;

double middle(const Interval& x) { return 0.5 * (x.low + x.high); }
Triple middle(const Vector& v) { return {middle(v[0]), middle(v[1]), middle(v[2])}; }
double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// x of the positive definite m x = d, by Cramer's rule.
Triple solve(const Square& m, const Triple& d) {
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t r = (i + 1) % 3, s = (i + 2) % 3, p = (j + 1) % 3, q = (j + 2) % 3;
    return m[r][p] * m[s][q] - m[r][q] * m[s][p];
  };
  double determinant = 0;
  for (std::size_t j = 0; j < 3; ++j) determinant += m[0][j] * cofactor(0, j);
  Triple x{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) x[j] += cofactor(i, j) * d[i] / determinant;
  }
  return x;
}

struct Guess {
  Triple normal;  // from A to B, not 0
  Triple point;   // relative to A's centre
};

// F(s) = s (1-s) d' ((1-s) M_A + s M_B)^-1 d is concave; where it is largest, v = (...)^-1 d is the
// direction and (1-s) M_A v the point of the lowest common level.
class PerramWertheim {
 public:
  PerramWertheim(const Square& a, const Square& b, const Triple& d) : a_(a), b_(b), d_(d) {}

  Guess best() const {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double s = 0.5 * (low + high);
      const Triple v = direction(s);
      // F' has the sign of (1-s)^2 v'M_A v - s^2 v'M_B v.
      ((1 - s) * (1 - s) * form(a_, v) > s * s * form(b_, v) ? low : high) = s;
    }
    const double s = 0.5 * (low + high);
    const Triple v = direction(s);
    Guess guess{v, {}};
    for (std::size_t i = 0; i < 3; ++i) guess.point[i] = (1 - s) * dot(a_[i], v);
    return guess;
  }

 private:
  Triple direction(double s) const {
    Square m;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) m[i][j] = (1 - s) * a_[i][j] + s * b_[i][j];
    }
    return solve(m, d_);
  }
  static double form(const Square& m, const Triple& v) {
    return v[0] * dot(m[0], v) + v[1] * dot(m[1], v) + v[2] * dot(m[2], v);
  }

  Square a_, b_;
  Triple d_;
};

Square shape(const RawEllipsoid& body, const Matrix& start, const Span& at) {
  Square m{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Triple axis = middle(at.forward({start[0][k], start[1][k], start[2][k]}));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        m[i][j] += axis[i] * axis[j] * body.semi_axes[k] * body.semi_axes[k];
      }
    }
  }
  return m;
}

// ---- the search

class Search {
 public:
  Search(const MovingBody& a, const MovingBody& b)
      : a_(a),
        b_(b),
        start_a_(rotation(a.body.orientation)),
        start_b_(rotation(b.body.orientation)),
        between_(vector(b.body.centre) - vector(a.body.centre)) {}

  FirstContact run(double horizon, double resolution) const {
    constexpr auto kNone = FirstContact::Status::none;
    FirstContact found{kNone, 0, horizon};
    if (in_contact(0, guess_at(0).point)) return {FirstContact::Status::contact, 0, 0};
    std::vector<Interval> parts{{0, horizon}};  // the leftmost last
    while (!parts.empty()) {
      const Interval part = parts.back();
      const double m = 0.5 * part.low + 0.5 * part.high;
      const Guess guess = guess_at(m);
      if (apart(part, m, guess.normal)) {
        found.from = part.high;
        parts.pop_back();
        continue;
      }
      found.from = part.low;
      if (in_contact(m, guess.point)) {
        found.status = FirstContact::Status::contact;
        found.to = m;
        parts = {{part.low, m}};
        if (m - part.low <= resolution) return found;
        continue;
      }
      if (part.high - part.low <= resolution) {
        if (found.status == kNone) found.status = FirstContact::Status::undecided;
        return found;
      }
      parts.back() = {m, part.high};
      parts.push_back({part.low, m});
    }
    return found;
  }

 private:
  Guess guess_at(double t) const {
    const Span a(a_, start_a_, t), b(b_, start_b_, t);
    const Triple d = middle(between_ + b.displacement() - a.displacement());
    return PerramWertheim(shape(a_.body, start_a_, a), shape(b_.body, start_b_, b), d).best();
  }

  Interval separation(const Span& a, const Span& b, const Vector& n) const {
    return dot(n, between_ + b.displacement() - a.displacement()) - a.support(n) - b.support(n);
  }

  bool apart(const Interval& part, double m, const Triple& normal) const {
    const Vector n = vector(normal);
    const Interval now = separation({a_, start_a_, m}, {b_, start_b_, m}, n);
    if (!(now.low > 0)) return false;
    const Span a(a_, start_a_, part), b(b_, start_b_, part);
    const Interval rate =
        dot(n, b.velocity() - a.velocity()) - a.support_rate(n) - b.support_rate(n);
    return (now + rate * (part - Interval(m))).low > 0;
  }

  bool in_contact(double m, const Triple& point) const {
    const Span a(a_, start_a_, m), b(b_, start_b_, m);
    const Vector x = vector(point);
    return a.level(x).high < 1 &&
           b.level(x - (between_ + b.displacement() - a.displacement())).high < 1;
  }

  const MovingBody &a_, &b_;
  Matrix start_a_, start_b_;
  Vector between_;
};

}  // namespace

FirstContact first_contact(const MovingBody& a, const MovingBody& b, double horizon,
                           double resolution) {
  return Search(a, b).run(horizon, resolution);
}

}  // namespace tangency::inline v0::verify
