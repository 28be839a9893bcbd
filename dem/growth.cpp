// SPDX-License-Identifier: MIT
#include <tangency/dem/growth.hpp>

#include <algorithm>
#include <cmath>

namespace tangency::inline v0::dem {

namespace {

/// Relative error that decimal fractions bring in, generously. Chosen: 1000 cycles a per cent over
/// e = 0.29 are 29000 increments and not 29001, and a ramp to e = 0.01 is over at 0.01.
constexpr double kRounding = 1e-12;

}  // namespace

Shape Growth::shape_after(const Shape& start, std::int64_t done) const {
  const double share = static_cast<double>(done) / static_cast<double>(increments);
  const auto between = [share](double from, double to) { return std::lerp(from, to, share); };
  const double flat = between(start.flatness, flatness.value_or(start.flatness));
  if (!by_eccentricity || done == 0 || done == increments)
    return {start.mean_radius, between(start.elongation, elongation), flat};
  const double e = between(eccentricity_of(start.elongation), eccentricity_of(elongation));
  return {start.mean_radius, elongation_of(e), flat};
}

double Growth::stress_after(const Shape& start, std::int64_t done, double full) const {
  if (!ramp) return full;
  const double first = eccentricity_of(start.elongation);
  const double now = eccentricity_of(shape_after(start, done).elongation);
  const double share = (now - first) / (ramp->eccentricity - first);
  return share < 1.0 - kRounding ? std::lerp(ramp->start, full, share) : full;
}

double Growth::largest_change(const Shape& start, int dimensions) const {
  // Equal steps of a ratio are relatively largest where the ratio is smallest, those of e where it
  // is largest: at an end.
  double largest = 0.0;
  for (const std::int64_t done : {std::int64_t{0}, increments - 1}) {
    const Vec3 before = shape_after(start, done).semi_axes(dimensions);
    const Vec3 after = shape_after(start, done + 1).semi_axes(dimensions);
    largest = std::max(largest, (after - before).cwiseQuotient(before).cwiseAbs().maxCoeff());
  }
  return largest;
}

std::int64_t increments_at(std::int64_t cycles_per_percent, double change_of_eccentricity) {
  const double cycles = 100.0 * static_cast<double>(cycles_per_percent) * change_of_eccentricity;
  return std::max<std::int64_t>(1,
                                static_cast<std::int64_t>(std::ceil(cycles * (1.0 - kRounding))));
}

}  // namespace tangency::inline v0::dem
