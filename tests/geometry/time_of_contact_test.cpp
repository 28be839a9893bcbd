// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmpxx.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <tuple>

#include <tangency/geometry/bodies/moving_pair.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/time_of_contact.hpp>
#include <tangency/tests/support/generators.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/oracles/time_of_contact.hpp>

namespace tangency {
namespace {

using Eigen::Quaterniond;
using Status = ContactTimeStatus;

constexpr double kTolerance = 1e-9;

Ellipsoid sphere(const Vec3& centre, double radius) { return {centre, Vec3::Constant(radius)}; }
Motion flight(const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  return {velocity, spin, Vec3::Zero()};
}

void expect_contact_at(const TimeOfContact& found, double time, double tolerance) {
  EXPECT_EQ(found.status, Status::contact);
  EXPECT_LE(found.time, time);
  EXPECT_GE(found.latest, time);
  EXPECT_LE(found.latest, found.time + tolerance);
}

TEST(TimeOfContact, OfSpheresHeadOnIsTheDistanceOverTheSpeed) {
  const Ellipsoid a = sphere({0, 0, 0}, 1), b = sphere({10, 0, 0}, 2);
  expect_contact_at(time_of_contact(a, {}, b, flight({-2, 0, 0}), 10, kTolerance), 3.5, kTolerance);
  expect_contact_at(
      time_of_contact(a, flight({1, 0, 0}), b, flight({-2.5, 0, 0}, {0, 5, 0}), 10, kTolerance), 2,
      kTolerance);
}

TEST(TimeOfContact, LatestIsNoFurtherThanTheToleranceExactly) {
  // time + tolerance is rounded: up in half of all cases.
  const Ellipsoid a = sphere({0, 0, 0}, 1);
  for (int i = 0; i < 200; ++i) {
    const Ellipsoid b = sphere({3.1 + 0.01 * i, 0.1, 0}, 2);
    const double tolerance = 1e-9 * (1 + 0.37 * i);
    const TimeOfContact found = time_of_contact(a, {}, b, flight({-1, 0, 0}), 10, tolerance);
    ASSERT_EQ(found.status, Status::contact);
    EXPECT_LE(mpq_class(found.latest) - mpq_class(found.time), mpq_class(tolerance)) << i;
  }
}

TEST(TimeOfContact, IsNoneUntilTheHorizonAndThenContact) {
  const Ellipsoid a = sphere({0, 0, 0}, 1), b = sphere({10, 0, 0}, 2);
  const Motion approach = flight({-2, 0, 0});
  const TimeOfContact before = time_of_contact(a, {}, b, approach, 3.499, kTolerance);
  EXPECT_EQ(before.status, Status::none);
  EXPECT_EQ(before.time, 3.499);
  EXPECT_NEAR(before.gap.gap, 0.002, 1e-12);
  expect_contact_at(time_of_contact(a, {}, b, approach, 3.501, kTolerance), 3.5, kTolerance);
  EXPECT_EQ(time_of_contact(a, {}, b, flight({2, 0, 0}), 1e6, kTolerance).status, Status::none);
}

TEST(TimeOfContact, CountsThePositionsLookedAt) {
  const Ellipsoid a = sphere({0, 0, 0}, 1), b = sphere({10, 0, 0}, 2);
  EXPECT_EQ(time_of_contact(a, {}, b, flight({2, 0, 0}), 1e6, kTolerance).steps, 1);
  EXPECT_EQ(time_of_contact(a, {}, b, flight({-2, 0, 0}), 3, kTolerance).steps, 1);
  EXPECT_EQ(time_of_contact(a, {}, a, flight({-2, 0, 0}), 3, kTolerance).steps, 1);
}

TEST(TimeOfContact, GrazingSpheresAreToldApartByTheirLeastDistance) {
  const Ellipsoid a = sphere({0, 0, 0}, 1);
  for (const double least : {1e-3, 1e-9, 1e-12}) {
    const Ellipsoid past = sphere({-5, 2 + least, 0}, 1), through = sphere({-5, 2 - least, 0}, 1);
    const Motion motion = flight({1, 0, 0});
    EXPECT_EQ(time_of_contact(a, {}, past, motion, 10, 1e-9).status, Status::none) << least;
    const double y = through.centre().y(), half = std::sqrt((2 - y) * (2 + y));
    // Closing at half / 2 when they meet: a tolerance in time that is above 2 resolution / that.
    expect_contact_at(time_of_contact(a, {}, through, motion, 10, 1e-6), 5 - half, 1e-6);
  }
}

TEST(TimeOfContact, PassThatRoundingHidesIsCalledGrazingAndIsNotLate) {
  const Ellipsoid a = sphere({0, 0, 0}, 1), b = sphere({-5, 2, 0}, 1);
  const TimeOfContact found = time_of_contact(a, {}, b, flight({1, 0, 0}), 10, 1e-9);
  EXPECT_EQ(found.status, Status::grazing);
  EXPECT_LE(found.time, 5);
  EXPECT_LE(found.gap.gap, found.resolution);
  EXPECT_LE(found.resolution, 2e-13);
}

TEST(TimeOfContact, StartThatTouchesOrOverlapsIsToldExactly) {
  const Ellipsoid a = sphere({0, 0, 0}, 1);
  const Motion away = flight({5, 0, 0});
  for (const double x : {0.0, 1.0, 2.999, 3.0}) {
    const TimeOfContact found = time_of_contact(a, {}, sphere({x, 0, 0}, 2), away, 10, 1e-6);
    EXPECT_EQ(found.status, Status::touching_at_start) << x;
    EXPECT_EQ(found.time, 0);
  }
  const Ellipsoid apart = sphere({std::nextafter(3.0, 4.0), 0, 0}, 2);
  EXPECT_NE(time_of_contact(a, {}, apart, away, 10, 1e-6).status, Status::touching_at_start);
}

TEST(TimeOfContact, LengthsOfTheAnswerFollowTheUnit) {
  const auto solve = [](double unit) {
    const Ellipsoid a({0, 0, 0}, unit * Vec3(1, 2, 3)),
        b(unit * Vec3(9, 1, 0), unit * Vec3(2, 1, 1));
    return time_of_contact(a, {}, b, flight(unit * Vec3(-1, 0, 0)), 10, kTolerance);
  };
  const TimeOfContact one = solve(1);
  ASSERT_EQ(one.status, Status::contact);
  EXPECT_LE(one.gap.gap_error, 16 * 0x1p-53 * 16);  // the gap's own promise, L below 16
  for (const int power : {-600, -3, 5, 600}) {
    const TimeOfContact other = solve(std::exp2(power));
    EXPECT_EQ(other.time, one.time) << power;
    EXPECT_EQ(std::scalbn(other.gap.gap, -power), one.gap.gap) << power;
    EXPECT_EQ(std::scalbn(other.gap.gap_error, -power), one.gap.gap_error) << power;
    EXPECT_EQ(std::scalbn(other.resolution, -power), one.resolution) << power;
  }
}

TEST(TimeOfContact, SpinningRodHitsWhenItsFlankDoes) {
  // A spheroid of semi-axes (3, 1, 1) turns about z; a small sphere waits beside it at (0, 2, 0).
  const Ellipsoid rod({0, 0, 0}, {3, 1, 1});
  const double r = 0.25;
  const TimeOfContact found =
      time_of_contact(rod, flight({0, 0, 0}, {0, 0, 1}), sphere({0, 2, 0}, r), {}, 3, kTolerance);
  ASSERT_EQ(found.status, Status::contact);
  const verify::MovingBody a{verify::to_raw(rod), {{}, {0, 0, 1}, {}}};
  const verify::MovingBody b{verify::to_raw(sphere({0, 2, 0}, r)), {}};
  const auto truth = verify::first_contact(a, b, 3, 1e-12);
  ASSERT_EQ(truth.status, verify::FirstContact::Status::contact);
  EXPECT_LE(found.time, truth.to);
  EXPECT_GE(found.time, truth.from - kTolerance);
}

TEST(TimeOfContact, OfAScrewIsWhereTheHelixComesNear) {
  // A sphere on a helix of radius 3 and rise 0.5 a radian about z meets one that waits on it.
  const Ellipsoid moving = sphere({3, 0, 0}, 1);
  const Motion motion = screw(moving, {0, 0, 7}, {0, 0, 2}, 1);
  const double there = 4.0;  // radians
  const Ellipsoid waiting = sphere({3 * std::cos(there), 3 * std::sin(there), 0.5 * there}, 1);
  double low = 0, high = there;  // of the angle still to go: 18 (1 - cos x) + x^2 / 4 = 4
  for (int i = 0; i < 100; ++i) {
    const double x = 0.5 * (low + high);
    (x < M_PI && 18 * (1 - std::cos(x)) + 0.25 * x * x < 4 ? low : high) = x;
  }
  // The constructed centre is rounded: 1e-15 of the distance, far below the tolerance.
  expect_contact_at(time_of_contact(moving, motion, waiting, {}, 10, kTolerance), (there - low) / 2,
                    kTolerance);
}

TEST(Moved, HalfTurnAboutAnOffsetAxisCarriesTheBodyAcross) {
  const Ellipsoid body({2, 0, 0}, {3, 2, 1}, Quaterniond(1, 0, 0, 0));
  const Motion motion = screw(body, {1, 0, 0}, {0, 0, M_PI}, 0.5);
  const Ellipsoid there = moved(body, motion, 1);
  EXPECT_LE((there.centre() - Vec3(0, 0, 0.5)).norm(), 1e-15);
  EXPECT_NEAR(there.level({3, 0, 0.5}), 1, 1e-14);
  EXPECT_NEAR(there.level({0, 2, 0.5}), 1, 1e-14);
}

TEST(TimeOfContact, DoesNotChangeWithAPowerOfTwoUnit) {
  const Ellipsoid a({0, 0, 0}, {1, 0.1, 0.5}, Quaterniond(0.3, -0.5, 0.1, 0.8));
  const Ellipsoid b({4, 0.3, 0}, {0.2, 2, 0.5}, Quaterniond(0.1, 0.5, 0.7, -0.2));
  const Motion ma = flight({1, 0, 0.1}, {0.3, 0.1, 2}), mb{{-1, 0, 0}, {0, 1, 1}, {0.1, 0, 0}};
  const TimeOfContact one = time_of_contact(a, ma, b, mb, 10, kTolerance);
  ASSERT_EQ(one.status, Status::contact);
  for (const double s : {0x1p-490, 0x1p490}) {
    const auto body = [&](const Ellipsoid& e) {
      return Ellipsoid(s * e.centre(), s * e.semi_axes(), e.orientation());
    };
    const auto motion = [&](const Motion& m) {
      return Motion{s * m.velocity, m.angular_velocity, s * m.pivot_arm};
    };
    const TimeOfContact other =
        time_of_contact(body(a), motion(ma), body(b), motion(mb), 10, kTolerance);
    EXPECT_EQ(other.time, one.time);
    EXPECT_EQ(other.gap.gap, s * one.gap.gap);
  }
}

TEST(TimeOfContact, AbsurdSpeedsEndInAStatus) {
  const Ellipsoid a({0, 0, 0}, {1, 0.1, 0.5}), b({4, 0, 0}, {1e-200, 1e-200, 1e-200});
  for (const double fast : {1e30, 1e150, 1e300}) {
    const TimeOfContact spinning =
        time_of_contact(a, flight({0, 0, 0}, {0, 0, fast}), b, flight({-1, 0, 0}), 10, 1e-6);
    EXPECT_LE(spinning.time, 3.9);
    EXPECT_NE(spinning.status, Status::none);
    const TimeOfContact flying = time_of_contact(a, {}, b, flight({-fast, 0, 0}), 10, 1e-6);
    EXPECT_LE(flying.time, 3 / fast);
    EXPECT_NE(flying.status, Status::none);
  }
}

// geometry/time_of_contact.hpp (5)
TEST(TimeOfContact, DoesNotChangeWithAPowerOfTwoUnitOfTimeOrLength) {
  const Ellipsoid a({0, 0, 0}, {1, 0.1, 0.5}, Quaterniond(0.3, -0.5, 0.1, 0.8));
  const Ellipsoid b({4, 0.3, 0}, {0.2, 2, 0.5}, Quaterniond(0.1, 0.5, 0.7, -0.2));
  const Motion ma = flight({0.1, 0, 0.1}, {0.3, 0.1, 2}), mb{{-0.1, 0, 0}, {0, 1, 1}, {0.1, 0, 0}};
  const TimeOfContact one = time_of_contact(a, ma, b, mb, 16, kTolerance);
  ASSERT_EQ(one.status, Status::contact);
  // Squares of these speeds are no doubles, or 0.
  for (const double s : {0x1p-1000, 0x1p-600, 0x1p600, 0x1p1000}) {
    const auto motion = [&](const Motion& m) {
      return Motion{m.velocity / s, m.angular_velocity / s, m.pivot_arm};
    };
    const TimeOfContact other =
        time_of_contact(a, motion(ma), b, motion(mb), s * 16, s * kTolerance);
    EXPECT_EQ(other.status, one.status) << s;
    EXPECT_EQ(other.time, s * one.time) << s;
    EXPECT_EQ(other.latest, s * one.latest) << s;
    EXPECT_EQ(other.gap.gap, one.gap.gap) << s;
  }
  for (const double s : {0x1p-300, 0x1p-20, 0x1p300}) {
    const auto body = [&](const Ellipsoid& e) {
      return Ellipsoid(s * e.centre(), s * e.semi_axes(), e.orientation());
    };
    const auto motion = [&](const Motion& m) {
      return Motion{s * m.velocity, m.angular_velocity, s * m.pivot_arm};
    };
    const TimeOfContact other =
        time_of_contact(body(a), motion(ma), body(b), motion(mb), 16, kTolerance);
    EXPECT_EQ(other.status, one.status) << s;
    EXPECT_EQ(other.time, one.time) << s;
    EXPECT_EQ(other.latest, one.latest) << s;
    EXPECT_EQ(other.gap.gap, s * one.gap.gap) << s;
  }
}

void expect_gap_at_start(const TimeOfContact& found, const Ellipsoid& a, const Ellipsoid& b) {
  const Gap start = signed_gap(a, b);
  EXPECT_LE(std::abs(found.gap.gap - start.gap), found.gap.gap_error + start.gap_error);
  EXPECT_NE(found.status, Status::contact);  // none of these is in contact at once
}

TEST(TimeOfContact, BodiesThatAreLostOnTheirWayAreSeenAtTheStart) {
  const Ellipsoid a({0, 0, 0}, {1, 2, 3}), b({10, 0, 0}, {1, 1, 2});
  const Vec3 across(1, 1, 1);
  const TimeOfContact fast =
      time_of_contact(a, flight(1e308 * across), b, flight({0, 0, 0}), 1e308, 1e-9);
  EXPECT_EQ(fast.status, Status::not_converged);
  expect_gap_at_start(fast, a, b);
  const TimeOfContact slow =
      time_of_contact(a, flight(1e160 * across), b, flight({0, 0, 0}), 1e299, 1e-9);
  EXPECT_EQ(slow.status, Status::not_converged);
  expect_gap_at_start(slow, a, b);
  const Ellipsoid grain({0, 0, 0}, 1e-300 * Vec3(1, 2, 3)),
      other({1e-299, 0, 0}, {1e-300, 1e-300, 2e-300});
  const TimeOfContact away =
      time_of_contact(grain, flight({-1e200, 0, 0}), other, flight({0, 0, 0}), 1, 1e-6);
  EXPECT_EQ(away.status, Status::not_converged);
  expect_gap_at_start(away, grain, other);
}

TEST(TimeOfContact, OfAnyFiniteMotionsIsAStatusThatHolds) {
  constexpr double kMost = std::numeric_limits<double>::max();
  const Ellipsoid a({0, 0, 0}, {1, 0.1, 0.5});
  const Ellipsoid apart({4, 0.3, 0}, {0.2, 2, 0.5}), tiny({4, 0, 0}, {1e-300, 1e-300, 1e-300});
  const Ellipsoid touching({2, 0, 0}, {1, 1, 1}), huge({0, 1e308, 0}, {1e307, 1e307, 1e307});
  for (const Ellipsoid& b : {apart, tiny, touching, huge}) {
    for (const double horizon : {kMost, 10.0, 1e-300, 5e-324, 0.0}) {
      for (unsigned which = 0; which < 64; ++which) {
        const auto part = [&](unsigned bit, double sign) -> Vec3 {
          return (which >> bit & 1) != 0 ? Vec3(sign * Vec3(kMost, -kMost, kMost)) : Vec3::Zero();
        };
        const Motion ma{part(0, 1), part(1, 1), part(2, 1)};
        const Motion mb{part(3, -1), part(4, 1), part(5, -1)};
        const TimeOfContact found = time_of_contact(a, ma, b, mb, horizon, 1e-6);
        EXPECT_EQ(found.status == Status::touching_at_start, b.centre().x() == 2) << which;
        EXPECT_TRUE(found.time >= 0.0 && found.time <= found.latest && found.latest <= horizon)
            << which << ' ' << horizon << ' ' << found.time << ' ' << found.latest;
        EXPECT_GE(found.resolution, 0.0) << which << ' ' << horizon;  // and a number
        if (found.time == 0.0) expect_gap_at_start(found, a, b);
        if (which != 0 && horizon != 0.0) continue;
        EXPECT_EQ(found.status,
                  b.centre().x() == 2 ? Status::touching_at_start : Status::none);  // at rest
      }
    }
  }
}

TEST(TimeOfContact, FlightBeyondTheSquaresOfDoublesIsFollowedAlongEveryAxis) {
  const Ellipsoid a({0, 0, 0}, {1, 1.5, 1.2});
  for (int k = 0; k < 3; ++k) {
    const Ellipsoid b(4 * Vec3::Unit(k), {1, 1, 1});
    const TimeOfContact away = time_of_contact(a, {}, b, flight(1e200 * Vec3::Unit(k)), 10, 1e-5);
    EXPECT_EQ(away.status, Status::none) << k;
    EXPECT_EQ(away.time, 10) << k;
    EXPECT_DOUBLE_EQ(away.gap.gap, 1e201) << k;
  }
}

TEST(TimeOfContact, TumblingThinDisksAreFollowedToTheirTouch) {
  const Ellipsoid a({0, 0, 0}, {1, 1, 1e-4}), b({0, 0.1, 0.5}, {1, 1, 1e-4});
  const TimeOfContact found = time_of_contact(a, flight({0, 0, 0}, {0.02, 0, 0}), b,
                                              flight({0, 0, -0.1}, {0, 0.03, 0}), 10, 1e-7);
  EXPECT_EQ(found.status, Status::contact);
  EXPECT_LE(found.latest, found.time + 1e-7);
  EXPECT_GE(found.gap.gap, 0);
}

struct Moving {
  Ellipsoid a, b;
  Motion ma, mb;
};

rc::Gen<Motion> motion() {
  return rc::gen::map(
      rc::gen::tuple(testing::direction(), testing::uniform(0, 3), testing::direction(),
                     testing::uniform(0, 3), testing::direction(), rc::gen::inRange(0, 3)),
      [](const std::tuple<Vec3, double, Vec3, double, Vec3, int>& t) {
        const auto& [v, speed, w, rate, arm, kind] = t;
        return Motion{speed * v, kind > 0 ? Vec3(rate * w) : Vec3(Vec3::Zero()),
                      kind > 1 ? arm : Vec3(Vec3::Zero())};
      });
}

/// Apart at the start, and on the way to each other more often than not.
rc::Gen<Moving> moving() {
  return rc::gen::map(
      rc::gen::tuple(testing::pair_at(30, testing::uniform(1.01, 4)), motion(), motion()),
      [](const std::tuple<testing::Pair, Motion, Motion>& t) {
        const auto& [p, ma, mb] = t;
        Motion towards = mb;
        const Vec3 d = p.b.centre() - p.a.centre();
        if (d.dot(mb.velocity - ma.velocity) > 0) towards.velocity = 2 * ma.velocity - mb.velocity;
        return Moving{p.a, p.b, ma, towards};
      });
}

void showValue(const Moving& m, std::ostream& os) {
  showValue(testing::Pair{m.a, m.b}, os);
  for (const Motion* x : {&m.ma, &m.mb}) {
    os << " v " << x->velocity.transpose() << " w " << x->angular_velocity.transpose() << " r "
       << x->pivot_arm.transpose();
  }
}

constexpr double kHorizon = 5, kCoarse = 1e-6;

TimeOfContact solve(const Moving& m, double horizon = kHorizon) {
  return time_of_contact(m.a, m.ma, m.b, m.mb, horizon, kCoarse);
}

/// Two answers about one motion, either of which may be early by the tolerance. A contact that only
/// one has can only be a graze.
bool agree(const TimeOfContact& x, const TimeOfContact& y) {
  if (x.status == Status::grazing || y.status == Status::grazing) return true;
  return x.status == y.status && std::abs(x.time - y.time) <= 2 * kCoarse;
}

RC_GTEST_PROP(TimeOfContactProperty, PairIsApartBeforeAndInContactByTheLatestTime, ()) {
  const Moving m = *moving();
  const TimeOfContact found = solve(m);
  RC_ASSERT(found.status != Status::not_converged);
  RC_ASSERT(found.time >= 0 && found.time <= found.latest && found.latest <= kHorizon);
  const auto at = [&](double t) {
    return signed_gap(moved(m.a, m.ma, t), moved(m.b, m.mb, t)).gap;
  };
  if (found.status != Status::touching_at_start) {
    for (int i = 0; i < 20; ++i) RC_ASSERT(at(found.time * i / 20) > 0);
  }
  if (found.status == Status::contact) RC_ASSERT(at(found.latest) < 0);
}

// geometry/time_of_contact.hpp (1)
RC_GTEST_PROP(TimeOfContactProperty, ExchangeLeavesStatusAndTime, ()) {
  const Moving m = *moving();
  RC_ASSERT(agree(solve(m), solve({m.b, m.a, m.mb, m.ma})));
}

// geometry/time_of_contact.hpp (2)
RC_GTEST_PROP(TimeOfContactProperty, CommonVelocityChangesNothing, ()) {
  const Moving m = *moving();
  const Vec3 v = *testing::uniform(0, 10) * *testing::direction();
  Moving other = m;
  other.ma.velocity += v, other.mb.velocity += v;
  RC_ASSERT(agree(solve(m), solve(other)));
}

// geometry/time_of_contact.hpp (3)
RC_GTEST_PROP(TimeOfContactProperty, IsNoEarlierThanTheGreatestClosingSpeedAllows, ()) {
  const Moving m = *moving();
  const TimeOfContact found = solve(m);
  RC_PRE(found.status == Status::contact);
  const auto speed = [](const Ellipsoid& e, const Motion& x) {
    return x.velocity.norm() +
           x.angular_velocity.norm() * (x.pivot_arm.norm() + e.largest_semi_axis());
  };
  const double greatest = speed(m.a, m.ma) + speed(m.b, m.mb);
  RC_ASSERT(found.latest * greatest >= signed_gap(m.a, m.b).gap * (1 - 1e-12));
}

// geometry/time_of_contact.hpp (4)
RC_GTEST_PROP(TimeOfContactProperty, LongerHorizonLeavesAContactWhereItIs, ()) {
  const Moving m = *moving();
  const TimeOfContact found = solve(m);
  RC_PRE(found.status == Status::contact);
  RC_ASSERT(agree(found, solve(m, 3 * kHorizon)));
}

RC_GTEST_PROP(MovingPairProperty, StepIsSafeAndTouchesNothingOnTheWay, ()) {
  const Moving m = *moving();
  const Vec3 d = m.b.centre() - m.a.centre();
  const detail::MovingPair pair(m.a, m.ma, m.b, m.mb, d);
  const detail::PairAt start = pair.at(0);
  // Any direction gives a safe step; most of them a short one.
  const Vec3 n =
      *testing::uniform(0, 1) < 0.3 ? *testing::direction() : signed_gap(m.a, m.b, d).normal;
  const double step = pair.safe_step(start, n, kHorizon);
  RC_ASSERT(step >= 0 && step <= kHorizon);
  if (step == 0) return;
  for (int i = 1; i <= 20; ++i) {
    const detail::PairAt now = pair.at(step * i / 20);
    RC_ASSERT(signed_gap(now.a, now.b, now.d).gap > -pair.rounding(now.t));
  }
}

}  // namespace
}  // namespace tangency
