// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/score.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <tangency/bench/nearest_rank.hpp>

namespace tangency::speed_accuracy {
namespace {

int sign(double x) { return (x > 0) - (x < 0); }

/// gap - true gap (for open pairs the least that it can be below): exact but for one rounding.
double deviation(const Answer& answer, const Truth& truth) {
  return (answer.gap - truth.gap) - truth.gap_rest;
}

bool is_finite(const Answer& a) {
  return std::isfinite(a.gap) && std::isfinite(a.gap_error) && a.normal.allFinite() &&
         a.arm_a.allFinite() && a.arm_b.allFinite();
}

bool is_wrong(const Answer& answer, const Truth& truth) {
  if (answer.standing == Standing::none) return false;
  if (answer.overlaps) return *answer.overlaps != (truth.gap < 0);
  if (!is_finite(answer) || sign(answer.gap) != sign(truth.gap)) return true;
  const double off = deviation(answer, truth);
  const bool too_great = off > answer.gap_error + truth.unproven;
  if (answer.standing == Standing::local) return too_great;
  return answer.standing == Standing::proven && (too_great || off < -answer.gap_error);
}

/// Angle between unit vectors, down to their rounding.
double angle(const Vec3& a, const Vec3& b) {
  return 2 * std::asin(std::min(1.0, 0.5 * (a - b).norm()));
}

std::optional<Errors> errors(std::vector<double> all) {
  if (all.empty()) return std::nullopt;
  for (double& e : all) {
    if (std::isnan(e)) e = std::numeric_limits<double>::infinity();
  }
  std::sort(all.begin(), all.end());
  return Errors{bench::nearest_rank(all, 0.5), bench::nearest_rank(all, 0.99), all.back()};
}

void raise(std::optional<double>& largest, double value) {
  largest = std::max(largest.value_or(0), std::isnan(value) ? HUGE_VAL : value);
}

}  // namespace

Score score(std::span<const Answer> answers, std::span<const Truth> truths) {
  assert(answers.size() == truths.size());
  Score s;
  s.pairs = answers.size();
  std::vector<double> gaps, normals, points;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Answer& a = answers[i];
    const Truth& truth = truths[i];
    s.unanswered += a.standing == Standing::none;
    s.local += a.standing == Standing::local;
    s.open += truth.unproven > 0;
    if (is_wrong(a, truth)) {
      ++s.wrong;
      if (!s.first_wrong) s.first_wrong = i;
    }
    if (a.standing == Standing::none || a.overlaps) continue;
    if (a.standing == Standing::proven) raise(s.gap_error, a.gap_error / truth.unit);
    if (truth.unproven > 0) continue;
    const double error = std::abs(deviation(a, truth)) / truth.unit;
    if (a.standing == Standing::local) {
      raise(s.local_error, error);
      continue;
    }
    gaps.push_back(error);
    if (!truth.unique) continue;
    normals.push_back(angle(a.normal, truth.normal));
    points.push_back(
        std::max((a.arm_a - truth.arm_a).stableNorm(), (a.arm_b - truth.arm_b).stableNorm()) /
        truth.unit);
  }
  s.gap = errors(std::move(gaps));
  s.normal = errors(std::move(normals));
  s.point = errors(std::move(points));
  return s;
}

}  // namespace tangency::speed_accuracy
