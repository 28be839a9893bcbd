// SPDX-License-Identifier: MIT
#include <tangency/dem/growth.hpp>

#include <algorithm>
#include <cmath>

namespace tangency::dem {

Shape Growth::shape_after(const Shape& start, std::int64_t done) const {
  const double share = static_cast<double>(done) / static_cast<double>(increments);
  const auto between = [share](double from, double to) { return std::lerp(from, to, share); };
  return {start.mean_radius, between(start.elongation, elongation),
          between(start.flatness, flatness.value_or(start.flatness))};
}

double Growth::largest_change(const Shape& start, int dimensions) const {
  // Equal steps of a ratio are relatively largest where the ratio is smallest: at an end.
  double largest = 0.0;
  for (const std::int64_t done : {std::int64_t{0}, increments - 1}) {
    const Vec3 before = shape_after(start, done).semi_axes(dimensions);
    const Vec3 after = shape_after(start, done + 1).semi_axes(dimensions);
    largest = std::max(largest, (after - before).cwiseQuotient(before).cwiseAbs().maxCoeff());
  }
  return largest;
}

}  // namespace tangency::dem
