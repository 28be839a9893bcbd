// SPDX-License-Identifier: MIT
/// @file
/// Semi-axes in the order that particles have them.
#pragma once

#include <algorithm>
#include <array>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// Turns the body axes so that the semi-axes descend; where they do so already both stay, to the
/// bit.
/// @param axes         semi-axes, length
/// @param orientation  body to space
inline void make_descend(Vec3& axes, Quaternion& orientation) {
  std::array<Eigen::Index, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return axes[a] > axes[b]; });
  if (order == std::array<Eigen::Index, 3>{0, 1, 2}) return;
  Mat3 turn;  // to the old body axes; the third of either sign is an axis of the body
  turn.col(0) = Vec3::Unit(order[0]);
  turn.col(1) = Vec3::Unit(order[1]);
  turn.col(2) = Vec3(turn.col(0)).cross(Vec3(turn.col(1)));
  axes = Vec3(axes[order[0]], axes[order[1]], axes[order[2]]);
  orientation = orientation * Quaternion(turn);
}

}  // namespace tangency::inline v0::dem
