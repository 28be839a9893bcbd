// SPDX-License-Identifier: MIT
/// @file
/// Plane walls of their own, at any angle, beside the faces of a cell: fixed, moving at a given
/// velocity, or pushed so that they bear a stress. They do not strain with the cell, and stages of
/// scenes that have them strain nothing.
///
/// A wall has no mass: its velocity is what is given or what its servo says, from one step to the
/// next. Bodies are on the side that its normal points to.
#pragma once

#include <optional>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// The half-space normal . x <= offset, solid.
struct PlaneWall {
  /// A stress to bear, normal to the wall.
  struct Held {
    double stress;     ///< force over section_area(), > 0
    double max_speed;  ///< along the normal, > 0, length/time
  };

  Vec3 normal = Vec3::UnitZ();    ///< unit, out of the wall
  double offset = 0.0;            ///< of its face along the normal, length
  Vec3 velocity = Vec3::Zero();   ///< of its material; what is along the normal moves the face
  std::optional<Held> held = {};  ///< then the velocity along the normal follows the stress

  /// How far x is in front of it; < 0 behind.
  double height_of(const Vec3& x) const { return normal.dot(x) - offset; }
  /// Sets the velocity along the normal of a wall that is held, by a proportional servo: it would
  /// take a share of what the force lacks away in a step if bodies stayed where they are. Without
  /// contacts the wall comes at its largest speed.
  ///
  /// The force is that on the wall along -normal, the stiffness the sum over its contacts of their
  /// normal stiffness, the area section_area(), dt the step's.
  void follow(double force, double stiffness, double area, double dt);
};

/// The area of a wall's face within a box from the origin with these edges; length^2. In the plane,
/// where the third edge is 1, a length.
double section_area(const PlaneWall& wall, const Vec3& edges);

}  // namespace tangency::inline v0::dem
