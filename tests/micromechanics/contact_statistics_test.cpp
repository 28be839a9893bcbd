// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <tangency/dem/micromechanics/contact_statistics.hpp>

#include "fields.hpp"
#include "planted_bodies.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using std::numbers::pi;
using tangency::Mat3;
using tangency::Quaternion;
using tangency::Vec3;

const Spheroid kProlate{1.0, 0.7}, kOblate{0.7, 1.0};
constexpr HarmonicSpread kAxes{.second = 0.8, .fourth = 0.3};

void expect_shares(const LengthShares& found, const LengthShares& published, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], published[i], tolerance);
}

// dem/micromechanics/contact_statistics.hpp (1)
TEST(LocalDistribution, IsTheIntegralOfItsDensity) {
  for (const double a1 : {-1.0, -0.3, 0.0, 0.75, 2.0})
    for (const double beta : {0.0, 0.3, 1.2, 2.0, pi}) {
      const double share = integral(
          [&](double b) { return 2.0 * pi * std::sin(b) * local_density(a1, b); }, 0.0, beta);
      EXPECT_NEAR(local_distribution(a1, beta), share, 1e-13);
      EXPECT_NEAR(local_distribution(a1, pi - beta), 1.0 - share, 1e-13);
    }
}

// dem/micromechanics/contact_statistics.hpp (2)
TEST(LocalDistribution, AngleOfAShareHasThatShare) {
  for (const double a1 : {-1.0, -0.3, 0.0, 0.75, 2.0})
    for (const double g : {0.0, 1e-9, 0.02, 0.3, 0.5, 0.9, 1.0})
      EXPECT_NEAR(local_distribution(a1, local_angle(a1, g)), g, 1e-15) << a1;
  EXPECT_THROW(local_angle(2.1, 0.5), std::invalid_argument);
  EXPECT_THROW(local_angle(-1.1, 0.5), std::invalid_argument);
  EXPECT_THROW(local_angle(0.5, 1.1), std::invalid_argument);
  EXPECT_THROW(local_angle(0.5, -0.1), std::invalid_argument);
}

TEST(LengthShares, TablesOfTheSpecificationAreFound) {
  expect_shares(*length_shares(kProlate, 0.75), {0.5405, 0.2652, 0.1943}, 6e-5);
  expect_shares(*length_shares(kProlate, 0.72), {0.546, 0.263, 0.191}, 6e-4);
  expect_shares(*length_shares(kProlate, 0.78), {0.535, 0.268, 0.197}, 6e-4);
  expect_shares(*length_shares(kProlate, 0.0), {0.6779, 0.2022, 0.1199}, 6e-5);
  expect_shares(*length_shares_by_area(kProlate), {0.5827, 0.2416, 0.1757}, 6e-5);
  const PairShares pairs = pair_shares({0.54, 0.27, 0.19});
  const PairShares published{0.2916, 0.2916, 0.2052, 0.0729, 0.1026, 0.0361};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(pairs[i], published[i], 1e-12);
}

TEST(LengthShares, OfFlatBodiesAreThoseOfTheirEquator) {
  EXPECT_EQ(longer_share(kOblate, 0.3, 0.69), 1.0);
  EXPECT_EQ(longer_share(kOblate, 0.3, 1.01), 0.0);
  EXPECT_NEAR(longer_share(kOblate, 0.3, 0.8),
              1.0 - 2.0 * local_distribution(0.3, *angle_of_length(kOblate, 0.8)), 1e-15);
  for (const Spheroid& s : {kProlate, kOblate, Spheroid{1.0, 50.0}})
    for (const auto& f : {*length_shares(s, 0.4), *length_shares_by_area(s)})
      EXPECT_NEAR(f[0] + f[1] + f[2], 1.0, 1e-15);
  EXPECT_FALSE(length_shares({1.0, 1.0}, 0.0));
  EXPECT_FALSE(length_shares_by_area({1.0, 1.0}));
  EXPECT_EQ(longer_share({1.0, 1.0}, 0.0, 0.9), 1.0);
  EXPECT_EQ(longer_share({1.0, 1.0}, 0.0, 1.1), 0.0);
}

