// SPDX-License-Identifier: MIT
/// @file
/// Work shared among threads: what the argument `threads` of calls for many pairs does. Internal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace tangency::inline v0::detail {

/// work(k) for every k below `parts`, on this thread and up to threads - 1 others that end before
/// it returns. Which thread does which part is left to chance.
/// @param threads  below 1 counts as 1
/// @throws  the first exception that a part threw; the parts not yet begun are left undone
void in_parts(std::size_t parts, int threads, const std::function<void(std::size_t)>& work);

/// Threads are not worth their start for fewer pairs: 20 us each, some thousand pairs. Chosen.
inline constexpr std::size_t kLeastPart = 1024;

/// work(first, last) for ranges that cover [0, count) once, one a thread, each but the last a
/// multiple of `block`.
template <class Work>
void in_ranges(std::size_t count, int threads, std::size_t block, const Work& work) {
  const std::size_t most = std::max<std::size_t>(1, count / kLeastPart);
  const std::size_t parts = std::min(most, static_cast<std::size_t>(std::max(threads, 1)));
  if (parts == 1) return work(std::size_t{0}, count);
  const std::size_t blocks = (count + block - 1) / block;
  const auto begin = [&](std::size_t part) {
    return std::min(count, blocks * part / parts * block);
  };
  in_parts(parts, threads, [&](std::size_t part) { work(begin(part), begin(part + 1)); });
}

}  // namespace tangency::inline v0::detail
