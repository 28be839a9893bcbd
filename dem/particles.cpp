// SPDX-License-Identifier: MIT
#include <tangency/dem/particles.hpp>

#include <cmath>
#include <numbers>

#include <tangency/dem/elementary.hpp>

namespace tangency::dem {

Vec3 Shape::semi_axes(int dimensions) const {
  if (dimensions == 2) {
    const double root = std::sqrt(elongation);
    return {mean_radius * root, mean_radius / root, mean_radius / root};
  }
  const double b = mean_radius * cube_root(flatness / elongation);
  return {b * elongation, b, b / flatness};
}

double volume_of(const Vec3& semi_axes, int dimensions) {
  if (dimensions == 2) return std::numbers::pi * semi_axes[0] * semi_axes[1];
  return 4.0 / 3.0 * std::numbers::pi * semi_axes.prod();
}

Vec3 principal_inertia(double mass, const Vec3& semi_axes, int dimensions) {
  const Vec3 squares = semi_axes.cwiseAbs2();
  if (dimensions == 2) return mass / 4.0 * Vec3(squares[1], squares[0], squares[0] + squares[1]);
  return mass / 5.0 * (Vec3::Constant(squares.sum()) - squares);
}

void Particles::add(const Vec3& centre, const Quaternion& axes, const Vec3& radii, double density,
                    std::int32_t type_index) {
  position.push_back(centre);
  velocity.push_back(Vec3::Zero());
  angular_velocity.push_back(Vec3::Zero());
  orientation.push_back(axes.normalized());
  semi_axes.push_back(radii);
  mass.push_back(density * volume_of(radii, dimensions));
  type.push_back(type_index);
  id.push_back(static_cast<std::int32_t>(id.size()));
}

}  // namespace tangency::dem
