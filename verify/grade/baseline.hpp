// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A grade beside an earlier one of the same corpora, so that no step back passes unseen.
///
///  (1) A grade beside itself is neither worse nor better.
///  (2) Worse: a count that has grown; an error that has grown by more than the slack; a size that
///      has changed; a value of a graded corpus that is no longer there; a graded corpus of which
///      the baseline has nothing.
///  (3) Better: a count that has fallen; an error that has fallen by more than the slack.
///  (4) Times, and overlaps answered on an external touch, are information.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <tangency/verify/grade/outputs.hpp>

namespace tangency::inline v0::verify {

/// Values by name.
using Baseline = std::map<std::string, double>;

/// What as_json() wrote. Throws tables::Error, naming the file and the line, for anything else.
Baseline read_baseline(const std::string& path);

/// A line each, with both values; worse and better: the largest change first.
struct Comparison {
  std::vector<std::string> worse, better;
  std::vector<std::string> unknown;      ///< names that the baseline does not have
  std::vector<std::string> information;  ///< times
};

/// `slack` >= 0 is a share of the baseline's error. Corpora that were not graded are left out.
Comparison compare(const std::vector<CorpusReport>& corpora, const Baseline& baseline,
                   double slack);

}  // namespace tangency::inline v0::verify
