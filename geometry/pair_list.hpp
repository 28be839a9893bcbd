// SPDX-License-Identifier: MIT
/// @file
/// The pairs that a batch call is asked about.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <tangency/geometry/indexed_pair.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// The pairs of one call.
struct PairList {
  std::span<const IndexedPair> pairs;  ///< which bodies
  /// c_B - c_A of each pair, as for periodic images; empty: that of the centres.
  std::span<const Vec3> separations = {};
};

/// A pair of indices of any integer types. One that is no index (negative, or beyond 32 bits)
/// becomes 2^32 - 1, which is none either: a call that is asked about it treats it as every index
/// beyond the bodies.
constexpr IndexedPair indexed_pair(std::integral auto a, std::integral auto b) noexcept {
  constexpr auto most = std::numeric_limits<std::uint32_t>::max();
  return {std::in_range<std::uint32_t>(a) ? static_cast<std::uint32_t>(a) : most,
          std::in_range<std::uint32_t>(b) ? static_cast<std::uint32_t>(b) : most};
}

}  // namespace tangency::inline v0
