// SPDX-License-Identifier: MIT
/// @file
/// What tables and frames tell of contacts and particles in addition to packing.hpp. Units and
/// signs are those of packing.hpp: force of a on b, normal from a to b, compression positive.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// Of a on b in the tangent plane: the whole force less its normal part.
Vec3 shear_force(const PackingContacts& contacts, std::size_t contact);

/// Of b's surface relative to a's at each contact, length/time: motion of the cell, fluctuations
/// and spins, half a step ago.
///
/// (1) Its part along the normal is the rate at which the gap opens, of centres and spins.
std::vector<Vec3> contact_velocities(const Packing& packing, const Cell& cell);

/// Principal curvatures of the distance between the two surfaces at a contact, 1/length, the
/// smaller first; in the plane 0, since disks are straight across it, and that of the outlines.
///
/// (2) Of two spheres both are 1/r_a + 1/r_b.
std::array<double, 2> relative_curvatures(const Packing& packing, std::size_t contact);

/// Stress of each particle in the order of ids, force/area: the sum over its contacts, those with
/// walls included, of force (x) branch over its volume, made symmetric. Each contact gives a the
/// part with a's arm and b the rest; to a wall the branch is that of Contact.
///
/// (3) Weighted by volume the stresses of all particles add up to that of the cell times its
/// volume.
std::vector<Mat3> particle_stresses(const State& state);

}  // namespace tangency::inline v0::dem
