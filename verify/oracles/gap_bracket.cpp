// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/gap_bracket.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

using ascent::dot;
using Long3 = std::array<long double, 3>;

constexpr long double kInfinity = std::numeric_limits<long double>::infinity();

// ---- numbers with an error bound

// The true value is within `error` of `value`. Each operation adds its own rounding, at most kUnit
// of the result and kLeast below the normal range; kUp covers the roundings of the bound itself,
// which are fewer than eight.
class Ball {
 public:
  Ball() = default;
  Ball(long double value, long double error = 0) : value_(value), error_(error) {}

  long double value() const { return value_; }
  long double low() const { return value_ - width(); }
  long double high() const { return value_ + width(); }

  friend Ball operator+(const Ball& a, const Ball& b) {
    return rounded(a.value_ + b.value_, a.error_ + b.error_);
  }
  friend Ball operator-(const Ball& a, const Ball& b) {
    return rounded(a.value_ - b.value_, a.error_ + b.error_);
  }
  friend Ball operator*(const Ball& a, const Ball& b) {
    return rounded(a.value_ * b.value_, std::abs(a.value_) * b.error_ +
                                            a.error_ * std::abs(b.value_) + a.error_ * b.error_);
  }
  // Of b > 0; unknown where b may be 0.
  friend Ball operator/(const Ball& a, const Ball& b) {
    const long double least = b.low(), quotient = a.value_ / b.value_;
    if (!(least > 0)) return {0, kInfinity};
    return rounded(quotient, (a.error_ + (std::abs(quotient) + kLeast) * b.error_) / least);
  }
  // Of a >= 0; unknown where a may be 0.
  friend Ball sqrt(const Ball& a) {
    if (!(a.low() > 0)) return {0, kInfinity};
    const long double root = std::sqrt(a.value_);
    return rounded(root, a.error_ / root);
  }

 private:
  static constexpr long double kUnit = std::numeric_limits<long double>::epsilon() / 2;
  static constexpr long double kUp = 1 + 32 * kUnit;
  static constexpr long double kLeast = 8 * std::numeric_limits<long double>::denorm_min();

  // Of both ends: the bound, and the roundings of the ends.
  long double width() const { return error_ + 4 * kUnit * (std::abs(value_) + error_) + kLeast; }
  static Ball rounded(long double value, long double error) {
    return {value, (error + kUnit * std::abs(value)) * kUp + kLeast};
  }

  long double value_ = 0, error_ = 0;
};

using Ball3 = std::array<Ball, 3>;

