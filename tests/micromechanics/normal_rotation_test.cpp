// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <tangency/dem/micromechanics/contact_statistics.hpp>
#include <tangency/dem/micromechanics/fabric.hpp>
#include <tangency/dem/micromechanics/normal_rotation.hpp>
#include <tangency/dem/micromechanics/plane.hpp>
#include <tangency/dem/micromechanics/rotation_models.hpp>

#include "fields.hpp"
#include "planted_bodies.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using std::numbers::pi;
using tangency::Mat3;
using tangency::Quaternion;
using tangency::Vec3;

const Spheroid kProlate{1.0, 0.5}, kOblate{0.5, 1.0};
constexpr HarmonicSpread kAxes{.second = 1.2, .fourth = 0.8};

/// Deviations that are numbers, above 0 and small; a component that cannot vary has none.
void expect_small(const SymmetricTensor4& error, double most) {
  for (const double component : error.components) {
    EXPECT_GT(component, 0.0);
    EXPECT_LT(component, most);
  }
}

/// The largest component of what is left, in its deviations.
double deviations_left(const NormalRotation& found) {
  double most = found.other.cwiseAbs().cwiseQuotient(found.other_error).maxCoeff();
  for (std::size_t c = 0; c < SymmetricTensor4::kComponents; ++c)
    most = std::max(
        most, std::abs(found.fourth_other.components[c]) / found.fourth_other_error.components[c]);
  return most;
}

TEST(NormalRotation, IndependentNormalsLeaveNothingAndHaveTheModelsFactors) {
  Random random(121);
  for (const Spheroid& s : {kProlate, kOblate})
    for (const double a1 : {0.0, 0.9}) {
      const BodyPacking sample =
          draw_among_spheres(random, s, planted_axes(random, kAxes), everywhere(a1), 4000, 4);
      const Shape shape = s.along > s.across ? Shape::prolate : Shape::oblate;
      const auto found = normal_rotation_of(sample.contacts(), sample.bodies(), shape);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->sides, 16000U);
      expect_small(found->fourth_other_error, 0.1);
      EXPECT_GT(found->other_error.minCoeff(), 0.0);
      EXPECT_LT(found->other_error.maxCoeff(), 0.03);
      EXPECT_LT(deviations_left(*found), 4.0);
      const auto seen = contact_statistics_of(sample.contacts(), sample.bodies(), shape);
      const RotationFactors own = space_rotation(s).factors(seen->spheroid->a1.value);
      EXPECT_NEAR(found->calculated.second, own.second, 1e-12);
      EXPECT_NEAR(found->calculated.fourth, own.fourth, 1e-12);
      const RotationFactors model = space_rotation(s).factors(a1);
      EXPECT_LT(std::abs(found->second.value - model.second), 4.0 * found->second.error);
      EXPECT_LT(std::abs(found->fourth.value - model.fourth), 4.0 * found->fourth.error);
      EXPECT_LT((found->axes_of_sides - found->axes_of_bodies).norm(), 1e-12);  // 4 contacts each
      EXPECT_GT(found->rotated.norm(), 0.2);
    }
}

TEST(NormalRotation, NormalsThatDependOnAxesLeaveMore) {
  Random random(122);
  const LocalLaw law = [](const Vec3& u) { return u[2] * u[2] > 0.4 ? 1.5 : -0.5; };
  const BodyPacking sample =
      draw_among_spheres(random, kProlate, planted_axes(random, kAxes), law, 4000, 4);
  const auto found = normal_rotation_of(sample.contacts(), sample.bodies(), Shape::prolate);
  EXPECT_GT(deviations_left(*found), 6.0);
}

// dem/micromechanics/normal_rotation.hpp (1)
TEST(NormalRotation, BothPartsTogetherAreTheAnisotropyOfNormals) {
  Random random(123);
  const BodyPacking sample =
      draw_among_spheres(random, kProlate, planted_axes(random, kAxes), everywhere(0.5), 300, 3);
  const auto found = normal_rotation_of(sample.contacts(), sample.bodies(), Shape::prolate);
  const auto normals = fit_orientations(sample.packing.normal);
  EXPECT_LT((found->rotated + found->other - normals->model.second).norm(), 1e-12);
  EXPECT_LT(distance(found->fourth_rotated + found->fourth_other, normals->model.fourth), 1e-11);
  EXPECT_LT((found->normals - normals->model.second).norm(), 1e-12);
}

TEST(NormalRotation, IsEmptyWithoutAnAxis) {
  Random random(124);
  BodyPacking sample =
      draw_among_spheres(random, kProlate, planted_axes(random, kAxes), everywhere(0.5), 30, 3);
  const auto of = [&](Shape shape) {
    return normal_rotation_of(sample.contacts(), sample.bodies(), shape).has_value();
  };
  EXPECT_TRUE(of(Shape::prolate));
  EXPECT_FALSE(of(Shape::oblate));
  EXPECT_FALSE(of(Shape::sphere));
  for (Vec3& r : sample.semi_axes) r = Vec3(1.0, 0.8, 0.6);
  EXPECT_FALSE(of(Shape::triaxial));
}

