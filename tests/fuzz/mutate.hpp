// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Mutations of inputs: bytes, tables and other text with numbers in it, and rows of doubles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tangency::testing::fuzz {

/// The next number of a sequence, which is the state (SplitMix64).
std::uint64_t next(std::uint64_t& state);

/// The next number, below `limit` > 0.
std::size_t below(std::uint64_t& state, std::size_t limit);

/// Flipped bits, and runs of bytes that are left out, doubled, or put elsewhere.
std::size_t mutate_bytes(std::uint8_t* data, std::size_t size, std::size_t most,
                         std::uint64_t seed);

/// The same of text, and more often: numbers that readers fear in place of a number, lines and
/// cells that are left out, doubled or exchanged, and words of this text elsewhere in it.
std::size_t mutate_text(std::uint8_t* data, std::size_t size, std::size_t most, std::uint64_t seed);

/// A number that arithmetic fears, or the next doubles to `value`, or one of other bits.
double mutated(double value, std::uint64_t& state);

}  // namespace tangency::testing::fuzz
