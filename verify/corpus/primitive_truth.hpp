// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What is true of an ellipsoid and a point, a wall or a ray, and of two that move. Words are
/// exact: by rational numbers for the stored doubles, all but those of bodies that turn, which are
/// proven by intervals.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <tangency/verify/corpus/truth.hpp>
#include <tangency/verify/families/families.hpp>

namespace tangency::inline v0::verify {

struct PointTruth {
  Real size;  ///< L = |p - c| + largest semi-axis
  Real gap;   ///< 0 exactly where the point is on the surface
  std::vector<TrueNormals> normals;
};

/// Throws std::logic_error where sign and exact level do not fit each other.
PointTruth point_truth(const BodyAndPoint& question);

struct WallRowTruth {
  ExactRelation relation;
  Real size;  ///< L = distance of the centre from the face + largest semi-axis
  Real gap;
  Real3 normal;
};

WallRowTruth wall_truth(const BodyAndWall& question);

struct RayTruth {
  std::string_view result;
  Real size;             ///< L / |direction|, L = |origin - c| + largest semi-axis
  std::vector<Real> at;  ///< t by increasing order
};

RayTruth ray_truth(const BodyAndRay& question);

struct TimeTruth {
  std::string_view status;
  std::optional<std::array<Real, 2>> contact;  ///< the first one lies between
};

/// Nothing where intervals do not tell. Balls that do not turn are told exactly.
std::optional<TimeTruth> time_truth(const MovingPair& question);

}  // namespace tangency::inline v0::verify
