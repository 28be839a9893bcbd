// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/judge.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tangency::inline v0::verify {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double distance(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Length of the part of v that is orthogonal to the axis.
double across(const Vector& v, const Vector& axis) {
  const double along = dot(v, axis);
  return std::hypot(v[0] - along * axis[0], v[1] - along * axis[1], v[2] - along * axis[2]);
}

// To the nearest of all turns of the maximiser about its axis.
double distance_to_circle(const Vector& n, const Vector& normal, const Vector& axis) {
  return std::hypot(dot(n, axis) - dot(normal, axis), across(n, axis) - across(normal, axis));
}

// Of the nearest of all turns of the maximiser about its axis.
double cosine_to_circle(const Vector& n, const Vector& normal, const Vector& axis) {
  return dot(n, axis) * dot(normal, axis) + across(n, axis) * across(normal, axis);
}

}  // namespace

ErrorSummary summary_of(std::span<const double> errors) {
  ErrorSummary s;
  std::vector<double> all;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (std::isnan(errors[i])) continue;
    all.push_back(errors[i]);
    if (s.worst_row == kNoRow || errors[i] > s.largest) s.worst_row = i, s.largest = errors[i];
  }
  s.count = all.size();
  if (all.empty()) return s;
  const auto ranked = [&](std::size_t percent) {
    const std::size_t rank = (all.size() * percent + 99) / 100;
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(all.begin(), at, all.end());
    return *at;
  };
  s.median = ranked(50);
  s.percentile_99 = ranked(99);
  return s;
}

double excess(double gap, const TwoDoubles& truth) {
  const double first = gap - truth.high;
  // Both are near each other where it matters, and then the first difference is exact.
  return first - truth.low;
}

bool breaks_bound(double excess, double bound, bool is_local, double unproven) {
  return !(excess <= bound + unproven) || (!is_local && !(-excess <= bound));
}

NormalVerdict judge_normal(const TruthTable& truth, const TruthRow& row, const Vector& n) {
  if (row.every_normal) return {std::abs(std::hypot(n[0], n[1], n[2]) - 1), false};
  NormalVerdict best{std::numeric_limits<double>::infinity(), true};
  for (std::size_t i = 0; i < row.normals; ++i) {
    const auto& [normal, axis] = truth.maximisers[row.first_normal + i];
    best.error =
        std::min(best.error, axis ? distance_to_circle(n, normal, *axis) : distance(n, normal));
    if ((axis ? cosine_to_circle(n, normal, *axis) : dot(n, normal)) >= 0) best.reversed = false;
  }
  return best;
}

}  // namespace tangency::inline v0::verify
