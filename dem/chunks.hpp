// SPDX-License-Identifier: MIT
/// @file
/// Loops over particles in chunks, shared among threads, whose sums have the same bits at every
/// number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tangency/dem/lanes/particle_lanes.hpp>
#include <tangency/dem/parallel.hpp>

namespace tangency::inline v0::dem {

/// work(first, last) for the chunks [first, last) of [0, count). Threads call it, each for other
/// chunks; it may not throw.
template <class Work>
void for_each_chunk(std::size_t count, const Work& work) {
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  for_ranges(chunks, kParallelThreshold / kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk)
      work(kChunk * chunk, std::min(count, kChunk * (chunk + 1)));
  });
}

/// The sum of what work(first, last) returns for the chunks, added in their order.
/// @tparam Sum  starts as {} and has +=
template <class Sum, class Work>
Sum sum_by_chunks(std::size_t count, const Work& work) {
  std::vector<Sum> sums((count + kChunk - 1) / kChunk);
  for_each_chunk(count, [&](std::size_t first, std::size_t last) {
    sums[first / kChunk] = work(first, last);
  });
  Sum sum{};
  for (const Sum& one : sums) sum += one;
  return sum;
}

}  // namespace tangency::inline v0::dem
