// SPDX-License-Identifier: GPL-3.0-or-later
//
// Impacts of two bodies against the theory of rigid bodies with a small elastic region at the
// contact [Goldsmith1960]: arms and normals stay those of the touch, which is right in the limit of
// stiff contacts. What is left out is the way v T made during a contact time T, over a radius.
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tangency/geometry/gap.hpp>

#include "few_bodies.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;
using std::numbers::pi;

constexpr double kNoSlip = 1e9;

/// Two ellipsoids that just touch, on their way into each other.
struct Impact : FewBodies {
  Vec3 normal, arm_a, arm_b;
  Mat3 inverse_mass;  ///< of the relative motion at the contact: velocity = inverse_mass impulse
  Vec3 start;         ///< velocity of b relative to a at the contact
  Vec3 velocity_b;

  explicit Impact(const ContactLaw& law, const Vec3& sliding = Vec3::Zero()) : FewBodies(law) {
    const Eigen::Quaterniond turn_a(0.4, -0.3, 0.7, 0.2), turn_b(0.8, 0.1, 0.2, -0.6);
    const Vec3 a = Vec3::Constant(50.0), d(1.4, 0.6, -0.5);
    add(a, turn_a, {1.3, 1.0, 0.8}, {0.5, -0.1, 0.2}, {0.1, -0.3, 0.2});
    add(a + d, turn_b, {0.9, 0.7, 0.6}, Vec3(-0.9, -0.3, 0.6) + sliding, {-0.2, 0.3, 0.4});
    const tangency::Gap gap = tangency::signed_gap(body(0), body(1), d);
    particles.position[1] -= gap.gap * gap.normal;
    normal = gap.normal;
    arm_a = gap.arm_a;
    arm_b = gap.arm_b;
    inverse_mass = (1.0 / mass(0) + 1.0 / mass(1)) * Mat3::Identity() - of_turns(0, arm_a) -
                   of_turns(1, arm_b);
    start = relative();
    velocity_b = particles.velocity[1];
    update();
  }
  tangency::Ellipsoid body(std::size_t i) const {
    return {Vec3::Zero(), particles.semi_axes[i], particles.orientation[i]};
  }
  Mat3 of_turns(std::size_t i, const Vec3& arm) const {
    return cross(arm) * inertia(i).inverse() * cross(arm);
  }
  Vec3 relative() const {
    return particles.velocity[1] + particles.angular_velocity[1].cross(arm_b) -
           particles.velocity[0] - particles.angular_velocity[0].cross(arm_a);
  }
  /// Lets them part; `parts` steps a radian of the normal oscillation.
  void run(double parts = 100.0) {
    const double dt =
        1.0 / (parts * std::sqrt(laws.law[0].normal_stiffness * normal.dot(inverse_mass * normal)));
    bool touched = false;
    for (int k = 0; !touched || touching() > 0; ++k) {
      ASSERT_LT(k, 20.0 * parts);
      step(dt);
      touched = touched || touching() > 0;
    }
  }
  Vec3 impulse() const { return mass(1) * (particles.velocity[1] - velocity_b); }
};

/// The impulse of a contact with springs K across the tangent plane and in it: from u'' = -W K u,
/// u(0) = 0, until the normal part of u comes back to 0.
Vec3 impulse_of_springs(const Impact& impact, double normal_stiffness, double shear_stiffness) {
  const Vec3& n = impact.normal;
  const Mat3 across = n * n.transpose();
  const Mat3 root = std::sqrt(normal_stiffness) * across +
                    std::sqrt(shear_stiffness) * (Mat3::Identity() - across);
  const Eigen::SelfAdjointEigenSolver<Mat3> modes(root * impact.inverse_mass * root);
  const Vec3 w = modes.eigenvalues().cwiseSqrt();
  const Vec3 part = modes.eigenvectors().transpose() * (root * impact.start);
  const auto stretch = [&](double t) {
    const Vec3 y = (w.array() * t).sin() / w.array() * part.array();
    return n.dot(modes.eigenvectors() * y);
  };
  double low = 0.1 / w.maxCoeff(), high = low;
  while (stretch(high) < 0.0) high += 0.01 / w.maxCoeff();
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (stretch(middle) < 0.0 ? low : high) = middle;
  }
  const Vec3 integral = (1.0 - (w.array() * high).cos()) / w.array().square() * part.array();
  return -root * (modes.eigenvectors() * integral);
}

TEST(Impact, WithoutFrictionReversesTheNormalVelocityOfTheCommonNormal) {
  const auto off = [](double stiffness) {
    Impact impact({stiffness, 0.0, 0.0, 0.0});
    const Vec3& n = impact.normal;
    const double expected = -2.0 * n.dot(impact.start) / n.dot(impact.inverse_mass * n);
    const double energy = kinetic_energy(impact.particles);
    impact.run();
    // Leapfrog with 1 / 100 of a radian: (1/100)^2 / 24 of the impulse, twice that of the energy,
    // and as much where the force sets in and where it ends.
    EXPECT_NEAR(kinetic_energy(impact.particles), energy, 2e-5 * energy);
    return (impact.impulse() - expected * n).norm() / expected;
  };
  ASSERT_LT(Impact({1.0, 0.0, 0.0, 0.0}).start.dot(Impact({1.0, 0.0, 0.0, 0.0}).normal), -0.5);
  // v T / radius is 1 / 40 at 1e4; it and the error halve for four times the stiffness.
  const double soft = off(1e4), stiff = off(16e4), stiffer = off(256e4);
  EXPECT_LT(soft, 0.1);
  EXPECT_NEAR(soft / stiff, 4.0, 0.8);
  EXPECT_NEAR(stiff / stiffer, 4.0, 0.4);
}

