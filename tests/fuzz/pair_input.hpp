// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Any 20 doubles as a pair of ellipsoids, and what mutations do to it: those of the hunt
/// (verify/hunt/moves.hpp), and numbers that arithmetic fears.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/tests/fuzz/target.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/pair.hpp>

namespace tangency::testing::fuzz {

/// Centre, semi-axes and quaternion of A, then of B.
inline constexpr std::size_t kPairBytes = 20 * sizeof(double);

/// Of the first kPairBytes of an input; what it lacks is 0.
verify::EllipsoidPair pair_of(Bytes input);
void write_pair(const verify::EllipsoidPair& pair, std::uint8_t* to);

/// Hexadecimal, as a row of a table.
std::string row_of(const verify::EllipsoidPair& pair);

struct Bodies {
  Ellipsoid a, b;
};
/// Nothing where one of them is no ellipsoid.
std::optional<Bodies> bodies_of(const verify::EllipsoidPair& pair);

/// One of the hunt's moves, towards where the bodies are nearest.
void move_pair(verify::EllipsoidPair& pair, verify::Draw& draw);

/// A move, seven times of eight, or a number of other bits.
void mutate_pair(verify::EllipsoidPair& pair, std::uint64_t seed);

/// Of every corpus of pairs, some rows of each; and those that were once answered wrongly.
std::vector<verify::EllipsoidPair> seed_pairs();

}  // namespace tangency::testing::fuzz
