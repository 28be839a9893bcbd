// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using testing::Pair;

constexpr double kU = kUnitRoundoff;

bool exists(const GapDerivatives& d) {
  return d.status == DerivativeStatus::ok || d.status == DerivativeStatus::local;
}

bool vanishes(const GapDerivatives& d) {
  return d.gradient == GapGradient::Zero() && d.hessian == GapHessian::Zero();
}

/// A pair with derivatives, and the tolerances that gap_derivatives.hpp promises for them.
struct Answer {
  explicit Answer(const Pair& pair)
      : a(pair.a), b(pair.b), gap(signed_gap(a, b)), d(gap_derivatives(a, b, gap)) {
    size = (b.centre() - a.centre()).norm() + a.largest_semi_axis() + b.largest_semi_axis();
    kappa = 1 + size / d.least_radius;
    beta = std::max(a.largest_semi_axis() / a.support(gap.normal),
                    b.largest_semi_axis() / b.support(gap.normal));
    first = 64 * kU * kappa;
    const double deep = 1 + std::max(0.0, -gap.gap / d.least_radius);
    second = 64 * kU * kappa * deep * beta / d.least_radius;
    reach = size + a.centre().norm() + b.centre().norm();
  }
  /// Bounds on what a parameter does, as gap_derivatives.hpp has them, about the origin.
  double scale(int i) const {
    const int kind = i % kOfBodyB;
    return kind < kRotation ? 1 : kind < kSemiAxes ? reach * beta : beta;
  }

  Ellipsoid a, b;
  Gap gap;
  GapDerivatives d;
  double size, kappa, beta, first, second, reach;
};

Vec3 at(const GapGradient& g, int i) { return g.segment<3>(i); }

// geometry/gap_derivatives.hpp (1)
RC_GTEST_PROP(GapDerivativesProperty, MovingBothBodiesAlikeChangesNothing, ()) {
  const Answer r(*testing::pair(20));
  RC_PRE(exists(r.d));
  RC_ASSERT(at(r.d.gradient, kCentre) == -at(r.d.gradient, kOfBodyB + kCentre));
  for (int i = 0; i < 18; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double sum = r.d.hessian(i, kCentre + k) + r.d.hessian(i, kOfBodyB + kCentre + k);
      RC_ASSERT(std::abs(sum) <= r.second * r.scale(i));
    }
  }
}

// geometry/gap_derivatives.hpp (2)
RC_GTEST_PROP(GapDerivativesProperty, TurningBothBodiesAlikeChangesNothing, ()) {
  const Answer r(*testing::pair(20));
  RC_PRE(exists(r.d));
  const GapGradient& g = r.d.gradient;
  const Vec3 moment = r.a.centre().cross(at(g, kCentre)) + at(g, kRotation) +
                      r.b.centre().cross(at(g, kOfBodyB + kCentre)) + at(g, kOfBodyB + kRotation);
  RC_ASSERT(moment.norm() <= 4 * r.first * r.reach);
  // The gradient by B's centre turns with the bodies: its derivative along a turn v is v x n.
  for (int k = 0; k < 3; ++k) {
    const Vec3 v = Vec3::Unit(k);
    GapGradient turn = GapGradient::Zero();
    turn.segment<3>(kCentre) = v.cross(r.a.centre());
    turn.segment<3>(kRotation) = v;
    turn.segment<3>(kOfBodyB + kCentre) = v.cross(r.b.centre());
    turn.segment<3>(kOfBodyB + kRotation) = v;
    const Vec3 rate = (r.d.hessian * turn).segment<3>(kOfBodyB + kCentre);
    RC_ASSERT((rate - v.cross(at(g, kOfBodyB + kCentre))).norm() <= 8 * r.second * r.reach);
  }
}

// geometry/gap_derivatives.hpp (3)
RC_GTEST_PROP(GapDerivativesProperty, TheGapIsHomogeneousOfDegreeOneInTheLengths, ()) {
  const Answer r(*testing::pair(20));
  RC_PRE(exists(r.d));
  GapGradient lengths = GapGradient::Zero();
  lengths.segment<3>(kCentre) = r.a.centre();
  lengths.segment<3>(kSemiAxes) = r.a.semi_axes();
  lengths.segment<3>(kOfBodyB + kCentre) = r.b.centre();
  lengths.segment<3>(kOfBodyB + kSemiAxes) = r.b.semi_axes();
  RC_ASSERT(std::abs(lengths.dot(r.d.gradient) - r.gap.gap) <= 4 * r.first * r.reach);
  const GapGradient row = r.d.hessian * lengths;
  for (int i = 0; i < 18; ++i) {
    const bool angle = i % kOfBodyB / 3 == kRotation / 3;
    const double expected = angle ? r.d.gradient[i] : 0.0;
    RC_ASSERT(std::abs(row[i] - expected) <= 8 * r.second * r.scale(i) * r.beta * r.reach);
  }
}

