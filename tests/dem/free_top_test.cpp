// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rotation of rigid bodies against Jacobi's elliptic functions [Whittaker1937, sec. 69].
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <tangency/dem/motion/motion.hpp>
#include <tangency/verify/oracles/elliptic.hpp>

#include "few_bodies.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using tangency::testing::order;
using tangency::verify::complete_elliptic_k;
using tangency::verify::jacobi_elliptic;
using tangency::verify::JacobiElliptic;

constexpr double kUnit = tangency::kUnitRoundoff;

/// One ellipsoid with three different moments of inertia, I_1 < I_2 < I_3, that nothing touches.
struct Top {
  Particles particles;
  Cell cell = Cell::box(Vec3::Constant(10.0));
  Resultants resultants{{Vec3::Zero()}, {Vec3::Zero()}};
  Motion motion;

  explicit Top(const Vec3& spin_in_body, Rotation rotation = Rotation::full)
      : motion{rotation, Vec3::Zero(), 0.0} {
    particles.add(Vec3::Ones(), Eigen::Quaterniond(0.5, 0.1, -0.7, 0.2), {1.5, 1.0, 0.7}, 2.0, 0);
    particles.angular_velocity[0] = particles.orientation[0] * spin_in_body;
  }
  const tangency::Quaternion& axes() const { return particles.orientation[0]; }
  Vec3& spin() { return particles.angular_velocity[0]; }
  Vec3 spin_in_body() const { return axes().conjugate() * particles.angular_velocity[0]; }
  Vec3 inertia() const { return principal_inertia(particles.mass[0], particles.semi_axes[0]); }
  Vec3 momentum() const { return axes() * inertia().cwiseProduct(spin_in_body()); }
  double energy() const { return kinetic_energy(particles); }
  void step(double dt) { move(particles, cell, resultants, motion, dt); }
  void turn(double time, int steps) {
    for (int k = 0; k < steps; ++k) step(time / steps);
  }
};

/// What Euler's equations give from (w_1, 0, w_3) where L^2 > 2 E I_2: w = (A_1 cn, A_2 sn, A_3 dn)
/// of rate t.
struct Theory {
  Vec3 amplitude;
  double rate, m;

  Theory(const Vec3& inertia, const Vec3& spin) {
    const auto [i1, i2, i3] = std::tuple(inertia[0], inertia[1], inertia[2]);
    const double twice = inertia.dot(spin.cwiseAbs2());              // 2 E
    const double square = inertia.cwiseProduct(spin).squaredNorm();  // L^2
    const double to_i1 = square - twice * i1, to_i3 = twice * i3 - square;
    amplitude = Vec3(to_i3 / (i1 * (i3 - i1)), to_i3 / (i2 * (i3 - i2)), to_i1 / (i3 * (i3 - i1)))
                    .cwiseSqrt();
    rate = std::sqrt((i3 - i2) * to_i1 / (i1 * i2 * i3));
    m = (i2 - i1) * to_i3 / ((i3 - i2) * to_i1);
  }
  Vec3 spin(double time) const {
    const JacobiElliptic at = jacobi_elliptic(rate * time, m);
    return amplitude.cwiseProduct(Vec3(at.cn, at.sn, at.dn));
  }
};

const Vec3 kSpin(0.6, 0.0, 1.0);

TEST(FreeTop, FollowsJacobisFunctionsWithAnErrorOfSecondOrder) {
  const double time = 20.0;
  const Theory theory(Top(kSpin).inertia(), kSpin);
  ASSERT_LT(theory.m, 1.0);
  ASSERT_GT(theory.rate * time, 1.5 * complete_elliptic_k(theory.m)) << "all phases are seen";
  const auto at_the_end = [&](int steps) {
    Top top(kSpin);
    top.turn(time, steps);
    return top.spin_in_body();
  };
  const Vec3 truth = theory.spin(time), coarse = at_the_end(2000), fine = at_the_end(4000);
  EXPECT_NEAR(order((coarse - truth).norm(), (fine - truth).norm()), 2.0, 0.01);
  // What is left without the second order is of the fourth: (w dt)^4 times the turns made.
  EXPECT_LT(((4.0 * fine - coarse) / 3.0 - truth).norm(), time * std::pow(time / 2000.0, 4));
}

