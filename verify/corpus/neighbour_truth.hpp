// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Which bodies of many share a point, in a cell or in open space.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <tangency/verify/oracles/plain_bodies.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

struct TruePair {
  std::size_t i, j;
  std::array<int, 3> image;
  Relation relation;
};

/// Sorted; i < j, or i = j and the image comes after 0 0 0. `cell`: edges that are whole numbers; 0
/// is an open direction. Requires centres on a grid so coarse that those of images are doubles.
std::vector<TruePair> true_pairs(std::span<const RawEllipsoid> bodies,
                                 const std::array<double, 3>& cell);

}  // namespace tangency::inline v0::verify