// geometry/gap_derivatives.hpp (4)
RC_GTEST_PROP(GapDerivativesProperty, ExchangeExchangesTheBlocks, ()) {
  const Answer r(*testing::pair(20));
  RC_PRE(exists(r.d));
  Gap reversed = r.gap;
  reversed.normal = -r.gap.normal;
  const GapDerivatives other = gap_derivatives(r.b, r.a, reversed);
  RC_ASSERT(other.status == r.d.status);
  for (int i = 0; i < 18; ++i) {
    const int k = (i + kOfBodyB) % 18;
    RC_ASSERT(std::abs(r.d.gradient[i] - other.gradient[k]) <= r.first * r.scale(i));
    for (int j = 0; j < 18; ++j) {
      RC_ASSERT(std::abs(r.d.hessian(i, j) - other.hessian(k, (j + kOfBodyB) % 18)) <=
                r.second * r.scale(i) * r.scale(j));
    }
  }
}

RC_GTEST_PROP(GapDerivativesProperty, AreFiniteOrSaidNotToExist, ()) {
  const Pair p = *testing::pair(1e8);
  const GapDerivatives d = gap_derivatives(p.a, p.b, signed_gap(p.a, p.b));
  RC_ASSERT(d.gradient.allFinite() && d.hessian.allFinite() && std::isfinite(d.least_radius));
  RC_ASSERT((exists(d) ? d.least_radius > 0 : vanishes(d)));
  RC_CLASSIFY(exists(d), "exist");
}

RC_GTEST_PROP(GapDerivativesProperty, DoNotExistForConcentricPairs, ()) {
  const Pair p = *testing::pair_at(100, rc::gen::just(0.0));
  const GapDerivatives d = gap_derivatives(p.a, p.b, signed_gap(p.a, p.b));
  RC_ASSERT(d.status == DerivativeStatus::tie);
  RC_ASSERT(vanishes(d));
}

RC_GTEST_PROP(GapDerivativesProperty, DoNotExistWhereACircleOfNormalsTies, ()) {
  // Coaxial prolate spheroids, one deep in the other, off-centre along their common axis. Spheres
  // at its ends are as far as its sides: the gap is -(r_A + r_B) for every normal across the axis.
  const double a = *testing::uniform(2, 30), b = *testing::uniform(2, 30);
  const double shift = *testing::uniform(0.05, 0.9);
  const Eigen::Quaterniond q = *testing::orientation();
  const Ellipsoid outer(Vec3::Zero(), {1, 1, a}, q), inner(Vec3::Zero(), {0.5, 0.5, 0.5 * b}, q);
  const Vec3 axis = outer.rotation().col(2);
  const Ellipsoid moved = inner.moved_to(shift * axis);
  const Vec3 start = outer.rotation() * Vec3(0.6, 0.8, shift / (a * a + b * b));
  const Gap gap = follow_gap(outer, moved, moved.centre(), start);
  // On the branch across the axis, and not at the tie of n and -n, which has a status of its own.
  constexpr double kAcross = 0.9, kOffTheTie = 1e-6;  // chosen; of bodies of width 2
  RC_PRE(std::abs(gap.normal.dot(axis)) < kAcross);
  RC_PRE(gap.normal.dot(moved.centre()) > kOffTheTie);
  const GapDerivatives d = gap_derivatives(outer, moved, gap);
  RC_ASSERT(d.status == DerivativeStatus::degenerate);
  RC_ASSERT(vanishes(d));
}

TEST(GapDerivatives, OfSpheresAreThoseOfTheDistanceOfTheirCentres) {
  const Ellipsoid a({1, 2, 3}, {2, 2, 2}), b({1, 2 + 12, 3 + 5}, {4, 4, 4});
  const GapDerivatives d = gap_derivatives(a, b, signed_gap(a, b));
  ASSERT_EQ(d.status, DerivativeStatus::ok);
  const Vec3 n = Vec3(0, 12, 5) / 13;
  const Mat3 across = (Mat3::Identity() - n * n.transpose()) / 13;
  EXPECT_NEAR(d.least_radius, 13, 64 * kU);
  EXPECT_LE((at(d.gradient, kOfBodyB + kCentre) - n).norm(), 16 * kU);
  EXPECT_LE(at(d.gradient, kRotation).norm(), 64 * kU);
  EXPECT_LE((at(d.gradient, kSemiAxes) + n.cwiseAbs2()).norm(), 16 * kU);
  const Mat3 cc = d.hessian.block<3, 3>(kOfBodyB, kOfBodyB),
             ab = d.hessian.block<3, 3>(0, kOfBodyB);
  EXPECT_LE((cc - across).norm(), 16 * kU);
  EXPECT_LE((ab + across).norm(), 16 * kU);
  // A turned sphere is the same sphere.
  const Eigen::Matrix<double, 3, 18> turns = d.hessian.middleRows<3>(kRotation);
  EXPECT_LE(turns.leftCols<6>().norm() + turns.middleCols<6>(9).norm(), 256 * kU);
}

