// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Packs: an input of target `batch`, which is a number and some pairs, as many pairs. The number
/// stands for all draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/indexed_pair.hpp>
#include <tangency/geometry/pair_list.hpp>
#include <tangency/tests/fuzz/pair_checks.hpp>
#include <tangency/verify/families/pair.hpp>

namespace tangency::testing::fuzz {

inline constexpr std::size_t kMostPairs = 6;  ///< of an input

struct Pack {
  std::vector<Ellipsoid> bodies;
  std::vector<IndexedPair> pairs;
  // As many as pairs, of placed ones; of moved ones there are none.
  std::vector<Vec3> separations;
  std::vector<Vec3> normals;     ///< where the witness points have them
  std::vector<Enclosure> known;  ///< of the gap

  PairList list() const { return {pairs, separations}; }
  /// As two bodies with centres, of which the kernel is asked one by one.
  verify::EllipsoidPair raw(std::size_t i) const;
};

/// The pairs, and each moved by moves of the hunt and by small turns and shifts, again and again,
/// until it is no fair pair any longer (verify/hunt/moves.hpp), which takes it back to one of the
/// given. Pairs have centres. One in a thousand of those that are deeper than -rho (gap.hpp) stays:
/// they are searched, which takes as long as a hundred others.
Pack moved_pack(std::span<const verify::EllipsoidPair> given, std::uint64_t seed);

/// Of their bodies, and of those that moves make of them, pairs whose gap is known
/// (placed_pairs.hpp). Empty where no body can be placed.
Pack placed_pack(std::span<const verify::EllipsoidPair> given, std::uint64_t seed);

}  // namespace tangency::testing::fuzz
