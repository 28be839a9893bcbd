// SPDX-License-Identifier: MIT
/// @file
/// Work in parts that any of several threads may do. Internal.
#pragma once

#include <cstddef>
#include <functional>

namespace tangency::detail {

/// work(k) for every k below `parts`, on this thread and up to threads - 1 others that end before
/// it returns. Which thread does which part is left to chance.
/// @param threads  0 counts as 1
/// @throws  the first exception that a part threw; the parts not yet begun are left undone
void in_parts(std::size_t parts, unsigned threads, const std::function<void(std::size_t)>& work);

}  // namespace tangency::detail