Ball3 cross(const Ball3& a, const Ball3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Ball inner(const Ball3& a, const Ball3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// ---- bodies

// |q|^2 R(q) by columns, in any arithmetic that the entries of q are given in.
template <class T>
std::array<std::array<T, 3>, 3> turned_axes(const T& w, const T& x, const T& y, const T& z) {
  const T ww = w * w, xx = x * x, yy = y * y, zz = z * z, two = 2.0L;
  return {{{ww + xx - yy - zz, two * (x * y + w * z), two * (x * z - w * y)},
           {two * (x * y - w * z), ww - xx + yy - zz, two * (y * z + w * x)},
           {two * (x * z + w * y), two * (y * z - w * x), ww - xx - yy + zz}}};
}

// A power of two, so that the largest entry of q is about 1: exact.
int exponent_of(const RawEllipsoid& body) {
  double most = 0;
  for (const double v : body.orientation) most = std::max(most, std::abs(v));
  const bool finite = std::ranges::all_of(body.centre, [](double v) { return std::isfinite(v); });
  const bool is_body =
      std::ranges::all_of(body.semi_axes, [](double v) { return v > 0 && std::isfinite(v); });
  if (!finite || !is_body || !(most > 0) || !std::isfinite(most)) {
    throw std::invalid_argument("oracle: not an ellipsoid");
  }
  return std::ilogb(most);
}

template <class T>
std::array<T, 4> orientation_of(const RawEllipsoid& body) {
  const int exponent = exponent_of(body);
  std::array<T, 4> q;
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = std::ldexp(static_cast<long double>(body.orientation[i]), -exponent);
  }
  return q;
}

Shape<long double> guessed_shape(const RawEllipsoid& body) {
  const auto q = orientation_of<long double>(body);
  Shape<long double> shape{{body.semi_axes[0], body.semi_axes[1], body.semi_axes[2]},
                           turned_axes(q[0], q[1], q[2], q[3])};
  const long double per = 1 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (Long3& axis : shape.axes) axis = ascent::scaled(per, axis);
  return shape;
}

// A body with an error bound beside each number.
class ProvenBody {
 public:
  explicit ProvenBody(const RawEllipsoid& body) {
    const auto q = orientation_of<Ball>(body);
    axes_ = turned_axes(q[0], q[1], q[2], q[3]);
    norm_ = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    for (std::size_t k = 0; k < 3; ++k) lengths_[k] = Ball(body.semi_axes[k]);
    const auto [least, most] = std::ranges::minmax(body.semi_axes);
    radius_ = Ball(least) * Ball(least) / Ball(most);
  }

  const Ball& least_radius() const { return radius_; }

  // h(n) for n of any length.
  Ball support(const Ball3& n) const { return reach(n, nullptr); }
  // The same, and subtracts x(n) from `w`.
  Ball support_from(const Ball3& n, Ball3& w) const { return reach(n, &w); }

  // Is x, relative to the centre, inside?
  bool holds(const Ball3& x) const {
    Ball sum;
    for (std::size_t k = 0; k < 3; ++k) {
      const Ball along = inner(axes_[k], x) / (norm_ * lengths_[k]);
      sum = sum + along * along;
    }
    return sum.high() < 1;
  }

 private:
  Ball reach(const Ball3& n, Ball3* w) const {
    Ball sum;
    Ball3 along;
    for (std::size_t k = 0; k < 3; ++k) {
      along[k] = lengths_[k] * inner(axes_[k], n) / norm_;
      sum = sum + along[k] * along[k];
    }
    const Ball h = sqrt(sum);
    if (w == nullptr) return h;
    for (std::size_t k = 0; k < 3; ++k) {
      const Ball share = along[k] * lengths_[k] / (h * norm_);
      for (std::size_t i = 0; i < 3; ++i) (*w)[i] = (*w)[i] - share * axes_[k][i];
    }
    return h;
  }

  std::array<Ball3, 3> axes_;  // times norm_
  Ball norm_;
  Ball3 lengths_;
  Ball radius_;
};

// ---- guesses, in double and in units of the pair's size

using Vector = std::array<double, 3>;
using Rows = std::array<Vector, 3>;

Rows squared(const Shape<long double>& body, long double size) {
  Rows m{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto a = static_cast<double>(body.semi_axes[k] / size);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        m[i][j] += a * a * static_cast<double>(body.axes[k][i] * body.axes[k][j]);
      }
    }
  }
  return m;
}

Vector times(const Rows& m, const Vector& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

Rows sum(const Rows& a, double l, const Rows& b) {
  Rows m = a;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] += l * b[i][j];
  }
  return m;
}

// adj(m) v and det m.
Vector adjugate_times(const Rows& m, const Vector& v, double& determinant) {
  const Rows adjugate{ascent::cross(m[1], m[2]), ascent::cross(m[2], m[0]),
                      ascent::cross(m[0], m[1])};
  determinant = dot(m[0], adjugate[0]);
  return times(adjugate, v);
}

// v = (M_A + l M_B)^-1 d up to a factor, at the l where the Perram-Wertheim function is greatest:
// there both terms below are equal; their ratio falls as l grows. And the point between both
// bodies, relative to A's centre.
struct Meeting {
  Vector normal, point;
};

Meeting guessed_meeting(const Rows& ma, const Rows& mb, const Vector& d) {
  double low = -60, high = 60;  // chosen: of log2 l, for ratios of lengths to 1e9
  Meeting meeting{d, {}};
  for (int step = 0; step < 24; ++step) {
    const double middle = (low + high) / 2, l = std::exp2(middle);
    double determinant = 0;
    const Vector v = adjugate_times(sum(ma, l, mb), d, determinant);
    const Vector of_a = times(ma, v);
    const double reach_a = dot(v, of_a), reach_b = l * l * dot(v, times(mb, v));
    if (!(determinant > 0) || !std::isfinite(reach_a + reach_b)) break;
    meeting = {v, ascent::scaled(1 / determinant, of_a)};
    (reach_a > reach_b ? low : high) = middle;
  }
  return meeting;
}

// ---- the proof

class Proof {
 public:
  Proof(const RawEllipsoid& a, const RawEllipsoid& b) : a_(a), b_(b) {
    guess_ = {{}, guessed_shape(a), guessed_shape(b)};
    for (std::size_t i = 0; i < 3; ++i) {
      d_[i] = Ball(b.centre[i]) - Ball(a.centre[i]);
      guess_.d[i] = d_[i].value();
    }
    size_ = ascent::extent(guess_);
  }

