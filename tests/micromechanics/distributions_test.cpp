// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <tangency/dem/micromechanics/distributions.hpp>
#include <tangency/dem/micromechanics/fabric.hpp>

#include "fields.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using tangency::Mat3;
using tangency::Quaternion;
using tangency::Vec3;

// dem/micromechanics/distributions.hpp (1)
TEST(DirectionGroups, DensityAndWeightsAddUpToOne) {
  Random random(51);
  const Packing packing = draw(random, random_planted(random, true), 600, 0.2);
  for (const auto& partition : {SpherePartition::near_uniform(4), SpherePartition::polar(18, 36)}) {
    const DirectionGroups groups(partition, packing.normal);
    double density = 0.0, weight = 0.0, of_contacts = 0.0;
    std::int64_t sides = 0;
    for (std::size_t g = 0; g < partition.size(); ++g) {
      density += groups.density(g) * partition.area(g);
      weight += groups.weight(g);
      sides += groups.sides(g);
      EXPECT_EQ(groups.sides(g), groups.sides(partition.opposite(g)));
    }
    for (std::size_t c = 0; c < groups.contacts(); ++c) of_contacts += groups.contact_weight(c);
    EXPECT_NEAR(density, 1.0, 1e-12);
    EXPECT_NEAR(weight, 1.0, 1e-12);
    EXPECT_NEAR(of_contacts, 1.0, 1e-12);
    EXPECT_EQ(sides, 1200);
    EXPECT_GT(groups.empty_classes(), 0U);
  }
}

// dem/micromechanics/distributions.hpp (2)
TEST(DirectionGroups, ExchangingBodiesChangesNoMean) {
  Random random(52);
  const Packing packing = draw(random, random_planted(random, true), 600, 0.2);
  const Packing other = exchanged(packing);
  const SpherePartition partition = SpherePartition::near_uniform(3);
  const DirectionGroups a(partition, packing.normal), b(partition, other.normal);
  const auto before = a.means(packing.force), after = b.means(other.force);
  for (std::size_t g = 0; g < partition.size(); ++g) {
    EXPECT_EQ(a.sides(g), b.sides(g));
    EXPECT_LT((before[g] - after[g]).norm(), 1e-13);
    EXPECT_EQ(before[g], -before[partition.opposite(g)]);
  }
  EXPECT_NEAR(a.over_orientations(lengths(packing.branch)),
              b.over_orientations(lengths(other.branch)), 1e-13);
}

// Second-order models: the average over contacts is f0 (1 + (2/15) a^r:a^n).
TEST(DirectionGroups, TheTwoAveragesDifferAsTheModelsSay) {
  Random random(53);
  Planted planted = random_planted(random, false);
  planted.density.second = axisymmetric(Vec3::UnitX(), 0.5);
  planted.force.second = axisymmetric(Vec3::UnitX(), 0.8);
  const Packing packing = draw(random, planted, 100000, 0.0);
  const DirectionGroups groups(SpherePartition::near_uniform(4), packing.normal);
  const auto along = normal_components(packing.normal, packing.force);
  const double f0 = planted.force.mean;
  EXPECT_NEAR(groups.over_orientations(along), f0, 0.002 * f0);
  EXPECT_NEAR(groups.over_contacts(along), f0 * (1.0 + 2.0 / 15.0 * 0.5 * 0.8), 0.003 * f0);
}

TEST(DirectionGroups, ArraysOfAnotherLengthAreRefused) {
  const DirectionGroups groups(SpherePartition::near_uniform(1),
                               std::vector<Vec3>{Vec3::UnitX(), Vec3::UnitY()});
  EXPECT_THROW(groups.over_contacts(std::vector<double>(3)), std::invalid_argument);
  EXPECT_THROW(groups.over_orientations(std::vector<double>(1)), std::invalid_argument);
  EXPECT_THROW(groups.means(std::vector<double>(3)), std::invalid_argument);
  EXPECT_THROW(groups.means(std::vector<Vec3>(3)), std::invalid_argument);
  EXPECT_EQ(DirectionGroups(SpherePartition::near_uniform(1), {}).over_contacts({}), 0.0);
}

