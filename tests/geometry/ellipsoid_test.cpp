// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/geometry/ellipsoid.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <string>

#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using Eigen::Quaterniond;
constexpr double kU = 0x1p-53;
const double kInf = std::numeric_limits<double>::infinity();
const double kNan = std::numeric_limits<double>::quiet_NaN();

std::string fault_field(const Vec3& c, const Vec3& r, const Quaterniond& q) {
  const auto fault = Ellipsoid::find_fault(c, r, q);
  return fault ? fault->field : "";
}

TEST(Ellipsoid, RejectsEveryBadFieldByItsName) {
  const Vec3 c(1, 2, 3), r(1, 2, 3);
  const Quaterniond q = Quaterniond::Identity();
  EXPECT_EQ(fault_field(c, r, q), "");
  for (const double bad : {kNan, kInf, -kInf}) {
    EXPECT_EQ(fault_field({bad, 2, 3}, r, q), "x");
    EXPECT_EQ(fault_field({1, bad, 3}, r, q), "y");
    EXPECT_EQ(fault_field({1, 2, bad}, r, q), "z");
    EXPECT_EQ(fault_field(c, r, {bad, 0, 0, 1}), "qw");
    EXPECT_EQ(fault_field(c, r, {1, bad, 0, 0}), "qx");
    EXPECT_EQ(fault_field(c, r, {1, 0, bad, 0}), "qy");
    EXPECT_EQ(fault_field(c, r, {1, 0, 0, bad}), "qz");
  }
  for (const double bad : {kNan, kInf, -kInf, 0.0, -0.0, -1.0}) {
    EXPECT_EQ(fault_field(c, {bad, 2, 3}, q), "r1");
    EXPECT_EQ(fault_field(c, {1, bad, 3}, q), "r2");
    EXPECT_EQ(fault_field(c, {1, 2, bad}, q), "r3");
  }
  EXPECT_EQ(fault_field(c, r, {0, 0, -0.0, 0}), "qw");
}

TEST(Ellipsoid, ConstructorThrowsWithFieldValueAndRule) {
  try {
    Ellipsoid(Vec3::Zero(), {1, -1, 1});
    FAIL() << "no exception";
  } catch (const InvalidEllipsoid& e) {
    EXPECT_STREQ(e.what(), "r2 = -1: a semi-axis must be finite and > 0");
    EXPECT_STREQ(e.fault().field, "r2");
  }
}

TEST(Ellipsoid, AcceptsTheSmallestAndLargestDoubles) {
  for (const double r :
       {std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()}) {
    EXPECT_EQ(fault_field({-r, r, 0}, {r, r, r}, {r, r, r, r}), "");
    EXPECT_TRUE(rotation_of({r, r, r, r}).allFinite());
  }
}

TEST(Ellipsoid, OrientationMeansTheRotationOfTheNormalisedQuaternion) {
  const Mat3 expected =
      Eigen::AngleAxisd(2 * M_PI / 3, Vec3(1, 1, 1).normalized()).toRotationMatrix();
  for (const double length : {1.0, 0.5, 3.0, 1e-300, 1e300}) {
    const Mat3 r = rotation_of({length, length, length, length});
    EXPECT_LE((r - expected).cwiseAbs().maxCoeff(), 12 * kU) << length;
  }
}

TEST(Ellipsoid, SphereHasItsRadiusAsSupport) {
  const Ellipsoid e({1, 2, 3}, {2, 2, 2}, {0.3, -0.2, 0.9, 0.1});
  EXPECT_NEAR(e.support({0, 3, 4}), 10, 20 * kU);
  EXPECT_LE((e.support_point({0, 3, 4}) - Vec3(0, 1.2, 1.6)).norm(), 16 * kU);
}

TEST(Ellipsoid, IsClosed) {
  const Ellipsoid e({1, 2, 3}, {4, 2, 8});
  EXPECT_TRUE(e.contains({5, 2, 3}));
  EXPECT_TRUE(e.contains({1, 2, -5}));
  EXPECT_FALSE(e.contains({1, std::nextafter(4, 5), 3}));
}

// geometry/ellipsoid.hpp (1)
RC_GTEST_PROP(EllipsoidProperty, ContainsItsCentre, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e6);
  RC_ASSERT(e.contains(e.centre()));
}

// geometry/ellipsoid.hpp (2) (3)
RC_GTEST_PROP(EllipsoidProperty, SupportIsHomogeneousAndReachedAtTheSupportPoint, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e3);
  const Vec3 n = *testing::direction();
  const double s = *testing::uniform(-4, 4);
  const double bound = 16 * kU * e.largest_semi_axis();
  RC_ASSERT(std::abs(e.support(s * n) - std::abs(s) * e.support(n)) <= 4 * bound);
  RC_ASSERT(std::abs(n.dot(e.support_point(n)) - e.support(n)) <= bound);
}

RC_GTEST_PROP(EllipsoidProperty, SupportPointIsOnTheSurfaceAndNoPointOfTheSolidReachesFurther, ()) {
  const Ellipsoid e = *testing::ellipsoid(100);
  const Vec3 n = *testing::direction(), m = *testing::direction();
  const double bound = 32 * kU * e.largest_semi_axis();
  // The rounding of a point moves the level by its size over the smallest semi-axis.
  const double level = e.level(e.centre() + e.support_point(n));
  const double slack = (bound + kU * e.centre().norm()) / e.smallest_semi_axis();
  RC_ASSERT(std::abs(level - 1) <= 4 * slack);
  RC_ASSERT(n.dot(e.support_point(m)) <= e.support(n) + bound);
}

// geometry/ellipsoid.hpp (4)
RC_GTEST_PROP(EllipsoidProperty, SolidDependsOnNeitherSignNorLengthOfTheQuaternionNorOrderOfAxes,
              ()) {
  const Ellipsoid e = *testing::ellipsoid(100);
  const Vec3 n = *testing::direction();
  const Quaterniond q = e.orientation();
  const Vec3 r = e.semi_axes();
  const double bound = 32 * kU * e.largest_semi_axis();
  const Ellipsoid negated(e.centre(), r, Quaterniond(-q.coeffs()));
  const Ellipsoid longer(e.centre(), r, Quaterniond(64 * q.coeffs()));
  RC_ASSERT(negated.support(n) == e.support(n));
  RC_ASSERT(longer.support(n) == e.support(n));
  // A turn by a third about the body's diagonal takes axes 1, 2, 3 to 2, 3, 1.
  const Ellipsoid cycled(e.centre(), {r[1], r[2], r[0]}, q * Quaterniond(1, 1, 1, 1));
  RC_ASSERT(std::abs(cycled.support(n) - e.support(n)) <= bound);
  const Ellipsoid half_turned(e.centre(), r, q * Quaterniond(0, 0, 1, 0));
  RC_ASSERT(std::abs(half_turned.support(n) - e.support(n)) <= bound);
}

RC_GTEST_PROP(EllipsoidProperty, BoundingBoxTouchesTheSolidOnAllSixSides, ()) {
  const Ellipsoid e = *testing::ellipsoid(1e3);
  const auto box = e.bounding_box();
  const double bound = 16 * kU * (e.largest_semi_axis() + e.centre().norm());
  for (int i = 0; i < 3; ++i) {
    const Vec3 unit = Vec3::Unit(i);
    RC_ASSERT(std::abs(box.max()[i] - (e.centre()[i] + e.support(unit))) <= bound);
    RC_ASSERT(std::abs(box.min()[i] - (e.centre()[i] - e.support(unit))) <= bound);
  }
}

}  // namespace
}  // namespace tangency
