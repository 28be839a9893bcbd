// SPDX-License-Identifier: GPL-3.0-or-later
/// perram_wertheim_factor(): closed forms, scales, bodies by matrices. Against the oracle:
/// other_gaps_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>

namespace tangency {
namespace {

constexpr std::uint64_t kSeed = 20261130;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(PerramWertheimFactor, OfADiscAndANeedleIsThePublishedOne) {
  const Ellipsoid disc({0, 0, 0}, {10, 10, 0.1}), needle({0.7, -0.7, 1.1}, {5, 0.5, 0.5});
  const PerramWertheimFactor found = perram_wertheim_factor(disc, needle);
  EXPECT_EQ(found.status, OtherGapStatus::ok);
  EXPECT_NEAR(found.factor, 3.36270604063863, 5e-15);
  EXPECT_NEAR(found.scale * found.scale, 3.36270604063863, 5e-15);
}

TEST(PerramWertheimFactor, OfTwoSpheresIsTheirDistanceOverTheirRadii) {
  const PerramWertheimFactor found =
      perram_wertheim_factor(Ellipsoid({1, 1, 1}, {1, 1, 1}), Ellipsoid({4, 5, 1}, {3, 3, 3}));
  EXPECT_EQ(found.scale, 1.25);
  EXPECT_EQ(found.factor, 1.5625);
}

TEST(PerramWertheimFactor, OfCoincidingCentresIsZeroWithoutError) {
  const PerramWertheimFactor found =
      perram_wertheim_factor(Ellipsoid({1, 2, 3}, {1, 1, 1}), Ellipsoid({1, 2, 3}, {1, 2, 3}));
  EXPECT_EQ(found.status, OtherGapStatus::ok);
  EXPECT_EQ(found.factor, 0);
  EXPECT_EQ(found.factor_error, 0);
  EXPECT_EQ(found.scale_error, 0);
}

TEST(PerramWertheimFactor, IsInfiniteOrNothingBeyondTheRangeOfDoublesAndItsRootIsNot) {
  const Vec3 axes(1, 1, 1);
  const auto apart = [&](double x) {
    return perram_wertheim_factor(Ellipsoid({0, 0, 0}, axes), Ellipsoid({x, 0, 0}, {3, 1, 1}));
  };
  EXPECT_EQ(apart(1e200).factor, kInfinite);
  EXPECT_EQ(apart(1e200).factor_error, kInfinite);
  EXPECT_NEAR(apart(1e200).scale, 2.5e199, 1e184);
  EXPECT_EQ(apart(1e-200).factor, 0);
  EXPECT_GT(apart(1e-200).factor_error, 0);
  EXPECT_NEAR(apart(1e-200).scale, 2.5e-201, 1e-216);
}

// Semi-axes far below d are not taken for thicker ones.
TEST(PerramWertheimFactor, OfTinyBodiesFarApartIsRight) {
  const Ellipsoid a({0, 0, 0}, {0x1p-400, 0x1p-410, 0x1p-405}),
      b({1, 0, 0}, {0x3p-400, 0x1p-402, 0x1p-380});
  const PerramWertheimFactor found = perram_wertheim_factor(a, b);
  ASSERT_EQ(found.status, OtherGapStatus::ok);
  EXPECT_LE(std::abs(found.scale - 0x1p398), found.scale_error);
}

// geometry/other_gaps.hpp (5)
TEST(PerramWertheimFactor, IsAboveOneWhereTheSolidsAreApartAndBelowWhereTheyOverlap) {
  verify::ManufacturedContacts contacts(verify::contact_classes()[1], kSeed);
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 40; ++i) {
    const auto contact = contacts.next();
    const Ellipsoid a = verify::to_ellipsoid(contact.a), b = verify::to_ellipsoid(contact.b);
    const PerramWertheimFactor found = perram_wertheim_factor(a, b);
    if (found.factor - found.factor_error > 1) {
      EXPECT_EQ(relation(a, b).relation, Relation::separate);
      ++apart;
    } else if (found.factor + found.factor_error < 1) {
      EXPECT_TRUE(overlaps(a, b));
      ++overlapping;
    }
  }
  EXPECT_GT(apart, 3);
  EXPECT_GT(overlapping, 3);
  const Ellipsoid a({0, 0, 0}, {1, 2, 3}), touching({3, 0, 0}, {2, 1, 1});
  EXPECT_EQ(perram_wertheim_factor(a, touching).factor, 1);
}

// geometry/other_gaps.hpp (6)
TEST(PerramWertheimFactor, IsThatOfTheScaledAndOfTheExchangedPair) {
  verify::ManufacturedContacts contacts(verify::contact_classes()[2], kSeed);
  for (int i = 0; i < 10; ++i) {
    const auto contact = contacts.next();
    const Ellipsoid a = verify::to_ellipsoid(contact.a), b = verify::to_ellipsoid(contact.b);
    const Vec3 d = 3 * (b.centre() - a.centre());
    const double errors = 2 * perram_wertheim_factor(a, b, d).factor_error;
    const double factor = perram_wertheim_factor(a, b, d).factor;
    EXPECT_NEAR(perram_wertheim_factor(b, a, -d).factor, factor, errors);
    for (const double scale : {0x1p-500, 0x1p300}) {
      const auto scaled = [&](const Ellipsoid& e) {
        return Ellipsoid(Vec3::Zero(), scale * e.semi_axes(), e.orientation());
      };
      const Vec3 far = scale * d;
      EXPECT_NEAR(perram_wertheim_factor(scaled(a), scaled(b), far).factor, factor, errors);
    }
  }
}

TEST(PerramWertheimFactor, OfBodiesByMatricesHasTheirRoundingInItsError) {
  Mat3 shape = Mat3::Zero();
  shape.diagonal() << 2, 3, 5;
  const auto a = MatrixEllipsoid::from_shape({0, 0, 0}, shape);
  const auto b = MatrixEllipsoid::from_precision({0, 0, 10}, shape);
  ASSERT_GT(a.relative_rounding(), 0);
  const PerramWertheimFactor found = perram_wertheim_factor(a, b);
  const long double scale = 10 / (std::sqrt(5.0L) + 1 / std::sqrt(5.0L));
  EXPECT_LE(std::abs(found.scale - scale), found.scale_error);
  EXPECT_LE(std::abs(found.factor - scale * scale), found.factor_error);
  EXPECT_LE(found.factor_error, 1e-13 * found.factor);
  const PerramWertheimFactor rounded = perram_wertheim_factor(a.ellipsoid(), b.ellipsoid());
  EXPECT_EQ(found.factor, rounded.factor);
  EXPECT_GE(found.scale_error, rounded.scale_error + a.relative_rounding() * (1 + found.scale));
}

TEST(PerramWertheimFactor, IsTheSameInEveryFloatingPointEnvironment) {
  const Ellipsoid a({0, 0, 0}, {1, 2, 3}, {1, 2, 3, 4}), b({3, 1, 2}, {3, 2, 1}, {4, 3, 1, 2});
  const PerramWertheimFactor right = perram_wertheim_factor(a, b);
  for (const auto& environment : testing::all_environments()) {
    const PerramWertheimFactor found = [&] {
      const testing::EnvironmentGuard guard(environment);
      return perram_wertheim_factor(a, b);
    }();
    EXPECT_EQ(found.factor, right.factor) << environment.name;
    EXPECT_EQ(found.factor_error, right.factor_error) << environment.name;
  }
}

}  // namespace
}  // namespace tangency
