// SPDX-License-Identifier: MIT
#include <tangency/geometry/normals/precise_perram_wertheim.hpp>

#include <algorithm>
#include <cmath>

#include <tangency/geometry/normals/perram_wertheim.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr int kFirstSteps = 40;  // chosen: Newton's method in double takes 2 to 10
// Chosen: halving the logarithm of the widest bracket, 2^4200, down to where Newton's method
// converges takes 16, and down to double-double's rounding 66.
constexpr int kSteps = 100;
constexpr double kNear = 0x1p-40;            // of a step in log l: the next one is below 2^-75
constexpr double kSmallestSlope = 0x1p-100;  // chosen: leads out of the bracket, so to its middle

// docs/derivations/other-gaps.md. In units of the arithmetic's epsilon:
constexpr double kResidual = 0x1p9;  // of (S + E) v = d and of A'v, B'v: |E| over |S|
constexpr double kSlope = 0x1p12;    // of p over kappa v'Sv

/// M_A + l M_B as L D L', L unit lower triangular.
template <class T>
class ShapeSum {
 public:
  ShapeSum(const PreciseShape<T>& a, const PreciseShape<T>& b, const T& l) {
    const T xy = a.xy + l * b.xy, zx = a.zx + l * b.zx;
    d0_ = a.xx + l * b.xx;
    l10_ = xy / d0_, l20_ = zx / d0_;
    d1_ = (a.yy + l * b.yy) - l10_ * xy;
    const T rest = (a.yz + l * b.yz) - l20_ * xy;
    l21_ = rest / d1_;
    d2_ = (a.zz + l * b.zz) - l20_ * zx - l21_ * rest;
  }
  bool positive() const {
    const Rough<T> zero = 0.0;
    const auto above = [&](const T& d) { return zero < Arithmetic<T>::rough(d); };
    return above(d0_) && above(d1_) && above(d2_);
  }
  Vector3<T> solve(const Vector3<T>& v) const {
    const T y1 = v[1] - l10_ * v[0], y2 = v[2] - l20_ * v[0] - l21_ * y1;
    const T z = y2 / d2_, y = y1 / d1_ - l21_ * z;
    return {v[0] / d0_ - l10_ * y - l20_ * z, y, z};
  }

 private:
  T d0_, d1_, d2_, l10_, l20_, l21_;
};

/// Both levels at one l, for v in a unit of its own, and how they change with it.
template <class T>
struct Levels {
  Direction<T> v;
  Vector3<T> y_a, y_b;     ///< A' v and l B' v
  Rough<T> l, in_a, in_b;  ///< l; their squares, the levels
  Rough<T> apart;          ///< log of the ratio of the levels
  /// v' M_A S^-1 l M_B v, a form of the parallel sum of M_A and l M_B.
  Rough<T> parallel;

  /// v' S v
  Rough<T> energy() const { return in_a + in_b / l; }
  /// Minus the derivative of `apart` by log l: within [0, 2].
  Rough<T> slope(const Rough<T>& p) const {
    return Rough<T>(2.0) * p * (Rough<T>(1.0) / in_a + l / in_b);
  }
};

/// log(a/b), to first order where that is small.
double log_ratio(const DoubleDouble& a, const DoubleDouble& b) {
  const double x = ((a - b) / b).high;
  return x < -0.5 ? std::log((a / b).high) : std::log1p(x);
}
WideFloat log_ratio(const WideFloat& a, const WideFloat& b) {
  // Of exponents: below, the square of x does not matter to a step of Newton's method; beyond, only
  // the bracket is halved.
  constexpr long kTiny = -60, kSmall = -1, kFar = 100;
  const WideFloat x = (a - b) / b;
  if (x.is_zero() || x.exponent() < kTiny) return x;
  if (x.exponent() < kSmall) return std::log1p(static_cast<double>(x));
  const WideFloat quotient = a / b;
  const double e = static_cast<double>(quotient.exponent());
  return std::abs(e) > kFar ? e : std::log(static_cast<double>(quotient));
}

