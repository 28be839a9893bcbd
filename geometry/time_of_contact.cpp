// SPDX-License-Identifier: MIT
#include <tangency/geometry/time_of_contact.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include <tangency/geometry/bodies/moving_pair.hpp>
#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0 {
namespace {

using detail::MovingPair;
using detail::PairAt;

constexpr int kMaxSteps = 2000;  // chosen: docs/derivations/time-of-contact.md, section 5
constexpr int kProbes = 24;      // chosen: moments looked at for an overlap that is soon over

/// Is a ball of radius `depth` around the point inside both solids? The point is relative to A.
bool both_hold(const PairAt& now, const Vec3& point, double depth) {
  return closest_point(now.a, point).distance < -depth &&
         closest_point(now.b, point - now.d).distance < -depth;
}

/// Do the true solids overlap at that moment?
bool proven_overlap(const MovingPair& pair, double t) {
  const PairAt now = pair.at(t);
  const Gap gap = signed_gap(now.a, now.b, now.d);
  const double error = pair.rounding(t);
  if (gap.status == GapStatus::ok) return gap.gap + gap.gap_error < -error;
  if (gap.gap >= 0.0) return false;
  const Vec3 middle = 0.5 * (gap.arm_a + now.d + gap.arm_b);
  return both_hold(now, middle, error) || both_hold(now, Vec3::Zero(), error) ||
         both_hold(now, now.d, error);
}

/// A moment of (from, to] at which they are proven to overlap, or -1: the ends of ever shorter
/// parts, and then the search for the least gap.
double overlap_within(const MovingPair& pair, double from, double to) {
  const auto gap_at = [&](double t) {
    const PairAt now = pair.at(t);
    return signed_gap(now.a, now.b, now.d).gap;
  };
  double part = to - from;
  for (int i = 0; i < kProbes; ++i, part *= 0.5) {
    const double t = std::min(from + part, to);  // to - from is rounded, and so is the sum
    if (proven_overlap(pair, t)) return t;
  }
  constexpr double kGolden = 0.6180339887498949;
  double low = from, high = to;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = gap_at(left), at_right = gap_at(right);
  for (int i = 0; i < kProbes; ++i) {
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      left = high - kGolden * (high - low), at_left = gap_at(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + kGolden * (high - low), at_right = gap_at(right);
    }
  }
  const double best = 0.5 * (low + high);
  return proven_overlap(pair, best) ? best : -1.0;
}

/// By how many powers of two a motion is in a larger unit of length, and of time.
Motion in_units(const Motion& motion, int length, int time) {
  return {scaled_by_power(motion.velocity, time - length),
          scaled_by_power(motion.angular_velocity, time),
          scaled_by_power(motion.pivot_arm, -length)};
}

/// The exponent of the largest length on a body's way, in a unit of time in which the horizon is
/// below 2. Of a body at rest less than any other.
int exponent_of_path(const Motion& motion, int time) {
  constexpr int kNone = -4096;
  const auto exponent = [](const Vec3& v, int power) {
    return v == Vec3::Zero() ? kNone : exponent_of(v) + power;
  };
  return std::max(exponent(motion.velocity, time + 1), exponent(motion.pivot_arm, 0));
}

/// The pair in units of length and time, powers of two, in which squares of what is on the way do
/// not overflow, and bodies are no smaller than the start can be seen in.
struct Problem {
  MovingPair pair;
  double horizon, tolerance;
  int length, time;  ///< the exponents of the units
  bool within;       ///< may bounds of the motion be computed? If not, both bodies are at rest here
};

Problem problem(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b,
                const Motion& motion_b, double horizon, double tolerance) {
  const auto start = detail::scaled_pair<Ellipsoid>({a, b});
  constexpr int kLongest = 500;  // of the way
  constexpr int kWidest = 100;   // rad, of a turn: rounding hides it from 2^46 on
  constexpr double kLeast = std::numeric_limits<double>::min();
  const int time = horizon > 0.0 ? exponent_of(horizon) : 0;
  const int path = std::max(exponent_of_path(motion_a, time), exponent_of_path(motion_b, time));
  const int way = std::max(start.exponent, path - kLongest);
  constexpr double kSeen = 0x1p60 * kLeast;  // chosen: what is subnormal of d is below u of it
  const auto seen = [&](const Ellipsoid& e) {
    return way == start.exponent ||
           scaled_by_power(e.semi_axes(), start.exponent - way).minCoeff() >= kSeen;
  };
  const bool within = exponent_of(motion_a.angular_velocity) + time < kWidest &&
                      exponent_of(motion_b.angular_velocity) + time < kWidest && seen(start.a) &&
                      seen(start.b);
  const Motion &by_a = within ? motion_a : Motion{}, &by_b = within ? motion_b : Motion{};
  const int length = within ? way : start.exponent, shift = start.exponent - length;
  const auto body = [&](const Ellipsoid& e) {
    return Ellipsoid(Vec3::Zero(), scaled_by_power(e.semi_axes(), shift).cwiseMax(kLeast),
                     e.orientation());
  };
  return {MovingPair(body(start.a), in_units(by_a, length, time), body(start.b),
                     in_units(by_b, length, time), scaled_by_power(start.d, shift)),
          std::scalbn(horizon, -time),
          std::scalbn(tolerance, -time),
          length,
          time,
          within};
}

/// t * 2^power, where that is subnormal no later or no earlier than exactly.
double scaled_time(double t, int power, double towards) {
  const double scaled = std::scalbn(t, power), back = std::scalbn(scaled, -power);
  const bool beyond = towards < t ? back > t : back < t;
  return beyond ? std::nextafter(scaled, towards) : scaled;
}

TimeOfContact answer(const MovingPair& pair, ContactTimeStatus status, double time, double latest,
                     int steps) {
  const PairAt now = pair.at(time);
  return {status, time, latest, 2.0 * pair.rounding(time), signed_gap(now.a, now.b, now.d), steps};
}

/// @param start, gap  of the pair at t = 0
TimeOfContact advance(const MovingPair& pair, const PairAt& start, const Gap& start_gap,
                      double horizon, double tolerance) {
  double t = 0.0;
  for (int step = 1; step <= kMaxSteps; ++step) {
    const PairAt now = step == 1 ? start : pair.at(t);
    const Gap gap = step == 1 ? start_gap : signed_gap(now.a, now.b, now.d);
    const double move = pair.safe_step(now, gap.normal, horizon - t);
    if (t + move >= horizon) return answer(pair, ContactTimeStatus::none, horizon, horizon, step);
    const bool lost = gap.gap <= 2.0 * pair.rounding(t) || t + move == t;
    t += move;
    if (move > detail::kNearContact * tolerance) continue;
    const double end = std::min(detail::at_most_after(t, tolerance), horizon);
    if (proven_overlap(pair, end)) return answer(pair, ContactTimeStatus::contact, t, end, step);
    if (!lost) continue;
    const double overlap = overlap_within(pair, t, end);
    const bool found = overlap >= 0.0;
    return answer(pair, found ? ContactTimeStatus::contact : ContactTimeStatus::grazing, t,
                  found ? overlap : t, step);
  }
  return answer(pair, ContactTimeStatus::not_converged, t, t, kMaxSteps);
}

[[maybe_unused]] bool finite(const Motion& motion) {
  return motion.velocity.allFinite() && motion.angular_velocity.allFinite() &&
         motion.pivot_arm.allFinite();
}

TimeOfContact found_time(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b,
                         const Motion& motion_b, double horizon, double tolerance) {
  assert(std::isfinite(horizon) && horizon >= 0.0 && tolerance > 0.0);
  assert(finite(motion_a) && finite(motion_b));
  const Problem asked = problem(a, motion_a, b, motion_b, horizon, tolerance);
  const MovingPair& pair = asked.pair;
  const PairAt start = pair.at(0.0);
  const Gap gap = signed_gap(start.a, start.b, start.d);
  const bool in_doubt = gap.gap <= pair.rounding(0.0);
  TimeOfContact found = in_doubt && relation(a, b).relation != Relation::separate
                            ? answer(pair, ContactTimeStatus::touching_at_start, 0.0, 0.0, 1)
                        : asked.within || horizon == 0.0
                            ? advance(pair, start, gap, asked.horizon, asked.tolerance)
                            : answer(pair, ContactTimeStatus::not_converged, 0.0, 0.0, 1);
  found.time = scaled_time(found.time, asked.time, 0.0);
  found.latest = scaled_time(found.latest, asked.time, std::numeric_limits<double>::max());
  found.gap.gap = std::scalbn(found.gap.gap, asked.length);
  found.gap.gap_error = std::scalbn(found.gap.gap_error, asked.length);
  found.gap.arm_a = scaled_by_power(found.gap.arm_a, asked.length);
  found.gap.arm_b = scaled_by_power(found.gap.arm_b, asked.length);
  found.resolution = std::scalbn(found.resolution, asked.length);
  return found;
}

/// The body by doubles, larger or smaller about its centre by the share that it is off: the true
/// one lies inside, or has it inside. Nothing where such a body is beyond the range of doubles.
std::optional<Ellipsoid> grown(const MatrixEllipsoid& body, double sign) {
  // The share, and what its own arithmetic rounds.
  const double share = body.relative_rounding() + (body.exact() != nullptr ? 0x1p-50 : 0.0);
  const Ellipsoid& e = body.ellipsoid();
  const Vec3 axes = (1.0 + sign * share) * e.semi_axes();
  constexpr double kLeast = std::numeric_limits<double>::min();  // above, no product is subnormal
  if (share == 0.0) return e;
  if (!axes.allFinite() || !(axes.minCoeff() >= kLeast)) return std::nullopt;
  return Ellipsoid(e.centre(), axes, e.orientation());
}

TimeOfContact found_time(const MatrixEllipsoid& a, const Motion& motion_a, const MatrixEllipsoid& b,
                         const Motion& motion_b, double horizon, double tolerance) {
  if (a.exact() == nullptr && b.exact() == nullptr)
    return found_time(a.ellipsoid(), motion_a, b.ellipsoid(), motion_b, horizon, tolerance);
  const auto larger_a = grown(a, 1.0), larger_b = grown(b, 1.0);
  const auto smaller_a = grown(a, -1.0), smaller_b = grown(b, -1.0);
  const bool encloses = larger_a && larger_b;
  // Where no larger body can be stored nothing is proven beyond the start.
  TimeOfContact found = found_time(encloses ? *larger_a : a.ellipsoid(), motion_a,
                                   encloses ? *larger_b : b.ellipsoid(), motion_b,
                                   encloses ? horizon : 0.0, tolerance);
  const bool touching = relation(a, b).relation != Relation::separate;
  if (touching || !encloses || found.status == ContactTimeStatus::touching_at_start) {
    found.status = touching   ? ContactTimeStatus::touching_at_start
                   : encloses ? ContactTimeStatus::grazing
                              : ContactTimeStatus::not_converged;
    found.time = found.latest = 0.0;
    return found;
  }
  if (found.status != ContactTimeStatus::contact) return found;
  const TimeOfContact inner = smaller_a && smaller_b ? found_time(*smaller_a, motion_a, *smaller_b,
                                                                  motion_b, horizon, tolerance)
                                                     : found;
  const bool proven = smaller_a && smaller_b && inner.status == ContactTimeStatus::contact;
  found.status = proven ? ContactTimeStatus::contact : ContactTimeStatus::grazing;
  found.latest = proven ? std::max(inner.latest, found.time) : found.time;
  return found;
}

}  // namespace

