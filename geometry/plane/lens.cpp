// SPDX-License-Identifier: MIT
#include <tangency/geometry/plane/lens.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tangency::inline v0::detail {
namespace {

using exact::Meeting;
using Coefficients = std::array<DoubleDouble, 5>;

constexpr int kMostSteps = 220;  // halvings alone take 110
constexpr double kResolution = 0x1p-104;

struct Polynomial {
  Coefficients c;
  int degree;

  DoubleDouble operator()(const DoubleDouble& x) const noexcept {
    DoubleDouble sum = c[static_cast<std::size_t>(degree)];
    for (int k = degree - 1; k >= 0; --k) sum = sum * x + c[static_cast<std::size_t>(k)];
    return sum;
  }
  Polynomial derivative() const noexcept {
    Polynomial result{{}, degree - 1};
    for (int k = 1; k <= degree; ++k) {
      result.c[static_cast<std::size_t>(k - 1)] = DoubleDouble(k) * c[static_cast<std::size_t>(k)];
    }
    return result;
  }
  /// Above the magnitude of every root [Cauchy's bound].
  double bound() const noexcept {
    const double lead = std::abs(c[static_cast<std::size_t>(degree)].high);
    double most = 0.0;
    for (int k = 0; k < degree; ++k) {
      most = std::max(most, std::abs(c[static_cast<std::size_t>(k)].high) / lead);
    }
    return 1.5 + most;
  }
};

struct Roots {
  int count = 0;
  std::array<DoubleDouble, 4> at;

  void add(const DoubleDouble& x) noexcept { at[static_cast<std::size_t>(count++)] = x; }
  const DoubleDouble& operator[](int i) const noexcept { return at[static_cast<std::size_t>(i)]; }
};

bool less(const DoubleDouble& a, const DoubleDouble& b) noexcept { return (a - b).high < 0.0; }

/// The root between two points where p, monotone between them, has different signs.
DoubleDouble root_between(const Polynomial& p, const Polynomial& slope, DoubleDouble low,
                          DoubleDouble high) noexcept {
  const bool rising = p(high).high > 0.0;
  DoubleDouble x = DoubleDouble(0.5) * (low + high);
  for (int step = 0; step < kMostSteps; ++step) {
    const DoubleDouble value = p(x);
    if (value.high == 0.0) return x;
    ((value.high > 0.0) == rising ? high : low) = x;
    const double width = (high - low).high, scale = std::abs(x.high);
    if (width <= kResolution * scale) break;
    const DoubleDouble s = slope(x);
    const DoubleDouble next = x - value / s;
    const bool inside = s.high != 0.0 && less(low, next) && less(next, high);
    // Newton's steps come from one side: every fourth step halves what is left.
    const DoubleDouble to = inside && step % 4 != 3 ? next : DoubleDouble(0.5) * (low + high);
    if (std::abs((to - x).high) <= kResolution * scale) return to;
    x = to;
  }
  return x;
}

/// Ascending roots at which p changes its sign, by those of the derivative.
Roots sign_changes(const Polynomial& p) noexcept {
  Roots roots;
  if (p.degree == 1) {
    roots.add(-p.c[0] / p.c[1]);
    return roots;
  }
  const Polynomial slope = p.derivative();
  const Roots turns = sign_changes(slope);
  DoubleDouble low(-p.bound());
  for (int i = 0; i <= turns.count; ++i) {
    const DoubleDouble high = i < turns.count ? turns[i] : DoubleDouble(p.bound());
    const double at_low = p(low).high, at_high = p(high).high;
    if ((at_low < 0.0) != (at_high < 0.0)) roots.add(root_between(p, slope, low, high));
    low = high;
  }
  return roots;
}

double magnitude(const Polynomial& p, const DoubleDouble& x) noexcept {
  return std::abs(p(x).high);
}

/// The candidates in the order of how little p is there.
Roots by_magnitude(const Polynomial& p, Roots candidates) noexcept {
  sort_few(candidates.at, candidates.count, [&](const DoubleDouble& x, const DoubleDouble& y) {
    return magnitude(p, x) < magnitude(p, y);
  });
  return candidates;
}

MultipleRoots sorted(MultipleRoots roots) noexcept {
  sort_few(roots.root, roots.count,
           [](const MultipleRoot& x, const MultipleRoot& y) { return less(x.at, y.at); });
  return roots;
}

/// `wanted` simple roots, whatever double-double makes of nearly equal ones.
MultipleRoots simple_roots(const Polynomial& p, int wanted) noexcept {
  Roots found = sign_changes(p);
  while (found.count > wanted) {
    int closest = 0;
    for (int i = 1; i + 1 < found.count; ++i) {
      if ((found[i + 1] - found[i]).high < (found[closest + 1] - found[closest]).high) closest = i;
    }
    std::copy(found.at.begin() + closest + 2, found.at.begin() + found.count,
              found.at.begin() + closest);
    found.count -= 2;
  }
  const Roots turns = by_magnitude(p, sign_changes(p.derivative()));
  for (int i = 0; found.count < wanted; ++i) {
    const DoubleDouble x = turns[std::min(i, turns.count - 1)];
    found.add(x);
    if (found.count < wanted) found.add(x);
  }
  MultipleRoots roots;
  for (int i = 0; i < wanted; ++i)
    roots.root[static_cast<std::size_t>(roots.count++)] = {found[i], 1};
  return sorted(roots);
}

}  // namespace