TEST(LengthShares, ClassesAreThirdsBetweenTheSemiAxes) {
  const Vec3 r(1.0, 0.75, 0.7);
  EXPECT_EQ(length_class(r, Vec3(5.0, 0.0, 0.0)), 2U);
  EXPECT_EQ(length_class(r, Vec3(0.0, 0.1, 0.0)), 0U);
  EXPECT_EQ(length_class({1.0, 0.85, 0.7}, Vec3::UnitY()), 1U);
  EXPECT_FALSE(length_class(Vec3::Ones(), Vec3::UnitX()));
}

// dem/micromechanics/contact_statistics.hpp (3)
TEST(AreaLaw, AnisotropyIsTheQuadratureOverTheSurface) {
  for (const double ratio : {1e-4, 0.02, 0.5, 0.86, 0.88, 0.999, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.001,
                             1.1, 1.19, 1.2, 3.0, 50.0, 1e4}) {
    const auto over = [&](bool weighted) {
      return integral(
          [&](double t) {  // the eccentric angle from the equator; semi-axes ratio, 1
            const double x = ratio * std::sin(t), y = std::cos(t);
            const double area = std::hypot(std::sin(t), ratio * std::cos(t)) * std::cos(t);
            return weighted ? area * x * x / (x * x + y * y) : area;
          },
          0.0, 0.5 * pi);
    };
    EXPECT_NEAR(area_law_a1({ratio, 1.0}), 7.5 * (over(true) / over(false) - 1.0 / 3.0), 1e-11)
        << ratio;
  }
  const std::array<std::array<double, 2>, 5> table{
      {{0.9, 0.1435}, {0.8, 0.3120}, {0.7, 0.5148}, {0.6, 0.7650}, {0.5, 1.0813}}};
  for (const auto& [b, a1] : table) EXPECT_NEAR(area_law_a1({1.0, b}), a1, 6e-5);
}

TEST(AreaLaw, IsNearTheModelByAsMuchAsTheTableSays) {
  const std::array<std::array<double, 2>, 4> table{
      {{0.5, 0.0034}, {0.6, 0.0105}, {0.7, 0.0197}, {0.8, 0.0292}}};
  for (const auto& [a1, published] : table) {
    double most = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      const double beta = pi * i / 1000.0;
      const double area = surface_within(kProlate, beta) / surface_within(kProlate, pi);
      most = std::max(most, std::abs(local_distribution(a1, beta) - area));
    }
    EXPECT_NEAR(most, published, 6e-5);
  }
}

// Erratum 8: the published text calls the calculated 54, 27, 19 % like the shares of area.
TEST(ContactStatisticsErrata, SharesOfAreaAreNotThoseOfContacts) {
  const LengthShares area = *length_shares_by_area(kProlate),
                     contacts = *length_shares(kProlate, 0.75);
  expect_shares(contacts, {0.54, 0.27, 0.19}, 0.005);
  expect_shares(area, {0.583, 0.242, 0.176}, 0.0005);
  EXPECT_GT(area[0] - contacts[0], 0.04);
}

// Erratum 9, second half: most contacts are short, but most of the surface is; at a1 = 0.75, above
// the area's 0.515, they are rarer for their area there than anywhere.
TEST(ContactStatisticsErrata, ContactsAreRarerForTheirAreaWhereTheSurfaceIsFlat) {
  const auto relative = [](double a1) {
    return (*length_shares(kProlate, a1))[0] / (*length_shares_by_area(kProlate))[0];
  };
  EXPECT_GT((*length_shares(kProlate, 0.75))[0], 0.5);
  EXPECT_GT((*length_shares_by_area(kProlate))[0], 0.5);
  EXPECT_LT(area_law_a1(kProlate), 0.75);
  EXPECT_LT(relative(0.75), 0.95);
  EXPECT_GT(relative(0.3), 1.05);
  const auto by_area = [](double beta) {
    return local_density(0.75, beta) / area_per_solid_angle(kProlate, beta);
  };
  for (const double beta : {0.0, 0.3, 0.7, 1.1}) EXPECT_GT(by_area(beta), by_area(0.5 * pi));
}

