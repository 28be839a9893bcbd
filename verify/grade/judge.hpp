// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One answer beside the truth of its pair, and the ranks of many errors: by the same rules whether
/// the answers stand in a table (grade.hpp) or came from calls (calls.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include <tangency/verify/answers/truth_table.hpp>

namespace tangency::inline v0::verify {

inline constexpr std::size_t kNoRow = std::numeric_limits<std::size_t>::max();

// Of the answers that there are; nearest rank: the least value that at least this share of all do
// not exceed.
struct ErrorSummary {
  std::size_t count = 0;
  double median = 0, percentile_99 = 0, largest = 0;
  std::size_t worst_row = kNoRow;
};

// `errors` >= 0, of the rows from 0; nan for a row that has none.
ErrorSummary summary_of(std::span<const double> errors);

// gap - truth, rounded once but for a share of 2^-53 of itself.
double excess(double gap, const TwoDoubles& truth);

// Is a claimed bound broken by a gap that is `excess` above the truth? The bound of a local gap
// holds from above alone, and the true gap may itself be larger by up to `unproven` >= 0.
bool breaks_bound(double excess, double bound, bool is_local, double unproven = 0);

struct NormalVerdict {
  double error;   // length of the difference to the nearest true normal
  bool reversed;  // more than a right angle from every true normal
};

// `n` of any finite length; `row` one of the table whose normal is defined. Where every normal is
// true the error is that of the length alone, and none is reversed.
NormalVerdict judge_normal(const TruthTable& truth, const TruthRow& row,
                           const std::array<double, 3>& n);

}  // namespace tangency::inline v0::verify
