// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Asks a peer in a process of its own: there are peers that end the program by an assertion or do
/// not come back.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tangency/bench/peers/peer.hpp>

namespace tangency::peers {

/// What a pair did.
enum class Outcome {
  answered,  ///< the peer answered
  failed,    ///< it said that it has no answer
  aborted,   ///< it ended the program
  hung,      ///< it took longer than the patience there was
};

/// A hundred times and more what any peer takes for a pair that it answers.
inline constexpr double kPatience = 0.25;  // s of processor time

struct Isolated {
  Outcome outcome = Outcome::aborted;
  std::optional<PeerContact> contact;  ///< where answered
};

/// Asks each pair once, for `patience` seconds of processor time, in children that are replaced as
/// they end; what they print on standard error is dropped.
/// @throws std::system_error  where the system gives no memory or no process
std::vector<Isolated> ask_isolated(std::span<const std::unique_ptr<PeerPair>> pairs,
                                   double patience = kPatience);

}  // namespace tangency::peers
