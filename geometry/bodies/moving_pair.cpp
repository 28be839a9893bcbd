// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/moving_pair.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <tangency/geometry/numbers/double_double.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr double kRounding = 64 * kUnitRoundoff;  // docs/derivations/time-of-contact.md, section 3
constexpr double kInflated = 1 + 0x1p-40;         // of second derivatives, for their own rounding
constexpr double kFarEnough = 0.95;  // chosen: of the longest step that the bound allows
constexpr int kRefinements = 100;    // of its bracket, which is halved each time

/// |w|, also where its square is no number.
double length(const Vec3& w) {
  const double square = w.squaredNorm();
  return square > 0x1p-900 && square < 0x1p900 ? std::sqrt(square) : w.stableNorm();
}

/// A rate w of turning by its speed and the axis, unit or 0.
struct Spin {
  double speed;
  Vec3 axis;
};

Spin spin_of(const Vec3& w) {
  const double speed = length(w);
  if (speed == 0.0) return {0.0, Vec3::Zero()};
  const bool plain = speed > 0x1p-450 && speed < 0x1p450;
  return {speed, plain ? Vec3(w / speed) : Vec3(w.stableNormalized())};
}

/// exp(t [w]x) as a unit quaternion.
Quaternion turn(const Vec3& w, double t) {
  const Spin spin = spin_of(w);
  const double half = 0.5 * spin.speed * t;
  if (half == 0.0) return Quaternion::Identity();
  const Vec3 axis = std::sin(half) * spin.axis;
  return {std::cos(half), axis.x(), axis.y(), axis.z()};
}

/// (exp(t [w]x) - 1) r without cancellation for a small turn.
Vec3 displacement(const Vec3& w, double t, const Vec3& r) {
  if (t == 0.0 || r == Vec3::Zero()) return Vec3::Zero();
  const Spin spin = spin_of(w);
  const double angle = spin.speed * t;
  if (angle == 0.0) return Vec3::Zero();
  const Vec3 across = spin.axis.cross(r);
  const double s = std::sin(0.5 * angle);
  return std::sin(angle) * across + 2.0 * s * s * spin.axis.cross(across);
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
  double slope_at(double s) const {
    const double value = at(s);
    return value > 0.0 ? 0.5 * (c1 + 2.0 * s * c2) / value : 0.0;
  }
};

/// A body in a direction n, before either turns.
struct Facing {
  const Mat3& factor;
  const Vec3& spin;
  const ShapeReach& shape;
  Vec3 y;  ///< diag(a) R'n
  double square;

  Facing(const Mat3& of_factor, const Vec3& of_spin, const ShapeReach& of_shape, const Vec3& n)
      : factor(of_factor),
        spin(of_spin),
        shape(of_shape),
        y(of_factor.transpose() * n),
        square(y.squaredNorm()) {}

  /// Where n turns at v.
  Reach reach(const Vec3& n, const Vec3& v) const {
    if (v == spin) return {square, 0.0, 0.0};
    const Vec3 relative = v - spin;
    const Vec3 dy = factor.transpose() * relative.cross(n);
    const double speed = relative.norm();
    return {square, 2.0 * y.dot(dy),
            kInflated * shape.spread * speed * (speed + spin.norm() + v.norm())};
  }
};

/// The largest step found at which a concave function with bound(low) > 0 is still > 0.
template <class Bound>
double last_positive(const Bound& bound, double low, double longest) {
  double at_low = bound(low), high = longest, at_high = bound(longest);
  if (at_high > 0.0) return longest;
  for (int i = 0; i < kRefinements && low < kFarEnough * high; ++i) {
    // A tangent of a concave function crosses zero after the function does, a chord before it; the
    // midpoint brings the ends in where the tangent is flat.
    const double slope = bound.slope_at(low);
    const double tangent = slope < 0.0 ? low - at_low / slope : high;
    const double first = tangent < high ? tangent : 0.5 * (low + high);
    for (int k = 0; k < 2; ++k) {
      const double s = k == 0 ? first : low + (high - low) * (at_low / (at_low - at_high));
      if (!(s > low && s < high)) continue;
      const double value = bound(s);
      (value > 0.0 ? low : high) = s;
      (value > 0.0 ? at_low : at_high) = value;
    }
  }
  return low;
}

double path_size(const ShapeReach& body, const Motion& motion) {
  return body.largest + 2.0 * motion.pivot_arm.norm();
}

ShapeReach reach(const Ellipsoid& body) {
  const double most = body.largest_semi_axis(), least = body.smallest_semi_axis();
  return {most, (most - least) * (most + least)};
}

/// R diag(a)
Mat3 factor(const Ellipsoid& body) { return body.rotation() * body.semi_axes().asDiagonal(); }

