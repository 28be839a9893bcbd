// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include <tangency/dem/micromechanics/fabric.hpp>

#include "fields.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using tangency::Mat3;
using tangency::Vec3;

/// The largest distance of any component from what was planted, in standard errors.
template <typename Model>
double errors_off(const Model& found, const HarmonicErrors& error, const Model& planted) {
  double most = ((found.second - planted.second).cwiseAbs().cwiseQuotient(error.second)).maxCoeff();
  for (std::size_t c = 0; c < SymmetricTensor4::kComponents; ++c)
    most = std::max(most, std::abs(found.fourth.components[c] - planted.fourth.components[c]) /
                              error.fourth.components[c]);
  return most;
}

TEST(Fabric, PlantedAnisotropiesAreFoundWithinFourStandardErrors) {
  Random random(31);
  for (const bool with_fourth : {false, true}) {
    const Planted planted = random_planted(random, with_fourth);
    const Packing packing = draw(random, planted, 5000, 0.4);
    const auto normals = fit_orientations(packing.normal);
    ASSERT_TRUE(normals);
    EXPECT_LT(errors_off(normals->model, normals->error, planted.density), 4.0);
    for (const auto& partition : {SpherePartition::near_uniform(4), SpherePartition::polar(18, 36)})
      for (const Estimator estimator : {Estimator::published, Estimator::unbiased}) {
        const Fabric fabric = fabric_of(packing.arrays(), partition, estimator);
        ASSERT_TRUE(fabric.force && fabric.branch && fabric.branch_length);
        const auto check = [&](const VectorFit& fit, const ScalarHarmonics& along,
                               const TangentialHarmonics& across) {
          EXPECT_LT(errors_off(fit.normal.model, fit.normal.error, along), 4.0);
          EXPECT_LT(errors_off(fit.tangential.model, fit.tangential.error, across), 4.0);
          EXPECT_LT(std::abs(fit.normal.model.mean - along.mean), 4.0 * fit.normal.error.mean);
          EXPECT_EQ(fit.tangential.model.mean, fit.normal.model.mean);
          EXPECT_LT(fit.normal.error.second.maxCoeff(), 0.05);
          EXPECT_GT(fit.normal.error.second.minCoeff(), 0.005);
        };
        check(*fabric.force, planted.force, planted.tangential_force);
        check(*fabric.branch, planted.branch, planted.tangential_branch);
      }
  }
}

// Branches along normals have the length of their normal component.
TEST(Fabric, BranchLengthsOfSpheresAreTheirNormalComponents) {
  Random random(32);
  Planted planted = random_planted(random, true);
  planted.tangential_branch = {};
  const Packing packing = draw(random, planted, 3000, 0.0);
  const Fabric fabric = fabric_of(packing.arrays(), SpherePartition::near_uniform(4));
  EXPECT_LT((fabric.branch_length->model.second - planted.branch.second).norm(), 1e-12);
  EXPECT_NEAR(fabric.branch_length->model.mean, planted.branch.mean, 1e-12);
  EXPECT_LT(fabric.branch->tangential.model.second.norm(), 1e-14);
}

TEST(Fabric, LeastSquaresGiveAFieldWithoutScatterBackExactly) {
  Random random(33);
  const Planted planted = random_planted(random, true);
  const Packing packing = draw(random, planted, 700, 0.0);
  for (const auto& partition : {SpherePartition::near_uniform(4), SpherePartition::polar(18, 36)}) {
    const auto fit = fit_vectors(DirectionGroups(partition, packing.normal), packing.force);
    EXPECT_NEAR(fit->normal.model.mean, planted.force.mean, 1e-12);
    EXPECT_LT((fit->normal.model.second - planted.force.second).norm(), 1e-12);
    EXPECT_LT(distance(fit->normal.model.fourth, planted.force.fourth), 1e-12);
    EXPECT_LT((fit->tangential.model.second - planted.tangential_force.second).norm(), 1e-12);
    EXPECT_LT(distance(fit->tangential.model.fourth, planted.tangential_force.fourth), 1e-12);
  }
}

