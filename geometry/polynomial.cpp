// SPDX-License-Identifier: MIT
#include <tangency/geometry/polynomial.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tangency/geometry/floating_point_environment.hpp>
#include <tangency/geometry/methods/projective_quartic.hpp>

namespace tangency {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// On the line: x = 1/y for a root in the chart y.
QuarticRoot on_the_line(const methods::ProjectiveRoot<double>& root) {
  if (root.c == 1.0) return {root.s, root.error, root.crosses};
  const double x = 1.0 / root.c, y = std::abs(root.c);
  if (root.error >= y) return {x, kInfinity, root.crosses};
  // |1/y - 1/(y -+ e)| <= e / (y (y - e)), and the roundings of that and of x.
  const double spread = root.error / (y - root.error) * std::abs(x);
  return {x, spread * (1 + 8 * kUnitRoundoff) + kUnitRoundoff * std::abs(x), root.crosses};
}

QuarticRoots found_roots(const std::array<double, 5>& a) {
  const methods::ProjectiveRoots<double> found = methods::projective_roots(a);
  QuarticRoots roots{0, {}, found.vanishes};
  for (int i = 0; i < found.count; ++i) {
    const QuarticRoot root = on_the_line(found.root[static_cast<std::size_t>(i)]);
    if (std::isfinite(root.x)) roots.root[static_cast<std::size_t>(roots.count++)] = root;
  }
  std::sort(roots.root.begin(), roots.root.begin() + roots.count,
            [](const QuarticRoot& p, const QuarticRoot& q) { return p.x < q.x; });
  return roots;
}

}  // namespace

QuarticRoots quartic_roots(const std::array<double, 5>& a) noexcept {
  return in_default_environment([&] { return found_roots(a); });
}

}  // namespace tangency