TEST(GapDerivatives, OfADeepAnswerSayThatTheyAreThoseOfItsBranch) {
  const Ellipsoid a({0, 0, 0}, {4, 2, 3}), b({0.5, 0.2, 0.1}, {5, 1, 2});
  const Gap gap = follow_gap(a, b, b.centre(), signed_gap(a, b).normal);
  ASSERT_EQ(gap.status, GapStatus::local);
  EXPECT_EQ(gap_derivatives(a, b, gap).status, DerivativeStatus::local);
}

TEST(GapDerivatives, ScaleWithTheUnitOfLengthFarBeyondSquaresOfDoubles) {
  const Eigen::Quaterniond q(0.3, 0.5, -0.2, 0.7);
  const Vec3 d(4, 3, 2), ra(1, 2, 3), rb(3, 1, 1.5);
  const auto solve = [&](double unit) {
    const Ellipsoid a(Vec3::Zero(), unit * ra, q), b(unit * d, unit * rb);
    return gap_derivatives(a, b, signed_gap(a, b));
  };
  const GapDerivatives one = solve(1);
  for (const int power : {-600, -70, 70, 600}) {
    const GapDerivatives other = solve(std::exp2(power));
    ASSERT_EQ(other.status, DerivativeStatus::ok);
    for (int i = 0; i < 18; ++i) {
      for (int j = 0; j < 18; ++j) {
        const int angles = (i % 9 / 3 == 1) + (j % 9 / 3 == 1);
        const double unscaled = std::scalbn(other.hessian(i, j), (1 - angles) * power);
        EXPECT_NEAR(unscaled, one.hessian(i, j), 1e-12) << power << ' ' << i << ' ' << j;
      }
    }
  }
}

TEST(GapDerivatives, AreTheSameWhereTheDifferenceOfTheCentresOverflows) {
  const Eigen::Quaterniond q(0.3, 0.5, -0.2, 0.7);
  const auto solve = [&](double unit) {
    const Vec3 c(2, 1, 1);
    const Ellipsoid a(-unit * c, unit * Vec3(1, 2, 3), q), b(unit * c, unit * Vec3(3, 1, 1.5));
    return gap_derivatives(a, b, signed_gap(a, b));
  };
  const GapDerivatives one = solve(1), huge = solve(0x1p1022);
  ASSERT_EQ(huge.status, DerivativeStatus::ok);
  for (const int body : {0, +kOfBodyB}) {
    for (const int i : {0, 1, 2, 6, 7, 8}) {
      EXPECT_NEAR(huge.gradient[body + i], one.gradient[body + i], 1e-14) << body << ' ' << i;
    }
  }
}

/// The example of docs/guide/further.md, with a turn.
TEST(GapDerivatives, PredictTheGapOfAPairThatMovesAndTurnsALittle) {
  const Ellipsoid a({0, 0, 0}, {3, 2, 1}), b({4, 1, 0.5}, {1, 2, 1.5});
  const GapDerivatives d = gap_derivatives(a, b, signed_gap(a, b));
  ASSERT_EQ(d.status, DerivativeStatus::ok);

  GapGradient step = GapGradient::Zero();
  step.segment<3>(kOfBodyB + kCentre) = Vec3(1e-3, -2e-3, 1e-3);
  step.segment<3>(kOfBodyB + kRotation) = Vec3(0, 2e-3, 1e-3);
  const double change = d.gradient.dot(step) + 0.5 * step.dot(d.hessian * step);

  const Vec3 v = step.segment<3>(kOfBodyB + kRotation);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(v.norm(), v.normalized()));
  const Ellipsoid moved(b.centre() + step.segment<3>(kOfBodyB + kCentre), b.semi_axes(),
                        turn * b.orientation());
  const double truth = signed_gap(a, moved).gap - signed_gap(a, b).gap;
  EXPECT_NEAR(change, truth, 1e-8);                         // third order in the step
  EXPECT_GT(std::abs(d.gradient.dot(step) - truth), 1e-7);  // second order
}

}  // namespace
}  // namespace tangency
