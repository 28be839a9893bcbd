// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <tangency/dem/micromechanics/independence.hpp>

#include "fields.hpp"
#include "planted_bodies.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using std::numbers::pi;
using tangency::Mat3;
using tangency::Vec3;

// dem/micromechanics/independence.hpp (1)
TEST(ChiSquared, TailIsTheIncompleteGammaFunction) {
  for (const std::int64_t degrees : {1, 2, 3, 4, 7, 10, 55, 100, 499, 2000})
    for (const double relative : {1e-3, 0.3, 0.9, 1.0, 1.1, 1.5, 4.0}) {
      const double x = relative * static_cast<double>(degrees);
      const double expected = gsl_cdf_chisq_Q(x, static_cast<double>(degrees));
      EXPECT_NEAR(chi_squared_tail(x, degrees), expected, 1e-12 * expected + 1e-300)
          << degrees << " " << x;
    }
  EXPECT_EQ(chi_squared_tail(0.0, 5), 1.0);
  for (const double x : {1e4, 1e19, 1e200, std::numeric_limits<double>::infinity()})
    EXPECT_LT(chi_squared_tail(x, 50), 1e-300);
  EXPECT_TRUE(std::isnan(chi_squared_tail(std::numeric_limits<double>::quiet_NaN(), 5)));
  EXPECT_THROW(chi_squared_tail(1.0, 0), std::invalid_argument);
}

TEST(Contingency, OfATableIsPearsonsChiSquared) {
  const std::vector<std::int64_t> counts = {20, 30, 0, 30, 20, 0};
  const Contingency found = contingency_of(counts, 3);  // the third column is empty
  EXPECT_EQ(found.count, 100);
  EXPECT_EQ(found.degrees, 1);
  EXPECT_DOUBLE_EQ(found.chi_squared, 4.0);
  EXPECT_DOUBLE_EQ(found.least_expected, 25.0);
  EXPECT_EQ(found.count_needed, 20);
  EXPECT_NEAR(found.p_value, std::erfc(std::sqrt(2.0)), 1e-15);
  EXPECT_DOUBLE_EQ(found.cramers_v, 0.2);
  EXPECT_THROW(contingency_of(counts, 4), std::invalid_argument);
  EXPECT_THROW(contingency_of(counts, 0), std::invalid_argument);
  EXPECT_THROW(contingency_of(std::vector<std::int64_t>{1, -1}, 2), std::invalid_argument);
}

TEST(Contingency, TooFewCountsHaveNoProbability) {
  const Contingency few = contingency_of(std::vector<std::int64_t>{3, 2, 2, 3}, 2);
  EXPECT_EQ(few.degrees, 1);
  EXPECT_TRUE(std::isnan(few.p_value));
  EXPECT_EQ(few.count_needed, 20);
  const Contingency one_row = contingency_of(std::vector<std::int64_t>{30, 20}, 2);
  EXPECT_EQ(one_row.degrees, 0);
  EXPECT_TRUE(std::isnan(one_row.p_value));
  EXPECT_TRUE(std::isnan(contingency_of({}, 2).p_value));
}

/// The largest distance of p values from the even distribution, by the root of their number.
double unevenness(std::vector<double> p) {
  std::ranges::sort(p);
  const auto count = static_cast<double>(p.size());
  double most = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto at = static_cast<double>(i);
    most = std::max({most, std::abs(p[i] - at / count), std::abs((at + 1.0) / count - p[i])});
  }
  return most * std::sqrt(count);
}

TEST(Independence, ProbabilitiesOfIndependentSamplesAreEven) {
  Random random(141);
  const ScalarHarmonics axes{0.25 / pi, random_second(random, 0.5), {}};
  std::vector<double> space, plane;
  for (int repeat = 0; repeat < 150; ++repeat) {
    const BodyPacking sample =
        draw_among_spheres(random, {1.0, 0.7}, axes, everywhere(0.6), 900, 1);
    const auto found = normal_independence(sample.contacts(), sample.bodies(), Shape::prolate, 4);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->degrees, 33);
    space.push_back(found->p_value);
    const BodyPacking flat = draw_plane(random, {1.0, 0.7}, 0.4, everywhere(0.5), 1800, 1);
    const auto in_plane = plane_normal_independence(flat.contacts(), flat.bodies());
    ASSERT_TRUE(in_plane);
    EXPECT_EQ(in_plane->degrees, 77);
    plane.push_back(in_plane->p_value);
  }
  for (const auto* sample : {&space, &plane})
    for (const double p : *sample) ASSERT_TRUE(p >= 0.0 && p <= 1.0) << p;
  // Beyond 1.63 one sample in a hundred is of an even distribution.
  EXPECT_LT(unevenness(space), 1.63);
  EXPECT_LT(unevenness(plane), 1.63);
}

TEST(Independence, DependentSamplesAreRefused) {
  Random random(142);
  const ScalarHarmonics axes{0.25 / pi, Mat3::Zero(), {}};
  const LocalLaw law = [](const Vec3& u) { return u[2] * u[2] > 0.4 ? 1.0 : 0.0; };
  const BodyPacking sample = draw_among_spheres(random, {1.0, 0.7}, axes, law, 4000, 2);
  const auto found = normal_independence(sample.contacts(), sample.bodies(), Shape::prolate);
  EXPECT_LT(found->p_value, 1e-6);
  EXPECT_GT(found->cramers_v, 0.05);
  const LocalLaw in_plane = [](const Vec3& u) { return u[0] * u[1] > 0.0 ? 0.6 : 0.0; };
  const BodyPacking flat = draw_plane(random, {1.0, 0.7}, 0.0, in_plane, 4000, 2);
  EXPECT_LT(plane_normal_independence(flat.contacts(), flat.bodies())->p_value, 1e-6);
}

TEST(Independence, SaysHowManySidesItNeedsAndIsEmptyWithoutAnAxis) {
  Random random(143);
  const ScalarHarmonics axes{0.25 / pi, Mat3::Zero(), {}};
  const BodyPacking few = draw_among_spheres(random, {1.0, 0.7}, axes, everywhere(0.5), 100, 1);
  const auto found = normal_independence(few.contacts(), few.bodies(), Shape::prolate);
  EXPECT_TRUE(std::isnan(found->p_value));
  EXPECT_GT(found->count_needed, 6 * 12 * 5 - 1);
  EXPECT_FALSE(normal_independence(few.contacts(), few.bodies(), Shape::sphere));
  EXPECT_FALSE(normal_independence(few.contacts(), few.bodies(), Shape::triaxial));
  EXPECT_FALSE(normal_independence(few.contacts(), few.bodies(), Shape::oblate));
  EXPECT_THROW(normal_independence(few.contacts(), few.bodies(), Shape::prolate, 1),
               std::invalid_argument);
}

TEST(Independence, TakesContactsOfItsDimensionsAloneAndSaysSo) {
  Random random(144);
  const ScalarHarmonics axes{0.25 / pi, Mat3::Zero(), {}};
  const BodyPacking space = draw_among_spheres(random, {1.0, 0.7}, axes, everywhere(0.5), 10, 1);
  const BodyPacking plane = draw_plane(random, {1.0, 0.7}, 0.4, everywhere(0.5), 10, 1);
  EXPECT_EQ(refusal([&] { normal_independence(plane.contacts(), plane.bodies(), Shape::prolate); }),
            "dimensions = 2: normal_independence takes contacts in space");
  EXPECT_EQ(refusal([&] { plane_normal_independence(space.contacts(), space.bodies()); }),
            "dimensions = 3: plane_normal_independence takes contacts in the plane");
}

}  // namespace
