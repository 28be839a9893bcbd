// SPDX-License-Identifier: MIT
/// @file
/// Entries that stand for pairs of near_pairs.hpp, in ascending order of their pairs: counted by
/// body a, then sorted within each. Linear in bodies and pairs where each body has some few.
/// Internal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tangency::inline v0::detail {

/// @param bodies    every a is below
/// @param for_each  for_each(use) calls use(const Entry&) for every entry, each time in one order
/// @param pair_of   pair_of(const Entry&) is the entry's NearPair
template <class Entry, class ForEach, class PairOf>
std::vector<Entry> sorted_by_pair(std::size_t bodies, const ForEach& for_each,
                                  const PairOf& pair_of) {
  std::vector<std::size_t> next(bodies + 1, 0);
  for_each([&](const Entry& entry) { ++next[pair_of(entry).a + std::size_t{1}]; });
  for (std::size_t i = 0; i < bodies; ++i) next[i + 1] += next[i];
  std::vector<Entry> sorted(next.back());
  for_each([&](const Entry& entry) { sorted[next[pair_of(entry).a]++] = entry; });
  std::size_t first = 0;  // next[i] is now where the pairs of i end
  for (std::size_t i = 0; i < bodies; first = next[i++])
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first),
              sorted.begin() + static_cast<std::ptrdiff_t>(next[i]),
              [&](const Entry& x, const Entry& y) { return pair_of(x) < pair_of(y); });
  return sorted;
}

}  // namespace tangency::inline v0::detail
