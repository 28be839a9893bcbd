// SPDX-License-Identifier: MIT
/// @file
/// The yes/no question for many pairs in one call, several times as fast as one by one: do the
/// interiors meet? By vector instructions that are chosen when the program runs; what a lane does
/// not prove is redone as a single pair inside the call. gap_batch.hpp includes this.
///
/// (1) Every answer is that of the single call, on every machine, at any place, order, number and
///     threads; bytes are 1 and 0.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <tangency/geometry/body_array.hpp>
#include <tangency/geometry/pair_list.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0 {

/// overlaps() of every pair. Exact for the stored doubles, in any floating-point environment; given
/// separations are taken as they are.
///
/// Here and below a length that does not match and a separation that is not finite end the process
/// with one line on standard error, in every build; indices only where asserts are on (a release
/// build does not look at them).
/// @param bodies  the bodies, by index
/// @param list  the pairs, with separations where they are given
/// @param answers  where the answers go
/// @param threads  as for signed_gaps()
void overlaps(const BodyArray& bodies, const PairList& list, std::span<bool> answers,
              int threads = 1) noexcept;
/// The same as bytes, 1 for true: for those who keep answers in a vector.
void overlaps(const BodyArray& bodies, const PairList& list, std::span<std::uint8_t> answers,
              int threads = 1) noexcept;

/// overlaps_by_filter() of every pair: nothing where only the exact tier would know. In bounded
/// time, and allocates nothing but for threads. An answer is that of the single call; near a touch
/// lanes may know what it does not, or the other way round, and which may depend on the list.
void overlaps_by_filter(const BodyArray& bodies, const PairList& list,
                        std::span<std::optional<bool>> answers, int threads = 1) noexcept;

}  // namespace tangency::inline v0
