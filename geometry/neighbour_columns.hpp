// SPDX-License-Identifier: MIT
/// @file
/// What neighbours.hpp is asked, and the columns of its answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// What is wanted of each pair. Each adds columns to those before it.
enum class NeighbourAnswers {
  pairs,     ///< which there are
  overlaps,  ///< do the interiors meet?
  gaps,      ///< gap, gap_error, status
  contacts,  ///< normal, arms and the separation
};

/// Which pairs are wanted, and which answers about each.
struct NeighbourQuestion {
  double reach = 0.0;                 ///< length; finite, >= 0
  Lattice lattice = Lattice::open();  ///< along which bodies are repeated; open space by default
  NeighbourAnswers answers = NeighbourAnswers::pairs;  ///< what is answered of each pair
  Accuracy accuracy = {};  ///< of gaps; not its cutoff, in whose place the reach is
  int threads = 1;         ///< below 1 counts as 1
};

/// Pairs and their answers by columns: each as long as `pairs`, or empty where it was not asked
/// for. Valid until the call to which it was handed returns, or as long as the Neighbours are.
struct NeighbourBlock {
  std::span<const NearPair> pairs;         ///< of body a and an image of body b
  std::span<const std::uint8_t> overlaps;  ///< 1 where the interiors meet, else 0
  std::span<const double> gap;             ///< length
  std::span<const double> gap_error;       ///< a bound on the error of each gap, where asked for
  std::span<const GapStatus> status;       ///< what is proven of each gap, where asked for
  std::span<const Vec3> normal;            ///< unit, from a to the image of b
  std::span<const Vec3> arm_a;             ///< from a's centre to its witness point
  std::span<const Vec3> arm_b;             ///< from the centre of b's image to its witness point
  std::span<const Vec3> separation;        ///< of the centres, rounded: separation() of lattice.hpp
};

/// The same as a list that owns its columns.
struct Neighbours {
  std::vector<NearPair> pairs;         ///< sorted by a, b and image
  std::vector<std::uint8_t> overlaps;  ///< 1 where the pair shares a point, where asked for
  std::vector<double> gap, gap_error;  ///< of each pair, in the unit of length, where asked for
  std::vector<GapStatus> status;       ///< what is proven of each gap, where asked for
  /// of each pair, as Gap has them, where asked for
  std::vector<Vec3> normal, arm_a, arm_b, separation;

  /// The number of pairs.
  std::size_t size() const noexcept { return pairs.size(); }
  /// All of it as one block, which looks at these columns.
  NeighbourBlock all() const& noexcept {
    return {pairs, overlaps, gap, gap_error, status, normal, arm_a, arm_b, separation};
  }
  NeighbourBlock all() const&& = delete;  ///< the columns would be gone
};

}  // namespace tangency::inline v0
