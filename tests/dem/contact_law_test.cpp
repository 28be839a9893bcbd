// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tangency/dem/contact_law.hpp>

namespace {

using tangency::Vec3;
using tangency::dem::ContactLaw;
using tangency::dem::turned_with;

const Vec3 kNormal = Vec3(1.0, 2.0, 2.0) / 3.0;
const Vec3 kTangent = Vec3(2.0, 1.0, -2.0) / 3.0;
constexpr ContactLaw kLaw{100.0, 50.0, 0.5, 0.0};

TEST(ContactLaw, NormalForceIsLinearInOverlapAndNeverPulls) {
  EXPECT_EQ(kLaw.normal_force(0.25), 25.0);
  EXPECT_EQ(kLaw.normal_force(0.0), 0.0);
  EXPECT_EQ(kLaw.normal_force(-0.25), 0.0);
}

TEST(ContactLaw, ShearForceOpposesTheTangentialDisplacement) {
  const Vec3 moved = 0.01 * kTangent + 0.3 * kNormal;
  const Vec3 shear = kLaw.shear_force(Vec3::Zero(), kNormal, kNormal, moved, 1e9);
  EXPECT_LT((shear + 0.5 * kTangent).norm(), 1e-14);
}

TEST(ContactLaw, ShearForceGrowsUpToTheCoulombLimit) {
  Vec3 shear = Vec3::Zero();
  for (int step = 0; step < 100; ++step)
    shear = kLaw.shear_force(shear, kNormal, kNormal, 0.01 * kTangent, 10.0);
  EXPECT_LT((shear + 5.0 * kTangent).norm(), 1e-13);
}

TEST(ContactLaw, CohesionAddsToTheLimit) {
  constexpr ContactLaw cohesive{100.0, 50.0, 0.5, 3.0};
  const Vec3 shear = cohesive.shear_force(Vec3::Zero(), kNormal, kNormal, kTangent, 10.0);
  EXPECT_NEAR(shear.norm(), 8.0, 1e-14);
}

TEST(ContactLaw, ShearForceTurnsWithTheNormalAtConstantLength) {
  const Vec3 turned = Vec3(1.0, 2.0, 2.5).normalized();
  const Vec3 shear = kLaw.shear_force(kTangent, kNormal, turned, Vec3::Zero(), 1e9);
  EXPECT_NEAR(shear.norm(), 1.0, 1e-15);
  EXPECT_NEAR(shear.dot(turned), 0.0, 1e-15);
  // The smallest turn leaves the axis across both normals where it is.
  const Vec3 axis = kNormal.cross(turned).normalized();
  EXPECT_NEAR(shear.dot(axis), kTangent.dot(axis), 1e-15);
}

TEST(ContactLaw, SmallestTurnTakesOneNormalToTheOther) {
  const Vec3 to = Vec3(-3.0, 1.0, 0.5).normalized();
  EXPECT_LT((turned_with(kNormal, kNormal, to) - to).norm(), 1e-15);
  EXPECT_EQ(turned_with(kTangent, kNormal, kNormal), kTangent);
}

TEST(ContactLaw, BearsShearOnlyWithStiffnessAndALimit) {
  EXPECT_TRUE(kLaw.bears_shear());
  EXPECT_TRUE((ContactLaw{1.0, 1.0, 0.0, 1.0}.bears_shear()));
  EXPECT_FALSE((ContactLaw{1.0, 1.0, 0.0, 0.0}.bears_shear()));
  EXPECT_FALSE((ContactLaw{1.0, 0.0, 0.5, 1.0}.bears_shear()));
}

}  // namespace
