// SPDX-License-Identifier: MIT
#include <tangency/dem/plane_wall.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tangency::inline v0::dem {
namespace {

/// Share of the missing force that a step makes up for. Chosen: that of a stage that comes to rest.
constexpr double kGain = 0.2;

using Polygon = std::vector<Vec3>;

/// The part of a convex polygon where side * x[axis] <= most [SutherlandHodgman1974].
Polygon clipped(const Polygon& polygon, int axis, double side, double most) {
  Polygon part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double out = side * from[axis] - most, next = side * to[axis] - most;
    if (out <= 0.0) part.push_back(from);
    if ((out <= 0.0) != (next <= 0.0)) part.push_back(from + out / (out - next) * (to - from));
  }
  return part;
}

}  // namespace

void PlaneWall::follow(double force, double stiffness, double area, double dt) {
  const double missing = held->stress * area - force;
  const double wanted = stiffness > 0.0 ? kGain * missing / (stiffness * dt)
                                        : std::copysign(held->max_speed, missing);
  const double along = std::clamp(wanted, -held->max_speed, held->max_speed);
  velocity += (along - normal.dot(velocity)) * normal;
}

double section_area(const PlaneWall& wall, const Vec3& edges) {
  // A square of the face about the middle of the box that goes beyond it on all sides.
  const Vec3 middle = 0.5 * edges, centre = middle - wall.height_of(middle) * wall.normal;
  const Vec3 first = wall.normal.unitOrthogonal(), second = wall.normal.cross(first);
  const double reach = edges.norm();
  Polygon face;
  for (const auto& [x, y] : {std::pair(1.0, 1.0), {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}})
    face.push_back(centre + reach * (x * first + y * second));
  for (int axis = 0; axis < 3; ++axis)
    face = clipped(clipped(face, axis, 1.0, edges[axis]), axis, -1.0, 0.0);
  Vec3 twice = Vec3::Zero();
  for (std::size_t k = 2; k < face.size(); ++k)
    twice += (face[k - 1] - face[0]).cross(face[k] - face[0]);
  return 0.5 * twice.norm();
}

}  // namespace tangency::inline v0::dem