// Evenly spread contacts, so that scatter does not hide it: 0.8 to 1 % of order 2.
TEST(Fabric, PublishedEstimatesComeOutAsMuchTooSmallAsTheHeaderSays) {
  Random random(34);
  Planted planted = random_planted(random, false);
  planted.density.second.setZero();
  const Packing packing = draw(random, planted, 60000, 0.0);
  const DirectionGroups groups(SpherePartition::near_uniform(4), packing.normal);
  const auto fit = fit_vectors(groups, packing.force, Estimator::published);
  const Mat3& a = planted.force.second;
  const double ratio = fit->normal.model.second.cwiseProduct(a).sum() / a.squaredNorm();
  EXPECT_GT(ratio, 0.988);
  EXPECT_LT(ratio, 0.994);
}

// The published estimate as the sums of its definition, with class means at class middles.
TEST(Fabric, PublishedEstimatesAreProjectionsOfClassMeans) {
  Random random(35);
  const Packing packing = draw(random, random_planted(random, true), 800, 0.3);
  const DirectionGroups groups(SpherePartition::near_uniform(4), packing.normal);
  const auto along = groups.means(normal_components(packing.normal, packing.force));
  const auto across = groups.means(tangential_components(packing.normal, packing.force));
  Mat3 fn = Mat3::Zero(), ft = Mat3::Zero();
  SymmetricTensor4 fn4, ft4;
  for (std::size_t g = 0; g < along.size(); ++g) {
    const Vec3& n = groups.partition().direction(g);
    fn += groups.weight(g) * along[g] * n * n.transpose();
    ft += groups.weight(g) * across[g] * n.transpose();
    fn4 += groups.weight(g) * along[g] * SymmetricTensor4::power(n);
    ft4 += groups.weight(g) * SymmetricTensor4::product(across[g], n);
  }
  const double f0 = fn.trace();
  const auto fit = fit_vectors(groups, packing.force, Estimator::published);
  EXPECT_NEAR(fit->normal.model.mean, f0, 1e-12);
  EXPECT_LT((fit->normal.model.second - 7.5 / f0 * harmonic_part(fn)).norm(), 1e-12);
  EXPECT_LT((fit->tangential.model.second - 5.0 / f0 * harmonic_part(ft)).norm(), 1e-12);
  EXPECT_LT(distance(fit->normal.model.fourth, 315.0 / 8.0 / f0 * harmonic_part(fn4)), 1e-11);
  EXPECT_LT(distance(fit->tangential.model.fourth, 31.5 / f0 * harmonic_part(ft4)), 1e-11);
}

TEST(Fabric, ContactSumsFindWhatIsPlantedWithOrderTwoNormals) {
  Random random(36);
  const Planted planted = random_planted(random, false);
  const Packing packing = draw(random, planted, 20000, 0.3);
  const auto fit = fit_vectors(DirectionGroups(SpherePartition::near_uniform(1), packing.normal),
                               packing.force, Estimator::contact_sums, 2);
  EXPECT_LT((fit->normal.model.second - planted.force.second).norm(), 0.1);
  EXPECT_LT((fit->tangential.model.second - planted.tangential_force.second).norm(), 0.1);
  Mat3 sum = Mat3::Zero();
  const Mat3 r = fit_orientations(packing.normal)->model.second;
  for (std::size_t c = 0; c < packing.normal.size(); ++c) {
    const Vec3& n = packing.normal[c];
    sum += packing.force[c].dot(n) / (1.0 + n.dot(r * n)) * n * n.transpose() /
           static_cast<double>(packing.normal.size());
  }
  EXPECT_LT((fit->normal.model.second - 7.5 * harmonic_part(sum) / sum.trace()).norm(), 1e-12);
}

