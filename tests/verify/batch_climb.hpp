// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How near the true error of what lanes answer comes to gap_error: from a pair uphill, by nudges
/// of its numbers.
#pragma once

#include <cstdint>
#include <string>

#include <tangency/verify/families/pair.hpp>

namespace tangency::testing {

enum class LaneForm { ellipsoids, moving };

struct Climbed {
  verify::EllipsoidPair pair;
  double ratio = 0;  ///< the error over gap_error, by the oracle; 0 where no lane answers
};

/// Each step moves one number of the pair by some units in the last place, or by up to a part of
/// itself, and stays where that raises the ratio of a cold answer with Accuracy::certified().
Climbed climb(const verify::EllipsoidPair& start, LaneForm form, int steps, std::uint64_t seed);

}  // namespace tangency::testing