  GapBracket bracket() {
    const Vector unit_d{static_cast<double>(guess_.d[0] / size_),
                        static_cast<double>(guess_.d[1] / size_),
                        static_cast<double>(guess_.d[2] / size_)};
    const bool concentric = dot(unit_d, unit_d) == 0;
    const Meeting meeting =
        concentric ? Meeting{{1, 0, 0}, {}}
                   : guessed_meeting(squared(guess_.a, size_), squared(guess_.b, size_), unit_d);
    Long3 n{};
    std::ranges::copy(meeting.normal, n.begin());
    if (!(dot(n, n) > 0) || !std::isfinite(dot(n, n))) n = {1, 0, 0};
    // Chosen: some roundings of long doubles; as many steps as nearly all pairs take, and few where
    // (2) will hardly apply.
    const bool shallow = ascent::value(guess_, ascent::normalised(n)).f +
                             a_.least_radius().value() + b_.least_radius().value() >
                         0;
    n = ascent::ascend(guess_, n, 0x1p-62L * size_, shallow ? 40 : 6).at.n;
    GapBracket result = bounds_at(n);
    if (result.lower > 0) {
      result.relation = Relation::separate;
    } else if ((result.upper < 0 || share(meeting.point)) && protrudes(a_, b_, guess_.a, n, -1) &&
               protrudes(b_, a_, guess_.b, n, 1)) {
      result.relation = Relation::overlap;
    }
    return result;
  }

 private:
  // (1) to (3)
  GapBracket bounds_at(const Long3& n) const {
    const Ball3 along{Ball(n[0]), Ball(n[1]), Ball(n[2])};
    Ball3 w = d_;
    const Ball h_a = a_.support_from(along, w), h_b = b_.support_from(along, w);
    const Ball length = sqrt(inner(along, along));
    const Ball f = (inner(along, d_) - h_a - h_b) / length;
    // |n x w| is |n| times the part of w across n, however n is rounded.
    const Ball3 across = cross(along, w);
    const long double slope = (sqrt(Ball(inner(across, across).high())) / length).high();
    const long double raised = (f + a_.least_radius() + b_.least_radius()).low();
    GapBracket result{-kInfinity,
                      kInfinity,
                      {},
                      std::numeric_limits<double>::infinity(),
                      static_cast<double>(size_),
                      std::nullopt};
    for (std::size_t i = 0; i < 3; ++i) result.normal[i] = static_cast<double>(n[i]);
    if (f.low() > -kInfinity) result.lower = f.low();  // not so where it is unknown
    if (!(raised > 0 && slope < kInfinity)) return result;
    const Ball excess = Ball(slope) * Ball(slope) / (Ball(2) * Ball(raised));
    if (const long double end = (f + Ball(excess.high())).high(); end < kInfinity) {
      result.upper = end;
      result.normal_error = static_cast<double>(2 * slope / raised);
    }
    return result;
  }

  // Is the point, relative to A's centre in units of the size, inside both?
  bool share(const Vector& point) const {
    Ball3 of_a, of_b;
    for (std::size_t i = 0; i < 3; ++i) {
      of_a[i] = Ball(point[i] * size_);
      of_b[i] = of_a[i] - d_[i];
    }
    return a_.holds(of_a) && b_.holds(of_b);
  }

  // (5): does `body` reach beyond `other`? `sign` is that of the side where it lies along n.
  bool protrudes(const ProvenBody& body, const ProvenBody& other, const Shape<long double>& shape,
                 const Long3& n, long double sign) const {
    const auto reaches = [&](const Long3& m) {
      const Ball3 way{Ball(m[0]), Ball(m[1]), Ball(m[2])};
      const Ball shift = inner(way, d_);
      const Ball beyond = body.support(way) - other.support(way);
      return (sign > 0 ? beyond + shift : beyond - shift).low() > 0;
    };
    if (reaches(ascent::scaled(sign, n))) return true;
    for (const Long3& axis : shape.axes) {
      if (reaches(axis) || reaches(ascent::scaled(-1.0L, axis))) return true;
    }
    return false;
  }

  ProvenBody a_, b_;
  Ball3 d_;
  Separation<long double> guess_;
  long double size_ = 0;
};

}  // namespace

GapBracket gap_bracket(const RawEllipsoid& a, const RawEllipsoid& b) {
  return Proof(a, b).bracket();
}

}  // namespace tangency::inline v0::verify