TEST(Fabric, StandardErrorsAreTheScatterOfRepeatedSamples) {
  Random random(37);
  const Planted planted = random_planted(random, false);
  constexpr int repeats = 150;
  for (const Estimator estimator : {Estimator::published, Estimator::unbiased}) {
    std::vector<std::vector<double>> seen(5), error(5);
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const Packing packing = draw(random, planted, 400, 0.5);
      const DirectionGroups groups(SpherePartition::near_uniform(1), packing.normal);
      const auto fit = fit_vectors(groups, packing.force, estimator, 2);
      const auto normals = fit_orientations(packing.normal);
      const auto keep = [&](std::size_t i, double value, double deviation) {
        seen[i].push_back(value);
        error[i].push_back(deviation);
      };
      keep(0, normals->model.second(0, 0), normals->error.second(0, 0));
      keep(1, normals->model.fourth(0, 1, 1, 2), normals->error.fourth(0, 1, 1, 2));
      keep(2, fit->normal.model.second(0, 2), fit->normal.error.second(0, 2));
      keep(3, fit->tangential.model.second(1, 1), fit->tangential.error.second(1, 1));
      keep(4, fit->normal.model.mean, fit->normal.error.mean);
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      double mean = 0.0, square = 0.0, expected = 0.0;
      for (const double value : seen[i]) mean += value / repeats;
      for (const double value : seen[i]) square += (value - mean) * (value - mean) / (repeats - 1);
      for (const double value : error[i]) expected += value / repeats;
      // 4 deviations of a deviation from 150 samples: 4/sqrt(300) of it.
      EXPECT_NEAR(std::sqrt(square) / expected, 1.0, 0.23) << i;
    }
  }
}

TEST(Fabric, ErrorsOfEvenlySpreadNormalsAreThoseOfTheirNumber) {
  Random random(38);
  std::vector<Vec3> directions(20000);
  for (Vec3& n : directions) n = random_direction(random);
  const auto fit = fit_orientations(directions);
  const auto count = static_cast<double>(directions.size());
  EXPECT_NEAR(fit->error.second(0, 0) / std::sqrt(5.0 / count), 1.0, 0.03);
  EXPECT_NEAR(fit->error.second(0, 1) / (7.5 / std::sqrt(15.0 * count)), 1.0, 0.03);
  EXPECT_NEAR(fit->error.second.norm() / std::sqrt(37.5 / count), 1.0, 0.03);
  EXPECT_NEAR(fit->error.fourth.norm() / std::sqrt(354.4 / count), 1.0, 0.03);
}

// dem/micromechanics/fabric.hpp (1)
TEST(Fabric, TurningDirectionsTurnsTheirTensors) {
  Random random(39);
  const Packing packing = draw(random, random_planted(random, true), 500, 0.0);
  const Mat3 rotation = random_rotation(random);
  const auto before = fit_orientations(packing.normal);
  const auto after = fit_orientations(rotated(packing, rotation).normal);
  EXPECT_LT((after->model.second - rotation * before->model.second * rotation.transpose()).norm(),
            1e-13);
  EXPECT_LT(distance(after->model.fourth, before->model.fourth.rotated(rotation)), 1e-12);
}

// dem/micromechanics/fabric.hpp (2)
TEST(Fabric, TurningContactsTurnsTheirTensors) {
  Random random(40);
  Mat3 symmetry;
  symmetry << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const SpherePartition partition = SpherePartition::near_uniform(3);
  const auto check = [&](const Packing& packing, const Mat3& rotation, Estimator estimator,
                         int order) {
    const Packing turned = rotated(packing, rotation);
    const auto before =
        fit_vectors(DirectionGroups(partition, packing.normal), packing.force, estimator, order);
    const auto after =
        fit_vectors(DirectionGroups(partition, turned.normal), turned.force, estimator, order);
    const auto turned_back = [&](const Mat3& a) {
      return Mat3(rotation.transpose() * a * rotation);
    };
    EXPECT_LT((turned_back(after->normal.model.second) - before->normal.model.second).norm(),
              1e-11);
    EXPECT_LT(
        (turned_back(after->tangential.model.second) - before->tangential.model.second).norm(),
        1e-11);
    EXPECT_LT(distance(after->normal.model.fourth, before->normal.model.fourth.rotated(rotation)),
              1e-10);
    EXPECT_LT(
        distance(after->tangential.model.fourth, before->tangential.model.fourth.rotated(rotation)),
        1e-10);
  };
  const Packing scattered = draw(random, random_planted(random, true), 1500, 0.4);
  for (const Estimator estimator :
       {Estimator::published, Estimator::unbiased, Estimator::contact_sums})
    check(scattered, symmetry, estimator, 4);
  const Mat3 rotation = random_rotation(random);
  check(draw(random, random_planted(random, true), 1500, 0.0), rotation, Estimator::unbiased, 4);
  check(scattered, rotation, Estimator::contact_sums, 4);
}

