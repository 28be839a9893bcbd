// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <tangency/dem/micromechanics/plane.hpp>

#include "fields.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using tangency::Mat3;
using tangency::Vec3;

Mat3 plane_tensor(double size, double angle) {
  Mat3 a = Mat3::Zero();
  a.topLeftCorner<2, 2>() << std::cos(2.0 * angle), std::sin(2.0 * angle), std::sin(2.0 * angle),
      -std::cos(2.0 * angle);
  return size * a;
}

/// Of any axes.
PlaneState random_state(Random& random) {
  PlaneState state{10.0, 3.0, 2.0, {}, {}, {}, {}, {}};
  for (Mat3* a : {&state.r, &state.n, &state.t, &state.z, &state.zt})
    *a = plane_tensor(uniform(random, 0.05, 0.5), uniform(random, 0.0, std::numbers::pi));
  return state;
}

PlaneState coaxial_state(double angle, const PlaneAmplitudes& a) {
  return {10.0,
          3.0,
          2.0,
          plane_tensor(a.r, angle),
          plane_tensor(a.n, angle),
          plane_tensor(a.t, angle),
          plane_tensor(a.z, angle),
          plane_tensor(a.zt, angle)};
}

Vec3 field(double mean, const Mat3& along, const Mat3& across, const Vec3& n) {
  const Vec3 left(-n[1], n[0], 0.0);
  return mean * ((1.0 + n.dot(along * n)) * n + left.dot(across * n) * left);
}

Mat3 by_quadrature(const PlaneState& s) {
  return 0.5 * s.contact_density * mean_over(circle_points(), [&](const Vec3& n) {
           const double relative_density = 1.0 + n.dot(s.r * n);
           return Mat3(relative_density * field(s.force, s.n, s.t, n) *
                       field(s.branch, s.z, s.zt, n).transpose());
         });
}

Packing draw_plane(Random& random, const PlaneState& state, std::size_t contacts, double noise) {
  Packing packing;
  packing.dimensions = 2;
  packing.volume = 2.0 * static_cast<double>(contacts) / state.contact_density;
  while (packing.normal.size() < contacts) {
    const double theta = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const Vec3 n(std::cos(theta), std::sin(theta), 0.0);
    if (uniform(random, 0.0, 2.0) > 1.0 + n.dot(state.r * n)) continue;
    const auto off = [&](double mean) {
      return Vec3(noise * mean * normal(random), noise * mean * normal(random), 0.0);
    };
    packing.normal.push_back(n);
    packing.force.push_back(field(state.force, state.n, state.t, n) + off(state.force));
    packing.branch.push_back(field(state.branch, state.z, state.zt, n) + off(state.branch));
  }
  return packing;
}

// dem/micromechanics/plane.hpp (1)
TEST(Plane, ClosedFormOfTheStressIsTheQuadratureOfTheModels) {
  Random random(81);
  for (int trial = 0; trial < 50; ++trial) {
    const PlaneState state = random_state(random);
    const Mat3 expected = by_quadrature(state);
    EXPECT_LT((plane_stress(state) - expected).norm(), 1e-13 * expected.norm());
  }
}

// dem/micromechanics/plane.hpp (2)
TEST(Plane, CoaxialShearRatioIsThatOfTheStress) {
  Random random(82);
  for (int trial = 0; trial < 50; ++trial) {
    PlaneAmplitudes a{uniform(random, 0.1, 0.5), uniform(random, 0.1, 0.5),
                      uniform(random, 0.0, 0.3), uniform(random, -0.1, 0.1),
                      uniform(random, -0.1, 0.1)};
    const double angle = uniform(random, 0.0, std::numbers::pi);
    EXPECT_NEAR(coaxial_shear_ratio(a), plane_shear_ratio(by_quadrature(coaxial_state(angle, a))),
                1e-12);
    a.z = a.zt = 0.0;
    EXPECT_NEAR(coaxial_shear_ratio(a), 0.5 * (a.r + a.n + a.t) / (1.0 + 0.5 * a.r * a.n), 1e-15);
    EXPECT_NEAR(shear_ratio_of_small_anisotropy(a),
                coaxial_shear_ratio(a) * (1.0 + 0.5 * a.r * a.n), 1e-15);
  }
  EXPECT_TRUE(std::isnan(plane_shear_ratio(Mat3::Zero())));
}

TEST(Plane, AmplitudeIsThePositivePrincipalValue) {
  EXPECT_NEAR(amplitude(plane_tensor(0.3, 0.7)), 0.3, 1e-15);
  EXPECT_NEAR(plane_tensor(0.3, 0.7).norm() / std::sqrt(2.0), 0.3, 1e-15);
}