TEST(GroupSums, ExactSumIsTheStressWithHalfBranchesAndWithContactVectors) {
  Random random(54);
  Packing packing = draw(random, random_planted(random, true), 3000, 0.3);
  const Mat3 stress = stress_of(packing.arrays());
  const DirectionGroups groups(SpherePartition::near_uniform(4), packing.normal);
  const GroupSums with_arms = group_sums(groups, packing.arrays());
  EXPECT_LT((with_arms.exact - stress).norm(), 1e-12 * stress.norm());
  packing.arm.clear();
  const GroupSums with_branches = group_sums(groups, packing.arrays());
  EXPECT_LT((with_branches.exact - stress).norm(), 1e-12 * stress.norm());
}

TEST(GroupSums, IndependentSumTellsWhetherForcesDependOnBranchesWithinGroups) {
  Random random(55);
  Planted planted = random_planted(random, false);
  Packing packing = draw(random, planted, 30000, 0.0);
  packing.arm.clear();
  const DirectionGroups groups(SpherePartition::near_uniform(4), packing.normal);
  const auto off = [&] {
    const GroupSums sums = group_sums(groups, packing.arrays());
    return (sums.independent - sums.exact).trace() / sums.exact.trace();
  };
  EXPECT_NEAR(off(), 0.0, 0.01);
  for (std::size_t c = 0; c < packing.force.size(); ++c) {
    const double factor = uniform(random, 0.5, 1.5);  // of variance 1/12
    packing.force[c] *= factor;
    packing.branch[c] *= factor;
  }
  EXPECT_NEAR(off(), -1.0 / 13.0, 0.01);
}

TEST(GroupSums, ProductsAreThoseOfTheSidesOfEachClass) {
  Random random(63);
  const Packing packing = draw(random, random_planted(random, true), 200, 0.3);
  const DirectionGroups groups(SpherePartition::near_uniform(2), packing.normal);
  const std::vector<Mat3> found = group_sums(groups, packing.arrays()).products;
  ASSERT_EQ(found.size(), groups.partition().size());
  for (std::size_t g = 0; g < found.size(); ++g) {
    Mat3 sum = Mat3::Zero();
    for (std::size_t c = 0; c < packing.normal.size(); ++c) {
      const Vec3 of_b = packing.arm[c] - packing.branch[c];
      if (groups.partition().class_of(packing.normal[c]) == g)
        sum += packing.force[c] * packing.arm[c].transpose();
      if (groups.partition().class_of(-packing.normal[c]) == g)
        sum += -packing.force[c] * of_b.transpose();
    }
    EXPECT_LT((found[g] - sum).norm(), 1e-12);
  }
}

// One class holds one contact and its opposite the other side: both sums are the contact's product.
TEST(GroupSums, OfOneContactIsItsForceTimesItsBranch) {
  Random random(56);
  Packing one = draw(random, random_planted(random, false), 1, 0.2);
  const GroupSums sums =
      group_sums(DirectionGroups(SpherePartition::near_uniform(4), one.normal), one.arrays());
  const Mat3 product = one.force[0] * one.branch[0].transpose() / one.volume;
  EXPECT_LT((sums.exact - product).norm(), 1e-13);
  EXPECT_LT((sums.independent - product).norm(), 1e-13);
}

