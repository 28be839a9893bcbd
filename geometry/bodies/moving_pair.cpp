// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/moving_pair.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangency::detail {
namespace {

constexpr double kRounding = 64 * kUnitRoundoff;  // docs/derivations/time-of-contact.md, section 3
constexpr double kInflated = 1 + 0x1p-40;         // of second derivatives, for their own rounding
constexpr double kFarEnough = 0.95;  // chosen: of the longest step that the bound allows
constexpr int kRefinements = 100;    // of its bracket, which is halved each time

/// exp(t [w]x) as a unit quaternion.
Quaternion turn(const Vec3& w, double t) {
  const double half = 0.5 * w.stableNorm() * t;
  if (half == 0.0) return Quaternion::Identity();
  const Vec3 axis = std::sin(half) * w.stableNormalized();
  return {std::cos(half), axis.x(), axis.y(), axis.z()};
}

/// (exp(t [w]x) - 1) r without cancellation for a small turn.
Vec3 displacement(const Vec3& w, double t, const Vec3& r) {
  const double angle = w.stableNorm() * t;
  if (angle == 0.0) return Vec3::Zero();
  const Vec3 axis = w.stableNormalized(), across = axis.cross(r);
  const double s = std::sin(0.5 * angle);
  return std::sin(angle) * across + 2.0 * s * s * axis.cross(across);
}

Ellipsoid turned(const Ellipsoid& body, const Vec3& w, double t) {
  if (w == Vec3::Zero() || t == 0.0) return body;
  Quaternion q = body.orientation();
  q.coeffs() /= q.coeffs().cwiseAbs().maxCoeff();
  return {Vec3::Zero(), body.semi_axes(), turn(w, t) * q};
}

/// An upper bound of a support function along a step s: sqrt(c0 + c1 s + c2 s^2).
struct Reach {
  double c0, c1, c2;
  double at(double s) const { return std::sqrt(std::max(0.0, c0 + s * (c1 + s * c2))); }
};

/// Of a body that turns at w, in a direction n that turns at v.
Reach reach_of(const Ellipsoid& body, const Vec3& w, const Vec3& n, const Vec3& v) {
  const Vec3& a = body.semi_axes();
  const Vec3 relative = v - w, rate = relative.cross(n);
  const Vec3 y = a.cwiseProduct(body.rotation().transpose() * n);
  const Vec3 dy = a.cwiseProduct(body.rotation().transpose() * rate);
  const double speed = relative.norm();
  const double spread = (a.maxCoeff() - a.minCoeff()) * (a.maxCoeff() + a.minCoeff());
  return {y.squaredNorm(), 2.0 * y.dot(dy),
          kInflated * spread * speed * (speed + w.norm() + v.norm())};
}

/// The largest step found at which a concave function with bound(0) > 0 is still > 0.
template <class Bound>
double last_positive(const Bound& bound, double longest) {
  if (!(bound(0.0) > 0.0)) return 0.0;
  double low = 0.0, high = longest, at_low = bound(0.0), at_high = bound(longest);
  if (at_high > 0.0) return longest;
  for (int i = 0; i < kRefinements && low < kFarEnough * high; ++i) {
    // The chord of a concave function crosses zero before the function does; the midpoint brings
    // the far end in.
    for (const double s :
         {low + (high - low) * (at_low / (at_low - at_high)), 0.5 * (low + high)}) {
      if (!(s > low && s < high)) continue;
      const double value = bound(s);
      (value > 0.0 ? low : high) = s;
      (value > 0.0 ? at_low : at_high) = value;
    }
  }
  return low;
}

double path_size(const Ellipsoid& body, const Motion& motion) {
  return body.largest_semi_axis() + 2.0 * motion.pivot_arm.norm();
}

}  // namespace

MovingPair::MovingPair(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b,
                       const Motion& motion_b, const Vec3& separation) noexcept
    : a_(a.moved_to(Vec3::Zero())),
      b_(b.moved_to(Vec3::Zero())),
      motion_a_(motion_a),
      motion_b_(motion_b),
      separation_(separation) {
  const double wa = motion_a.angular_velocity.stableNorm(),
               wb = motion_b.angular_velocity.stableNorm();
  const double ra = motion_a.pivot_arm.norm(), rb = motion_b.pivot_arm.norm();
  const double size_a = path_size(a, motion_a), size_b = path_size(b, motion_b);
  const double speed = motion_a.velocity.norm() + motion_b.velocity.norm();
  greatest_speed_ = kInflated * (speed + wa * ra + wb * rb);
  greatest_acceleration_ = kInflated * (wa * wa * ra + wb * wb * rb);
  rounding_at_start_ = kRounding * (separation.norm() + size_a + size_b);
  rounding_per_time_ = kRounding * (speed + wa * size_a + wb * size_b);
}

