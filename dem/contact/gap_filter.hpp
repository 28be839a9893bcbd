// SPDX-License-Identifier: MIT
/// @file
/// Which candidates for a neighbour list are apart by more than their skins. Internal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/lattice.hpp>

namespace tangency::inline v0::dem {

/// For each pair: 0 where its gap is proven to be above the sum of both skins, else 1.
/// @param pairs  whose bounding spheres, with their skins, meet
/// @param skins  length, one a particle
std::vector<std::uint8_t> within_skins(std::span<const NearPair> pairs, const Particles& particles,
                                       const Cell& cell, std::span<const double> skins);

}  // namespace tangency::inline v0::dem
