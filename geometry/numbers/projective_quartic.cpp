// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/projective_quartic.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>

namespace tangency::inline v0::detail {
namespace {

/// A polynomial of the given degree on [-1, 1], lowest coefficient first.
template <class Real, std::size_t degree>
using Coefficients = std::array<Real, degree + 1>;

/// Of a rounded value over u sum |a_k x^k|: Horner's rule makes 2 degree <= 8 roundings, the
/// coefficients of a derivative one more each, the sum itself is 8 u too small at most; the rest to
/// be round.
constexpr int kRoundings = 12;

template <class Real, std::size_t degree>
Real value(const Coefficients<Real, degree>& a, Real x) {
  Real sum = a[degree];
  for (std::size_t k = degree; k-- > 0;) sum = sum * x + a[k];
  return sum;
}

/// More than |value(a, x) - p(x)| for |x| <= 1 and coefficients around 1 or below.
template <class Real, std::size_t degree>
Real rounding(const Coefficients<Real, degree>& a, Real x) {
  Real sum = std::abs(a[degree]);
  for (std::size_t k = degree; k-- > 0;) sum = sum * std::abs(x) + std::abs(a[k]);
  constexpr Real u = std::numeric_limits<Real>::epsilon() / 2;
  return kRoundings * u * sum + std::numeric_limits<Real>::min();
}

/// -1 or 1 where that is certain, else 0.
template <class Real, std::size_t degree>
int sign_at(const Coefficients<Real, degree>& a, Real x) {
  const Real v = value<Real, degree>(a, x);
  if (std::abs(v) <= rounding<Real, degree>(a, x)) return 0;
  return v < 0 ? -1 : 1;
}

template <class Real, std::size_t degree>
Coefficients<Real, degree - 1> derivative(const Coefficients<Real, degree>& a) {
  Coefficients<Real, degree - 1> result;
  for (std::size_t k = 1; k <= degree; ++k) result[k - 1] = static_cast<Real>(k) * a[k];
  return result;
}

/// A point between low and high, where the sign is `sign` and -sign, at which the value is 0 as far
/// as can be told, or next to which no number is left: Newton's method, halving where it is slow.
template <class Real, std::size_t degree>
Real root_between(const Coefficients<Real, degree>& a, Real low, Real high, int sign) {
  const auto slope = derivative<Real, degree>(a);
  Real x = low + (high - low) / 2, previous = high - low;
  while (low < x && x < high) {
    const int here = sign_at<Real, degree>(a, x);
    if (here == 0) return x;
    (here == sign ? low : high) = x;
    const Real step = value<Real, degree>(a, x) / value<Real, degree - 1>(slope, x);
    const Real newton = x - step;
    // A step that is no number fails every comparison.
    const bool good = low < newton && newton < high && std::abs(step) < previous / 2;
    previous = good ? std::abs(step) : (high - low) / 2;
    x = good ? newton : low + (high - low) / 2;
  }
  return x;
}

/// Up to 7 numbers, ascending.
template <class Real>
struct Points {
  std::array<Real, 7> x;
  std::size_t count = 0;
  void add(Real value) { x[count++] = value; }
};

/// Where p changes sign or touches 0 inside (-1, 1): at most 1, 3 and 7 points for degree 1, 2, 3.
template <class Real, std::size_t degree>
Points<Real> roots_inside(const Coefficients<Real, degree>& a) {
  Points<Real> inner;
  if constexpr (degree > 1) inner = roots_inside<Real, degree - 1>(derivative<Real, degree>(a));
  Points<Real> roots;
  Real left = -1;
  int sign_left = sign_at<Real, degree>(a, left);
  for (std::size_t i = 0; i <= inner.count; ++i) {
    const bool last = i == inner.count;
    const Real right = last ? Real(1) : inner.x[i];
    const int sign_right = sign_at<Real, degree>(a, right);
    if (sign_left * sign_right < 0) {
      roots.add(root_between<Real, degree>(a, left, right, sign_left));
    }
    if (sign_right == 0 && !last) roots.add(right);
    left = right;
    sign_left = sign_right;
  }
  return roots;
}

/// A point of the line in one of the charts, and the certain sign there.
template <class Real>
struct Node {
  int chart;  ///< 0: w, ascending; 1: y = 1/w, descending
  Real x;
  int sign;
};

/// Once round the line, from w = -1 over 1, infinity and back to -1: at most 16 nodes, between
/// neighbours of which p is monotone in the chart of the first one.
template <class Real>
struct Circle {
  std::array<QuarticCoefficients<Real>, 2> chart;
  std::array<Node<Real>, 16> node;
  std::size_t count = 0;

