// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far a contact moves before it is followed, for the benchmarks.
#pragma once

#include <cmath>

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::bench {

/// Of the smallest semi-axis, and in rad: more than a simulator's step.
inline constexpr double kFollowedStep = 1e-4;

/// B a moment ago: moved and turned by kFollowedStep in a direction of its own for each i.
inline Ellipsoid moment_ago(const Ellipsoid& b, double smallest_semi_axis, std::size_t i) {
  const double angle = 2.4 * static_cast<double>(i);  // any direction, another one each time
  const Vec3 way(std::cos(angle), std::sin(angle), std::cos(1.7 * angle));
  const Vec3 axis = way.cross(Vec3(0.3, 0.5, 0.8)).normalized();
  return {b.centre() + kFollowedStep * smallest_semi_axis * way.normalized(), b.semi_axes(),
          Eigen::Quaterniond(Eigen::AngleAxisd(kFollowedStep, axis)) * b.orientation()};
}

}  // namespace tangency::bench
