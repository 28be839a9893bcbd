// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/equal_level.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tangency/geometry/methods/perram_wertheim.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::methods {
namespace {

using Vector = DoubleDoubleVector;

constexpr int kFirstSteps = 40;  // chosen: Newton's method in double takes 2 to 10
// Chosen: halving the logarithm of the widest bracket, 2^722, down to rounding takes 62.
constexpr int kSteps = 100;
constexpr double kNear = 0x1p-40;            // of a step in log l: the next one is below 2^-75
constexpr double kSmallestSlope = 0x1p-100;  // chosen: below it rounding alone could be seen
constexpr double kSettled = 0x1p-75;         // no longer seen in doubles, even 2^22 times as large

DoubleDouble scaled(const DoubleDouble& v, int power) {
  return {scaled_by_power(v.high, power), scaled_by_power(v.low, power)};
}

Vector scaled(const Vector& v, int power) {
  return {scaled(v[0], power), scaled(v[1], power), scaled(v[2], power)};
}

/// M_A + l M_B as L D L', L unit lower triangular.
class ShapeSum {
 public:
  ShapeSum(const DoubleDoubleShape& a, const DoubleDoubleShape& b, const DoubleDouble& l) {
    const DoubleDouble xy = a.xy + l * b.xy, zx = a.zx + l * b.zx;
    d0_ = a.xx + l * b.xx;
    l10_ = xy / d0_, l20_ = zx / d0_;
    d1_ = (a.yy + l * b.yy) - l10_ * xy;
    const DoubleDouble rest = (a.yz + l * b.yz) - l20_ * xy;
    l21_ = rest / d1_;
    d2_ = (a.zz + l * b.zz) - l20_ * zx - l21_ * rest;
  }
  bool positive() const { return d0_.high > 0.0 && d1_.high > 0.0 && d2_.high > 0.0; }
  Vector solve(const Vector& v) const {
    const DoubleDouble y1 = v[1] - l10_ * v[0], y2 = v[2] - l20_ * v[0] - l21_ * y1;
    const DoubleDouble z = y2 / d2_, y = y1 / d1_ - l21_ * z;
    return {v[0] / d0_ - l10_ * y - l20_ * z, y, z};
  }

 private:
  DoubleDouble d0_, d1_, d2_, l10_, l20_, l21_;
};

/// Both levels at one l, for v in a unit of its own.
struct Levels {
  Direction v;
  Vector y_a, y_b;          ///< A' v and l B' v
  DoubleDouble in_a, in_b;  ///< their squares, the levels
};

Levels levels(const DoubleDoubleShape& a, const DoubleDoubleShape& b, const ShapeSum& sum,
              const DoubleDouble& l, const Direction& d) {
  Levels at;
  at.v = direction(sum.solve(d.vector));
  at.y_a = a.stretched(at.v.vector);
  at.y_b = l * b.stretched(at.v.vector);
  at.in_a = dot(at.y_a, at.y_a), at.in_b = dot(at.y_b, at.y_b);
  return at;
}

/// Newton's step of log l towards equal levels. The logarithm of their ratio falls with log l, by
/// at most 2: its derivative is -2 p (1/P + 1/Q), P the level of A, l Q that of B and
/// p = v' M_A (M_A + l M_B)^-1 l M_B v, a form of the parallel sum of M_A and l M_B.
double newton_step(const DoubleDoubleShape& a, const DoubleDoubleShape& b, const ShapeSum& sum,
                   const DoubleDouble& l, const Levels& at) {
  const double apart = std::log1p(((at.in_a - at.in_b) / at.in_b).high);
  const double p = dot(at.y_a, a.stretched(sum.solve(b.spread(at.y_b)))).high;
  const double q = at.in_b.high / l.high;
  const double slope = 2.0 * p * (1.0 / at.in_a.high + 1.0 / q);
  return apart / std::clamp(slope, kSmallestSlope, 2.0);
}

/// l by the polynomials in double; the geometric mean of the bracket where they may not be used.
double first_ratio(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, double low, double high) {
  const double middle = std::sqrt(low) * std::sqrt(high);
  if (!a.moderate() || !b.moderate()) return middle;
  const PerramWertheimForm form(a, b, d);
  PerramWertheimSearch search;
  double l = form.first_guess();
  for (int step = 0; step < kFirstSteps; ++step) {
    const double next = search.next(form.at(l));
    const bool settled = std::abs(next - l) <= 0x1p-26 * l;
    l = next;
    if (settled) break;
  }
  return low <= l && l <= high ? l : middle;
}

EqualLevel equal_level(const DoubleDoubleShape& a, const DoubleDoubleShape& b,
                       const DoubleDouble& l, const Levels& at, const Direction& d) {
  const DoubleDouble length = exact::length(at.v.vector);
  // v = 2^unit at.v.vector, if d = 2^d.exponent d.vector.
  const int unit = at.v.exponent + d.exponent;
  // F = l/(1+l) d'v = l/(1+l) (2 d'v - v' (M_A + l M_B) v): the errors of v and of l in the latter
  // are of second order.
  const DoubleDouble twice = scaled(dot(d.vector, at.v.vector), 1 - at.v.exponent);
  const DoubleDouble level = (l * (twice - at.in_a) - at.in_b) / (DoubleDouble(1.0) + l);
  return {l,
          (DoubleDouble(1.0) / length) * at.v.vector,
          scaled(level, 2 * unit),
          scaled(length, unit),
          scaled(a.spread(at.y_a), unit),
          -scaled(b.spread(at.y_b), unit)};
}

}  // namespace