MultipleRoots real_quartic_roots(const Coefficients& c, Meeting meeting) noexcept {
  const Polynomial p{c, 4};
  const Polynomial slope = p.derivative();
  // Minus the sum of the roots, and the sum of their products by twos.
  const DoubleDouble sum = -(c[3] / c[4]), products = c[2] / c[4];
  switch (meeting) {
    case Meeting::equal:
    case Meeting::nowhere:
      return {};
    case Meeting::two_simple:
      return simple_roots(p, 2);
    case Meeting::four_simple:
      return simple_roots(p, 4);
    case Meeting::one_double:
      return {1, {{{by_magnitude(p, sign_changes(slope))[0], 2}}}};
    case Meeting::two_double: {
      const Roots turns = by_magnitude(p, sign_changes(slope));
      return sorted({2, {{{turns[0], 2}, {turns[std::min(1, turns.count - 1)], 2}}}});
    }
    case Meeting::double_and_two_simple: {
      const DoubleDouble t = by_magnitude(p, sign_changes(slope))[0];
      const DoubleDouble half = DoubleDouble(0.5) * sum - t;
      const DoubleDouble product = products - t * t - DoubleDouble(4.0) * t * half;
      const DoubleDouble offset = sqrt(half * half - product);
      return sorted({3, {{{t, 2}, {half - offset, 1}, {half + offset, 1}}}});
    }
    case Meeting::triple_and_simple: {
      const Roots bends = by_magnitude(p, sign_changes(slope.derivative()));
      // Where double-double sees no inflection the two roots are as good as one.
      const DoubleDouble t = bends.count > 0 ? bends[0] : DoubleDouble(0.25) * sum;
      return sorted({2, {{{t, 3}, {sum - DoubleDouble(3.0) * t, 1}}}});
    }
    case Meeting::quadruple:
      break;
  }
  return {1, {{{DoubleDouble(0.25) * sum, 4}}}};
}

namespace {

LensBody lens_body(const Ellipse& e) noexcept {
  return {double_double_direction(e.direction()), e.semi_axes()[0], e.semi_axes()[1]};
}

/// A key that orders the two bodies of a pair, whichever comes first.
auto key(const Ellipse& e, const Vec2& d) {
  const Vec2 &a = e.semi_axes(), &u = e.direction();
  return std::make_tuple(a[0] * a[1], a[0], a[1], u[0], u[1], d[0], d[1]);
}

DoubleDouble level(const DoubleDouble2& y) noexcept { return dot(y, y) - DoubleDouble(1.0); }

/// y with the square of its first component, and so on: coefficients of a square, and of a product.
using Quadratic = std::array<DoubleDouble, 3>;

void add_square(std::array<DoubleDouble, 5>& sum, const Quadratic& q, double weight) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      sum[i + j] = sum[i + j] + DoubleDouble(weight) * (q[i] * q[j]);
    }
  }
}

}  // namespace

DoubleDouble2 LensBody::to_plane(const DoubleDouble2& y) const noexcept {
  return turned(axis, {DoubleDouble(a1) * y.x, DoubleDouble(a2) * y.y});
}

