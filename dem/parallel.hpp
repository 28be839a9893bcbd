// SPDX-License-Identifier: MIT
/// @file
/// When a loop is shared among threads.
#pragma once

#include <cstddef>

namespace tangency::dem {

/// Below so many pairs, or particles, a loop is over before a second thread has woken up. Chosen:
/// some 50 us of work, a few times what waking takes.
inline constexpr std::size_t kParallelThreshold = 400;

}  // namespace tangency::dem
