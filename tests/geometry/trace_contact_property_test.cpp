// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbered identities of trace_contact.hpp.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/trace_contact.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using testing::Pair;

constexpr double kU = kUnitRoundoff;
constexpr double kAspect = 10;

double size_of(const Pair& p) {
  return (p.b.centre() - p.a.centre()).norm() + p.a.largest_semi_axis() + p.b.largest_semi_axis();
}

/// Overlapping by a part in 10^4 of the distance of centres to most of it.
rc::Gen<Pair> overlapping() {
  return testing::pair_at(
      kAspect, rc::gen::map(testing::log_uniform(1e-4, 0.5), [](double part) { return 1 - part; }));
}

/// How far rounding of bodies may move an answer: the limits of the angles move by rounding over
/// half of the arc they limit, and with them the normal.
double moving(const Pair& p, const TraceContact& t) {
  const double arc = (t.corners[2] - t.corners[1]).norm();
  const double around = std::min(arc, (t.corners[1] - t.corners[0]).norm());
  return 1000 * kAspect * kAspect * kU * (size_of(p) + p.a.centre().norm() + p.b.centre().norm()) *
         size_of(p) / around;
}

/// The same curve was cut, so that only rounding lies between the two.
bool comparable(const TraceContact& s, const TraceContact& t) {
  return s.status == TraceStatus::ok && t.status == TraceStatus::ok && s.curves == t.curves &&
         s.cone == t.cone && s.other_pole == t.other_pole;
}

RC_GTEST_PROP(TraceContactProperty, AnswersOverlapWithANegativeGapAndNothingElse, ()) {
  const Pair p = *testing::pair(kAspect);
  const TraceContact t = trace_contact(p.a, p.b);
  const bool overlap = relation(p.a, p.b).relation == Relation::overlap;
  RC_ASSERT((t.status == TraceStatus::not_overlapping) == !overlap);
  RC_ASSERT((t.status == TraceStatus::ok) == (t.gap < 0));
  RC_ASSERT((t.status == TraceStatus::ok) == (t.normal != Vec3::Zero()));
}

// geometry/trace_contact.hpp (1)
RC_GTEST_PROP(TraceContactProperty, PointsAreOnTheSurfacesAndApartByTheGapAlongTheNormal, ()) {
  const Pair p = *overlapping();
  const TraceContact t = trace_contact(p.a, p.b);
  RC_CLASSIFY(t.status == TraceStatus::ok);
  if (t.status != TraceStatus::ok) return;
  const Vec3 d = p.b.centre() - p.a.centre();
  const double rounding = 64 * kAspect * kU * size_of(p);
  RC_ASSERT(std::abs(t.normal.norm() - 1) <= 8 * kU);
  RC_ASSERT((d + t.arm_b - t.arm_a - t.gap * t.normal).norm() <= rounding);
  const auto off_surface = [](const Ellipsoid& e, const Vec3& arm) {
    return std::abs(e.moved_to(Vec3::Zero()).level(arm) - 1);
  };
  RC_ASSERT(off_surface(p.a, t.arm_a) <= rounding * kAspect / p.a.largest_semi_axis());
  // Where the line grazes B the point is as ill-determined as the root of its quadratic.
  RC_ASSERT(off_surface(p.b, t.arm_b) <= rounding * kAspect / p.b.smallest_semi_axis());
  for (const Vec3& corner : t.corners) {
    RC_ASSERT(off_surface(p.a, corner) <= rounding * kAspect / p.a.largest_semi_axis());
  }
}

RC_GTEST_PROP(TraceContactProperty, CornersAreCoplanarAcrossTheNormal, ()) {
  const Pair p = *overlapping();
  const TraceContact t = trace_contact(p.a, p.b);
  if (t.status != TraceStatus::ok) return;
  for (const Vec3& corner : t.corners) {
    RC_ASSERT(std::abs(t.normal.dot(corner - t.corners[0])) <= 64 * kAspect * kU * size_of(p));
  }
}

// geometry/trace_contact.hpp (2)
RC_GTEST_PROP(TraceContactProperty, CommonMotionCarriesItAlong, ()) {
  const Pair p = *overlapping();
  const Eigen::Quaterniond q = (*testing::orientation()).normalized();
  const Vec3 shift = *testing::direction();
  const auto moved = [&](const Ellipsoid& e) {
    return Ellipsoid(q * e.centre() + shift, e.semi_axes(), q * e.orientation().normalized());
  };
  const TraceContact before = trace_contact(p.a, p.b),
                     after = trace_contact(moved(p.a), moved(p.b));
  RC_CLASSIFY(comparable(before, after));
  if (!comparable(before, after) || moving(p, before) > 1e-6) return;
  RC_ASSERT(std::abs(after.gap - before.gap) <= moving(p, before));
  RC_ASSERT((after.normal - q * before.normal).norm() <= moving(p, before));
  RC_ASSERT((after.arm_a - q * before.arm_a).norm() <= moving(p, before));
  RC_ASSERT((after.arm_b - q * before.arm_b).norm() <= moving(p, before));
}

