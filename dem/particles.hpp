// SPDX-License-Identifier: MIT
/// @file
/// The particles of an assembly: solid ellipsoids of uniform density.
///
/// In a plane assembly (dimensions = 2) they are elliptic disks of unit thickness: centres have
/// z = 0, orientations turn about z alone, the first two semi-axes are those of the ellipse and the
/// third, which is the second again, is only drawn.
///
/// Units are any consistent set; the scenes and files say SI. Frame: that of
/// geometry/ellipsoid.hpp. A particle's velocity is the *fluctuation*: what it moves in addition to
/// the homogeneous strain of the cell. Velocities belong to the half step before the positions
/// (leapfrog).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// The shape of a particle by the thesis' three parameters [Ouadfel1998, eq. 3.37-3.39].
struct Shape {
  double mean_radius;  ///< geometric mean of the semi-axes, > 0, length
  double elongation;   ///< a / b >= 1
  double flatness;     ///< b / c >= 1; 1 in the plane

  /// Semi-axes a >= b >= c with a b c = mean_radius^3; in the plane a >= b = c with
  /// a b = mean_radius^2.
  Vec3 semi_axes(int dimensions = 3) const;
};

/// Arrays of one length, one entry a particle, in an order that keeps neighbours near each other in
/// memory; `id` is a particle's place in the order of the scene, in which results are reported.
/// Positions are not wrapped into the cell: an image is chosen where two particles meet.
struct Particles {
  int dimensions = 3;                   ///< 2 or 3, the cell's
  std::vector<Vec3> position;           ///< centre, length
  std::vector<Vec3> velocity;           ///< relative to the affine motion, length/time
  std::vector<Vec3> angular_velocity;   ///< in space coordinates, 1/time
  std::vector<Quaternion> orientation;  ///< unit; body to space
  std::vector<Vec3> semi_axes;          ///< length
  std::vector<double> mass;             ///< one a particle
  std::vector<std::int32_t> type;       ///< index into the scene's particle types
  std::vector<std::int32_t> id;         ///< each of 0 to size() - 1 once

  /// The number of particles.
  std::size_t size() const { return position.size(); }
  /// Appends a particle at rest; its id is its index.
  void add(const Vec3& centre, const Quaternion& axes, const Vec3& radii, double density,
           std::int32_t type_index);

  /// Puts the particle that is order[k] now in place k, with its id.
  /// @throws std::invalid_argument  where `order` does not name each particle once
  void permute(std::span<const std::uint32_t> order);
  /// Where the particle with each id is.
  std::vector<std::uint32_t> index_of_id() const;
};

/// The geometric mean of the semi-axes, of which the plane has two.
double mean_radius_of(const Vec3& semi_axes, int dimensions = 3);

/// Are all particles spheres, or disks?
bool are_round(const Particles& particles);

/// Volume of an ellipsoid, 4/3 pi a b c; of an elliptic disk of unit thickness, pi a b.
double volume_of(const Vec3& semi_axes, int dimensions = 3);

/// Moments of inertia about the body axes, (m/5)(b^2 + c^2, c^2 + a^2, a^2 + b^2) [Ouadfel1998,
/// eq. 3.19]; of a disk (m/4)(b^2, a^2, a^2 + b^2), of which only the last is ever used.
Vec3 principal_inertia(double mass, const Vec3& semi_axes, int dimensions = 3);

/// Resultants of the contact forces on each particle, about its centre, in space coordinates.
struct Resultants {
  std::vector<Vec3> force, moment;  ///< of each particle, in space
  /// Pairs of it that touch. One of a particle with its own image counts twice: both its ends are
  /// on the particle.
  std::vector<std::int32_t> contacts{};
};

}  // namespace tangency::inline v0::dem