/// R(q/|q|) in double: (Q) of docs/derivations/gap-batch.md.
Mat3 matrix(const Quaternion& q) {
  const double ww = q.w() * q.w(), xx = q.x() * q.x(), yy = q.y() * q.y(), zz = q.z() * q.z();
  const double once = 1.0 / ((ww + xx) + (yy + zz)), twice = 2.0 * once;
  const auto beside = [&](double a, double b, double c, double d) {
    return (a * b + c * d) * twice;
  };
  Mat3 r;
  r << ((ww + xx) - (yy + zz)) * once, beside(q.x(), q.y(), -q.w(), q.z()),
      beside(q.x(), q.z(), q.w(), q.y()), beside(q.x(), q.y(), q.w(), q.z()),
      ((ww + yy) - (zz + xx)) * once, beside(q.y(), q.z(), -q.w(), q.x()),
      beside(q.x(), q.z(), -q.w(), q.y()), beside(q.y(), q.z(), q.w(), q.x()),
      ((ww + zz) - (xx + yy)) * once;
  return r;
}

Mat3 turned(const Mat3& factor, const Vec3& w, double t) {
  if (t == 0.0 || w == Vec3::Zero()) return factor;
  return matrix(turn(w, t)) * factor;
}

}  // namespace

double at_most_after(double from, double by) noexcept {
  const DoubleDouble sum = two_sum(from, by);
  return sum.low < 0.0 ? std::nextafter(sum.high, 0.0) : sum.high;
}

/// A lower bound, concave in s, of n(s).d(s) - h_A - h_B less what all of it may be off.
struct MotionBounds::Bound {
  double value, slope, fall, growth, error;
  Reach a, b;

  double operator()(double s) const {
    return value + s * slope - s * s * (fall + s * growth) - a.at(s) - b.at(s) - error;
  }
  double slope_at(double s) const {
    return slope - s * (2.0 * fall + 3.0 * s * growth) - a.slope_at(s) - b.slope_at(s);
  }
  bool positive_throughout(double span) const { return (*this)(0.0) > 0.0 && (*this)(span) > 0.0; }
};

MotionBounds::MotionBounds(const ShapeReach& a, const Motion& motion_a, const ShapeReach& b,
                           const Motion& motion_b, const Vec3& separation) noexcept
    : a_(a), b_(b), motion_a_(motion_a), motion_b_(motion_b), separation_(separation) {
  const double wa = length(motion_a.angular_velocity), wb = length(motion_b.angular_velocity);
  const double ra = motion_a.pivot_arm.norm(), rb = motion_b.pivot_arm.norm();
  const double size_a = path_size(a, motion_a), size_b = path_size(b, motion_b);
  const double speed = motion_a.velocity.norm() + motion_b.velocity.norm();
  greatest_speed_ = kInflated * (speed + wa * ra + wb * rb);
  greatest_acceleration_ = kInflated * (wa * wa * ra + wb * wb * rb);
  rounding_at_start_ = kRounding * (separation.norm() + size_a + size_b);
  rounding_per_time_ = kRounding * (speed + wa * size_a + wb * size_b);
}

void MotionBounds::place(PairMoment& moment) const noexcept {
  const double t = moment.t;
  const Vec3 shift_a = displacement(motion_a_.angular_velocity, t, motion_a_.pivot_arm);
  const Vec3 shift_b = displacement(motion_b_.angular_velocity, t, motion_b_.pivot_arm);
  moment.d = separation_ + t * (motion_b_.velocity - motion_a_.velocity) + (shift_b - shift_a);
  moment.pivot_arm_a = motion_a_.pivot_arm + shift_a;
  moment.pivot_arm_b = motion_b_.pivot_arm + shift_b;
}

PairMoment MotionBounds::at(double t, const Mat3& factor_a, const Mat3& factor_b) const noexcept {
  PairMoment moment{t,
                    turned(factor_a, motion_a_.angular_velocity, t),
                    turned(factor_b, motion_b_.angular_velocity, t),
                    {},
                    {},
                    {}};
  place(moment);
  return moment;
}

double MotionBounds::rounding(double t) const noexcept {
  return rounding_at_start_ + t * rounding_per_time_;
}

Vec3 MotionBounds::velocity(const Vec3& pivot_arm_a, const Vec3& pivot_arm_b) const noexcept {
  return motion_b_.velocity + motion_b_.angular_velocity.cross(pivot_arm_b) - motion_a_.velocity -
         motion_a_.angular_velocity.cross(pivot_arm_a);
}

/// A direction that is apart now, and what its bounds have in common.
struct MotionBounds::Looking {
  const MotionBounds& of;
  const PairMoment& now;
  const Vec3& normal;
  Vec3 velocity;
  double distance, error;
  Facing a, b;

