// SPDX-License-Identifier: MIT
/// @file
/// A list of pairs shared among threads: what the batch calls' argument `threads` does. Internal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <system_error>
#include <thread>
#include <vector>

namespace tangency::detail {

/// Threads are not worth their start for fewer pairs: 20 us each, some thousand pairs. Chosen.
inline constexpr std::size_t kLeastPart = 1024;

/// work(first, last) for parts that cover [0, count) once, each but the last a multiple of `block`,
/// on at most `threads` threads, of which the calling one is one. A part whose thread the system
/// does not start is done here.
template <class Work>
void for_parts(std::size_t count, int threads, std::size_t block, const Work& work) {
  const std::size_t most = std::max<std::size_t>(1, count / kLeastPart);
  const std::size_t parts = std::min(most, static_cast<std::size_t>(std::max(threads, 1)));
  if (parts == 1) return work(std::size_t{0}, count);
  const std::size_t blocks = (count + block - 1) / block;
  const auto begin = [&](std::size_t part) {
    return std::min(count, blocks * part / parts * block);
  };
  std::vector<std::jthread> others;
  others.reserve(parts - 1);
  for (std::size_t part = 1; part < parts; ++part) {
    const std::size_t first = begin(part), last = begin(part + 1);
    try {
      others.emplace_back([&work, first, last] { work(first, last); });
    } catch (const std::system_error&) {
      work(first, last);
    }
  }
  work(std::size_t{0}, begin(1));
}

}  // namespace tangency::detail
