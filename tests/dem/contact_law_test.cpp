// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tangency/dem/contact/contact_law.hpp>
#include <tangency/tests/support/generators.hpp>

#include "one_contact.hpp"

namespace {

using tangency::Vec3;
using tangency::dem::ContactLaw;
using tangency::dem::NormalResponse;
using tangency::dem::ShearState;
using tangency::testing::linear_push;
using tangency::testing::shear_step;

const Vec3 kNormal = Vec3(1.0, 2.0, 2.0) / 3.0;
const Vec3 kTangent = Vec3(2.0, 1.0, -2.0) / 3.0;
constexpr ContactLaw kLaw{100.0, 50.0, 0.5, 0.0};

/// The shear force of a law after one step from `before`, under a push of `normal_force`.
Vec3 sheared(const ContactLaw& law, const Vec3& before, const Vec3& normal_before,
             const Vec3& normal, const Vec3& displacement, double normal_force) {
  ShearState state{before, law.shear_stiffness, before.squaredNorm() / (2.0 * law.shear_stiffness)};
  const NormalResponse response = linear_push(law, normal_force / law.normal_stiffness);
  shear_step(law, state, {normal_before, normal, displacement}, response);
  return state.force;
}

TEST(ContactLaw, NormalForceIsLinearInOverlapAndItsEnergyThatOfASpring) {
  tangency::testing::ContactArrays one;
  one.set_law(0, kLaw);
  one.gap[0] = -0.25;
  one.normal[0] = kNormal;
  one.step(1, false);
  EXPECT_EQ(one.normal_force[0], 25.0);
  EXPECT_EQ(one.normal_stiffness_now[0], 100.0);
  EXPECT_EQ(one.normal_energy[0], 0.5 * 100.0 * 0.25 * 0.25);
}

// dem/contact/contact_law.hpp (4)
TEST(ContactLaw, WorkOnTheShearSpringIsStoredOrSlidAway) {
  // Out along the tangent until it slides, back until it slides the other way.
  ShearState state;
  const NormalResponse response = linear_push(kLaw, 0.1);
  double work = 0.0, slid = 0.0, limit = 0.0;
  for (int step = 0; step < 300; ++step) {
    const Vec3 moved = (step < 100 ? 0.002 : -0.002) * kTangent + 1e-4 * step * kNormal;
    const Vec3 before = state.force;
    slid += shear_step(kLaw, state, {kNormal, kNormal, moved}, response);
    work -= 0.5 * (before + state.force).dot(moved);
    limit = std::max(limit, state.force.norm());
  }
  EXPECT_NEAR(limit, 5.0, 1e-14);
  EXPECT_NEAR(state.energy, 5.0 * 5.0 / (2.0 * 50.0), 1e-14);
  EXPECT_NEAR(work, slid + state.energy, 1e-14);
  // It sticks over 0.1 outward and 0.2 back, and slides under 5 over the rest.
  EXPECT_NEAR(slid, 5.0 * (0.2 - 0.1) + 5.0 * (0.4 - 0.2), 1e-12);
}

TEST(ContactLaw, ShearForceOpposesTheTangentialDisplacement) {
  const Vec3 moved = 0.01 * kTangent + 0.3 * kNormal;
  const Vec3 shear = sheared(kLaw, Vec3::Zero(), kNormal, kNormal, moved, 1e9);
  EXPECT_LT((shear + 0.5 * kTangent).norm(), 1e-14);
}

TEST(ContactLaw, ShearForceGrowsUpToTheCoulombLimit) {
  Vec3 shear = Vec3::Zero();
  for (int step = 0; step < 100; ++step)
    shear = sheared(kLaw, shear, kNormal, kNormal, 0.01 * kTangent, 10.0);
  EXPECT_LT((shear + 5.0 * kTangent).norm(), 1e-13);
}

TEST(ContactLaw, CohesionAddsToTheLimit) {
  constexpr ContactLaw cohesive{100.0, 50.0, 0.5, 3.0};
  const Vec3 shear = sheared(cohesive, Vec3::Zero(), kNormal, kNormal, kTangent, 10.0);
  EXPECT_NEAR(shear.norm(), 8.0, 1e-14);
}

TEST(ContactLaw, ShearForceTurnsWithTheNormalAtConstantLength) {
  const Vec3 turned = Vec3(1.0, 2.0, 2.5).normalized();
  const Vec3 shear = sheared(kLaw, kTangent, kNormal, turned, Vec3::Zero(), 1e9);
  EXPECT_NEAR(shear.norm(), 1.0, 1e-15);
  EXPECT_NEAR(shear.dot(turned), 0.0, 1e-15);
  // The smallest turn leaves the axis across both normals where it is.
  const Vec3 axis = kNormal.cross(turned).normalized();
  EXPECT_NEAR(shear.dot(axis), kTangent.dot(axis), 1e-15);
}

constexpr double kU = tangency::kUnitRoundoff;

/// A contact that turns by anything up to a right angle and slides.
struct Step {
  Vec3 shear, from, to, displacement;
  double size;  ///< of the force before it is cut back
};

Step any_step(const ContactLaw& law) {
  namespace testing = tangency::testing;
  const Vec3 from = *testing::direction();
  Vec3 to = (from + *testing::uniform(0, 1) * *testing::direction()).normalized();
  if (!(from.dot(to) > 0.0)) to = from;
  const Vec3 across = from.cross(*testing::direction());
  const Vec3 shear = *testing::log_uniform(1e-6, 1e6) * across;
  const Vec3 displacement = *testing::log_uniform(1e-9, 1e3) * *testing::direction();
  return {shear, from, to, displacement, shear.norm() + law.shear_stiffness * displacement.norm()};
}

// dem/contact/contact_law.hpp (1) (2)
RC_GTEST_PROP(ContactLawProperty, ShearForceIsTangentialAndWithinTheCoulombLimit, ()) {
  const double cohesion = *rc::gen::element(0.0, 1e-3, 10.0);
  const ContactLaw law{100.0, 50.0, *tangency::testing::uniform(0, 2), cohesion};
  const double normal_force = *tangency::testing::log_uniform(1e-6, 1e6);
  const Step s = any_step(law);
  const Vec3 shear = sheared(law, s.shear, s.from, s.to, s.displacement, normal_force);
  const double limit = law.cohesion + normal_force * law.friction_coefficient;
  RC_ASSERT(std::abs(shear.dot(s.to)) <= 32 * kU * s.size);
  RC_ASSERT(shear.norm() <= limit * (1 + 8 * kU));
  RC_CLASSIFY(shear.norm() < 0.99 * limit, "within the limit");
}

// dem/contact/contact_law.hpp (3)
RC_GTEST_PROP(ContactLawProperty, ShearForceKeepsItsLengthAsTheNormalTurns, ()) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Step s = any_step(kLaw);
  const Vec3 shear = sheared(kLaw, s.shear, s.from, s.to, Vec3::Zero(), kNone);
  RC_ASSERT(std::abs(shear.norm() - s.shear.norm()) <= 32 * kU * s.shear.norm());
}

TEST(ContactLaw, BearsShearOnlyWithStiffnessAndALimit) {
  EXPECT_TRUE(kLaw.bears_shear());
  EXPECT_TRUE((ContactLaw{1.0, 1.0, 0.0, 1.0}.bears_shear()));
  EXPECT_FALSE((ContactLaw{1.0, 1.0, 0.0, 0.0}.bears_shear()));
  EXPECT_FALSE((ContactLaw{1.0, 0.0, 0.5, 1.0}.bears_shear()));
}

}  // namespace
