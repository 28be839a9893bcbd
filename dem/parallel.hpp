// SPDX-License-Identifier: MIT
/// @file
/// Loops that are shared among threads: oneTBB's, whose threads sleep when there is nothing to do,
/// and take back the share of one that the machine does not let run (docs/decisions/0012).
#pragma once

#include <cstddef>

namespace tangency::inline v0::dem {

/// Sets how many threads the loops of this library use from now on; 0: as many as the machine lets
/// this process run at once, which is where it starts. Loops that a program gives TBB itself keep
/// their own number. Not while a loop is running. No result
/// depends on it, to the bit.
void set_threads(int count);

/// How many threads loops use.
int threads();

/// Below so many pairs, or particles, a loop is over before a second thread has begun. Chosen: some
/// 20 us of work, a few times what a loop costs to share.
inline constexpr std::size_t kParallelThreshold = 400;

/// for_ranges() with a function and what it is called with. Internal.
void share_range(std::size_t count, void (*call)(const void*, std::size_t, std::size_t),
                 const void* what);

/// Calls what(first, last) for ranges that make up [0, count), one after the other or at once.
/// `what` does not throw.
/// @param count  how many
/// @param what  called with the ends of each range
/// @param least  in one call where count is less
template <class F>
void for_ranges(std::size_t count, std::size_t least, const F& what) {
  if (count == 0) return;
  if (count < least) return what(std::size_t{0}, count);
  share_range(
      count,
      [](const void* f, std::size_t first, std::size_t last) {
        (*static_cast<const F*>(f))(first, last);
      },
      &what);
}

}  // namespace tangency::inline v0::dem
