// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/peers/score.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include <tangency/bench/nearest_rank.hpp>

namespace tangency::peers {

using bench::nearest_rank;

Score score(std::span<const std::optional<PeerContact>> answers, std::span<const Truth> truth) {
  assert(answers.size() == truth.size());
  Score s;
  s.pairs = answers.size();
  std::vector<double> errors;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!answers[i]) {
      ++s.unanswered;
      continue;
    }
    if (answers[i]->overlap != (truth[i].gap < 0)) ++s.wrong;
    if (!answers[i]->gap) continue;
    const double error = std::abs(*answers[i]->gap - truth[i].gap) / truth[i].unit;
    errors.push_back(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
  }
  std::sort(errors.begin(), errors.end());
  s.gaps = errors.size();
  s.median = nearest_rank(errors, 0.5);
  s.percentile_99 = nearest_rank(errors, 0.99);
  s.largest = nearest_rank(errors, 1.0);
  return s;
}

}  // namespace tangency::peers
