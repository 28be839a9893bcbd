// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/normal.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangency::verify {
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

}  // namespace tangency::verify