TEST(FreeTop, FlipsAboutItsIntermediateAxisInHalfThePeriodOfSn) {
  const Vec3 spin(0.0, 1.0, 0.03);
  const Theory theory(Top(spin).inertia(), spin);
  const double flip = 2.0 * complete_elliptic_k(theory.m) / theory.rate;
  ASSERT_GT(flip, 10.0);
  const auto measured = [&](double dt) {
    Top top(spin);
    double first = 0.0, last = 0.0, before = spin[1];
    int flips = -1;
    for (int k = 1; flips < 4; ++k) {
      top.step(dt);
      const double now = top.spin_in_body()[1];
      if ((now > 0.0) != (before > 0.0)) {
        last = (k - now / (now - before)) * dt;
        if (++flips == 0) first = last;
      }
      before = now;
    }
    return (last - first) / flips;
  };
  const double coarse = measured(0.02) - flip, fine = measured(0.01) - flip;
  EXPECT_NEAR(order(coarse, fine), 2.0, 0.05);
  // The integrator's own energy differs by (w dt)^2 E / 10 at most, and the flip takes log(1 / (1 -
  // m)) / 2 of a turn: it is off by about that over 1 - m.
  EXPECT_LT(std::abs(fine), 0.1 * 0.01 * 0.01 / (1.0 - theory.m));
}

TEST(FreeTop, KeepsItsAngularMomentumToRounding) {
  Top top(kSpin);
  const Vec3 start = top.momentum();
  constexpr int steps = 100000;
  for (int k = 0; k < steps; ++k) top.step(0.05);
  // Some 40 roundings a step, which need not be of either sign: the angles hardly change.
  EXPECT_LT((top.momentum() - start).norm(), 40.0 * steps * kUnit * start.norm());
}

TEST(FreeTop, HasAnEnergyThatSwingsWithTheSquareOfTheStepAndDoesNotDrift) {
  const auto swing = [](double dt, double& drift) {
    Top top(kSpin);
    const double start = top.energy();
    double largest = 0.0, first = 0.0, last = 0.0;
    constexpr int steps = 100000, window = steps / 10;
    for (int k = 0; k < steps; ++k) {
      top.step(dt);
      const double off = top.energy() / start - 1.0;
      largest = std::max(largest, std::abs(off));
      if (k < window) first += off / window;
      if (k >= steps - window) last += off / window;
    }
    drift = std::abs(last - first);
    return largest;
  };
  double drift = 0.0, fine_drift = 0.0;
  const double coarse = swing(0.08, drift), fine = swing(0.04, fine_drift);
  EXPECT_NEAR(order(coarse, fine), 2.0, 0.02);
  // A mean over a window of T is off by the swing times a period over T: less than a hundredth.
  EXPECT_LT(drift, 0.01 * coarse);
  EXPECT_LT(fine_drift, 0.01 * fine);
}

TEST(FreeTop, TurnedRoundGoesBackToWhereItCameFrom) {
  for (const Rotation rotation : {Rotation::full, Rotation::simplified}) {
    Top top(kSpin, rotation);
    const Eigen::Quaterniond start = top.axes();
    const Vec3 spin = top.spin();
    constexpr int steps = 1000;
    for (int k = 0; k < steps; ++k) top.step(0.1);
    ASSERT_GT(top.axes().angularDistance(start), 0.1);
    top.spin() *= -1.0;
    for (int k = 0; k < steps; ++k) top.step(0.1);
    // 40 u a step there and back, which the motion carries on over |w| t = 117 radians.
    const double rounding = 40.0 * 2.0 * steps * kUnit;
    EXPECT_LT((top.spin() + spin).norm(), rounding);
    EXPECT_LT((top.axes().coeffs() - start.coeffs()).norm(), 117.0 * rounding);
  }
}

TEST(FreeTop, BySimplifiedEquationsKeepsItsAngularVelocityAndNotItsMomentum) {
  Top top(kSpin, Rotation::simplified);
  const Vec3 spin = top.spin(), momentum = top.momentum();
  const double energy = top.energy();
  double momentum_off = 0.0, energy_off = 0.0;
  for (int k = 0; k < 200; ++k) {
    top.step(0.05);
    ASSERT_EQ(top.spin(), spin);
    momentum_off = std::max(momentum_off, (top.momentum() - momentum).norm());
    energy_off = std::max(energy_off, std::abs(top.energy() - energy));
  }
  EXPECT_LT(energy_off, 1e-13 * energy) << "a turn about the spin leaves the spin in the body";
  EXPECT_GT(momentum_off, 0.1 * momentum.norm());
}