// dem/micromechanics/fabric.hpp (3)
TEST(Fabric, ExchangingBodiesAndTheOrderOfContactsChangesNothing) {
  Random random(41);
  const Packing packing = draw(random, random_planted(random, true), 900, 0.4);
  Packing other = exchanged(packing);
  for (auto* vectors : {&other.normal, &other.branch, &other.force, &other.arm})
    std::ranges::reverse(*vectors);
  for (const Estimator estimator :
       {Estimator::published, Estimator::unbiased, Estimator::contact_sums}) {
    const SpherePartition partition = SpherePartition::near_uniform(4);
    const Fabric before = fabric_of(packing.arrays(), partition, estimator);
    const Fabric after = fabric_of(other.arrays(), partition, estimator);
    EXPECT_LT((after.stress - before.stress).norm(), 1e-12);
    EXPECT_LT((after.normals->model.second - before.normals->model.second).norm(), 1e-12);
    EXPECT_LT((after.force->normal.model.second - before.force->normal.model.second).norm(), 1e-11);
    EXPECT_LT(
        distance(after.branch->tangential.model.fourth, before.branch->tangential.model.fourth),
        1e-10);
    EXPECT_LT((after.force->normal.error.second - before.force->normal.error.second).norm(), 1e-11);
    EXPECT_LT((after.contact_vectors->model.second - before.contact_vectors->model.second).norm(),
              1e-12);
    EXPECT_NEAR(after.normals_unexplained, before.normals_unexplained, 1e-12);
    EXPECT_EQ(after.empty_classes, before.empty_classes);
  }
}

// dem/micromechanics/fabric.hpp (4)
TEST(Fabric, AnotherUnitChangesTheMeanAlone) {
  Random random(42);
  const Packing packing = draw(random, random_planted(random, true), 900, 0.4);
  std::vector<Vec3> scaled = packing.force;
  for (Vec3& f : scaled) f *= 0x1p30;
  const DirectionGroups groups(SpherePartition::near_uniform(4), packing.normal);
  const auto before = fit_vectors(groups, packing.force), after = fit_vectors(groups, scaled);
  EXPECT_EQ(after->normal.model.mean, 0x1p30 * before->normal.model.mean);
  EXPECT_EQ(after->normal.error.mean, 0x1p30 * before->normal.error.mean);
  EXPECT_EQ(after->normal.model.second, before->normal.model.second);
  EXPECT_EQ(after->tangential.model.second, before->tangential.model.second);
  EXPECT_EQ(after->normal.unexplained, before->normal.unexplained);
}

TEST(Fabric, NoContactHasNoFabric) {
  const Packing none;
  for (const Estimator estimator :
       {Estimator::published, Estimator::unbiased, Estimator::contact_sums}) {
    const Fabric fabric = fabric_of(none.arrays(), SpherePartition::near_uniform(4), estimator);
    EXPECT_FALSE(fabric.normals || fabric.force || fabric.branch || fabric.branch_length ||
                 fabric.contact_vectors);
    EXPECT_EQ(fabric.stress, Mat3::Zero());
    EXPECT_EQ(fabric.contact_density, 0.0);
    EXPECT_EQ(fabric.empty_classes, 384U);
  }
}

TEST(Fabric, OneContactLeavesLeastSquaresOpenAndErrorsUnknown) {
  Random random(43);
  const Packing one = draw(random, random_planted(random, false), 1, 0.0);
  const SpherePartition partition = SpherePartition::near_uniform(4);
  const Fabric least = fabric_of(one.arrays(), partition, Estimator::unbiased);
  EXPECT_FALSE(least.force || least.branch);
  ASSERT_TRUE(least.normals);
  EXPECT_TRUE(std::isnan(least.normals->error.second(0, 0)));
  const Vec3& n = one.normal[0];
  EXPECT_LT(
      (least.normals->model.second - 7.5 * (n * n.transpose() - Mat3::Identity() / 3.0)).norm(),
      1e-13);
  const Fabric published = fabric_of(one.arrays(), partition, Estimator::published);
  ASSERT_TRUE(published.force);
  EXPECT_NEAR(published.force->normal.model.mean, one.force[0].dot(n), 1e-14);
  EXPECT_TRUE(std::isnan(published.force->normal.error.second(0, 0)));
}