TEST(UnexplainedVariance, IsZeroOfAPerfectModelAndOneOfAConstant) {
  Random random(57);
  const Planted planted = random_planted(random, true);
  std::vector<Vec3> normals;
  const SpherePartition partition = SpherePartition::near_uniform(4);
  for (std::size_t g = 0; g < partition.size(); ++g)
    if (partition.opposite(g) > g) normals.push_back(partition.direction(g));
  std::vector<double> along;
  std::vector<Vec3> across;
  for (const Vec3& n : normals) {
    along.push_back(planted.force.value(n));
    across.push_back(planted.tangential_force.value(n));
  }
  const DirectionGroups groups(partition, normals);
  EXPECT_LT(unexplained_variance(groups, along, planted.force), 1e-28);
  EXPECT_LT(unexplained_variance(groups, across, planted.tangential_force), 1e-28);
  const double mean = groups.over_orientations(along);
  EXPECT_NEAR(unexplained_variance(groups, along, ScalarHarmonics{mean, Mat3::Zero(), {}}), 1.0,
              1e-12);
  EXPECT_NEAR(unexplained_variance(groups, across, TangentialHarmonics{}), 1.0, 1e-12);
  const ScalarHarmonics even{0.25 / std::numbers::pi, Mat3::Zero(), {}};
  EXPECT_NEAR(unexplained_variance(groups, even), 1.0, 1e-12);
  const std::vector<double> constant(normals.size(), 0.1);
  EXPECT_TRUE(std::isnan(unexplained_variance(groups, constant, planted.force)));
}

TEST(UnexplainedVariance, OfNormalsFallsWithTheOrderThatIsPlanted) {
  Random random(58);
  const Packing packing = draw(random, random_planted(random, true), 50000, 0.0);
  const DirectionGroups groups(SpherePartition::near_uniform(4), packing.normal);
  ScalarHarmonics model = fit_orientations(packing.normal)->model;
  const double four = unexplained_variance(groups, model);
  model.fourth = {};
  const double two = unexplained_variance(groups, model);
  EXPECT_LT(four, 0.3);
  EXPECT_LT(four, 0.9 * two);
  EXPECT_LT(two, 1.0);
}

TEST(RadialMeans, FollowTheRadialComponentOfTheModel) {
  Random random(59);
  const Planted planted = random_planted(random, true);
  const Vec3 axis(1.0, 2.0, -0.5);
  const Packing packing = draw(random, planted, 100000, 0.0);
  const DirectionGroups groups(SpherePartition::polar(18, 36, axis), packing.normal);
  const auto rings = radial_means(groups, tangential_components(packing.normal, packing.force));
  ASSERT_EQ(rings.size(), 18U);
  for (const RadialRing& ring : rings) {
    EXPECT_EQ(ring.filled_sectors, 36U);
    EXPECT_NEAR(ring.value, planted.tangential_force.radial(ring.beta, groups.partition().axis()),
                0.05);
  }
  EXPECT_NEAR(rings[0].beta, std::numbers::pi / 36.0, 1e-15);
  EXPECT_THROW(radial_means(DirectionGroups(SpherePartition::near_uniform(1), packing.normal),
                            packing.force),
               std::invalid_argument);
}

TEST(ContactArrays, StressIsForceTimesBranchOverVolumeAsItComes) {
  Packing one;
  one.volume = 4.0;
  one.normal = {Vec3::UnitX()};
  one.force = {Vec3(3.0, 1.0, 0.0)};
  one.branch = {Vec3(2.0, 0.0, 0.0)};
  Mat3 expected = Mat3::Zero();
  expected(0, 0) = 1.5;
  expected(1, 0) = 0.5;
  EXPECT_EQ(stress_of(one.arrays()), expected);
  EXPECT_NEAR(stress_asymmetry(expected), 0.5 * std::sqrt(2.0) / 0.5, 1e-15);
  EXPECT_TRUE(std::isnan(stress_asymmetry(Mat3::Zero())));
  EXPECT_EQ(contact_density(one.arrays()), 0.5);
}

