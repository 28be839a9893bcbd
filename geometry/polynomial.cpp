// SPDX-License-Identifier: MIT
#include <tangency/geometry/polynomial.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <tangency/geometry/methods/projective_quartic.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// docs/derivations/quartic-roots.md, section 2: powers of two.
constexpr int kApart = 66;   // bands of roots further apart than this are looked at one by one
constexpr int kMargin = 32;  // beyond a band's ends there are none of its roots

/// Roots of like magnitude: those x with 2^low <= |x| < 2^(high + 1), but for a factor of 5, at
/// which terms of p have equal exponents.
struct Band {
  int low, high;
  int middle() const { return low + (high - low) / 2; }
  bool holds(int exponent) const { return low - kMargin <= exponent && exponent <= high + kMargin; }
};

struct Bands {
  std::size_t count = 0;
  std::array<Band, 4> band;
};

/// Where the greatest term of p becomes another, by the upper hull of the points (k, exponent of
/// a_k) [Newton's polygon]. Requires a[0] not 0.
Bands bands_of(const std::array<double, 5>& a) {
  std::size_t last = 4;
  while (is_zero(a[last])) --last;
  Bands bands;
  for (std::size_t i = 0; i < last;) {
    double least = kInfinity;
    std::size_t next = last;
    for (std::size_t k = i + 1; k <= last; ++k) {
      if (is_zero(a[k])) continue;
      const double at =
          static_cast<double>(exponent_of(a[i]) - exponent_of(a[k])) / static_cast<double>(k - i);
      if (at <= least) least = at, next = k;
    }
    const int at = static_cast<int>(std::floor(least));
    if (bands.count > 0 && at - bands.band[bands.count - 1].high <= kApart) {
      bands.band[bands.count - 1].high = at;
    } else {
      bands.band[bands.count++] = {at, at};
    }
    i = next;
  }
  return bands;
}

/// p(2^middle z), times a power of two that brings its largest coefficient into [1, 2).
std::array<double, 5> in_band(const std::array<double, 5>& a, int middle) {
  std::array<int, 5> power{};
  int largest = std::numeric_limits<int>::min();
  for (std::size_t k = 0; k < 5; ++k) {
    power[k] = static_cast<int>(k) * middle;
    if (!is_zero(a[k])) largest = std::max(largest, exponent_of(a[k]) + power[k]);
  }
  std::array<double, 5> scaled{};
  for (std::size_t k = 0; k < 5; ++k) scaled[k] = scaled_by_power(a[k], power[k] - largest);
  return scaled;
}

/// On the line: z = 1/y for a root in the chart y.
QuarticRoot on_the_line(const methods::ProjectiveRoot<double>& root) {
  if (root.c == 1.0) return {root.s, root.error, root.crosses};
  const double z = 1.0 / root.c, y = std::abs(root.c);
  if (root.error >= y) return {z, kInfinity, root.crosses};
  // |1/y - 1/(y -+ e)| <= e / (y (y - e)), and the roundings of that and of z.
  const double spread = root.error / (y - root.error) * std::abs(z);
  return {z, spread * (1 + 8 * kUnitRoundoff) + kUnitRoundoff * std::abs(z), root.crosses};
}

/// x = 2^middle z
QuarticRoot scaled_back(const QuarticRoot& root, int middle) {
  const double x = std::scalbn(root.x, middle);
  const double error = std::scalbn(root.error, middle);
  if (std::abs(x) >= std::numeric_limits<double>::min() &&
      error >= std::numeric_limits<double>::min()) {
    return {x, error, root.crosses};
  }
  // Both were rounded, to multiples of the least double.
  return {x, error + 2 * std::numeric_limits<double>::denorm_min(), root.crosses};
}

void add(QuarticRoots& roots, const QuarticRoot& root) {
  if (!std::isfinite(root.x)) {
    ++roots.beyond;
    return;
  }
  // A band of one root has one, any other at most 8: docs/derivations/quartic-roots.md, section 3.
  assert(static_cast<std::size_t>(roots.count) < roots.root.size());
  roots.root[static_cast<std::size_t>(roots.count++)] = root;
}

void add_band(QuarticRoots& roots, const std::array<double, 5>& a, const Band& band, bool even) {
  const int middle = band.middle();
  const auto found = methods::projective_roots(in_band(a, middle));
  for (int i = 0; i < found.count; ++i) {
    const QuarticRoot root = on_the_line(found.root[static_cast<std::size_t>(i)]);
    if (!std::isfinite(root.x) || !band.holds(exponent_of(root.x) + middle)) continue;
    if (even && root.x < 0) continue;
    QuarticRoot there = scaled_back(root, middle);
    add(roots, there);
    if (!even) continue;
    there.x = -there.x;
    add(roots, there);
  }
}

/// p / x^power, and that power.
struct WithoutZero {
  std::array<double, 5> a{};
  std::size_t power = 0;

  /// Requires p not 0.
  explicit WithoutZero(const std::array<double, 5>& p) {
    while (is_zero(p[power])) ++power;
    std::copy(p.begin() + static_cast<std::ptrdiff_t>(power), p.end(), a.begin());
  }
};

}  // namespace

QuarticRoots quartic_roots(const std::array<double, 5>& a) noexcept {
  assert(std::all_of(a.begin(), a.end(), [](double c) { return std::isfinite(c); }));
  QuarticRoots roots{0, {}, false, 0};
  roots.vanishes = std::all_of(a.begin(), a.end(), is_zero);
  if (roots.vanishes) return roots;
  WithoutZero rest(a);

  // Of p(x) and p(-x), and their negatives, the search sees one, and of an even p one half: where
  // it stops within rounding of a root depends on the signs.
  const double odd = is_zero(rest.a[1]) ? rest.a[3] : rest.a[1];
  const double sign = (odd < 0) != (rest.a[0] < 0) ? -1.0 : 1.0;
  for (const std::size_t k : {1u, 3u}) rest.a[k] *= sign;
  const Bands bands = bands_of(rest.a);
  for (std::size_t i = 0; i < bands.count; ++i) {
    add_band(roots, rest.a, bands.band[i], is_zero(odd));
  }
  for (int i = 0; i < roots.count; ++i) roots.root[static_cast<std::size_t>(i)].x *= sign;
  if (rest.power > 0) add(roots, {0.0, 0.0, rest.power % 2 == 1});
  std::sort(roots.root.begin(), roots.root.begin() + roots.count,
            [](const QuarticRoot& p, const QuarticRoot& q) { return p.x < q.x; });
  return roots;
}

}  // namespace tangency
