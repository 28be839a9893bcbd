// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The comparison with other codes as Markdown, by class of question.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tangency/bench/peers/peer.hpp>
#include <tangency/verify/grade/calls.hpp>

namespace tangency::peers {

/// One peer, or this library, on one family of pairs.
struct Row {
  std::string family;
  PeerDescription peer;
  bool ours = false;
  verify::CallGrade grade;
  std::size_t ended = 0;  ///< of grade.unanswered: pairs that ended the program or hung it
  double ours_there = 0;  ///< largest error of signed_gap over the pairs that have a gap here
  double time = 0;        ///< ns per pair, over all pairs but those that ended the program
  double signed_gap = 0;  ///< ns per pair of signed_gap over the same pairs
};

/// A line a row: what was timed, and its time.
std::string times(const std::vector<Row>& rows);

/// @param inverse  ns of Eigen's 3x3 inverse, the yardstick of all benchmarks here
std::string tables(const std::vector<Row>& rows, double inverse);

/// The call of ours that answers many pairs at once.
inline constexpr const char* kBatchCall = "signed_gaps";

/// Lines for each family: how many times as fast as Simbody's ConvexImplicitPair signed_gap is, and
/// signed_gaps at each instruction set, and the largest errors: of signed_gap on the pairs where
/// Simbody gives a depth, of signed_gaps on all.
std::string against_simbody(const std::vector<Row>& rows);

}  // namespace tangency::peers
