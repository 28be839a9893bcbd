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
/// (5) Answers are those of image_pair.hpp and gap_batch.hpp: within gap_error, with the sign of
///     the exact relation.
///
/// Time and memory are linear in bodies and pairs, where no more than some tens of bounding spheres
/// share a point. Bounding spheres are what is searched first: a dense heap of needles of aspect
/// 100 has many more of those that meet than needles that do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency {

/// What is wanted of each pair. Each adds columns to those before it.
enum class NeighbourAnswers {
  pairs,     ///< which there are
  overlaps,  ///< do the interiors meet?
  gaps,      ///< gap, gap_error, status
  contacts,  ///< normal, arms and the separation
};

struct NeighbourQuestion {
  double reach = 0.0;  ///< length; finite, >= 0
  Lattice lattice = Lattice::open();
  NeighbourAnswers answers = NeighbourAnswers::pairs;
  Accuracy accuracy = {};  ///< of gaps
  int threads = 1;         ///< below 1 counts as 1
};

/// Pairs and their answers by columns: each as long as `pairs`, or empty where it was not asked
/// for. Valid until the call to which it was handed returns, or as long as the Neighbours are.
struct NeighbourBlock {
  std::span<const NearPair> pairs;
  std::span<const std::uint8_t> overlaps;  ///< 1 where the interiors meet, else 0
  std::span<const double> gap;             ///< length
  std::span<const double> gap_error;
  std::span<const GapStatus> status;
  std::span<const Vec3> normal;      ///< unit, from a to the image of b
  std::span<const Vec3> arm_a;       ///< from a's centre to its witness point
  std::span<const Vec3> arm_b;       ///< from the centre of b's image to its witness point
  std::span<const Vec3> separation;  ///< of the centres, rounded: separation() of image_pair.hpp
};

/// The same as a list that owns its columns.
struct Neighbours {
  std::vector<NearPair> pairs;
  std::vector<std::uint8_t> overlaps;
  std::vector<double> gap, gap_error;
  std::vector<GapStatus> status;
  std::vector<Vec3> normal, arm_a, arm_b, separation;

  std::size_t size() const noexcept { return pairs.size(); }
  NeighbourBlock all() const noexcept {
    return {pairs, overlaps, gap, gap_error, status, normal, arm_a, arm_b, separation};
  }
};

/// All neighbours as one list.
/// @throws std::invalid_argument  a reach that is negative or not finite, or so large that no
///     double has it and a semi-axis; and as NearPairSearch, of whose rules the lattice and the
///     places of bodies are the user's part
Neighbours neighbours(std::span<const Ellipsoid> bodies, const NeighbourQuestion& question = {});
/// Of bodies as they were at their last refresh; their centres are needed.
/// @throws  also InvalidEllipsoid, where a body is none; std::invalid_argument without centres
Neighbours neighbours(const MovingBodies& bodies, const NeighbourQuestion& question = {});

/// The same without a list of all pairs: calls `take` for block after block, on the calling thread.
/// Blocks are neighbours in space; one holds what some hundreds of bodies find, and may be empty of
/// no pair. Beside the bodies' own search memory is that of some blocks for each thread.
void for_each_neighbours(std::span<const Ellipsoid> bodies, const NeighbourQuestion& question,
                         const std::function<void(const NeighbourBlock&)>& take);
void for_each_neighbours(const MovingBodies& bodies, const NeighbourQuestion& question,
                         const std::function<void(const NeighbourBlock&)>& take);

}  // namespace tangency
