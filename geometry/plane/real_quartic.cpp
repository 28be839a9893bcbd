// SPDX-License-Identifier: MIT
#include <tangency/geometry/plane/real_quartic.hpp>

#include <algorithm>
#include <cmath>

namespace tangency::detail {
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

QuarticRoots sorted(QuarticRoots roots) noexcept {
  sort_few(roots.root, roots.count,
           [](const QuarticRoot& x, const QuarticRoot& y) { return less(x.at, y.at); });
  return roots;
}

/// `wanted` simple roots, whatever double-double makes of nearly equal ones.
QuarticRoots simple_roots(const Polynomial& p, int wanted) noexcept {
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
  QuarticRoots roots;
  for (int i = 0; i < wanted; ++i)
    roots.root[static_cast<std::size_t>(roots.count++)] = {found[i], 1};
  return sorted(roots);
}

}  // namespace

QuarticRoots real_quartic_roots(const Coefficients& c, Meeting meeting) noexcept {
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

}  // namespace tangency::detail
