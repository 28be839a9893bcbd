// SPDX-License-Identifier: MIT
/// @file
/// How the axes of particles are turned where they start.
///
/// A body is turned by one of its axes, the directed axis. Directions are axes, without a sign: u
/// and -u are one. Frame: that of the cell; in the plane z is left out.
#pragma once

#include <cstdint>
#include <random>

#include <tangency/dem/particles.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// Uniform on [0, 1), from the 53 high bits: unlike std::uniform_real_distribution the same
/// everywhere.
double uniform(std::mt19937_64& random);

/// A rotation drawn uniformly [Shoemake1992]; in the plane one about z.
Quaternion uniform_rotation(std::mt19937_64& random, int dimensions = 3);

/// The body axis by which a body of such a shape is turned: 0, its longest; of an oblate spheroid
/// 2, its axis of symmetry and its shortest. Of a sphere, which has no such axis yet: 0.
int directed_axis(const Shape& shape);

/// How directed axes are drawn; the spin about them is uniform.
struct StartAxes {
  /// How orientations are drawn.
  enum class Rule {
    random,   ///< whole rotations, uniformly
    aligned,  ///< along the direction
    cone,     ///< uniform in the cone about the direction, in the plane in the wedge
    across,   ///< uniform in the plane across the direction, in the plane the line across it
  };
  Rule rule = Rule::random;        ///< how they are drawn
  Vec3 direction = Vec3::UnitZ();  ///< not 0, of any length; in the plane without a part along z
  double half_angle = 0.0;         ///< of the cone, between it and the direction, in (0, pi/2], rad

  /// (1) The mean square of the directed axis' component along the direction is 1 where it is
  ///     aligned, 0 across, and (1 + c + c^2) / 3 in a cone, c the cosine of its half angle; in
  ///     the plane (1 + sin(2 h) / (2 h)) / 2 in a wedge, h its half angle.
  /// (2) In space no direction across the given one is preferred, and the other two body axes have
  ///     equal mean squares along any direction.
  /// (3) Rule random draws what uniform_rotation() draws, bit for bit.
  /// @param random  the generator, which moves on
  /// @param dimensions  2 or 3
  /// @param axis  the directed one, 0 or 2; in the plane 0
  Quaternion draw(std::mt19937_64& random, int axis, int dimensions) const;
};

}  // namespace tangency::inline v0::dem