TEST(ContactStatistics, PlantedLawsAreFoundWithinFourDeviations) {
  Random random(101);
  for (const Spheroid& s : {kProlate, kOblate})
    for (const double a1 : {-0.4, 0.7}) {
      const BodyPacking sample =
          draw_pairs(random, s, planted_axes(random, kAxes), everywhere(a1), 700, 4000);
      const Shape shape = s.along > s.across ? Shape::prolate : Shape::oblate;
      const auto found = contact_statistics_of(sample.contacts(), sample.bodies(), shape);
      ASSERT_TRUE(found && found->spheroid);
      EXPECT_EQ(found->sides, 8000U);
      EXPECT_EQ(found->contacts, 4000U);
      const SpheroidStatistics& own = *found->spheroid;
      EXPECT_LT(std::abs(own.a1.value - a1), 4.0 * own.a1.error);
      EXPECT_NEAR(own.a1.error, 5.0 * std::sqrt(0.2 / 8000.0), 0.006);
      const int axis = shape == Shape::prolate ? 0 : 2;
      EXPECT_NEAR(found->local.model.second(axis, axis), own.a1.value, 1e-12);
      const LengthShares planted = *length_shares(s, a1);
      const PairShares pairs = pair_shares(planted);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LT(std::abs(found->length[i].value - planted[i]), 4.0 * found->length[i].error);
      for (std::size_t i = 0; i < 6; ++i)
        EXPECT_LT(std::abs(found->pairs[i].value - pairs[i]), 4.0 * found->pairs[i].error);
      EXPECT_LT(own.off_model, 1.0 / std::sqrt(8000.0));
      EXPECT_NEAR(own.area_law_a1, area_law_a1(s), 1e-12);
      expect_shares(own.by_area, *length_shares_by_area(s), 1e-12);
      const auto none = [](const Estimate& r) { return std::abs(r.value) < 4.0 * r.error; };
      EXPECT_TRUE(none(own.correlations.coordination));
      EXPECT_TRUE(std::ranges::all_of(own.correlations.orientation, none));
    }
}

TEST(ContactStatistics, ContactsEvenOnTheSurfaceFollowTheAreaLaw) {
  Random random(102);
  // Even on the surface: points drawn by rejection of the area per solid angle.
  BodyPacking sample =
      draw_pairs(random, kProlate, {0.25 / pi, Mat3::Zero(), {}}, everywhere(0.0), 500, 3000);
  const auto even = [&]() -> Vec3 {
    for (;;) {
      const Vec3 v = random_direction(random);
      const double area = area_per_solid_angle(kProlate, std::acos(v[0]));
      if (uniform(random, 0.0, 1.2) <= area) return v / v.cwiseQuotient(Vec3(1.0, 0.7, 0.7)).norm();
    }
  };
  for (std::size_t c = 0; c < sample.packing.arm.size(); ++c) {
    const auto [a, b] = sample.packing.bodies[c];
    const Vec3 of_a = sample.orientation[static_cast<std::size_t>(a)] * even();
    const Vec3 of_b = sample.orientation[static_cast<std::size_t>(b)] * even();
    sample.packing.arm[c] = of_a;
    sample.packing.branch[c] = of_a - of_b;
  }
  const auto found = contact_statistics_of(sample.contacts(), sample.bodies(), Shape::prolate);
  const SpheroidStatistics& own = *found->spheroid;
  EXPECT_LT(std::abs(own.a1.value - own.area_law_a1), 4.0 * own.a1.error);
  EXPECT_LT(own.off_area, 1.0 / std::sqrt(6000.0));
  const std::vector<double> beta = {0.4, 0.9, 1.4, 0.5 * pi};
  const auto measured =
      measured_distribution(sample.contacts(), sample.bodies(), Shape::prolate, beta);
  ASSERT_EQ(measured.size(), beta.size());
  for (std::size_t i = 0; i < beta.size(); ++i)
    EXPECT_NEAR(measured[i], surface_within(kProlate, beta[i]) / surface_within(kProlate, pi),
                0.012);
  EXPECT_EQ(measured.back(), 0.5);
  EXPECT_TRUE(
      measured_distribution(sample.contacts(), sample.bodies(), Shape::oblate, beta).empty());
}