template <class T>
Levels<T> levels(const PreciseShape<T>& a, const PreciseShape<T>& b, const ShapeSum<T>& sum,
                 const T& l, const Direction<T>& d) {
  const auto rough = [](const T& v) { return Arithmetic<T>::rough(v); };
  Levels<T> at;
  at.v = direction<T>(sum.solve(d.vector));
  at.y_a = a.stretched(at.v.vector);
  at.y_b = l * b.stretched(at.v.vector);
  const T in_a = dot(at.y_a, at.y_a), in_b = dot(at.y_b, at.y_b);
  at.l = rough(l), at.in_a = rough(in_a), at.in_b = rough(in_b);
  at.apart = log_ratio(in_a, in_b);
  at.parallel = rough(dot(at.y_a, a.stretched(sum.solve(b.spread(at.y_b)))));
  return at;
}

double clamped(double v, double low, double high) { return std::clamp(v, low, high); }
WideFloat clamped(const WideFloat& v, double low, double high) {
  return v < WideFloat(low) ? WideFloat(low) : WideFloat(high) < v ? WideFloat(high) : v;
}

/// Newton's step of log l towards equal levels.
template <class T>
Rough<T> newton_step(const Levels<T>& at) {
  return at.apart / clamped(at.slope(at.parallel), kSmallestSlope, 2.0);
}

/// l by the polynomials in double; 0 where they may not be used.
double first_ratio(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) {
  if (!a.moderate() || !b.moderate()) return 0.0;
  const PerramWertheimForm form(a, b, d);
  PerramWertheimSearch search;
  double l = form.first_guess();
  for (int step = 0; step < kFirstSteps; ++step) {
    const double next = search.next(form.at(l));
    const bool settled = std::abs(next - l) <= 0x1p-26 * l;
    l = next;
    if (settled) break;
  }
  return l;
}

/// v at an l that is settled, with the bounds of the derivation; nothing where they do not hold.
template <class T>
std::optional<PerramWertheimPoint<T>> settled_point(const PreciseShape<T>& a,
                                                    const PreciseShape<T>& b, const T& l,
                                                    const Levels<T>& at, const Direction<T>& d) {
  using std::abs, std::sqrt;
  using R = Rough<T>;
  const auto size = [&](double axis_a, double axis_b) {
    return R(axis_a) * R(axis_a) + at.l * (R(axis_b) * R(axis_b));
  };
  const R largest = size(a.body.largest_semi_axis(), b.body.largest_semi_axis());
  const R least = size(a.body.smallest_semi_axis(), b.body.smallest_semi_axis());
  const R epsilon = Arithmetic<T>::kEpsilon, kappa = largest / least, energy = at.energy();
  const R length = Arithmetic<T>::rough(detail::length(at.v.vector));
  const R root = sqrt(energy);
  const R share_a = root / sqrt(at.in_a), share_b = root * sqrt(at.l) / sqrt(at.in_b);

  const R solving = R(kResidual) * epsilon * largest * length / (sqrt(least) * root);
  const R parallel = at.parallel - R(kSlope) * epsilon * kappa * energy;
  const R in_levels = R(2.0) * solving * (share_a + share_b), slack = kSlack;
  if (!(R(kResidual) * epsilon * kappa < R(kSmallError)) || !(in_levels < R(kSmallError)) ||
      !(R(0.0) < parallel)) {
    return std::nullopt;
  }
  const R of_l = slack * (abs(at.apart) + slack * in_levels) / at.slope(parallel);
  if (!(of_l < R(kSmallError))) return std::nullopt;
  const R relative = slack * (solving + of_l), off = relative * root;
  return PerramWertheimPoint<T>{l,
                                at.v.vector,
                                at.y_a,
                                at.y_b,
                                at.v.exponent + d.exponent,
                                off / (sqrt(least) * length),
                                off,
                                off * sqrt(at.l),
                                relative * share_a,
                                relative * share_b};
}

template <class T>
bool below(const T& x, const T& y) {
  return Arithmetic<T>::rough(x) < Arithmetic<T>::rough(y);
}

}  // namespace

template <class T>
PreciseShape<T>::PreciseShape(const Ellipsoid& body_) noexcept
    : body(body_), rotation(Arithmetic<T>::rotation(body_.orientation())) {
  Vector3<T> squares;
  for (std::size_t k = 0; k < 3; ++k) {
    const double axis = body.semi_axes()[static_cast<int>(k)];
    squares[k] = Arithmetic<T>::product(axis, axis);
  }
  const auto entry = [&](std::size_t i, std::size_t j) {
    T sum = rotation[i][0] * rotation[j][0] * squares[0];
    for (std::size_t k = 1; k < 3; ++k) sum = sum + rotation[i][k] * rotation[j][k] * squares[k];
    return sum;
  };
  xx = entry(0, 0), yy = entry(1, 1), zz = entry(2, 2);
  yz = entry(1, 2), zx = entry(2, 0), xy = entry(0, 1);
}

