// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Percentiles of what the benchmarks measure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tangency::bench {

/// The least value that at least the share of all values do not exceed; 0 of none. Requires sorted
/// values.
inline double nearest_rank(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace tangency::bench
