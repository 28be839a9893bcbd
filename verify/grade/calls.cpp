// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/calls.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace tangency::inline v0::verify {
namespace {

using Vector = std::array<double, 3>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

int sign(double x) { return (x > 0) - (x < 0); }

bool is_finite(const std::optional<double>& x) { return !x || std::isfinite(*x); }

bool is_finite(const std::optional<Vector>& v) {
  return !v || std::ranges::all_of(*v, [](double x) { return std::isfinite(x); });
}

bool is_wrong(const CallAnswer& answer, const CallTruth& truth) {
  if (answer.overlaps && *answer.overlaps != (truth.gap.high < 0)) return true;
  if (!is_finite(answer.gap) || !is_finite(answer.gap_error) || !is_finite(answer.normal) ||
      !is_finite(answer.arm_a) || !is_finite(answer.arm_b))
    return true;
  if (!answer.gap) return false;
  if (!answer.overlaps && sign(*answer.gap) != sign(truth.gap.high)) return true;
  return answer.gap_error && breaks_bound(excess(*answer.gap, truth.gap), *answer.gap_error,
                                          answer.is_local, truth.unproven);
}

// What is not a number is infinitely far from the truth.
double or_infinite(double error) { return std::isnan(error) ? HUGE_VAL : error; }

double distance(const Vector& a, const Vector& b) {
  return or_infinite(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
}

// Between unit vectors, down to their rounding.
double angle(const Vector& a, const Vector& b) {
  const double half = 0.5 * distance(a, b);
  return std::isinf(half) ? HUGE_VAL : 2 * std::asin(std::min(1.0, half));
}

void raise(std::optional<double>& largest, double value) {
  largest = std::max(largest.value_or(0), or_infinite(value));
}

}  // namespace

CallGrade grade_calls(std::span<const std::optional<CallAnswer>> answers,
                      std::span<const CallTruth> truths) {
  assert(answers.size() == truths.size());
  CallGrade g;
  g.pairs = answers.size();
  std::vector<double> gaps(g.pairs, kNone), normals = gaps, points = gaps;
  for (std::size_t i = 0; i < g.pairs; ++i) {
    const CallTruth& truth = truths[i];
    const bool is_open = truth.unproven > 0;
    g.open += is_open;
    g.unanswered += !answers[i];
    if (!answers[i]) continue;
    const CallAnswer& a = *answers[i];
    g.local += a.is_local;
    if (is_wrong(a, truth) && g.wrong++ == 0) g.first_wrong = i;
    if (!a.gap) continue;
    if (a.gap_error && !a.is_local) raise(g.gap_error, *a.gap_error / truth.unit);
    if (is_open) continue;
    const double error = or_infinite(std::abs(excess(*a.gap, truth.gap)) / truth.unit);
    if (a.is_local) {
      raise(g.local_error, error);
      continue;
    }
    gaps[i] = error;
    if (!truth.contact) continue;
    const CallTruth::Contact& c = *truth.contact;
    if (a.normal) normals[i] = angle(*a.normal, c.normal);
    if (a.arm_a && a.arm_b)
      points[i] = std::max(distance(*a.arm_a, c.arm_a), distance(*a.arm_b, c.arm_b)) / truth.unit;
  }
  g.gap = summary_of(gaps);
  g.normal = summary_of(normals);
  g.point = summary_of(points);
  return g;
}

}  // namespace tangency::inline v0::verify