template <class T>
Vector3<T> PreciseShape<T>::stretched(const Vector3<T>& v) const noexcept {
  Vector3<T> y = turned_back(rotation, v);
  for (std::size_t k = 0; k < 3; ++k) y[k] = T(body.semi_axes()[static_cast<int>(k)]) * y[k];
  return y;
}

template <class T>
Vector3<T> PreciseShape<T>::spread(const Vector3<T>& y) const noexcept {
  Vector3<T> z;
  for (std::size_t k = 0; k < 3; ++k) z[k] = T(body.semi_axes()[static_cast<int>(k)]) * y[k];
  return turned(rotation, z);
}

template <class T>
Vector3<T> PreciseShape<T>::in_ball(const Vector3<T>& v) const noexcept {
  Vector3<T> y = turned_back(rotation, v);
  for (std::size_t k = 0; k < 3; ++k) y[k] = y[k] / T(body.semi_axes()[static_cast<int>(k)]);
  return y;
}

template <class T>
Direction<T> direction(const Vector3<T>& v) noexcept {
  const auto exponent = [](const T& x) { return Arithmetic<T>::exponent(x); };
  const int largest = std::max({exponent(v[0]), exponent(v[1]), exponent(v[2])});
  return {scaled_by_power(v, -largest), largest};
}

template <class T>
std::optional<PerramWertheimPoint<T>> find_perram_wertheim_point(const PreciseShape<T>& a,
                                                                 const PreciseShape<T>& b,
                                                                 const Direction<T>& d,
                                                                 double& ratio) noexcept {
  // Wider than l = h_A / h_B can be, so that l at an end, as along a common axis, is inside.
  T low = T(0.5) * (T(a.body.smallest_semi_axis()) / T(b.body.largest_semi_axis()));
  T high = T(2.0) * (T(a.body.largest_semi_axis()) / T(b.body.smallest_semi_axis()));
  if (ratio == 0.0) ratio = first_ratio(a.body, b.body, rounded(d.vector));
  const bool known = std::isfinite(ratio) && below(low, T(ratio)) && below(T(ratio), high);
  T l = known ? T(ratio) : sqrt(low) * sqrt(high);
  const Rough<T> near = kNear, settled = Arithmetic<T>::kSettled;
  bool newton = false;  // is there a step of Newton's method to compare with?
  Rough<T> last = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    using std::abs;
    const ShapeSum<T> sum(a, b, l);
    if (!sum.positive()) return std::nullopt;
    const Levels<T> at = levels(a, b, sum, l, d);
    const Rough<T> move = newton_step(at), length = abs(move);
    if (!std::isfinite(static_cast<double>(move))) return std::nullopt;
    ratio = static_cast<double>(at.l);
    // Where Newton's steps are short and no longer become shorter they are rounding.
    const bool shorter = !newton || length < Rough<T>(0.5) * last;
    if (length < settled || (length < near && !shorter)) return settled_point(a, b, l, at, d);
    last = length, newton = true;
    (static_cast<double>(move) > 0.0 ? low : high) = l;
    if (length < near) {
      l = l * (T(1.0) + T(move));
      continue;
    }
    const T next = l * T(std::exp(std::clamp(static_cast<double>(move), -700.0, 700.0)));
    newton = below(low, next) && below(next, high);
    l = newton ? next : sqrt(low) * sqrt(high);
  }
  return std::nullopt;
}

template struct PreciseShape<DoubleDouble>;
template struct PreciseShape<WideFloat>;
template Direction<DoubleDouble> direction(const Vector3<DoubleDouble>& v) noexcept;
template Direction<WideFloat> direction(const Vector3<WideFloat>& v) noexcept;
template std::optional<PerramWertheimPoint<DoubleDouble>> find_perram_wertheim_point(
    const PreciseShape<DoubleDouble>& a, const PreciseShape<DoubleDouble>& b,
    const Direction<DoubleDouble>& d, double& ratio) noexcept;
template std::optional<PerramWertheimPoint<WideFloat>> find_perram_wertheim_point(
    const PreciseShape<WideFloat>& a, const PreciseShape<WideFloat>& b,
    const Direction<WideFloat>& d, double& ratio) noexcept;

}  // namespace tangency::inline v0::detail