TEST(Plane, PlantedAnisotropiesAreFoundWithinFourStandardErrors) {
  Random random(83);
  const PlaneState planted = random_state(random);
  const Packing packing = draw_plane(random, planted, 5000, 0.4);
  for (const int arcs : {36, 72})
    for (const Estimator estimator :
         {Estimator::published, Estimator::unbiased, Estimator::contact_sums}) {
      const PlaneFabric fabric = plane_fabric_of(packing.arrays(), arcs, estimator);
      ASSERT_TRUE(fabric.normals && fabric.force && fabric.branch);
      const auto check = [](const PlaneScalarFit& fit, const Mat3& a) {
        for (int j = 0; j < 2; ++j)
          EXPECT_LT(std::abs(fit.second(0, j) - a(0, j)), 4.0 * fit.second_error(0, j));
        EXPECT_LT(fit.second_error.maxCoeff(), 0.03);
        EXPECT_GT(fit.second_error(0, 0), 0.003);
      };
      check(*fabric.normals, planted.r);
      check(fabric.force->normal, planted.n);
      check(fabric.force->tangential, planted.t);
      check(fabric.branch->normal, planted.z);
      check(fabric.branch->tangential, planted.zt);
      EXPECT_LT(std::abs(fabric.force->normal.mean - planted.force),
                4.0 * fabric.force->normal.mean_error);
      const auto state = plane_state(fabric);
      ASSERT_TRUE(state);
      EXPECT_LT((plane_stress(*state) - fabric.stress).norm(), 0.02 * fabric.stress.norm());
    }
}

TEST(Plane, LeastSquaresGiveAFieldWithoutScatterBackExactlyAtAnyRotation) {
  Random random(84);
  const PlaneState planted = random_state(random);
  const Packing packing = draw_plane(random, planted, 300, 0.0);
  const double angle = 0.8;
  const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  Packing turned = rotated(packing, turn);
  for (Vec3& n : turned.normal) n[2] = 0.0;
  const auto fit = fit_plane_vectors(packing.normal, packing.force);
  const auto after = fit_plane_vectors(turned.normal, turned.force);
  EXPECT_NEAR(fit->normal.mean, planted.force, 1e-12);
  EXPECT_LT((fit->normal.second - planted.n).norm(), 1e-12);
  EXPECT_LT((fit->tangential.second - planted.t).norm(), 1e-12);
  EXPECT_LT((after->normal.second - turn * planted.n * turn.transpose()).norm(), 1e-12);
  EXPECT_LT((after->tangential.second - turn * planted.t * turn.transpose()).norm(), 1e-12);
}

TEST(Plane, ExchangingBodiesChangesNothing) {
  Random random(85);
  Packing packing = draw_plane(random, random_state(random), 400, 0.3);
  packing.arm = packing.branch;
  packing.particles = 1;
  packing.bodies.assign(packing.normal.size(), {0, 0});
  const Packing other = exchanged(packing);
  for (const Estimator estimator : {Estimator::published, Estimator::unbiased}) {
    const PlaneFabric before = plane_fabric_of(packing.arrays(), 36, estimator);
    const PlaneFabric after = plane_fabric_of(other.arrays(), 36, estimator);
    EXPECT_LT((after.normals->second - before.normals->second).norm(), 1e-13);
    EXPECT_LT((after.force->tangential.second - before.force->tangential.second).norm(), 1e-12);
    EXPECT_LT((after.branch->normal.second_error - before.branch->normal.second_error).norm(),
              1e-12);
  }
}

TEST(Plane, TooFewContactsLeaveLeastSquaresOpen) {
  Random random(86);
  const Packing none;
  PlaneFabric fabric;
  Packing packing = none;
  packing.dimensions = 2;
  fabric = plane_fabric_of(packing.arrays());
  EXPECT_FALSE(fabric.normals || fabric.force || fabric.branch || plane_state(fabric));
  packing = draw_plane(random, random_state(random), 1, 0.0);
  EXPECT_FALSE(plane_fabric_of(packing.arrays()).force);
  const auto published = plane_fabric_of(packing.arrays(), 36, Estimator::published);
  ASSERT_TRUE(published.force);
  EXPECT_TRUE(std::isnan(published.force->normal.second_error(0, 0)));
  packing = draw_plane(random, random_state(random), 100, 0.1);
  for (Vec3& n : packing.normal) n = Vec3::UnitY();
  EXPECT_FALSE(plane_fabric_of(packing.arrays()).force);
}

TEST(Plane, WrongInputIsRefused) {
  const std::vector<Vec3> normals = {Vec3::UnitX(), Vec3::UnitY()};
  EXPECT_THROW(fit_plane_vectors(normals, normals, 7), std::invalid_argument);
  EXPECT_THROW(fit_plane_vectors(normals, normals, 2), std::invalid_argument);
  EXPECT_THROW(fit_plane_vectors(normals, std::vector<Vec3>(3)), std::invalid_argument);
  EXPECT_THROW(fit_plane_orientations(std::vector<Vec3>{Vec3::UnitZ()}), std::invalid_argument);
  Packing packing;
  EXPECT_THROW(plane_fabric_of(packing.arrays()), std::invalid_argument);
}

}  // namespace
