// SPDX-License-Identifier: MIT
/// @file
/// Neighbours: all pairs of images of ellipsoids whose signed gap (gap.hpp) is at most a reach, of
/// many bodies of any sizes, in open space or repeated by a lattice; and their answers.
///
/// Lengths are in any one unit. A pair is (a, b, image) as in near_pairs.hpp: body a as stored, and
/// body b moved by edges * image without rounding.
///
/// (1) With the reach 0 exactly the pairs that share a point are listed: touching counts. For the
///     doubles as stored, whatever the image's centre would be rounded to.
/// (2) With a reach > 0 every pair whose true gap is at most reach is listed, and none whose gap,
///     less its gap_error, is above: no pair that is left out is nearer, and what is listed is at
///     most 2 gap_error further.
/// (3) Each pair is listed once: a <= b, and where a == b the image is lexicographically positive.
///     A body may meet its own image. Along an axis that is not periodic every image is 0.
/// (4) Lists are in ascending order of a, b, image; so is each block. Lists, blocks, their order
///     and their answers are the same to the bit for every number of threads.
/// (5) Answers are those of image_gap.hpp and gap_batch.hpp: within gap_error, with the sign of
///     the exact relation.
///
/// Time and memory are linear in bodies and pairs, where no more than some tens of bounding spheres
/// share a point. Bounding spheres are what is searched first: a dense heap of needles of aspect
/// 100 has many more of those that meet than needles that do.
#pragma once

#include <functional>
#include <span>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/neighbour_columns.hpp>

namespace tangency::inline v0 {

/// All neighbours as one list.
/// @throws std::invalid_argument  a reach that is negative or not finite, or so large that no
///     double has it and a semi-axis; and as NearPairSearch, of whose rules the lattice and the
///     places of bodies are the user's part
Neighbours neighbours(std::span<const Ellipsoid> bodies, const NeighbourQuestion& question = {});
/// Of bodies as they were at their last refresh; their centres are needed.
/// @throws std::invalid_argument  also where a body is no ellipsoid, and without centres
Neighbours neighbours(const MovingBodies& bodies, const NeighbourQuestion& question = {});
/// Of bodies given in any form: exactly those that share a point where the reach is 0, and answers
/// of image_gap.hpp to rounding, whatever accuracy is asked for. Each pair takes a single call.
/// @throws std::invalid_argument  as of ellipsoids
Neighbours neighbours(std::span<const MatrixEllipsoid> bodies,
                      const NeighbourQuestion& question = {});

/// The same without a list of all pairs: calls `take` for block after block, on the calling thread.
/// Blocks are neighbours in space; one holds what some hundreds of bodies find, and may be empty.
/// Beside the bodies' own search memory is that of some blocks for each thread.
void for_each_neighbours(std::span<const Ellipsoid> bodies, const NeighbourQuestion& question,
                         const std::function<void(const NeighbourBlock&)>& take);
/// @overload
void for_each_neighbours(const MovingBodies& bodies, const NeighbourQuestion& question,
                         const std::function<void(const NeighbourBlock&)>& take);

}  // namespace tangency::inline v0
