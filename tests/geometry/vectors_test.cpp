// SPDX-License-Identifier: GPL-3.0-or-later
// Users write Eigen's own types; the library takes and gives the unaligned ones of vectors.hpp.
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/quadric.hpp>

namespace tangency {
namespace {

using Eigen::Matrix4d;
using Eigen::Quaterniond;
using Eigen::Vector2d;

const Quaterniond kTurn(0.3, -0.5, 0.1, 0.8);

TEST(UnalignedTypes, AreGivenAnyQuaternionOfEigens) {
  const Vec3 c(1, 2, 3), r(3, 2, 1);
  const std::array<double, 4> numbers{-0.5, 0.1, 0.8, 0.3};  // x, y, z, w
  const Eigen::Map<const Quaterniond> mapped(numbers.data());
  const Quaterniond one = Quaterniond::Identity();
  const std::array bodies{
      Ellipsoid(c, r, kTurn),
      Ellipsoid(c, r, {0.3, -0.5, 0.1, 0.8}),
      Ellipsoid(c, r, one * kTurn),
      Ellipsoid(c, r, mapped),
      Ellipsoid(c, r, Quaterniond(kTurn.coeffs())),
      Ellipsoid(c, r, kTurn.conjugate().conjugate()),
      Ellipsoid{c, r, Ellipsoid(c, r, kTurn).orientation()},
  };
  for (const Ellipsoid& body : bodies) {
    EXPECT_EQ(body.orientation().coeffs(), kTurn.coeffs());
    EXPECT_EQ(body.rotation(), rotation_of(kTurn));
  }
  EXPECT_FALSE(Ellipsoid::find_fault(c, r, kTurn));
  EXPECT_EQ(Ellipsoid(c, r).rotation(), rotation_of(Quaterniond(Eigen::AngleAxisd::Identity())));
}

TEST(UnalignedTypes, GiveAnyQuaternionOfEigens) {
  const Ellipsoid body({1, 2, 3}, {3, 2, 1}, kTurn);
  const Quaterniond copied = body.orientation();
  const Quaterniond& bound = body.orientation();
  Quaterniond assigned = Quaterniond::Identity();
  assigned = body.orientation();
  std::vector<Quaterniond> pushed;
  pushed.push_back(body.orientation());
  const auto size = [](const Quaterniond& q) { return q.norm(); };
  for (const Quaterniond& q : {copied, bound, assigned, pushed.front()}) {
    EXPECT_EQ(q.coeffs(), kTurn.coeffs());
    EXPECT_TRUE(q == body.orientation() && q.isApprox(body.orientation()));
  }
  EXPECT_EQ(size(body.orientation()), kTurn.norm());

  auto kept = body.orientation();
  kept.normalize();
  kept = kept * kTurn.normalized();
  const Mat3 twice = kTurn.normalized().toRotationMatrix() * kTurn.normalized().toRotationMatrix();
  EXPECT_LT((kept.toRotationMatrix() - twice).norm(), 1e-15);
  EXPECT_LT((body.orientation().normalized() * Vec3::UnitX() - body.rotation().col(0)).norm(),
            1e-15);
  EXPECT_LT(body.orientation().normalized().angularDistance(kTurn.normalized()), 1e-7);
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(body.centre()) * body.orientation().normalized();
  EXPECT_EQ(pose.translation(), body.centre());
  EXPECT_GT(Eigen::AngleAxisd(body.orientation()).angle(), 0.0);
}

TEST(UnalignedTypes, GiveAndTakeMatricesAndPlaneVectorsOfEigens) {
  const Quadric quadric = Quadric::from_ellipsoid(Ellipsoid({1, 2, 3}, {3, 2, 1}, kTurn));
  const Matrix4d copied = quadric.discriminant();
  const Matrix4d& bound = quadric.discriminant();
  Matrix4d assigned;
  assigned = quadric.moved(Quaterniond::Identity(), Vec3::Zero()).discriminant();
  const Eigen::Vector4d point(0.1, 0.2, 0.3, 1.0);
  EXPECT_EQ(copied, bound);
  EXPECT_LT((copied - assigned).norm(), 1e-14);
  EXPECT_NEAR(point.dot(quadric.discriminant() * point), quadric.evaluate(point.head<3>()), 1e-14);
  EXPECT_LT(Eigen::PartialPivLU<Matrix4d>(quadric.discriminant()).determinant(), 0.0);

  const Vector2d centre(1, 2), axes(2, 1);
  const Ellipse a(centre, axes, Vector2d(1, 0)), b({5, 2}, {0.5, 1}, {0.0, 1.0});
  const Vector2d apart = b.centre() - a.centre();
  const PlaneGap gap = signed_gap(a, b, apart);
  const Vector2d normal = gap.normal, touch = a.centre() + gap.arm_a;
  EXPECT_EQ(normal, Vector2d::UnitX());
  EXPECT_EQ(touch, Vector2d(3, 2));
  EXPECT_EQ(crossings(a, b, apart).count, 0);
  EXPECT_TRUE(a.contains(centre) && a.contains(Vector2d(2, 2)));
  EXPECT_EQ(a.moved_to(Vector2d::Zero()).centre(), Vector2d::Zero());
}

}  // namespace
}  // namespace tangency
