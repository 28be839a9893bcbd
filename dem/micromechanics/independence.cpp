// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/independence.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_sides.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

using std::numbers::pi;

}  // namespace

double chi_squared_tail(double chi_squared, std::int64_t degrees) {
  if (degrees < 1)
    throw std::invalid_argument("degrees = " + std::to_string(degrees) + ": must be at least 1");
  if (!(chi_squared > 0.0)) return std::isnan(chi_squared) ? kNotDefined : 1.0;
  constexpr double kBeyond = 1e20;  // derived: above any whole number of degrees
  if (chi_squared > kBeyond) return 0.0;
  // Q(degrees/2, half) as its finite sum: of half^j e^-half/j!, j whole or half a number.
  constexpr double kLarge = 0x1p500;  // chosen: terms grow to the power of half
  const double half = 0.5 * chi_squared;
  const bool odd = degrees % 2 != 0;
  double term = odd ? 2.0 * std::sqrt(half / pi) : 1.0, sum = 0.0, logarithm = -half;
  for (double j = odd ? 0.5 : 0.0; 2.0 * j < static_cast<double>(degrees) - 1.0; j += 1.0) {
    sum += term;
    term *= half / (j + 1.0);
    if (sum < kLarge) continue;
    sum /= kLarge;
    term /= kLarge;
    logarithm += std::log(kLarge);
  }
  const double tail =
      (odd ? std::erfc(std::sqrt(half)) : 0.0) + std::exp(logarithm + std::log(sum));
  return std::min(tail, 1.0);
}

Contingency contingency_of(std::span<const std::int64_t> counts, std::size_t columns) {
  if (columns == 0 || counts.size() % columns != 0)
    throw std::invalid_argument("counts: " + std::to_string(counts.size()) +
                                " entries: must be a multiple of " + std::to_string(columns) +
                                " columns, at least 1");
  const std::size_t rows = counts.size() / columns;
  std::vector<double> of_row(rows, 0.0), of_column(columns, 0.0);
  Contingency found;
  for (std::size_t at = 0; at < counts.size(); ++at) {
    if (counts[at] < 0)
      throw std::invalid_argument("counts[" + std::to_string(at) +
                                  "] = " + std::to_string(counts[at]) + ": must be at least 0");
    of_row[at / columns] += static_cast<double>(counts[at]);
    of_column[at % columns] += static_cast<double>(counts[at]);
    found.count += counts[at];
  }
  const auto filled = [](const std::vector<double>& sums) {
    return std::ranges::count_if(sums, [](double sum) { return sum > 0.0; });
  };
  const auto all = static_cast<double>(found.count);
  const std::int64_t more_rows = filled(of_row) - 1, more_columns = filled(of_column) - 1;
  found.degrees = found.count > 0 ? more_rows * more_columns : 0;
  found.p_value = found.cramers_v = kNotDefined;
  if (found.degrees == 0) return found;
  found.least_expected = all;
  for (std::size_t at = 0; at < counts.size(); ++at) {
    const double expected = of_row[at / columns] * of_column[at % columns] / all;
    if (!(expected > 0.0)) continue;
    const double off = static_cast<double>(counts[at]) - expected;
    found.chi_squared += off * off / expected;
    found.least_expected = std::min(found.least_expected, expected);
  }
  constexpr double kLeastExpected = 5.0;  // chosen: the rule of the trade for chi-squared's tail
  found.count_needed =
      static_cast<std::int64_t>(std::ceil(all * kLeastExpected / found.least_expected));
  if (found.least_expected >= kLeastExpected)
    found.p_value = chi_squared_tail(found.chi_squared, found.degrees);
  found.cramers_v =
      std::sqrt(found.chi_squared / (all * static_cast<double>(std::min(more_rows, more_columns))));
  return found;
}

namespace {

void require_classes(const char* name, int classes) {
  if (classes < 2)
    throw std::invalid_argument(std::string(name) + " = " + std::to_string(classes) +
                                ": must be at least 2");
}

/// A table of values in classes of equal numbers, equal values together, against classes that are
/// given.
Contingency table_of(std::span<const double> values, int local_classes,
                     std::span<const std::size_t> given) {
  std::vector<double> sorted(values.begin(), values.end()), border;
  std::ranges::sort(sorted);
  const auto rows = static_cast<std::size_t>(local_classes);
  for (std::size_t i = 1; i < rows; ++i) border.push_back(sorted[i * sorted.size() / rows]);
  std::map<std::size_t, std::size_t> column;
  for (const std::size_t g : given) column.emplace(g, column.size());
  std::vector<std::int64_t> counts(rows * column.size(), 0);
  for (std::size_t s = 0; s < values.size(); ++s) {
    const auto row =
        static_cast<std::size_t>(std::ranges::upper_bound(border, values[s]) - border.begin());
    ++counts[row * column.size() + column[given[s]]];
  }
  return contingency_of(counts, column.size());
}

}  // namespace

std::optional<Contingency> normal_independence(const ContactArrays& contacts,
                                               const BodyArrays& bodies, Shape shape,
                                               int local_classes,
                                               const SpherePartition& partition) {
  require_sound(contacts, bodies);
  require_dimensions(contacts, 3, "normal_independence");
  require_classes("local_classes", local_classes);
  if (!rotates(shape)) return std::nullopt;
  const std::vector<Side> sides = sides_of(contacts, bodies, shape);
  if (sides.empty()) return std::nullopt;
  std::vector<double> cosine;
  std::vector<std::size_t> axis;
  for (const Turned& side : turned_of(contacts, bodies, sides)) {
    const std::size_t g = partition.class_of(side.axis);
    cosine.push_back(std::abs(side.cosine));
    axis.push_back(std::min(g, partition.opposite(g)));
  }
  return table_of(cosine, local_classes, axis);
}

std::optional<Contingency> plane_normal_independence(const ContactArrays& contacts,
                                                     const BodyArrays& bodies, int local_classes,
                                                     int axis_classes) {
  require_classes("local_classes", local_classes);
  require_classes("axis_classes", axis_classes);
  require_sound(contacts, bodies);
  require_dimensions(contacts, 2, "plane_normal_independence");
  const PlaneSides plane = plane_sides(contacts, bodies);
  if (plane.sides.empty()) return std::nullopt;
  // Angles of lines: from 0 to pi.
  const auto of_line = [](double x, double y) {
    const double angle = std::atan2(y, x);
    return angle < 0.0 ? angle + pi : angle;
  };
  std::vector<double> local;
  std::vector<std::size_t> axis;
  for (const Side& side : plane.sides) {
    const Vec3 &n = contacts.normal[side.contact], &u = plane.of_body[side.body]->axis;
    local.push_back(of_line(n[0] * u[0] + n[1] * u[1], n[1] * u[0] - n[0] * u[1]));
    const double arc = of_line(u[0], u[1]) / pi * axis_classes;
    axis.push_back(
        std::min(static_cast<std::size_t>(arc), static_cast<std::size_t>(axis_classes - 1)));
  }
  return table_of(local, local_classes, axis);
}

}  // namespace tangency::inline v0::micromechanics