DoubleDouble2 LensBody::from_plane(const DoubleDouble2& x) const noexcept {
  const DoubleDouble2 local = turned_back(axis, x);
  return {local.x / DoubleDouble(a1), local.y / DoubleDouble(a2)};
}

PlaneLens::PlaneLens(const Ellipse& a, const Ellipse& b, const Vec2& d, const Vec2& d_low,
                     exact::Meeting meeting) noexcept
    : first_is_a_(key(a, d) <= key(b, -d)) {
  const DoubleDouble2 between = exactly(d) + exactly(d_low);
  d_ = first_is_a_ ? between : -between;
  body_ = {lens_body(first_is_a_ ? a : b), lens_body(first_is_a_ ? b : a)};
  column_ = {body_[1].from_plane(body_[0].to_plane({1.0, 0.0})),
             body_[1].from_plane(body_[0].to_plane({0.0, 1.0}))};
  shift_ = body_[1].from_plane(d_);
  find_vertices(meeting);
}

DoubleDouble2 PlaneLens::second_frame(const DoubleDouble2& z) const noexcept {
  return (z.x * column_[0] + z.y * column_[1]) - shift_;
}

// With z(w) = (1 - w^2, 2w) / (1 + w^2), seen from the direction `zero`, the level of the second
// body times (1 + w^2)^2 is a quartic in w. Its leading coefficient is the level opposite to
// `zero`, where w is infinite: that is put where the level is largest.
void PlaneLens::find_vertices(exact::Meeting meeting) noexcept {
  if (meeting == exact::Meeting::equal || meeting == exact::Meeting::nowhere) return;
  constexpr int kDirections = 16;
  constexpr double kCosine = 0x1.d906bcf328d46p-1, kSine = 0x1.87de2a6aea963p-2;  // of pi/8
  DoubleDouble2 z{1.0, 0.0}, zero = z;
  double most = -1.0;
  for (int k = 0; k < kDirections; ++k, z = turned({kCosine, kSine}, z)) {
    const double value = std::abs(level(second_frame(z)).high);
    if (value > most) most = value, zero = -z;
  }
  zero = normalised(zero);
  const DoubleDouble2 along = zero.x * column_[0] + zero.y * column_[1];
  const DoubleDouble2 across = zero.x * column_[1] - zero.y * column_[0];
  const DoubleDouble two(2.0), one(1.0);
  std::array<DoubleDouble, 5> quartic{};
  add_square(quartic, {along.x - shift_.x, two * across.x, -(along.x + shift_.x)}, 1.0);
  add_square(quartic, {along.y - shift_.y, two * across.y, -(along.y + shift_.y)}, 1.0);
  add_square(quartic, {one, DoubleDouble(), one}, -1.0);

  const MultipleRoots roots = real_quartic_roots(quartic, meeting);
  for (int i = 0; i < roots.count; ++i) {
    const MultipleRoot& root = roots.root[static_cast<std::size_t>(i)];
    const DoubleDouble square = root.at * root.at, norm = one + square;
    const DoubleDouble2 seen{(one - square) / norm, two * root.at / norm};
    const DoubleDouble2 unit = turned(zero, seen);
    vertex_[static_cast<std::size_t>(count_++)] = {
        {unit, normalised(second_frame(unit))}, body_[0].to_plane(unit), root.multiplicity};
  }
}

DoubleDouble2 arc_middle(const DoubleDouble2& from, const DoubleDouble2& to, bool whole) noexcept {
  const double ahead = cross(from, to).high;
  if (length(to - from).high == 0.0) return whole ? -from : from;
  const DoubleDouble2 sum = from + to;
  if (length(sum).high < 0x1p-20) return normalised(quarter(from - to));
  return normalised(ahead < 0.0 ? -sum : sum);
}

double arc_span(const DoubleDouble2& from, const DoubleDouble2& to, bool whole) noexcept {
  constexpr double kTurn = 0x1.921fb54442d18p+2;
  const double chord = length(to - from).high, sum = length(to + from).high;
  if (chord == 0.0) return whole ? kTurn : 0.0;
  const double span = 2.0 * std::atan2(chord, sum);
  return cross(from, to).high < 0.0 ? kTurn - span : span;
}

double PlaneLens::level_between(int i) const noexcept {
  return level(second_frame(arc_middle((*this)[i].unit[0], next(i).unit[0], is_last(i)))).high;
}

}  // namespace tangency::inline v0::detail
