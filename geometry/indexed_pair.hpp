// SPDX-License-Identifier: MIT
/// @file
/// A pair of bodies by their places in an array. No function may stand here: the file is read by
/// code for every instruction set (docs/decisions/0006-lanes.md).
#pragma once

#include <cstdint>

namespace tangency::inline v0 {

/// A and B of a pair by their places in a BodyArray.
struct IndexedPair {
  std::uint32_t a, b;  ///< places of A and B in the array of bodies
};

}  // namespace tangency::inline v0
