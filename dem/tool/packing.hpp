// SPDX-License-Identifier: MIT
/// @file
/// A state as plain arrays: its particles in the order of the scene, and its touching contacts.
/// What tables of contacts and particles and all averages over them are made of.
///
/// Contacts are those between particles that touch; those with walls are counted and give their
/// share of the stress. Bodies are
/// named by their ids, the places in the order of the scene from 0. Of a contact a <= b, and b is
/// the image of its particle that is moved by `image` edges of the cell; where a is b the image is
/// positive in lexicographic order. Contacts stand in ascending order of (a, b, image): nothing of
/// them depends on the order that particles have in memory.
///
/// Units are those of the scene. Positions are not wrapped into the cell, and the point of a
/// contact is beside a where a is. Signs are those of micromechanics/contact_arrays.hpp:
/// compression is positive. In the plane all vectors but angular velocities have z = 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// One entry a contact.
struct PackingContacts {
  std::vector<std::array<std::int64_t, 2>> bodies;  ///< ids of a and b
  std::vector<Image> image;                         ///< of b, in edges of the cell
  std::vector<Vec3> point;                          ///< length
  std::vector<Vec3> normal;                         ///< unit, from a to b
  std::vector<Vec3> branch;                         ///< centre of b less centre of a, length
  std::vector<Vec3> arm;                            ///< point less centre of a, length
  std::vector<Vec3> force;                          ///< the whole force of a on b
  std::vector<double> normal_force;                 ///< > 0 pushes
  std::vector<double> gap;                          ///< < 0, length
  /// 1 where the shear force is at the Coulomb limit of the laws, else 0; 0 without shear force.
  std::vector<std::uint8_t> sliding;

  std::vector<double> normal_stiffness;  ///< at this overlap, force/length
  std::vector<double> shear_stiffness;   ///< the larger one; 0 where no shear is borne

  std::size_t size() const { return bodies.size(); }
};

/// One entry a particle, in the order of ids.
struct PackingParticles {
  std::vector<std::int32_t> type;       ///< index into the scene's particle types
  std::vector<Vec3> position;           ///< centre, length
  std::vector<Vec3> semi_axes;          ///< length
  std::vector<Quaternion> orientation;  ///< unit; body to space
  std::vector<Vec3> velocity;           ///< relative to the strain of the cell, half a step ago
  std::vector<Vec3> angular_velocity;   ///< in space axes, alike
  /// That it has, those with walls included; one with its own image counts twice.
  std::vector<std::int32_t> contacts;

  std::size_t size() const { return position.size(); }
};

struct Packing {
  int dimensions = 3;
  Mat3 edges = Mat3::Identity();  ///< columns: edges of the cell, length
  double volume = 0.0;            ///< of the cell; in the plane an area
  std::int64_t wall_contacts = 0;
  /// What the contacts with walls give to the stress, force (x) branch over the volume.
  Mat3 wall_stress = Mat3::Zero();
  PackingContacts contacts;
  PackingParticles particles;

  /// Views of the contacts, valid as long as the packing stays as it is.
  micromechanics::ContactArrays arrays() const;
};

/// @param laws  that limit the shear forces. Those of a state have the friction of the scene's
///              contacts; a stage with a friction coefficient of its own has other ones
Packing packing_of(const State& state, const ContactLaws& laws);
inline Packing packing_of(const State& state) { return packing_of(state, state.laws); }

/// Laws as of a stage with a friction coefficient of its own.
ContactLaws with_friction(ContactLaws laws, double friction_coefficient);
/// Contacts that bear more shear than the laws let them: these are not those of their stage.
std::int64_t contacts_above_limit(const State& state, const ContactLaws& laws);

}  // namespace tangency::inline v0::dem
