// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracles for ellipses against pairs worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include <tangency/verify/oracles/ellipse.hpp>

namespace tangency::verify {
namespace {

using enum Relation;

const RawEllipse kWide{{0, 0}, {2, 1}, {1, 0}};

void expect(const RawEllipse& b, const ExactRelation& relation, const std::vector<int>& points) {
  const EllipseTruth truth = exact_ellipse_relation(kWide, b);
  EXPECT_TRUE(truth.relation == relation) << name(truth.relation.relation);
  EXPECT_EQ(truth.multiplicities, points);
}

TEST(EllipseOracle, KnowsRelationAndMultiplicities) {
  expect({{4, 0}, {1, 1}}, {separate}, {});
  expect({{3, 0}, {1, 1}}, {external_touch}, {2});
  expect({{2, 0}, {1, 1}}, {overlap}, {1, 1});
  expect({{1, 0}, {1, 2}}, {overlap}, {1, 1, 2});
  expect({{0, 0}, {2, 1}, {0, 1}}, {overlap}, {1, 1, 1, 1});
  expect({{0, 0}, {1, 1}, {3, 4}}, {internal_touch, Inner::b}, {2, 2});
  expect({{1.5, 0}, {0.5, 0.5}}, {internal_touch, Inner::b}, {4});
  expect({{0, 0}, {4, 2}}, {a_in_b}, {});
  expect({{0, 0}, {0.5, 0.5}}, {b_in_a}, {});
  EXPECT_EQ(exact_ellipse_relation({{0, 0}, {45, 80}}, {{-21, 28}, {60, 60}}).multiplicities,
            (std::vector<int>{1, 3}));
}

TEST(EllipseOracle, GivesEqualEllipsesNoCount) {
  const EllipseTruth truth = exact_ellipse_relation(kWide, {{0, 0}, {1, 2}, {0, -3}});
  EXPECT_TRUE(truth.relation == ExactRelation{equal});
  EXPECT_EQ(truth.crossings, -1);
}

TEST(EllipseOracle, RefusesWhatIsNoEllipse) {
  EXPECT_THROW(exact_ellipse_relation(kWide, {{0, 0}, {0, 1}}), std::invalid_argument);
  EXPECT_THROW(exact_ellipse_relation(kWide, {{0, 0}, {1, 1}, {0, 0}}), std::invalid_argument);
}

TEST(EllipseOracle, FindsTheCrossingsOfTwoCircles) {
  const RawEllipse unit{{5, 7}, {1, 1}}, other{{6, 7}, {1, 1}};
  const auto points = ellipse_crossings(unit, other);
  ASSERT_EQ(points.size(), 2U);
  for (const Real2& p : points) {
    EXPECT_LT(abs(p[0] - Real(1) / 2), 1e-100);
    EXPECT_LT(abs(abs(p[1]) - sqrt(Real(3)) / 2), 1e-100);
  }
  EXPECT_EQ(ellipse_crossings_by_gsl(unit, other, 1e-9).size(), 2U);
}

TEST(EllipseOracle, IntegratesTheLensOfTwoCirclesAndCrossedEllipses) {
  const Real pi = acos(Real(-1));
  const Real lens = common_area({{0, 0}, {1, 1}}, {{1, 0}, {1, 1}});
  EXPECT_LT(abs(lens - (2 * pi / 3 - sqrt(Real(3)) / 2)), 1e-18);
  const Real crossed = common_area(kWide, {{0, 0}, {2, 1}, {0, 1}});
  EXPECT_LT(abs(crossed - 8 * atan(Real(1) / 2)), 1e-18);
}

// Of pairs with crossings well apart, with two, with four and with none.
TEST(EllipseOracle, AreaByGreenAroundTheArcsIsThatOfTheSlices) {
  const double pi = acos(-1.0);
  EXPECT_NEAR(common_area_by_gsl({{3, 4}, {1, 1}}, {{4, 4}, {1, 1}}, 1e-9),
              2 * pi / 3 - std::sqrt(3.0) / 2, 1e-13);
  EXPECT_NEAR(common_area_by_gsl(kWide, {{9, 0}, {1, 1}}, 1e-9), 0, 1e-15);
  EXPECT_NEAR(common_area_by_gsl(kWide, {{0.5, 0}, {0.25, 0.5}, {1, 2}}, 1e-9), pi / 8, 1e-13);
  for (const RawEllipse& b :
       {RawEllipse{{0, 0}, {2, 1}, {0, 1}}, RawEllipse{{1, 0.5}, {3, 0.5}, {1, 1}},
        RawEllipse{{2, 0.25}, {1, 1.5}, {3, -1}}}) {
    EXPECT_NEAR(common_area_by_gsl(kWide, b, 1e-9), common_area(kWide, b).convert_to<double>(),
                1e-12);
  }
}

TEST(EllipseOracle, FindsTheGapApartAndDeep) {
  EXPECT_LT(abs(plane_gap({{0, 0}, {1, 1}}, {{3, 4}, {2, 2}}) - 2), 1e-30);
  EXPECT_LT(abs(plane_gap(kWide, {{0, 0}, {1, 2}}) + 3), 1e-30);
  EXPECT_LT(abs(plane_gap(kWide, {{0, 0}, {3, 0.25}}) + 1.25), 1e-30);
}

void expect_normals(const RawEllipse& b, const Real& gap, const std::vector<Real2>& normals) {
  const PlaneGapTruth truth = plane_gap_truth(kWide, b);
  EXPECT_LT(abs(truth.gap - gap), 1e-60);
  EXPECT_FALSE(truth.every_normal);
  ASSERT_EQ(truth.normals.size(), normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_LT(abs(truth.normals[i][k] - normals[i][k]), Real("1e-45")) << i << ' ' << k;
    }
  }
}

TEST(EllipseOracle, NamesEveryNormalThatReachesTheGap) {
  expect_normals({{3, 0}, {1, 1}}, 0, {{1, 0}});
  expect_normals({{0, 0}, {1, 2}}, -3, {{1, 0}, {0, 1}, {0, -1}, {-1, 0}});
  expect_normals({{0, 0}, {3, 0.25}}, -1.25, {{0, 1}, {0, -1}});
  // A circle on the long axis, nearer to the centre than the evolute's cusp at 1.5: two feet.
  const Real x = 1 / sqrt(Real(6)), y = sqrt(Real(5) / 6);
  expect_normals({{1, 0}, {0.25, 0.25}}, -sqrt(Real(6)) / 3 - 0.25, {{x, y}, {x, -y}});
  EXPECT_TRUE(plane_gap_truth({{1, 1}, {2, 2}}, {{1, 1}, {3, 3}}).every_normal);
}

TEST(EllipseOracle, TellsNormalsApartThatAreAboutToMeet) {
  // The foot of (x, 0) is at 4/3 x, and its normal along (x/3, y).
  const Real c = 1.5 - 0x1p-50, foot = c * 4 / 3, y = sqrt(1 - foot * foot / 4);
  const Real nx = foot / 4 / sqrt(foot * foot / 16 + y * y), ny = sqrt(1 - nx * nx);
  const Real gap = -sqrt((foot - c) * (foot - c) + y * y) - 0.25;
  expect_normals({{1.5 - 0x1p-50, 0}, {0.25, 0.25}}, gap, {{nx, ny}, {nx, -ny}});
  expect_normals({{1.5, 0}, {0.25, 0.25}}, -0.75, {{1, 0}});  // a maximum of fourth order
  // The same turned by a right angle, where the sample does not stand on it.
  const PlaneGapTruth turned = plane_gap_truth({{0, 0}, {2, 1}, {0, 1}}, {{0, 1.5}, {0.25, 0.25}});
  ASSERT_EQ(turned.normals.size(), 1U);
  EXPECT_LT(abs(turned.normals[0][0]), Real("1e-45"));
}

}  // namespace
}  // namespace tangency::verify
