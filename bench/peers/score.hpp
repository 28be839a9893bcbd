// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far a peer's answers are from a truth that no solver was asked for.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <tangency/bench/peers/peer.hpp>

namespace tangency::peers {

/// The signed gap of a pair by the common normal, not 0, and the length its errors are given in.
struct Truth {
  double gap;
  double unit;
};

struct Score {
  std::size_t pairs = 0;
  std::size_t unanswered = 0;  ///< failures that the peer admits
  std::size_t wrong = 0;       ///< answers whose yes or no is wrong
  std::size_t gaps = 0;        ///< answers with a gap, a wrong yes or no included
  double median = 0;           ///< of |gap - truth| / unit over those gaps, and so on; nearest rank
  double percentile_99 = 0;
  double largest = 0;  ///< infinite where a gap is not a number
};

/// @param answers, truth  of the same pairs in the same order
Score score(std::span<const std::optional<PeerContact>> answers, std::span<const Truth> truth);

}  // namespace tangency::peers
