// SPDX-License-Identifier: MIT
/// @file
/// Particles as bodies of geometry, centred at the origin.
#pragma once

#include <cstddef>

#include <tangency/dem/particles.hpp>
#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

inline Ellipsoid ellipsoid_of(const Particles& particles, std::size_t i) {
  return Ellipsoid(Vec3::Zero(), particles.semi_axes[i], particles.orientation[i]);
}

/// Of a plane assembly.
inline Ellipse ellipse_of(const Particles& particles, std::size_t i) {
  const Quaternion& q = particles.orientation[i];  // (cos, 0, 0, sin) of half the angle
  const Vec2 direction(q.w() * q.w() - q.z() * q.z(), 2.0 * q.w() * q.z());
  return Ellipse(Vec2::Zero(), particles.semi_axes[i].head<2>(), direction);
}

}  // namespace tangency::inline v0::dem