TEST(ContactArrays, CoordinationCountsBothEndsOfEveryContact) {
  Packing packing;
  packing.particles = 5;
  packing.bodies = {{0, 1}, {1, 2}, {2, 0}, {3, 3}};
  packing.normal.assign(4, Vec3::UnitX());
  packing.branch = packing.force = packing.normal;
  const Coordination found = coordination_of(packing.arrays());
  EXPECT_EQ(found.histogram, (std::vector<std::int64_t>{1, 0, 4}));
  EXPECT_DOUBLE_EQ(found.mean, 1.6);
  EXPECT_DOUBLE_EQ(found.deviation, 0.8);
  EXPECT_NEAR(found.skewness, -1.5, 1e-14);
  EXPECT_NEAR(found.excess_kurtosis, 0.25, 1e-14);
  packing.bodies.clear();
  EXPECT_THROW(coordination_of(packing.arrays()), std::invalid_argument);
  packing.normal.clear();
  packing.branch.clear();
  packing.force.clear();
  EXPECT_TRUE(std::isnan(coordination_of(packing.arrays()).skewness));
}

TEST(ContactArrays, ContactVectorsPointFromBothCentresAndTurnIntoBodyAxes) {
  Random random(60);
  Packing packing = draw(random, random_planted(random, false), 3, 0.3);
  const auto vectors = contact_vectors(packing.arrays());
  ASSERT_EQ(vectors.size(), 6U);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LT((vectors[2 * c] - packing.arm[c].normalized()).norm(), 1e-15);
    EXPECT_LT((vectors[2 * c + 1] - (packing.arm[c] - packing.branch[c]).normalized()).norm(),
              1e-15);
  }
  std::vector<Quaternion> axes;
  for (int i = 0; i < 3; ++i) axes.emplace_back(random_rotation(random));
  const auto local = contact_vectors(packing.arrays(), axes);
  for (std::size_t c = 0; c < 3; ++c)
    for (const std::size_t side : {0U, 1U}) {
      const auto body = static_cast<std::size_t>(packing.bodies[c][side]);
      EXPECT_LT((axes[body] * local[2 * c + side] - vectors[2 * c + side]).norm(), 1e-14);
    }
  axes.pop_back();
  EXPECT_THROW(contact_vectors(packing.arrays(), axes), std::invalid_argument);
  packing.arm.clear();
  EXPECT_THROW(contact_vectors(packing.arrays()), std::invalid_argument);
}

TEST(ContactArrays, UnsoundArraysAreRefused) {
  Random random(61);
  const Packing sound = draw(random, random_planted(random, false), 3, 0.1);
  EXPECT_NO_THROW(require_sound(sound.arrays()));
  const auto refused = [&](auto change) {
    Packing packing = sound;
    change(packing);
    try {
      require_sound(packing.arrays());
    } catch (const std::invalid_argument&) {
      return true;
    }
    return false;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused([](Packing& p) { p.branch.pop_back(); }));
  EXPECT_TRUE(refused([](Packing& p) { p.force.pop_back(); }));
  EXPECT_TRUE(refused([](Packing& p) { p.arm.pop_back(); }));
  EXPECT_TRUE(refused([](Packing& p) { p.bodies.pop_back(); }));
  EXPECT_TRUE(refused([](Packing& p) { p.bodies[1][0] = -1; }));
  EXPECT_TRUE(refused([](Packing& p) { p.bodies[1][1] = p.particles; }));
  EXPECT_TRUE(refused([](Packing& p) { p.normal[2] *= 1.001; }));
  EXPECT_TRUE(refused([&](Packing& p) { p.normal[2][0] = nan; }));
  EXPECT_TRUE(refused([&](Packing& p) { p.force[2][1] = nan; }));
  EXPECT_TRUE(refused([&](Packing& p) { p.branch[2][1] = nan; }));
  EXPECT_TRUE(refused([&](Packing& p) { p.arm[2][1] = nan; }));
  EXPECT_TRUE(refused([](Packing& p) { p.volume = 0.0; }));
  EXPECT_TRUE(refused([&](Packing& p) { p.volume = nan; }));
  EXPECT_TRUE(refused([](Packing& p) { p.dimensions = 4; }));
  EXPECT_TRUE(refused([](Packing& p) { p.dimensions = 2; }));
}

}  // namespace
