// SPDX-License-Identifier: MIT
/// @file
/// The contacts and bodies of a packing as plain arrays, anybody's: what micromechanics is computed
/// from.
///
/// Signs: a contact of particles a and b has the unit normal that points out of a, the branch from
/// the centre of a to that of b (of the image in contact), and the force of a on b. Compression is
/// positive: a contact that pushes has force . normal > 0. Exchanging a and b turns all three
/// vectors round and changes no result. Only contacts that touch belong here, and none with a wall.
///
/// Units are any consistent set. In the plane (dimensions = 2) all vectors have z = 0, and stresses
/// are those of the unit thickness, with `volume` an area.
///
/// Errors: arrays of different lengths, normals and orientations that are not units and numbers
/// that are not finite are std::invalid_argument, which names the array and the place. Functions
/// read what they are given and keep nothing: any number of threads may call them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// Views of arrays that the caller keeps, one entry a contact.
struct ContactArrays {
  std::span<const Vec3> normal;  ///< unit to kUnitTolerance, out of a
  std::span<const Vec3> branch;  ///< centre of b less centre of a, length
  std::span<const Vec3> force;   ///< of a on b
  /// Contact point less centre of a, length. May be empty: then what needs it is not computed.
  std::span<const Vec3> arm{};
  /// Indices of a and b, from 0 to particles - 1. May be empty, alike.
  std::span<const std::array<std::int64_t, 2>> bodies{};
  std::int64_t particles = 0;  ///< of the packing, those without contacts included
  double volume = 0.0;         ///< of the packing, voids included; an area in the plane
  int dimensions = 3;          ///< 2 or 3

  /// The number of contacts.
  std::size_t size() const { return normal.size(); }
  /// From the centre of a to the contact point, or from that of b. Needs `arm`.
  Vec3 lever(std::size_t contact, bool of_b) const {
    return of_b ? Vec3(arm[contact] - branch[contact]) : arm[contact];
  }
};

/// A body a particle, as ContactArrays::bodies numbers them; views as there.
struct BodyArrays {
  /// Unit to kUnitTolerance, body to space. In the plane body axis 2 is that of z, or its opposite,
  /// to kUprightTolerance.
  std::span<const Quaternion> orientation;
  std::span<const Vec3> semi_axes;  ///< finite and > 0, length
};

/// Chosen: tables of six digits pass.
inline constexpr double kUnitTolerance = 1e-5;
/// Of 1 less the cosine of the angle to z. Chosen: tables of six digits pass.
inline constexpr double kUprightTolerance = 1e-6;

/// What a number is that data do not define.
inline constexpr double kNotDefined = std::numeric_limits<double>::quiet_NaN();

/// With its standard deviation. Contacts of one particle and the two sides of a contact may depend
/// on each other: deviations account for both. NaN where there are too few data to tell.
struct Estimate {
  double value = 0.0, error = 0.0;  ///< the estimate and its standard error
};

/// @throws std::invalid_argument where an array is not what ContactArrays says
void require_sound(const ContactArrays& contacts);
/// @throws std::invalid_argument where an array is not what BodyArrays says, for as many particles
void require_sound(const BodyArrays& bodies, std::int64_t particles, int dimensions);
/// @throws std::invalid_argument  as both; without `arm` or `bodies`
void require_sound(const ContactArrays& contacts, const BodyArrays& bodies);

/// (1/V) times the sum of force (x) branch, as it comes: not made symmetric. Compression positive,
/// force/area; 0 without contacts [Ouadfel1998, eq. 2.6].
Mat3 stress_of(const ContactArrays& contacts);

/// |s - s'| over the mean normal stress: the resultant moments that the contacts leave
/// [Ouadfel1998, eq. 2.8-2.11]; NaN without stress.
double stress_asymmetry(const Mat3& stress, int dimensions = 3);

/// m_v: contact sides per volume, 2 contacts / volume [Ouadfel1998, eq. 2.15].
double contact_density(const ContactArrays& contacts);

/// How many contacts particles have [Ouadfel1998, section 2.3.1].
struct Coordination {
  std::vector<std::int64_t> histogram;  ///< particles with 0, 1, 2, ... contacts
  double mean = 0.0;                    ///< 2 contacts / particles
  double deviation = 0.0;               ///< standard deviation over particles
  /// Third and fourth standardised moments, the fourth less 3; NaN where all particles have equally
  /// many.
  double skewness = 0.0, excess_kurtosis = 0.0;
};
/// A particle that touches its own image has two contacts by it. Needs `bodies`, and particles > 0.
Coordination coordination_of(const ContactArrays& contacts);

/// Unit vectors from the centre of each particle to its contacts, two a contact: of a, then of b.
/// Needs `arm`. Turned into body axes by the inverse orientation of their particles they are the
/// local contact vectors [Ouadfel1998, section 7.2], as fit_orientations takes them.
/// @param contacts  the contacts
/// @param orientation  of each particle, unit, body to space; empty: vectors stay in space axes.
///                     Else `bodies` is needed too
std::vector<Vec3> contact_vectors(const ContactArrays& contacts,
                                  std::span<const Quaternion> orientation = {});

}  // namespace tangency::inline v0::micromechanics