PairAt MovingPair::at(double t) const noexcept {
  const Vec3 &wa = motion_a_.angular_velocity, &wb = motion_b_.angular_velocity;
  const Vec3 shift_a = displacement(wa, t, motion_a_.pivot_arm);
  const Vec3 shift_b = displacement(wb, t, motion_b_.pivot_arm);
  const Vec3 d = separation_ + t * (motion_b_.velocity - motion_a_.velocity) + (shift_b - shift_a);
  return {t,
          turned(a_, wa, t),
          turned(b_, wb, t),
          d,
          motion_a_.pivot_arm + shift_a,
          motion_b_.pivot_arm + shift_b};
}

double MovingPair::rounding(double t) const noexcept {
  return rounding_at_start_ + t * rounding_per_time_;
}

double MovingPair::safe_step(const PairAt& now, const Vec3& normal, const Vec3& turning,
                             double longest) const noexcept {
  const Vec3 &wa = motion_a_.angular_velocity, &wb = motion_b_.angular_velocity;
  const Vec3 velocity = motion_b_.velocity + wb.cross(now.pivot_arm_b) - motion_a_.velocity -
                        wa.cross(now.pivot_arm_a);
  const double w = turning.norm(), distance = now.d.norm();
  const double value = normal.dot(now.d);
  const double slope = normal.dot(velocity) + turning.cross(normal).dot(now.d);
  const double fall =
      kInflated * 0.5 * (w * w * distance + 2.0 * w * greatest_speed_ + greatest_acceleration_);
  const double growth = kInflated * 0.5 * w * w * greatest_speed_;
  const Reach a = reach_of(now.a, wa, normal, turning), b = reach_of(now.b, wb, normal, turning);
  // A direction that turns with one body turns about the other (section 3 there).
  double error = rounding(now.t), turned = 0.0;
  for (const auto& [spin, size] :
       {std::pair(wa, a_.largest_semi_axis()), std::pair(wb, b_.largest_semi_axis())}) {
    const double rate = (turning - spin).norm();
    if (rate > 0.0) error += kRounding * size;
    turned += 2.0 * rate * size;
  }
  const double error_rate =
      rounding_per_time_ + kRounding * (greatest_speed_ + w * distance + turned);
  return last_positive(
      [&](double s) {
        return value + s * (slope - error_rate) - s * s * (fall + s * growth) - a.at(s) - b.at(s) -
               error;
      },
      longest);
}

double MovingPair::safe_step_of_spheres(const PairAt& now, double longest) const noexcept {
  const double distance = now.d.norm();
  const double value = distance - a_.largest_semi_axis() - b_.largest_semi_axis();
  if (!(value > rounding(now.t))) return 0.0;
  const Vec3 n = now.d / distance;
  const Vec3 velocity = motion_b_.velocity + motion_b_.angular_velocity.cross(now.pivot_arm_b) -
                        motion_a_.velocity - motion_a_.angular_velocity.cross(now.pivot_arm_a);
  const double slope = n.dot(velocity) - rounding_per_time_ - kRounding * greatest_speed_;
  const double error = rounding(now.t);
  return last_positive(
      [&](double s) { return value + s * slope - 0.5 * s * s * greatest_acceleration_ - error; },
      longest);
}

double MovingPair::safe_step(const PairAt& now, const Vec3& normal, double longest) const noexcept {
  const Vec3 &wa = motion_a_.angular_velocity, &wb = motion_b_.angular_velocity;
  double step = safe_step_of_spheres(now, longest);
  step = std::max(step, safe_step(now, normal, Vec3::Zero(), longest));
  if (wa != Vec3::Zero()) step = std::max(step, safe_step(now, normal, wa, longest));
  if (wb != Vec3::Zero()) step = std::max(step, safe_step(now, normal, wb, longest));
  return step;
}

}  // namespace tangency::detail