TEST(Fabric, NormalsOfOneDirectionOrOfOnePlaneLeaveLeastSquaresOpen) {
  Random random(44);
  Packing packing = draw(random, random_planted(random, false), 200, 0.1);
  const SpherePartition partition = SpherePartition::near_uniform(4);
  const auto open = [&] {
    return !fit_vectors(DirectionGroups(partition, packing.normal), packing.force).has_value();
  };
  EXPECT_FALSE(open());
  for (Vec3& n : packing.normal) n = Vec3(n[0], n[1], 0.0).normalized();
  EXPECT_TRUE(open());
  for (Vec3& n : packing.normal) n = Vec3(1.0, 2.0, 2.0) / 3.0;
  EXPECT_TRUE(open());
  const auto published =
      fit_vectors(DirectionGroups(partition, packing.normal), packing.force, Estimator::published);
  ASSERT_TRUE(published);
  EXPECT_TRUE(std::isfinite(published->normal.model.second(0, 0)));
  for (Vec3& f : packing.force) f.setZero();
  EXPECT_FALSE(
      fit_vectors(DirectionGroups(partition, packing.normal), packing.force, Estimator::published));
}

TEST(Fabric, OrderTwoFitsHaveNoFourthOrderAndOtherOrdersAreRefused) {
  Random random(45);
  const Packing packing = draw(random, random_planted(random, true), 500, 0.1);
  const DirectionGroups groups(SpherePartition::near_uniform(4), packing.normal);
  const auto two = fit_vectors(groups, packing.force, Estimator::unbiased, 2);
  const auto four = fit_vectors(groups, packing.force, Estimator::unbiased, 4);
  EXPECT_EQ(two->normal.model.fourth.norm(), 0.0);
  EXPECT_LT(four->normal.unexplained, two->normal.unexplained);
  EXPECT_LT(four->tangential.unexplained, two->tangential.unexplained);
  EXPECT_THROW(fit_vectors(groups, packing.force, Estimator::unbiased, 3), std::invalid_argument);
  EXPECT_THROW(fit_scalars(groups, std::vector<double>(3)), std::invalid_argument);
  Packing plane = packing;
  plane.dimensions = 2;
  EXPECT_THROW(fabric_of(plane.arrays(), groups.partition()), std::invalid_argument);
  EXPECT_THROW(fit_orientations(std::vector<Vec3>{Vec3(1.0, 1.0, 0.0)}), std::invalid_argument);
}

// Erratum 11: the published text calls the cubic sample highly anisotropic in a^r.
TEST(FabricErrata, ACubicLatticeIsIsotropicInOrderTwoAndNotInOrderFour) {
  const std::vector<Vec3> lattice = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const auto fit = fit_orientations(lattice);
  EXPECT_LT(fit->model.second.norm(), 1e-14);
  EXPECT_NEAR(fit->model.fourth(0, 0, 0, 0), 21.0 / 4.0, 1e-13);
  EXPECT_NEAR(fit->model.fourth(0, 0, 1, 1), -21.0 / 8.0, 1e-13);
  EXPECT_NEAR(fit->model.fourth.norm(), 315.0 / 8.0 * std::sqrt(2.0 / 15.0), 1e-12);
}

// Erratum 12: the published text ties the symmetry of the tangential force tensor to a small angle
// of contact vector and normal; it is the balance of moments, and contact vectors do not enter.
TEST(FabricErrata, TangentialForceTensorIsSymmetricWhereMomentsBalanceWhateverTheContactVectors) {
  Random random(46);
  const Packing packing = draw(random, random_planted(random, true), 40000, 0.0);
  const DirectionGroups groups(SpherePartition::near_uniform(8), packing.normal);
  const auto balanced = fit_vectors(groups, packing.force);
  EXPECT_LT(balanced->tangential.asymmetry, 0.05);
  // w x n turns every particle: the field of moments that are not balanced.
  const Vec3 w(0.0, 0.0, 0.6);
  std::vector<Vec3> turning;
  for (const Vec3& n : packing.normal) turning.push_back(3.0 * n + w.cross(n));
  const auto unbalanced = fit_vectors(groups, turning);
  EXPECT_NEAR(unbalanced->tangential.asymmetry, 2.0, 0.05);
  EXPECT_LT(unbalanced->tangential.model.second.norm(), 0.01);
}

}  // namespace