DoubleDoubleShape::DoubleDoubleShape(const Ellipsoid& body_) noexcept
    : body(body_), rotation(exact::double_double_rotation(body_.orientation())) {
  Vector squares;
  for (std::size_t k = 0; k < 3; ++k) {
    const double axis = body.semi_axes()[static_cast<int>(k)];
    squares[k] = exact::two_product(axis, axis);
  }
  const auto entry = [&](std::size_t i, std::size_t j) {
    DoubleDouble sum;
    for (std::size_t k = 0; k < 3; ++k) sum = sum + rotation[i][k] * rotation[j][k] * squares[k];
    return sum;
  };
  xx = entry(0, 0), yy = entry(1, 1), zz = entry(2, 2);
  yz = entry(1, 2), zx = entry(2, 0), xy = entry(0, 1);
}

Vector DoubleDoubleShape::stretched(const Vector& v) const noexcept {
  Vector y = turned_back(rotation, v);
  for (std::size_t k = 0; k < 3; ++k)
    y[k] = DoubleDouble(body.semi_axes()[static_cast<int>(k)]) * y[k];
  return y;
}

Vector DoubleDoubleShape::spread(const Vector& y) const noexcept {
  Vector z;
  for (std::size_t k = 0; k < 3; ++k)
    z[k] = DoubleDouble(body.semi_axes()[static_cast<int>(k)]) * y[k];
  return {dot(rotation[0], z), dot(rotation[1], z), dot(rotation[2], z)};
}

DoubleDouble DoubleDoubleShape::inverse_form(const Vector& v) const noexcept {
  Vector y = turned_back(rotation, v);
  for (std::size_t k = 0; k < 3; ++k)
    y[k] = y[k] / DoubleDouble(body.semi_axes()[static_cast<int>(k)]);
  return dot(y, y);
}

Direction direction(const Vector& v) noexcept {
  const int exponent =
      std::max({exponent_of(v[0].high), exponent_of(v[1].high), exponent_of(v[2].high)});
  return {scaled(v, -exponent), exponent};
}

std::optional<EqualLevel> find_equal_level(const DoubleDoubleShape& a, const DoubleDoubleShape& b,
                                           const Direction& d) noexcept {
  // Wider than l = h_A / h_B can be, so that l at an end, as along a common axis, is inside.
  double low = 0.5 * a.body.smallest_semi_axis() / b.body.largest_semi_axis();
  double high = 2.0 * a.body.largest_semi_axis() / b.body.smallest_semi_axis();
  DoubleDouble l = first_ratio(a.body, b.body, exact::rounded(d.vector), low, high);
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kSteps; ++step) {
    const ShapeSum sum(a, b, l);
    if (!sum.positive()) return std::nullopt;
    const Levels at = levels(a, b, sum, l, d);
    const double move = newton_step(a, b, sum, l, at), length = std::abs(move);
    if (!std::isfinite(move)) return std::nullopt;
    // Where Newton's steps are short and no longer become shorter they are rounding.
    if (length <= kSettled || (length <= kNear && length >= 0.5 * last)) {
      return equal_level(a, b, l, at, d);
    }
    last = length;
    (move > 0.0 ? low : high) = l.high;
    const double next = l.high * std::exp(move);
    if (length <= kNear) {
      l = l * (DoubleDouble(1.0) + DoubleDouble(move));
    } else if (low < next && next < high) {
      l = next;
    } else {
      l = std::sqrt(low) * std::sqrt(high);
      last = std::numeric_limits<double>::infinity();  // no step of Newton's to compare with
    }
  }
  return std::nullopt;
}

}  // namespace tangency::methods
