// SPDX-License-Identifier: MIT
#include <tangency/geometry/polynomial.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/numbers/projective_quartic.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0 {
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

/// p without its root 0, and the exponents of its terms.
struct Terms {
  std::array<double, 5> a{};
  std::array<int, 5> exponent{};
  std::size_t last = 0;
  std::size_t zeros = 0;  ///< the multiplicity of the root 0

  /// Requires p not 0.
  explicit Terms(const std::array<double, 5>& p) {
    while (is_zero(p[zeros])) ++zeros;
    for (std::size_t k = 0; k + zeros < 5; ++k) {
      a[k] = p[k + zeros], exponent[k] = exponent_of(a[k]);
      if (!is_zero(a[k])) last = k;
    }
  }
};

/// Where the greatest term of p becomes another, by the upper hull of the points (k, exponent of
/// a_k) [Newton's polygon].
Bands bands_of(const Terms& p) {
  Bands bands;
  for (std::size_t i = 0; i < p.last;) {
    double least = kInfinity;
    std::size_t next = p.last;
    for (std::size_t k = i + 1; k <= p.last; ++k) {
      if (is_zero(p.a[k])) continue;
      const double at =
          static_cast<double>(p.exponent[i] - p.exponent[k]) / static_cast<double>(k - i);
      if (at <= least) least = at, next = k;
    }
    const int whole = static_cast<int>(least), at = whole - (least < whole ? 1 : 0);
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
std::array<double, 5> in_band(const Terms& p, int middle) {
  int largest = p.exponent[0];
  for (int k = 1; k < 5; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!is_zero(p.a[i])) largest = std::max(largest, p.exponent[i] + k * middle);
  }
  std::array<double, 5> scaled{};
  for (int k = 0; k < 5; ++k) {
    const auto i = static_cast<std::size_t>(k);
    scaled[i] = scaled_by_power(p.a[i], k * middle - largest);
  }
  return scaled;
}

/// On the line: z = 1/y for a root in the chart y.
QuarticRoot on_the_line(const detail::ProjectiveRoot<double>& root) {
  if (root.c == 1.0) return {root.s, root.error, root.crosses};
  const double z = 1.0 / root.c, y = std::abs(root.c);
  if (root.error >= y) return {z, kInfinity, root.crosses};
  // |1/y - 1/(y -+ e)| <= e / (y (y - e)), and the roundings of that and of z.
  const double spread = root.error / (y - root.error) * std::abs(z);
  return {z, spread * (1 + 8 * kUnitRoundoff) + kUnitRoundoff * std::abs(z), root.crosses};
}

/// x = 2^middle z
QuarticRoot scaled_back(const QuarticRoot& root, int middle) {
  const double x = scaled_by_power(root.x, middle);
  const double error = scaled_by_power(root.error, middle);
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

void add_band(QuarticRoots& roots, const Terms& p, const Band& band, bool even) {
  const int middle = band.middle();
  const auto found = detail::projective_roots(in_band(p, middle));
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

QuarticRoots found_roots(const std::array<double, 5>& a) {
  assert(std::all_of(a.begin(), a.end(), [](double c) { return std::isfinite(c); }));
  QuarticRoots roots{0, {}, false, 0};
  roots.vanishes = std::all_of(a.begin(), a.end(), is_zero);
  if (roots.vanishes) return roots;

  // Of p(x) and p(-x), and their negatives, the search sees one, and of an even p one half: where
  // it stops within rounding of a root depends on the signs.
  Terms p(a);
  const double odd = is_zero(p.a[1]) ? p.a[3] : p.a[1];
  const double sign = (odd < 0) != (p.a[0] < 0) ? -1.0 : 1.0;
  for (const std::size_t k : {1u, 3u}) p.a[k] *= sign;
  const Bands bands = bands_of(p);
  for (std::size_t i = 0; i < bands.count; ++i) add_band(roots, p, bands.band[i], is_zero(odd));
  for (int i = 0; i < roots.count; ++i) roots.root[static_cast<std::size_t>(i)].x *= sign;
  if (p.zeros > 0) add(roots, {0.0, 0.0, p.zeros % 2 == 1});
  std::sort(roots.root.begin(), roots.root.begin() + roots.count,
            [](const QuarticRoot& r, const QuarticRoot& s) { return r.x < s.x; });
  return roots;
}

}  // namespace

QuarticRoots quartic_roots(const std::array<double, 5>& a) noexcept {
  return in_default_environment([&] { return found_roots(a); });
}

}  // namespace tangency::inline v0
