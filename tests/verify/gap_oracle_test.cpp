// SPDX-License-Identifier: GPL-3.0-or-later
//
// The gap oracle against pairs worked out by hand, against contacts manufactured in 150 digits by
// formulas of this file, against the exact relation, and against itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>

#include <tangency/tests/verify/raw_sampler.hpp>
#include <tangency/verify/oracles/gap.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::verify {
namespace {

// What gap.hpp promises, in units of the extent of a pair.
const Real kGapError("1e-140");
// Chosen: the normal and the witness points have no bound of their own.
const Real kNormalError("1e-90");

Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Real3 plus(const Real3& a, const Real& s, const Real3& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

Real length(const Real3& a) { return sqrt(dot(a, a)); }

Real largest(const RealEllipsoid& e) { return *std::ranges::max_element(e.semi_axes); }

Real extent(const RealEllipsoid& a, const RealEllipsoid& b) {
  return length(plus(b.centre, -1, a.centre)) + largest(a) + largest(b);
}

Real least_radius(const RealEllipsoid& e) {
  const Real least = *std::ranges::min_element(e.semi_axes);
  return least * least / largest(e);
}

void expect_near(const Real& found, const Real& expected, const Real& tolerance) {
  EXPECT_LE(abs(found - expected), tolerance) << found.str(40) << " for " << expected.str(40);
}

void expect_gap(const RawEllipsoid& a, const RawEllipsoid& b, const Real& expected) {
  const GapTruth truth = signed_gap(a, b);
  expect_near(truth.gap, expected, kGapError * extent(real(a), real(b)));
}

RawEllipsoid ball(double x, double radius) { return {{x, 0, 0}, {radius, radius, radius}}; }

// v turned by q/|q|: q v q* / |q|^2 by the cross products of Rodrigues' formula.
Real3 turned(const std::array<Real, 4>& q, const Real3& v) {
  const auto cross = [](const Real3& a, const Real3& b) -> Real3 {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Real3 u{q[1], q[2], q[3]};
  const Real3 uv = cross(u, v);
  const Real twice = 2 / (q[0] * q[0] + dot(u, u));
  return plus(plus(v, twice * q[0], uv), twice, cross(u, uv));
}

// Support point on the side of n, relative to the centre.
Real3 reach(const RealEllipsoid& e, const Real3& n) {
  const auto& [w, x, y, z] = e.orientation;
  Real3 along = turned({w, -x, -y, -z}, n);
  for (std::size_t k = 0; k < 3; ++k) along[k] *= e.semi_axes[k];
  const Real h = length(along);
  for (std::size_t k = 0; k < 3; ++k) along[k] *= e.semi_axes[k] / h;
  return turned(e.orientation, along);
}

class Sampler : public RawSampler {
 public:
  using RawSampler::RawSampler;

  Real3 direction() {
    const auto v = vector();
    const Real3 n{v[0], v[1], v[2]};
    return plus({}, 1 / length(n), n);
  }
};

TEST(GapOracle, OfSpheresIsTheDistanceOfCentresLessTheRadii) {
  expect_gap(ball(0, 1), ball(4, 2), 1);
  expect_gap(ball(0, 1), ball(-3, 2), 0);
  expect_gap(ball(0, 1), ball(0.25, 2), -2.75);
  expect_gap(ball(0x1p-500, 0x1p-501), ball(0, 0x1p-502), Real(0x1p-502));
  expect_gap({{0, 0, 0}, {1, 1, 1}}, {{1, 2, 2}, {0.5, 0.5, 0.5}}, 1.5);
  EXPECT_TRUE(signed_gap(ball(0, 1), ball(0.25, 2)).global);
}

TEST(GapOracle, OfConcentricSpheresIsTheSumOfTheRadii) {
  expect_gap(ball(3, 1), ball(3, 2), -3);
  EXPECT_TRUE(signed_gap(ball(3, 1), ball(3, 2)).global);
}

TEST(GapOracle, OfAlignedBodiesAlongAnAxisIsThatOfTheirVertices) {
  expect_gap({{0, 0, 0}, {2, 3, 4}}, {{10, 0, 0}, {3, 1, 7}}, 5);
  expect_gap({{0, 0, 0}, {2, 3, 4}}, {{0, -4, 0}, {3, 1, 7}}, 0);
  expect_gap({{0, 0, 0}, {1, 1e8, 1}}, {{0, 0, 3}, {1e8, 1, 1e-8}}, Real(2) - Real(1e-8));
  expect_gap({{0, 0, 0}, {2, 3, 4}}, {{0, 0, 4.75}, {3, 1, 1}}, -0.25);
}

// |diag(a) n| + |diag(b) n| >= |diag(a + b) n|, with equality along the axes.
TEST(GapOracle, OfConcentricAlignedBodiesIsTheLeastSumOfTheirAxes) {
  expect_gap({{1, 2, 3}, {2, 3, 4}}, {{1, 2, 3}, {3, 1, 7}}, -4);
  expect_gap({{1, 2, 3}, {20, 30, 4}}, {{1, 2, 3}, {3, 1, 7}}, -11);
  expect_gap({{1, 2, 3}, {2, 3, 4}}, {{1, 2, 3}, {2, 3, 4}}, -4);
}

// n = (3, 4, 0)/5 meets A in (75, 16, 0).
TEST(GapOracle, OfAnEllipsoidAndASphereOnItsNormalIsTheRestOfTheWay) {
  const RawEllipsoid a{{1, 1, 1}, {85, 34, 50}};
  for (const double steps : {1e-20, 0.5, 1.0, 1e6}) {
    const RawEllipsoid b{{76 + 3 * steps, 17 + 4 * steps, 1}, {0x1p-40, 0x1p-40, 0x1p-40}};
    const RealEllipsoid centred{
        {76 + 3 * Real(steps), 17 + 4 * Real(steps), 1}, {0x1p-40, 0x1p-40, 0x1p-40}, {1, 0, 0, 0}};
    const Real expected = 5 * Real(steps) - Real(0x1p-40);
    const GapTruth truth = signed_gap(real(a), centred);
    expect_near(truth.gap, expected, kGapError * extent(real(a), centred));
    expect_near(truth.normal[0], Real(3) / 5, kNormalError);
    EXPECT_TRUE(truth.global);
    if (steps >= 0.5) expect_gap(a, b, expected);
  }
}

// f depends on c = n_z alone: d c - 2 sqrt(1 + 24 c^2), greatest where d^2 = 48^2 c^2/(1 + 24 c^2).
TEST(GapOracle, OfCoaxialSpheroidsIsRightThoughACircleOfNormalsTies) {
  const double d = 0.5;
  const Real c = d / sqrt(Real(2304 - 24 * d * d));
  expect_gap({{0, 0, 0}, {1, 1, 5}}, {{0, 0, d}, {1, 1, 5}}, c * (d - 96 / d));
  expect_gap({{0, 0, 0}, {1, 1, 5}}, {{0, 0, 0}, {1, 1, 5}}, -2);
}

TEST(GapOracle, IsThatOfTheManufacturedContact) {
  Sampler sample(20261122);
  for (int i = 0; i < 1500; ++i) {
    const double hard = i % 3 == 0 ? 5 : (i % 3 == 1 ? 1e3 : 1e8);
    const RealEllipsoid a = real(sample.body(1, sample.log_uniform(1, hard)));
    RealEllipsoid b =
        real(sample.body(sample.log_uniform(1 / hard, hard), sample.log_uniform(1, hard)));
    const Real3 n = sample.direction();
    const Real rho = least_radius(a) + least_radius(b);
    const Real gaps[] = {rho * sample.log_uniform(1e-24, 0.5),
                         -rho * sample.log_uniform(1e-24, 0.99),
                         largest(a) * sample.log_uniform(1e-24, 1e6), Real(0)};
    const Real gap = gaps[sample.uniform(0, 1) < 0.1 ? 3
                          : i % 3 == 2               ? 1
                                                     : static_cast<std::size_t>(i / 3 % 3)];
    const Real3 to_a = reach(a, n), to_b = reach(b, n);
    b.centre = plus(plus(plus(a.centre, 1, to_a), gap, n), 1, to_b);
    const Real size = extent(a, b);
    const GapTruth truth = signed_gap(a, b);
    expect_near(truth.gap, gap, kGapError * size);
    EXPECT_LE(length(plus(truth.normal, -1, n)), kNormalError);
    EXPECT_LE(length(plus(truth.arm_a, -1, to_a)), kNormalError * size);
    EXPECT_LE(length(plus(truth.arm_b, 1, to_b)), kNormalError * size);
    EXPECT_TRUE(truth.global);
    if (::testing::Test::HasFailure()) FAIL() << "sample " << i;
  }
}

// A pair around a touch: c_B in doubles, off by their rounding.
std::array<RawEllipsoid, 2> near_touch(Sampler& sample, double hard) {
  const RawEllipsoid a = sample.body(1, sample.log_uniform(1, hard));
  RawEllipsoid b = sample.body(sample.log_uniform(1 / hard, hard), sample.log_uniform(1, hard));
  const Real3 n = sample.direction();
  const Real way = 1 + Real(sample.uniform(-1, 1) * sample.log_uniform(1e-16, 1e-3));
  const Real3 centre = plus(plus(real(a).centre, way, reach(real(a), n)), way, reach(real(b), n));
  for (std::size_t i = 0; i < 3; ++i) b.centre[i] = static_cast<double>(centre[i]);
  return {a, b};
}

TEST(GapOracle, HasTheSignOfTheExactRelation) {
  Sampler sample(20261123);
  for (int i = 0; i < 400; ++i) {
    const auto [a, b] = near_touch(sample, i % 2 == 0 ? 10 : 1e8);
    const Real gap = signed_gap(a, b).gap;
    const Relation relation = exact_relation(a, b).relation;
    EXPECT_EQ(gap > 0, relation == Relation::separate) << i << ' ' << gap.str(20);
  }
}

TEST(GapOracle, KeepsItsIdentities) {
  Sampler sample(20261124);
  for (int i = 0; i < 120; ++i) {
    const auto [a, b] = near_touch(sample, i % 2 == 0 ? 5 : 1e8);
    const RealEllipsoid ra = real(a), rb = real(b);
    const Real size = extent(ra, rb), error = 2 * kGapError * size;
    const GapTruth truth = signed_gap(a, b);

    const GapTruth exchanged = signed_gap(b, a);
    expect_near(exchanged.gap, truth.gap, error);

    const Real3 d = plus(rb.centre, -1, ra.centre);
    const Real3 between = plus(plus(d, 1, truth.arm_b), -1, truth.arm_a);
    EXPECT_LE(length(plus(between, -truth.gap, truth.normal)), Real("2e-130") * size);

    const double factor = i % 4 < 2 ? 0x1p-500 : 0x1p498;  // 1e-150, 1e150
    RawEllipsoid sa = a, sb = b;
    for (RawEllipsoid* e : {&sa, &sb}) {
      for (double& v : e->centre) v *= factor;
      for (double& v : e->semi_axes) v *= factor;
    }
    expect_near(signed_gap(sa, sb).gap / factor, truth.gap, error);

    RealEllipsoid ma = ra, mb = rb;
    const auto shift = sample.vector();
    for (RealEllipsoid* e : {&ma, &mb}) {
      for (std::size_t k = 0; k < 3; ++k) e->centre[k] += Real(shift[k]) * 1e12;
      for (Real& v : e->orientation) v *= -Real(shift[0]);
    }
    expect_near(signed_gap(ma, mb).gap, truth.gap, error);
  }
}

// Two discs of aspect ratio 1000, parallel but for 0.01, edges past each other: flat bodies have
// local maxima below 0 though they are apart.
TEST(GapOracle, OfSeparateFlatBodiesIsPositiveFromTheStart) {
  Sampler sample(20261125);
  for (int i = 0; i < 300; ++i) {
    RawEllipsoid a = sample.body(1, 1), b = sample.body(1, 1);
    a.semi_axes = b.semi_axes = {1, 1, 1e-3};
    a.orientation = {1, 0, 0, 0};
    b.orientation = {1, sample.uniform(-0.01, 0.01), sample.uniform(-0.01, 0.01), 0};
    a.centre = {0, 0, 0};
    const double angle = sample.uniform(0, 7), away = sample.uniform(0.5, 2.2);
    b.centre = {away * std::cos(angle), away * std::sin(angle), sample.uniform(0.001, 0.02)};
    const GapTruth truth = signed_gap(a, b);
    EXPECT_EQ(truth.gap > 0, exact_relation(a, b).relation == Relation::separate);
    EXPECT_TRUE(truth.gap < 0 || truth.global);
  }
}

TEST(GapOracle, FollowsTheAscentFromTheStartThatIsGiven) {
  const RealEllipsoid a = real(RawEllipsoid{{0, 0, 0}, {2, 3, 4}});
  const RealEllipsoid b = real(RawEllipsoid{{0.5, 0, 0}, {2, 3, 4}});
  const GapTruth there = stationary_gap(a, b, {1e-200, 1e-202, 0});
  const GapTruth back = stationary_gap(a, b, {-1, 0.01, 0});
  expect_near(there.gap, -3.5, kGapError);
  expect_near(there.normal[0], 1, kNormalError);
  expect_near(back.gap, -4.5, kGapError);
  EXPECT_FALSE(back.global);
}

TEST(GapOracle, RefusesWhatIsNoEllipsoidAndNoDirection) {
  const RawEllipsoid good = ball(0, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(signed_gap(ball(nan, 1), good), std::invalid_argument);
  EXPECT_THROW(signed_gap(good, ball(0, 0)), std::invalid_argument);
  EXPECT_THROW(signed_gap(good, {{0, 0, 0}, {1, 1, 1}, {0, 0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(stationary_gap(real(good), real(good), {0, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace tangency::verify