TEST(FreeTop, OfASphereOrASpheroidIsTheSameByBothEquationsWhereTheyAgree) {
  Top full(kSpin), simplified(kSpin, Rotation::simplified);
  // About a principal axis the quadratic terms are 0.
  for (Top* top : {&full, &simplified}) top->spin() = top->axes() * Vec3(0.0, 0.0, 1.7);
  full.turn(20.0, 1000);
  simplified.turn(20.0, 1000);
  EXPECT_LT((full.axes().coeffs() - simplified.axes().coeffs()).norm(), 1000 * 40.0 * kUnit);
}

/// A field that turns the longest axis u towards z: moment k (u . z) u x z, energy -k (u . z)^2
/// / 2.
struct Compass : Top {
  double strength = 3.0;

  explicit Compass(const Eigen::Quaterniond& start) : Top(Vec3::Zero()) {
    particles.orientation[0] = start;
  }
  Vec3 moment() const {
    const Vec3 u = axes() * Vec3::UnitX();
    return strength * u[2] * u.cross(Vec3::UnitZ());
  }
  double potential() const {
    const Vec3 u = axes() * Vec3::UnitX();
    return -0.5 * strength * u[2] * u[2];
  }
  /// Velocities belong to half a step ago.
  void start_at_rest(double dt) {
    const Vec3 in_body = axes().conjugate() * moment();
    spin() = -0.5 * dt * (axes() * in_body.cwiseQuotient(inertia()));
  }
  void pull(double dt) {
    resultants.moment[0] = moment();
    step(dt);
  }
};

/// Its second body axis along y, the longest at `angle` from z.
Eigen::Quaterniond tilted(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle - 0.5 * std::numbers::pi, Vec3::UnitY()));
}

// About one axis, twice the angle from z is that of a pendulum: sin(angle) = sin(start) cd(w t),
// w^2 = k / I, with the parameter sin(start)^2.
TEST(RotationUnderAMoment, IsThePendulumsWithAnErrorOfSecondOrder) {
  const double start = 1.2, time = 30.0;
  const auto off = [&](int steps) {
    Compass compass(tilted(start));
    const double dt = time / steps;
    compass.start_at_rest(dt);
    for (int k = 0; k < steps; ++k) compass.pull(dt);
    const double m = std::pow(std::sin(start), 2);
    const double w = std::sqrt(compass.strength / compass.inertia()[1]);
    const JacobiElliptic at = jacobi_elliptic(w * time, m);
    return std::abs((compass.axes() * Vec3::UnitX())[0] - std::sin(start) * at.cn / at.dn);
  };
  EXPECT_NEAR(order(off(2000), off(4000)), 2.0, 0.02);
}

TEST(RotationUnderAMoment, IsReversible) {
  const Eigen::Quaterniond start = Eigen::Quaterniond(0.9, 0.3, -0.2, 0.4).normalized();
  const double dt = 0.05;
  constexpr int steps = 200;
  Compass compass(start);
  compass.spin() = Vec3(0.2, -0.5, 0.3);
  for (int k = 0; k < steps; ++k) compass.pull(dt);
  // The first step back has no kick: it undoes the last one's turn.
  compass.spin() *= -1.0;
  compass.resultants.moment[0].setZero();
  compass.step(dt);
  for (int k = 1; k < steps; ++k) compass.pull(dt);
  // 40 u a step there and back. The motion multiplies them, by less than a hundred in ten radians.
  EXPECT_LT((compass.axes().coeffs() - start.coeffs()).norm(), 100.0 * 40.0 * 2.0 * steps * kUnit);
}

TEST(RotationUnderAMoment, HasAnEnergyThatDoesNotDrift) {
  Compass compass(Eigen::Quaterniond(0.9, 0.3, -0.2, 0.4).normalized());
  const double dt = 0.05;
  compass.spin() = Vec3(0.2, -0.5, 0.3);
  compass.resultants.moment[0] = compass.moment();
  // At the time of the orientations, as the account of energies takes it.
  const auto energy = [&] {
    compass.resultants.moment[0] = compass.moment();
    return kinetic_energy_at(compass.particles, compass.resultants, compass.motion, dt) +
           compass.potential();
  };
  const double start = energy();
  double early = 0.0, late = 0.0;
  constexpr int steps = 100000;
  for (int k = 0; k < steps; ++k) {
    compass.pull(dt);
    double& largest = k < steps / 2 ? early : late;
    largest = std::max(largest, std::abs(energy() - start));
  }
  EXPECT_LT(early, 0.01 * compass.strength);
  EXPECT_LT(late, 1.05 * early) << "a drift would go on in the second half";
}

}  // namespace