  Looking(const MotionBounds& bounds, const PairMoment& moment, const Vec3& n)
      : of(bounds),
        now(moment),
        normal(n),
        velocity(bounds.velocity(moment.pivot_arm_a, moment.pivot_arm_b)),
        distance(moment.d.norm()),
        error(bounds.rounding(moment.t)),
        a(moment.factor_a, bounds.motion_a_.angular_velocity, bounds.a_, n),
        b(moment.factor_b, bounds.motion_b_.angular_velocity, bounds.b_, n) {}

  /// Where the direction turns at that rate.
  Bound turning(const Vec3& rate) const {
    const double w = rate.norm();
    const double slope = normal.dot(velocity) + rate.cross(normal).dot(now.d);
    const double fall =
        kInflated * 0.5 *
        (w * w * distance + 2.0 * w * of.greatest_speed_ + of.greatest_acceleration_);
    const double growth = kInflated * 0.5 * w * w * of.greatest_speed_;
    // A direction that turns with one body turns about the other (section 3 there).
    double off = error, turned = 0.0;
    for (const Facing* body : {&a, &b}) {
      if (rate == body->spin) continue;
      off += kRounding * body->shape.largest;
      turned += 2.0 * (rate - body->spin).norm() * body->shape.largest;
    }
    const double error_rate =
        of.rounding_per_time_ + kRounding * (of.greatest_speed_ + w * distance + turned);
    return {normal.dot(now.d),     slope - error_rate,   fall, growth, off,
            a.reach(normal, rate), b.reach(normal, rate)};
  }
  /// Of balls, along d.
  Bound balls() const {
    const double value = distance - of.a_.largest - of.b_.largest;
    if (!(value > error)) return {-1.0, 0.0, 0.0, 0.0, 0.0, {}, {}};
    const double slope =
        (now.d / distance).dot(velocity) - of.rounding_per_time_ - kRounding * of.greatest_speed_;
    return {value, slope, 0.5 * of.greatest_acceleration_, 0.0, error, {}, {}};
  }
};

bool MotionBounds::balls_apart_throughout(double span) const noexcept {
  const Vec3 rate = velocity(motion_a_.pivot_arm, motion_b_.pivot_arm);
  const double square = rate.squaredNorm(), along = -rate.dot(separation_);
  double nearest = 0.0;
  if (along > 0.0 && square > 0.0) nearest = std::min(along / square, span);
  // The direction in which the way, straightened, comes nearest: any is right.
  const Vec3 there = separation_ + nearest * rate;
  const double distance = there.norm();
  if (!(distance > 0.0)) return false;
  const Vec3 n = there / distance;
  const Bound bound{n.dot(separation_) - a_.largest - b_.largest,
                    n.dot(rate) - rounding_per_time_ - kRounding * greatest_speed_,
                    0.5 * greatest_acceleration_,
                    0.0,
                    rounding_at_start_,
                    {},
                    {}};
  return bound.positive_throughout(span);
}

double MotionBounds::safe_step(const PairMoment& now, const Vec3& normal,
                               double longest) const noexcept {
  const Vec3 &wa = motion_a_.angular_velocity, &wb = motion_b_.angular_velocity;
  const Looking looking(*this, now, normal);
  std::array<Bound, 4> bounds;
  std::size_t count = 0;
  const auto reaches = [&](const Bound& bound) {
    bounds[count++] = bound;
    return bound.positive_throughout(longest);
  };
  if (reaches(looking.turning(Vec3::Zero())) ||
      (wa != Vec3::Zero() && reaches(looking.turning(wa))) ||
      (wb != Vec3::Zero() && reaches(looking.turning(wb))) || reaches(looking.balls()))
    return longest;
  double step = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    // One that does not reach as far as another does is no longer.
    if (bounds[i].positive_throughout(step)) step = last_positive(bounds[i], step, longest);
  }
  return step;
}

MovingPair::MovingPair(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b,
                       const Motion& motion_b, const Vec3& separation) noexcept
    : a_(a.moved_to(Vec3::Zero())),
      b_(b.moved_to(Vec3::Zero())),
      bounds_(reach(a), motion_a, reach(b), motion_b, separation) {}

PairAt MovingPair::at(double t) const noexcept {
  PairMoment moment;
  moment.t = t;
  bounds_.place(moment);
  return {t,
          turned(a_, bounds_.motion_a().angular_velocity, t),
          turned(b_, bounds_.motion_b().angular_velocity, t),
          moment.d,
          moment.pivot_arm_a,
          moment.pivot_arm_b};
}

double MovingPair::safe_step(const PairAt& now, const Vec3& normal, double longest) const noexcept {
  return bounds_.safe_step(
      {now.t, factor(now.a), factor(now.b), now.d, now.pivot_arm_a, now.pivot_arm_b}, normal,
      longest);
}

}  // namespace tangency::inline v0::detail