TEST(NormalRotation, TakesContactsOfItsDimensionsAloneAndSaysSo) {
  Random random(127);
  const BodyPacking space =
      draw_among_spheres(random, kProlate, planted_axes(random, kAxes), everywhere(0.5), 30, 3);
  const BodyPacking plane = draw_plane(random, kProlate, 0.3, everywhere(0.5), 30, 3);
  EXPECT_EQ(refusal([&] { normal_rotation_of(plane.contacts(), plane.bodies(), Shape::prolate); }),
            "dimensions = 2: normal_rotation_of takes contacts in space");
  EXPECT_EQ(refusal([&] { plane_normal_rotation_of(space.contacts(), space.bodies()); }),
            "dimensions = 3: plane_normal_rotation_of takes contacts in the plane");
  BodyPacking bad = space;
  bad.orientation[5].coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(refusal([&] {
              normal_rotation_of(bad.contacts(), bad.bodies(), Shape::prolate);
            }).substr(0, 14),
            "orientation[5]");
}

// Each side's body counts by its own shape: one needle among rounder ones.
TEST(NormalRotation, CalculatedFactorsAreMeansOverTheSides) {
  Random random(128);
  BodyPacking sample =
      draw_among_spheres(random, kProlate, planted_axes(random, kAxes), everywhere(0.5), 40, 3);
  for (std::size_t body = 0; body < 10; ++body) sample.semi_axes[body] = {1.0, 0.2, 0.2};
  const auto found = normal_rotation_of(sample.contacts(), sample.bodies(), Shape::prolate);
  const auto seen = contact_statistics_of(sample.contacts(), sample.bodies(), Shape::prolate);
  const double a1 = seen->spheroid->a1.value;
  const RotationFactors needle = space_rotation({1.0, 0.2}).factors(a1);
  const RotationFactors other = space_rotation(kProlate).factors(a1);
  EXPECT_NEAR(found->calculated.second, 0.25 * needle.second + 0.75 * other.second, 1e-12);
  EXPECT_NEAR(found->calculated.fourth, 0.25 * needle.fourth + 0.75 * other.fourth, 1e-12);
}

TEST(PlaneNormalRotation, IndependentNormalsLeaveNothingAndHaveTheModelsFactor) {
  Random random(125);
  const Spheroid s{1.0 / 0.7, 1.0};
  const double a_l = 0.4, a_e = 0.8;
  const BodyPacking sample = draw_plane(random, s, a_e, everywhere(a_l), 5000, 4);
  const auto found = plane_normal_rotation_of(sample.contacts(), sample.bodies());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sides, 20000U);
  EXPECT_LT(std::abs(found->a_l.value - a_l), 4.0 * found->a_l.error);
  EXPECT_LT(std::abs(found->mean_cosine.value + plane_rotation(s).factor(a_l)),
            4.0 * found->mean_cosine.error);
  EXPECT_NEAR(found->calculated, -plane_rotation(s).factor(found->a_l.value), 1e-12);
  EXPECT_NEAR(found->arc_law_a_l, arc_law_anisotropy(s), 1e-12);
  EXPECT_NEAR(amplitude(found->axes_of_bodies), a_e, 0.06);
  const Mat3 left = found->other.cwiseAbs();
  EXPECT_LT(left(0, 0), 4.0 * found->other_error(0, 0));
  EXPECT_LT(left(0, 1), 4.0 * found->other_error(0, 1));
  const auto normals = fit_plane_orientations(sample.packing.normal);
  EXPECT_LT((found->rotated + found->other - normals->second).norm(), 1e-12);
  // Axes at 0: normals lie across.
  EXPECT_LT(found->rotated(0, 0), -0.05);
  const LocalLaw law = [](const Vec3& u) { return u[0] * u[1] > 0.0 ? 0.9 : -0.9; };
  const BodyPacking dependent = draw_plane(random, s, 0.0, law, 5000, 4);
  const auto seen = plane_normal_rotation_of(dependent.contacts(), dependent.bodies());
  EXPECT_GT(std::abs(seen->other(0, 1)), 6.0 * seen->other_error(0, 1));
}

TEST(PlaneNormalRotation, CirclesAreLeftOutAndTiltedBodiesRefused) {
  Random random(126);
  BodyPacking sample = draw_plane(random, {1.0, 1.0}, 0.0, everywhere(0.0), 10, 3);
  EXPECT_FALSE(plane_normal_rotation_of(sample.contacts(), sample.bodies()));
  sample.orientation[0] = Quaternion(random_rotation(random));
  EXPECT_THROW(plane_normal_rotation_of(sample.contacts(), sample.bodies()), std::invalid_argument);
}

}  // namespace
