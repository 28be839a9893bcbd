// SPDX-License-Identifier: MIT
#include <tangency/dem/particles.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <tangency/dem/lanes/elementary.hpp>

namespace tangency::inline v0::dem {

Vec3 Shape::semi_axes(int dimensions) const {
  if (dimensions == 2) {
    const double root = std::sqrt(elongation);
    return {mean_radius * root, mean_radius / root, mean_radius / root};
  }
  const double b = mean_radius * cube_root(flatness / elongation);
  return {b * elongation, b, b / flatness};
}

double mean_radius_of(const Vec3& semi_axes, int dimensions) {
  return dimensions == 2 ? std::sqrt(semi_axes[0] * semi_axes[1]) : cube_root(semi_axes.prod());
}

bool are_round(const Particles& particles) {
  return std::all_of(particles.semi_axes.begin(), particles.semi_axes.end(), [&](const Vec3& axes) {
    return axes[0] == axes[1] && (particles.dimensions == 2 || axes[0] == axes[2]);
  });
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

void Particles::permute(std::span<const std::uint32_t> order) {
  std::vector<bool> seen(size());
  for (const std::uint32_t i : order) {
    if (i >= size() || seen[i]) throw std::invalid_argument("order: no permutation");
    seen[i] = true;
  }
  if (order.size() != size()) throw std::invalid_argument("order: not of all particles");
  const auto move = [&](auto& column) {
    auto moved = column;
    for (std::size_t k = 0; k < order.size(); ++k) moved[k] = column[order[k]];
    column = std::move(moved);
  };
  move(position);
  move(velocity);
  move(angular_velocity);
  move(orientation);
  move(semi_axes);
  move(mass);
  move(type);
  move(id);
}

std::vector<std::uint32_t> Particles::index_of_id() const {
  std::vector<std::uint32_t> index(size());
  for (std::size_t i = 0; i < size(); ++i)
    index[static_cast<std::size_t>(id[i])] = static_cast<std::uint32_t>(i);
  return index;
}

}  // namespace tangency::inline v0::dem
