// SPDX-License-Identifier: MIT
/// @file
/// Random insertion by true shape: particles are put into a cell one by one at places and with axes
/// that are drawn, where they meet none of those before.
///
/// The largest come first, equal ones in random order. A draw that meets others is dropped: random
/// sequential addition [Widom1966], which for spheres comes to an end at a volume fraction of 0.384
/// and nears it ever slower. After kPlainDraws of them a draw that meets others is moved, as it is
/// turned, out of those that it meets, some steps at most: what is left of the room is found in a
/// few draws, and the particles that come last lie near their neighbours.
///
/// Units: any; lengths are those of the shapes. Frame: that of the cell, from its corner.
#pragma once

#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/dem/samples/batches.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// The largest share of a cell that particles may be asked to fill. Chosen: above what insertion
/// reaches for equal bodies of any shape; a mixture of sizes goes further.
inline constexpr double kMostInserted = 0.5;

/// Draws of a particle that are dropped where they meet others. Chosen: spheres take so many on the
/// mean where 0.26 of the cell is full, and three times as many at 0.3 (measured).
inline constexpr int kPlainDraws = 64;

/// Edges of the cell: those given, or a cube (in the plane a square) of which the particles fill
/// how.volume_fraction.
/// @throws DoesNotFit  where they fill more than kMostInserted of it or of a layer, an edge is
///     shorter than the largest particle, or walls leave nothing of a layer
Vec3 insertion_edges(const std::vector<Batch>& batches, const Placement& how);

/// Puts the particles at rest at random.
///
/// (1) No two particles overlap, images included, and none a wall of the cell: by overlaps() of
///     geometry/relation.hpp, for each body made larger by kInsertionClearance of itself.
/// (2) The same seed gives the same sample on every machine.
/// (3) The centres of a batch lie within its layer.
/// Time is linear in the number of particles of one mixture and volume fraction, but for what
/// memory costs beyond the caches: a look at a body is one at a random place.
/// @throws DoesNotFit  as insertion_edges(), and where a particle finds no room
Particles insert(const std::vector<Batch>& batches, const Placement& how, Cell& cell);

/// Share of a particle's size by which it is kept away from others. Chosen: far above rounding, far
/// below what a contact is pressed together by.
inline constexpr double kInsertionClearance = 1e-6;

}  // namespace tangency::inline v0::dem