// geometry/trace_contact.hpp (2)
RC_GTEST_PROP(TraceContactProperty, ScalingByAPowerOfTwoScalesIt, ()) {
  const Pair p = *overlapping();
  const double s = std::exp2(*rc::gen::inRange(-900, 900));
  const auto scaled = [&](const Ellipsoid& e) {
    return Ellipsoid(s * e.centre(), s * e.semi_axes(), e.orientation());
  };
  const TraceContact before = trace_contact(p.a, p.b);
  const TraceContact after = trace_contact(scaled(p.a), scaled(p.b));
  RC_ASSERT(before.status == after.status);
  RC_ASSERT(after.gap / s == before.gap);
  RC_ASSERT(after.normal == before.normal);
  RC_ASSERT(after.arm_a / s == before.arm_a);
}

// geometry/trace_contact.hpp (3)
RC_GTEST_PROP(TraceContactProperty, LabelsAndHalfTurnsOfAxesLeaveIt, ()) {
  const Pair p = *overlapping();
  // Axis k becomes axis k + 1: the same solid after a turn by a third about the body's diagonal.
  const auto relabelled = [](const Ellipsoid& e, int half_turn) {
    const Vec3& r = e.semi_axes();
    const Eigen::Quaterniond third(0.5, 0.5, 0.5, 0.5);
    Eigen::Quaterniond turn(0, 0, 0, 0);
    turn.coeffs()[half_turn] = 1;  // about x, y or z; 3: none
    return Ellipsoid(e.centre(), {r[1], r[2], r[0]}, e.orientation() * third * turn);
  };
  const Pair other{relabelled(p.a, *rc::gen::inRange(0, 4)),
                   relabelled(p.b, *rc::gen::inRange(0, 4))};
  const Vec3 x = p.a.rotation().col(0) * p.a.semi_axes()[0];
  RC_ASSERT((other.a.rotation().col(2) * other.a.semi_axes()[2]).cross(x).norm() <=
            64 * kU * x.squaredNorm());
  const TraceContact before = trace_contact(p.a, p.b), after = trace_contact(other.a, other.b);
  RC_CLASSIFY(comparable(before, after));
  if (!comparable(before, after) || moving(p, before) > 1e-6) return;
  RC_ASSERT(std::abs(after.gap - before.gap) <= moving(p, before));
  RC_ASSERT((after.normal - before.normal).norm() <= moving(p, before));
}

// geometry/trace_contact.hpp (3)
RC_GTEST_PROP(TraceContactProperty, TurnAboutAnAxisOfSymmetryLeavesIt, ()) {
  const Pair drawn = *overlapping();
  const double angle = *testing::uniform(-3, 3);
  const int axis = *rc::gen::inRange(0, 3);
  const auto spheroid = [&](double turn) {
    Vec3 r = Vec3::Constant(drawn.a.semi_axes()[1]);
    r[axis] = drawn.a.semi_axes()[0];
    const Eigen::Quaterniond q(Eigen::AngleAxisd(turn, Vec3::Unit(axis)));
    return Ellipsoid(drawn.a.centre(), r, drawn.a.orientation() * q);
  };
  const Pair p{spheroid(0), drawn.b};
  const TraceContact before = trace_contact(p.a, p.b);
  const TraceContact after = trace_contact(spheroid(angle), p.b);
  RC_CLASSIFY(comparable(before, after));
  if (!comparable(before, after) || moving(p, before) > 1e-6) return;
  RC_ASSERT(std::abs(after.gap - before.gap) <= moving(p, before));
  RC_ASSERT((after.normal - before.normal).norm() <= moving(p, before));
}

// geometry/trace_contact.hpp (4)
RC_GTEST_PROP(TraceContactProperty, OfSpheresItIsTheSignedGap, ()) {
  const Pair drawn = *overlapping();
  const auto sphere = [](const Ellipsoid& e) {
    return Ellipsoid(e.centre(), Vec3::Constant(e.semi_axes()[0]), e.orientation());
  };
  const Pair p{sphere(drawn.a), sphere(drawn.b)};
  const TraceContact t = trace_contact(p.a, p.b);
  RC_CLASSIFY(t.status == TraceStatus::ok);
  if (t.status != TraceStatus::ok) return;
  const Gap exact = signed_gap(p.a, p.b);
  RC_ASSERT(std::abs(t.gap - exact.gap) <= moving(p, t));
  RC_ASSERT((t.normal - exact.normal).norm() <= moving(p, t));
}

}  // namespace
}  // namespace tangency