TEST(ContactStatistics, DependenceOnOrientationAndOnCoordinationIsSeen) {
  Random random(103);
  const LocalLaw law = [](const Vec3& u) { return u[2] * u[2] > 0.4 ? 1.5 : -0.5; };
  const BodyPacking sample =
      draw_pairs(random, kProlate, planted_axes(random, kAxes), law, 600, 4000);
  const auto found = contact_statistics_of(sample.contacts(), sample.bodies(), Shape::prolate);
  const Estimate along_z = found->spheroid->correlations.orientation[2];
  EXPECT_GT(along_z.value, 6.0 * along_z.error);
  BodyPacking few =
      draw_among_spheres(random, kProlate, planted_axes(random, kAxes), everywhere(1.5), 400, 3);
  // The same bodies, turned, with more contacts of another law.
  const BodyPacking many =
      draw_among_spheres(random, kProlate, planted_axes(random, kAxes), everywhere(-0.5), 400, 9);
  const auto shift = static_cast<std::int64_t>(few.semi_axes.size());
  for (std::size_t c = 0; c < many.packing.normal.size(); ++c) {
    few.packing.normal.push_back(many.packing.normal[c]);
    few.packing.force.push_back(many.packing.force[c]);
    few.packing.arm.push_back(many.packing.arm[c]);
    few.packing.branch.push_back(many.packing.branch[c]);
    const auto [a, b] = many.packing.bodies[c];
    few.packing.bodies.push_back({a + shift, b + shift});
  }
  few.orientation.insert(few.orientation.end(), many.orientation.begin(), many.orientation.end());
  few.semi_axes.insert(few.semi_axes.end(), many.semi_axes.begin(), many.semi_axes.end());
  few.packing.particles = static_cast<std::int64_t>(few.semi_axes.size());
  const auto joined = contact_statistics_of(few.contacts(), few.bodies(), Shape::prolate);
  const Estimate by_number = joined->spheroid->correlations.coordination;
  EXPECT_LT(by_number.value, -6.0 * by_number.error);
  EXPECT_EQ(joined->contacts, 0U);
  EXPECT_TRUE(std::isnan(joined->pairs[0].value));
}

// Ten equal contacts of a body are one datum.
TEST(ContactStatistics, DeviationsKnowThatContactsOfABodyDependOnEachOther) {
  Random random(104);
  BodyPacking sample =
      draw_among_spheres(random, kProlate, planted_axes(random, kAxes), everywhere(0.5), 300, 10);
  const auto error = [&] {
    return contact_statistics_of(sample.contacts(), sample.bodies(), Shape::prolate)
        ->spheroid->a1.error;
  };
  const double independent = error();
  for (std::size_t c = 0; c < sample.packing.arm.size(); ++c) {
    sample.packing.arm[c] = sample.packing.arm[c / 10 * 10];
    sample.packing.branch[c] = sample.packing.branch[c / 10 * 10];
  }
  EXPECT_NEAR(error() / independent, std::sqrt(10.0), 0.6);
}