TEST(Impact, ThatSticksIsThatOfTheTwoSpringsOfTheLinearLaw) {
  for (const double ratio : {0.4, 1.0}) {
    const auto off = [&](double stiffness) {
      Impact impact({stiffness, ratio * stiffness, kNoSlip, 0.0});
      const Vec3 expected = impulse_of_springs(impact, stiffness, ratio * stiffness);
      impact.run(1000.0);  // the shear force ends at once: the impulse is off by that of a step
      const Vec3& n = impact.normal;
      EXPECT_GT((expected - n * n.dot(expected)).norm(), 0.1 * expected.norm());
      return (impact.impulse() - expected).norm() / expected.norm();
    };
    const double soft = off(1e4), stiff = off(16e4), stiffer = off(256e4);
    EXPECT_LT(soft, 0.1);
    EXPECT_NEAR(soft / stiff, 4.0, 0.8);
    EXPECT_NEAR(stiff / stiffer, 4.0, 0.4);
  }
}

TEST(Impact, ThatSlidesThroughoutHasACoulombImpulse) {
  const double mu = 0.2;
  const auto off = [&](double stiffness) {
    Impact impact({stiffness, stiffness, mu, 0.0}, 20.0 * Vec3(0.3, 0.1, 0.9).normalized());
    const Vec3& n = impact.normal;
    const Vec3 sliding = (impact.start - n * n.dot(impact.start)).normalized();
    // W (n - mu sliding) J takes the normal velocity away twice.
    const Vec3 direction = n - mu * sliding;
    const double size = -2.0 * n.dot(impact.start) / n.dot(impact.inverse_mass * direction);
    EXPECT_GT(sliding.dot(impact.start + size * (impact.inverse_mass * direction)), 0.0);
    impact.run(1000.0);
    return (impact.impulse() - size * direction).norm() / size;
  };
  const double soft = off(1e6), stiff = off(16e6);
  EXPECT_LT(stiff, 0.05);
  EXPECT_NEAR(soft / stiff, 4.0, 0.8);
}

/// Spheres of radius 1, head on with speeds of +-v/2; returns the time of contact, to the second
/// order in dt: from the touch at the start to where they are apart, less the way back.
struct HeadOn : FewBodies {
  double speed, time = 0.0, deepest = 0.0, restitution = 0.0;

  HeadOn(const ContactLaw& law, double v, double dt) : FewBodies(law), speed(v) {
    const Vec3 centre = Vec3::Constant(50.0), along = Vec3(2.0, -1.0, 2.0) / 3.0;
    add(centre, Eigen::Quaterniond::Identity(), Vec3::Ones(), 0.5 * v * along);
    add(centre + 2.0 * along, Eigen::Quaterniond::Identity(), Vec3::Ones(), -0.5 * v * along);
    update();
    bool touched = false;
    for (int k = 0; k < 1000000 && (!touched || touching() > 0); ++k) {
      step(dt);
      time += dt;
      touched = touched || touching() > 0;
      if (touching() > 0) deepest = std::max(deepest, contact().overlap);
    }
    const Vec3 between = particles.position[1] - particles.position[0];
    const double back = (particles.velocity[1] - particles.velocity[0]).dot(along);
    time -= (between.norm() - 2.0) / back;
    restitution = back / v;
  }
  static double effective_mass() { return 0.5 * 4.0 / 3.0 * pi; }
};

TEST(Impact, OfSpheresByTheLinearLawLastsHalfAPeriod) {
  const double stiffness = 1e4, w = std::sqrt(stiffness / HeadOn::effective_mass());
  const double dt = 0.02 / w;
  const HeadOn impact({stiffness, stiffness, 0.5, 0.0}, 0.3, dt);
  // Leapfrog's frequency is higher by (w dt)^2 / 24; where the force sets in costs as much again.
  EXPECT_NEAR(impact.time, pi / w, pi / w * 0.02 * 0.02);
  EXPECT_NEAR(impact.deepest, 0.3 / w, 0.3 / w * 0.02 * 0.02);
  EXPECT_NEAR(impact.restitution, 1.0, 0.02 * 0.02);
}

TEST(Impact, OfHertzSpheresLastsAsGammaFunctionsSay) {
  // m v^2 / 2 = (2/5) k s^(5/2) at the deepest s, k = (4/3) E* sqrt(R), R = 1/2, and the time is
  // 2 s/v times the integral of (1 - x^(5/2))^(-1/2) over [0, 1], (2/5) G(2/5) G(1/2) / G(9/10):
  // 2.943 s / v [Johnson1985, eq. 11.24].
  constexpr Material steel{1e6, 0.3};
  const double v = 0.1, m = HeadOn::effective_mass();
  const double k = 4.0 / 3.0 * steel.contact_modulus() * std::sqrt(0.5);
  const double deepest = std::pow(1.25 * m * v * v / k, 0.4);
  const double time = deepest / v * 0.8 * std::tgamma(0.4) * std::tgamma(0.5) / std::tgamma(0.9);
  ContactLaw law{1.5 * k * std::sqrt(deepest), 0.0, 0.0, 0.0};
  law.hertz = steel;
  const auto impact = [&](double parts) { return HeadOn(law, v, time / parts); };
  const HeadOn coarse = impact(100.0), fine = impact(200.0);
  // Half a period in 200 steps: (pi / 200)^2 / 24 = 1e-5, and the onset as much again.
  EXPECT_NEAR(fine.time / time, 1.0, 5e-5);
  EXPECT_NEAR(fine.deepest / deepest, 1.0, 1e-4);
  EXPECT_NEAR(fine.restitution, 1.0, 5e-5);
  EXPECT_LT(std::abs(fine.time / time - 1.0), 0.5 * std::abs(coarse.time / time - 1.0));
}

}  // namespace