Motion screw(const Ellipsoid& body, const Vec3& axis_point, const Vec3& angular_velocity,
             double speed) noexcept {
  return in_default_environment([&]() -> Motion {
    assert(angular_velocity != Vec3::Zero());
    return {speed * angular_velocity.stableNormalized(), angular_velocity,
            body.centre() - axis_point};
  });
}

Ellipsoid moved(const Ellipsoid& body, const Motion& motion, double t) noexcept {
  return in_default_environment([&] {
    // A body seen from a point that stays: its separation is the displacement of its centre.
    const PairAt now = MovingPair(body, Motion{}, body, motion, Vec3::Zero()).at(t);
    return now.b.moved_to(body.centre() + now.d);
  });
}

TimeOfContact time_of_contact(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b,
                              const Motion& motion_b, double horizon, double tolerance) noexcept {
  return in_default_environment(
      [&] { return found_time(a, motion_a, b, motion_b, horizon, tolerance); });
}

TimeOfContact time_of_contact(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b,
                              const Motion& motion_b, const Vec3& separation, double horizon,
                              double tolerance) noexcept {
  return time_of_contact(a.moved_to(Vec3::Zero()), motion_a, b.moved_to(separation), motion_b,
                         horizon, tolerance);
}

TimeOfContact time_of_contact(const MatrixEllipsoid& a, const Motion& motion_a,
                              const MatrixEllipsoid& b, const Motion& motion_b, double horizon,
                              double tolerance) noexcept {
  return in_default_environment(
      [&] { return found_time(a, motion_a, b, motion_b, horizon, tolerance); });
}

}  // namespace tangency::inline v0
