// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <random>
#include <set>
#include <string_view>

#include <tangency/geometry/classify.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/tests/geometry/quadric_generators.hpp>

namespace tangency {
namespace {

using enum QuadricType;

constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

TEST(Classify, KnowsTheNormalFormOfEveryTypeAndItsNegative) {
  for (const auto& form : testing::kNormalForms) {
    const Quadric q = testing::to_quadric(form.quadric);
    for (const Quadric& either : {q, q.negated()}) {
      const Classification c = classify(either);
      EXPECT_EQ(to_string(c.type), to_string(form.type));
      EXPECT_EQ(c.rank4, form.rank4) << to_string(form.type);
      EXPECT_EQ(c.rank3, form.rank3) << to_string(form.type);
    }
  }
}

TEST(Classify, NamesAreDistinctAndThoseOfTheFileFormat) {
  std::set<std::string_view> names;
  for (const auto& form : testing::kNormalForms) names.insert(to_string(form.type));
  EXPECT_EQ(names.size(), 20u);
  EXPECT_EQ(to_string(hyperboloid_two_sheets), "hyperboloid_two_sheets");
  EXPECT_EQ(to_string(all_space), "all_space");
  EXPECT_EQ(to_string(Tier::filter), "filter");
  EXPECT_EQ(to_string(Tier::exact), "exact");
}

TEST(Classify, EmptyTypesAreThoseWithoutARealPoint) {
  const std::set<QuadricType> empty{imaginary_ellipsoid, imaginary_elliptic_cylinder,
                                    imaginary_parallel_planes, no_points};
  for (const auto& form : testing::kNormalForms) {
    EXPECT_EQ(is_empty(form.type), empty.count(form.type) == 1) << to_string(form.type);
  }
}

/// A family of quadrics base + t direction: its type for t < 0, t = 0 and t > 0.
struct Border {
  testing::IntegerQuadric base;
  testing::IntegerQuadric direction;
  QuadricType below, at, above;
};

constexpr testing::IntegerQuadric kY2{0, 1, 0, 0, 0, 0, 0, 0, 0, 0};
constexpr testing::IntegerQuadric kZ2{0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
constexpr testing::IntegerQuadric kX2{1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
constexpr testing::IntegerQuadric kY{0, 0, 0, 0, 0, 0, 0, 1, 0, 0};
constexpr testing::IntegerQuadric kZ{0, 0, 0, 0, 0, 0, 0, 0, 1, 0};
constexpr testing::IntegerQuadric kOne{0, 0, 0, 0, 0, 0, 0, 0, 0, 1};

/// Every way in which one term of the textbook equations brings a type to its border.
// clang-format off
const Border kBorders[] = {
    {{1, 1, 1, 0, 0, 0, 0, 0, 0, 0}, kOne,
     real_ellipsoid, imaginary_elliptic_cone, imaginary_ellipsoid},
    {{1, 1, -1, 0, 0, 0, 0, 0, 0, 0}, kOne,
     hyperboloid_one_sheet, real_elliptic_cone, hyperboloid_two_sheets},
    {{1, 1, 0, 0, 0, 0, 0, 0, 0, -1}, kZ2,
     hyperboloid_one_sheet, real_elliptic_cylinder, real_ellipsoid},
    {{1, 1, 0, 0, 0, 0, 0, 0, 0, 1}, kZ2,
     hyperboloid_two_sheets, imaginary_elliptic_cylinder, imaginary_ellipsoid},
    {{1, 1, 0, 0, 0, 0, 0, 0, 1, 0}, kZ2,
     hyperboloid_two_sheets, elliptic_paraboloid, real_ellipsoid},
    {{1, -1, 0, 0, 0, 0, 0, 0, 1, 0}, kZ2,
     hyperboloid_one_sheet, hyperbolic_paraboloid, hyperboloid_one_sheet},
    {{1, -1, 0, 0, 0, 0, 0, 0, 0, -1}, kZ2,
     hyperboloid_two_sheets, hyperbolic_cylinder, hyperboloid_one_sheet},
    {{1, 1, 0, 0, 0, 0, 0, 0, 0, 0}, kZ2,
     real_elliptic_cone, imaginary_intersecting_planes, imaginary_elliptic_cone},
    {{1, -1, 0, 0, 0, 0, 0, 0, 0, 0}, kZ2,
     real_elliptic_cone, real_intersecting_planes, real_elliptic_cone},
    {{1, 1, 0, 0, 0, 0, 0, 0, 0, -1}, kZ,
     elliptic_paraboloid, real_elliptic_cylinder, elliptic_paraboloid},
    {{1, 1, 0, 0, 0, 0, 0, 0, 0, 1}, kZ,
     elliptic_paraboloid, imaginary_elliptic_cylinder, elliptic_paraboloid},
    {{1, 1, 0, 0, 0, 0, 0, 0, 0, 0}, kZ,
     elliptic_paraboloid, imaginary_intersecting_planes, elliptic_paraboloid},
    {{1, -1, 0, 0, 0, 0, 0, 0, 0, 1}, kZ,
     hyperbolic_paraboloid, hyperbolic_cylinder, hyperbolic_paraboloid},
    {{1, -1, 0, 0, 0, 0, 0, 0, 0, 0}, kZ,
     hyperbolic_paraboloid, real_intersecting_planes, hyperbolic_paraboloid},
    {{1, 1, 0, 0, 0, 0, 0, 0, 0, 0}, kOne,
     real_elliptic_cylinder, imaginary_intersecting_planes, imaginary_elliptic_cylinder},
    {{1, -1, 0, 0, 0, 0, 0, 0, 0, 0}, kOne,
     hyperbolic_cylinder, real_intersecting_planes, hyperbolic_cylinder},
    {{1, 0, 0, 0, 0, 0, 0, 0, 1, 0}, kY2,
     hyperbolic_paraboloid, parabolic_cylinder, elliptic_paraboloid},
    {{1, 0, 0, 0, 0, 0, 0, 1, 0, 0}, kY2,
     hyperbolic_cylinder, parabolic_cylinder, real_elliptic_cylinder},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, -1}, kY2,
     hyperbolic_cylinder, real_parallel_planes, real_elliptic_cylinder},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, 1}, kY2,
     hyperbolic_cylinder, imaginary_parallel_planes, imaginary_elliptic_cylinder},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kY2,
     real_intersecting_planes, coincident_planes, imaginary_intersecting_planes},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, -1}, kY,
     parabolic_cylinder, real_parallel_planes, parabolic_cylinder},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, 1}, kY,
     parabolic_cylinder, imaginary_parallel_planes, parabolic_cylinder},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kY,
     parabolic_cylinder, coincident_planes, parabolic_cylinder},
    {{1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kOne,
     real_parallel_planes, coincident_planes, imaginary_parallel_planes},
    {{0, 0, 0, 0, 0, 0, 0, 0, 1, 0}, kX2, parabolic_cylinder, plane, parabolic_cylinder},
    {{0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, kX2,
     real_parallel_planes, no_points, imaginary_parallel_planes},
    {{0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, kZ, plane, no_points, plane},
    {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kX2, coincident_planes, all_space, coincident_planes},
    {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kZ, plane, all_space, plane},
    {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kOne, no_points, all_space, no_points},
};
// clang-format on

Quadric at(const Border& border, double t) {
  Quadric::Coefficients c = testing::to_quadric(border.base).coefficients();
  for (std::size_t i = 0; i < c.size(); ++i) c[i] += t * static_cast<double>(border.direction[i]);
  return Quadric(c);
}

TEST(Classify, BordersAreCrossedByTheSmallestStep) {
  for (const Border& border : kBorders) {
    EXPECT_EQ(to_string(classify(at(border, 0)).type), to_string(border.at));
    for (const double t : {kSmallest, 0x1p-1022, 1e-300, 1e-16, 1.0, 1e300}) {
      EXPECT_EQ(to_string(classify(at(border, t)).type), to_string(border.above))
          << to_string(border.at) << ", t = " << t;
      EXPECT_EQ(to_string(classify(at(border, -t)).type), to_string(border.below))
          << to_string(border.at) << ", t = " << -t;
    }
  }
}

TEST(Classify, EveryTypeIsOnSomeBorder) {
  std::set<QuadricType> seen;
  for (const Border& b : kBorders) seen.insert({b.below, b.at, b.above});
  EXPECT_EQ(seen.size(), 20u);
}

TEST(Classify, EveryEnvironmentGivesTheSameAnswersAtTheBorders) {
  for (const auto& environment : testing::all_environments()) {
    for (const Border& border : kBorders) {
      const Quadric above = at(border, kSmallest), on = at(border, 0),
                    below = at(border, -kSmallest);
      QuadricType seen[3];
      {
        const testing::EnvironmentGuard guard(environment);
        seen[0] = classify(below).type;
        seen[1] = classify(on).type;
        seen[2] = classify(above).type;
      }
      EXPECT_EQ(to_string(seen[0]), to_string(border.below)) << environment.name;
      EXPECT_EQ(to_string(seen[1]), to_string(border.at)) << environment.name;
      EXPECT_EQ(to_string(seen[2]), to_string(border.above)) << environment.name;
    }
  }
}

// x^2 + 9 y^2 + 6 xy + z^2 - 1: the block [1 3; 3 9] is singular.
TEST(Classify, OneUnitInTheLastPlaceOfADenseBlockCrossesTheBorder) {
  const auto with_y2 = [](double b) { return Quadric({1, b, 1, 3, 0, 0, 0, 0, 0, -1}); };
  EXPECT_EQ(classify(with_y2(9)).type, real_elliptic_cylinder);
  EXPECT_EQ(classify(with_y2(std::nextafter(9.0, 10.0))).type, real_ellipsoid);
  EXPECT_EQ(classify(with_y2(std::nextafter(9.0, 8.0))).type, hyperboloid_one_sheet);
}

TEST(Classify, CoefficientsThatAreAllSubnormalAreDecided) {
  const auto with_y2 = [](double b) {
    const double s = kSmallest;
    return Quadric({s, b * s, s, 3 * s, 0, 0, 0, 0, 0, -s});
  };
  EXPECT_EQ(classify(with_y2(9)).type, real_elliptic_cylinder);
  EXPECT_EQ(classify(with_y2(10)).type, real_ellipsoid);
  EXPECT_EQ(classify(with_y2(8)).type, hyperboloid_one_sheet);
}

// The decimal 0.1 is not a tenth: 0.01 - 0.1^2 of the stored doubles is not 0, and its sign is that
// of the true product, not of the rounded one.
TEST(Classify, TheStoredDoublesCountNotTheirDecimalNames) {
  const double a = 0.1, b = 0.01;
  const long double determinant =
      static_cast<long double>(b) - static_cast<long double>(a) * static_cast<long double>(a);
  ASSERT_NE(determinant, 0.0L);
  const Classification c = classify(Quadric({1, b, 1, a, 0, 0, 0, 0, 0, -1}));
  EXPECT_EQ(c.type, determinant > 0 ? real_ellipsoid : hyperboloid_one_sheet);
}

TEST(Classify, MagnitudesFarApartAndCancellationBeyondDoublesAreDecided) {
  EXPECT_EQ(classify(Quadric({1e300, 1e-300, 1, 0, 0, 0, 0, 0, 0, -1e-300})).type, real_ellipsoid);
  EXPECT_EQ(classify(Quadric({1e300, 1e300, -1e-300, 0, 0, 0, 0, 0, 0, -1e300})).type,
            hyperboloid_one_sheet);
  // [2^500 1; 1 2^-500] is singular; the next double above 2^-500 makes it definite.
  const auto with_y2 = [](double b) { return Quadric({0x1p500, b, 1, 1, 0, 0, 0, 0, 0, 1}); };
  EXPECT_EQ(classify(with_y2(0x1p-500)).type, imaginary_elliptic_cylinder);
  EXPECT_EQ(classify(with_y2(std::nextafter(0x1p-500, 1.0))).type, imaginary_ellipsoid);
  EXPECT_EQ(classify(with_y2(std::nextafter(0x1p-500, 0.0))).type, hyperboloid_two_sheets);
}

TEST(Classify, RegularQuadricsAnswerInTheFilterAtAnyCommonScale) {
  for (const double scale : {0x1p-900, 0x1p-250, 1.0, 0x1p250, 0x1p900}) {
    for (const auto& form : testing::kNormalForms) {
      const Tier expected = form.rank4 == 4 && form.rank3 == 3 ? Tier::filter : Tier::exact;
      EXPECT_EQ(classify(testing::to_quadric(form.quadric, scale)).tier, expected)
          << to_string(form.type) << " x " << scale;
    }
  }
}

TEST(Classify, RandomQuadricsAnswerInTheFilterAndBordersInTheExactTier) {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> coefficient(-1, 1);
  int filtered = 0;
  constexpr int count = 100000;
  for (int i = 0; i < count; ++i) {
    Quadric::Coefficients c;
    for (double& value : c) value = coefficient(random);
    filtered += classify(Quadric(c)).tier == Tier::filter;
  }
  std::cout << "filter answered " << filtered << " of " << count << " random quadrics\n";
  EXPECT_GE(filtered, count - 1);
  for (const Border& border : kBorders) EXPECT_EQ(classify(at(border, 0)).tier, Tier::exact);
}

}  // namespace
}  // namespace tangency