  explicit Circle(const QuarticCoefficients<Real>& a) : chart{a, a} {
    std::reverse(chart[1].begin(), chart[1].end());
    for (const int c : {0, 1}) {
      const auto& p = chart[static_cast<std::size_t>(c)];
      Points<Real> inner = roots_inside<Real, 3>(derivative<Real, 4>(p));
      if (c == 1) std::reverse(inner.x.begin(), inner.x.begin() + inner.count);
      add(c, c == 0 ? Real(-1) : Real(1));
      for (std::size_t i = 0; i < inner.count; ++i) add(c, inner.x[i]);
    }
  }
  void add(int c, Real x) {
    node[count++] = {c, x, sign_at<Real, 4>(chart[static_cast<std::size_t>(c)], x)};
  }
  const Node<Real>& at(std::size_t i) const { return node[i % count]; }
  /// The coordinate of node i in a chart that holds it: the ends +-1 are in both.
  Real coordinate(std::size_t i, [[maybe_unused]] int c) const {
    assert(at(i).chart == c || std::abs(at(i).x) == 1);
    return at(i).x;
  }
};

template <class Real>
constexpr Real kShort = Real(0x1p-16);  // chosen: errors of triple roots in double, u^(1/3)

/// How far from x, towards `end`, the sign is certainly `sign`; no further than `end`, where it is.
template <class Real>
Real reach(const QuarticCoefficients<Real>& a, Real x, Real end, int sign) {
  const Real whole = std::abs(end - x), slope = std::abs(value<Real, 3>(derivative<Real, 4>(a), x));
  constexpr Real u = std::numeric_limits<Real>::epsilon() / 2;
  Real width = 2 * u * std::abs(x) + std::numeric_limits<Real>::min();
  // A guess that would pass over most of the way is that of a slope which is rounding itself.
  const Real guess = 2 * rounding<Real, 4>(a, x) / slope;
  if (guess < kShort<Real> * whole) width = std::max(width, guess);
  for (; width < whole; width *= 2) {
    const Real point = end > x ? x + width : x - width;
    if (sign_at<Real, 4>(a, point) == sign) return std::abs(point - x) * (1 + 2 * u);
  }
  return whole * (1 + 2 * u);
}

template <class Real>
void add_root(ProjectiveRoots<Real>& roots, int chart, Real x, Real error, bool crosses) {
  roots.root[static_cast<std::size_t>(roots.count++)] =
      chart == 0 ? ProjectiveRoot<Real>{x, 1, error, crosses}
                 : ProjectiveRoot<Real>{1, x, error, crosses};
}

/// The root at the run of nodes first..last where the sign is not known, between nodes where it is.
template <class Real>
void add_run(ProjectiveRoots<Real>& roots, const Circle<Real>& circle, std::size_t first,
             std::size_t last) {
  const Node<Real>& middle = circle.at(first + (last - first) / 2);
  const Node<Real>&before = circle.at(first + circle.count - 1), &after = circle.at(last + 1);
  const auto& a = circle.chart[static_cast<std::size_t>(middle.chart)];
  // A neighbour in the other chart lies beyond an end of this one: no further than twice that end.
  const auto towards = [&](const Node<Real>& node, bool ahead) {
    if (node.chart == middle.chart) return reach(a, middle.x, node.x, node.sign);
    const Real end = (middle.chart == 0) == ahead ? Real(1) : Real(-1);
    const Real limit = end * node.x > Real(0.5) ? 1 / node.x : 2 * end;
    const Real width = reach(a, middle.x, limit, node.sign);
    const int sign = sign_at<Real, 4>(a, middle.x < limit ? middle.x + width : middle.x - width);
    return sign == node.sign ? width : std::numeric_limits<Real>::infinity();
  };
  add_root(roots, middle.chart, middle.x, std::max(towards(before, false), towards(after, true)),
           before.sign != after.sign);
}

template <class Real>
void add_between(ProjectiveRoots<Real>& roots, const Circle<Real>& circle, std::size_t i) {
  const Node<Real>&here = circle.at(i), &next = circle.at(i + 1);
  const auto& a = circle.chart[static_cast<std::size_t>(here.chart)];
  const Real start = here.x, end = circle.coordinate(i + 1, here.chart);
  const bool ascending = start < end;
  const Real x = root_between<Real, 4>(a, ascending ? start : end, ascending ? end : start,
                                       ascending ? here.sign : next.sign);
  add_root(roots, here.chart, x,
           std::max(reach(a, x, start, here.sign), reach(a, x, end, next.sign)), true);
}

/// Times a power of two that brings the largest coefficient, if it is not 0, into [1/2, 1).
template <class Real>
QuarticCoefficients<Real> scaled(QuarticCoefficients<Real> a, Real largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (Real& c : a) c = std::scalbn(c, -exponent);
  return a;
}

}  // namespace

template <class Real>
ProjectiveRoots<Real> projective_roots(const QuarticCoefficients<Real>& a) noexcept {
  ProjectiveRoots<Real> roots{0, {}, true};
  Real largest = 0;
  for (const Real c : a) largest = std::max(largest, std::abs(c));
  assert(std::isfinite(largest));
  const Circle<Real> circle(scaled(a, largest));
  const auto known = [&](std::size_t i) { return circle.at(i).sign != 0; };
  std::size_t start = 0;
  while (start < circle.count && !known(start)) ++start;
  if (start == circle.count) return roots;

  roots.vanishes = false;
  for (std::size_t i = start; i < start + circle.count;) {
    if (known(i + 1)) {
      if (circle.at(i).sign != circle.at(i + 1).sign) add_between(roots, circle, i);
      ++i;
      continue;
    }
    std::size_t last = i + 1;
    while (!known(last + 1)) ++last;
    add_run(roots, circle, i + 1, last);
    i = last + 1;
  }
  std::sort(roots.root.begin(), roots.root.begin() + roots.count,
            [](const auto& x, const auto& y) { return x.angle() < y.angle(); });
  return roots;
}

template ProjectiveRoots<float> projective_roots(const QuarticCoefficients<float>&) noexcept;
template ProjectiveRoots<double> projective_roots(const QuarticCoefficients<double>&) noexcept;
template ProjectiveRoots<long double> projective_roots(
    const QuarticCoefficients<long double>&) noexcept;

}  // namespace tangency::inline v0::detail