// dem/micromechanics/contact_statistics.hpp (4)
TEST(ContactStatistics, OrderUnitsTurnsAndNumbersChangeNothing) {
  Random random(105);
  const BodyPacking sample =
      draw_pairs(random, kProlate, planted_axes(random, kAxes), everywhere(0.6), 60, 300);
  BodyPacking other = sample;
  other.packing = rotated(exchanged(sample.packing), Mat3::Identity());
  const Mat3 turn = random_rotation(random);
  const Quaternion turned(turn);
  other.packing = rotated(other.packing, turn);
  for (auto* vectors : {&other.packing.arm, &other.packing.branch})
    for (Vec3& v : *vectors) v *= 0x1p20;
  for (Vec3& r : other.semi_axes) r *= 0x1p20;
  for (auto* vectors :
       {&other.packing.arm, &other.packing.branch, &other.packing.normal, &other.packing.force})
    std::ranges::reverse(*vectors);
  std::ranges::reverse(other.packing.bodies);
  for (auto& pair : other.packing.bodies)
    for (auto& body : pair) body = 59 - body;
  for (Quaternion& q : other.orientation) q = Quaternion(turn * q.toRotationMatrix());
  std::ranges::reverse(other.orientation);
  const auto before = contact_statistics_of(sample.contacts(), sample.bodies(), Shape::prolate);
  const auto after = contact_statistics_of(other.contacts(), other.bodies(), Shape::prolate);
  EXPECT_NEAR(after->spheroid->a1.value, before->spheroid->a1.value, 1e-12);
  EXPECT_NEAR(after->spheroid->a1.error, before->spheroid->a1.error, 1e-12);
  EXPECT_NEAR(after->spheroid->off_area, before->spheroid->off_area, 1e-12);
  EXPECT_NEAR(after->spheroid->correlations.coordination.value,
              before->spheroid->correlations.coordination.value, 1e-12);
  EXPECT_LT((after->local.model.second - before->local.model.second).norm(), 1e-12);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(after->pairs[i].value, before->pairs[i].value, 1e-12);
}

TEST(ContactStatistics, WhatIsNotDefinedIsEmpty) {
  Random random(106);
  BodyPacking sample =
      draw_pairs(random, kProlate, planted_axes(random, kAxes), everywhere(0.6), 20, 50);
  const auto of = [&](Shape shape) {
    return contact_statistics_of(sample.contacts(), sample.bodies(), shape);
  };
  EXPECT_FALSE(of(Shape::sphere));
  EXPECT_FALSE(of(Shape::oblate));
  EXPECT_TRUE(of(Shape::prolate)->spheroid);
  for (Vec3& r : sample.semi_axes) r = Vec3(1.0, 0.8, 0.6);
  const auto triaxial = of(Shape::triaxial);
  ASSERT_TRUE(triaxial);
  EXPECT_FALSE(triaxial->spheroid);
  EXPECT_NEAR(triaxial->length[0].value + triaxial->length[1].value + triaxial->length[2].value,
              1.0, 1e-12);
  for (Vec3& r : sample.semi_axes) r = Vec3::Ones();
  EXPECT_FALSE(of(Shape::sphere));
  EXPECT_FALSE(of(Shape::prolate));
  const BodyPacking plane = draw_plane(random, kProlate, 0.3, everywhere(0.5), 30, 3);
  EXPECT_EQ(
      refusal([&] { contact_statistics_of(plane.contacts(), plane.bodies(), Shape::prolate); }),
      "dimensions = 2: contact_statistics_of takes contacts in space");
  EXPECT_EQ(
      refusal([&] { measured_distribution(plane.contacts(), plane.bodies(), Shape::prolate, {}); }),
      "dimensions = 2: measured_distribution takes contacts in space");
  sample.semi_axes.pop_back();
  EXPECT_THROW(of(Shape::prolate), std::invalid_argument);
  sample.semi_axes.push_back(Vec3::Ones());
  sample.packing.arm.clear();
  EXPECT_THROW(of(Shape::prolate), std::invalid_argument);
}

TEST(ContactStatistics, OneContactHasNoDeviation) {
  Random random(107);
  const BodyPacking one =
      draw_pairs(random, kProlate, planted_axes(random, kAxes), everywhere(0.6), 2, 1);
  const auto found = contact_statistics_of(one.contacts(), one.bodies(), Shape::prolate);
  ASSERT_TRUE(found);
  EXPECT_TRUE(std::isfinite(found->spheroid->a1.value));
  EXPECT_TRUE(std::isnan(found->spheroid->a1.error));
  EXPECT_TRUE(std::isnan(found->pairs[0].error));
}

}  // namespace
