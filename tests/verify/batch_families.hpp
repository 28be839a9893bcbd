// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the batch is held against the single calls on: ordinary pairs, hostile ones, and families
/// each of which makes one term of docs/derivations/gap-batch.md as large as it goes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <tangency/verify/families/pair.hpp>

namespace tangency::testing {

struct BatchFamily {
  std::string name;
  /// Of the pairs that are asked for: less where the single call searches for long.
  double share;
  std::function<std::vector<verify::EllipsoidPair>(std::uint64_t seed, std::size_t count)> pairs;
};

/// In an order that stays: a family's pairs depend on its place.
const std::vector<BatchFamily>& batch_families();

}  // namespace tangency::testing
