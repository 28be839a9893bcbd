// SPDX-License-Identifier: GPL-3.0-or-later
//
// The families are what their headers say: held against the oracles, and against doubles that are
// the same on every platform.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/families/placing.hpp>
#include <tangency/verify/oracles/gap.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::verify {
namespace {

constexpr std::uint64_t kSeed = 20261122;
constexpr double kRealRounding = 1e-140;  // of the 150 digits of Real

double distance(const EllipsoidPair& pair) {
  return std::hypot(pair.b.centre[0] - pair.a.centre[0], pair.b.centre[1] - pair.a.centre[1],
                    pair.b.centre[2] - pair.a.centre[2]);
}

double aspect(const RawEllipsoid& body) { return most_axis(body) / least_axis(body); }

std::array<double, 20> numbers(const EllipsoidPair& pair) {
  std::array<double, 20> all;
  auto end = all.begin();
  for (const RawEllipsoid* e : {&pair.a, &pair.b}) {
    end = std::ranges::copy(e->centre, end).out;
    end = std::ranges::copy(e->semi_axes, end).out;
    end = std::ranges::copy(e->orientation, end).out;
  }
  return all;
}

TEST(Draw, GivesTheseDoublesOnEveryPlatform) {
  Draw draw(kSeed);
  EXPECT_EQ(draw.integer(-9, 9), 6);
  EXPECT_EQ(draw.real(-1, 1), -0x1.c942ec9913148p-3);
  EXPECT_EQ(draw.log_uniform(1e-8, 1e8), 0x1.a52bf23bca8efp-12);
  EXPECT_EQ(rounded(drawn_direction(draw)[0]), -0x1.230c76aaea823p-1);
  EXPECT_EQ(draw.orientation()[3], -0x1.b0cdcb738547cp-2);
}

TEST(Draw, StaysWithinItsBounds) {
  Draw draw(kSeed);
  std::set<int> drawn;
  for (int i = 0; i < 1000; ++i) {
    drawn.insert(draw.integer(-2, 3));
    const double x = draw.real(-1, 3), y = draw.log_uniform(0.5, 4);
    EXPECT_TRUE(-1 <= x && x < 3 && 0.5 <= y && y <= 4);
    const Real3 n = drawn_direction(draw);
    EXPECT_LT(abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1), kRealRounding);
  }
  EXPECT_EQ(drawn, (std::set{-2, -1, 0, 1, 2, 3}));
  EXPECT_EQ(draw.log_uniform(3, 3), 3);
}

TEST(Sequence, DependsOnTheSeedAlone) {
  const ContactFamily& family = contact_classes()[1];
  ManufacturedContacts one(family, 1), again(family, 1), other(family, 2);
  for (int i = 0; i < 10; ++i) {
    const auto pair = numbers(one.next());
    EXPECT_EQ(pair, numbers(again.next()));
    EXPECT_NE(pair, numbers(other.next()));
  }
}

TEST(ManufacturedContact, HasTheGapAndTheNormalOfTheOracle) {
  for (const ContactFamily& family : contact_classes()) {
    ManufacturedContacts contacts(family, kSeed);
    int overlapping = 0;
    for (int i = 0; i < 20; ++i) {
      const ManufacturedContact c = contacts.next();
      const GapTruth truth = signed_gap(c.a, c.b);
      overlapping += c.gap < 0;
      const double unit =
          family.gap_unit == ContactFamily::GapUnit::rho ? least_radii(c) : least_axis(c);
      EXPECT_LE(std::abs(c.gap), family.largest_gap * unit + 0x1p-52 * c.size) << family.name;
      // To second order in rounding over the radius of curvature.
      const double second = std::pow(0x1p-52 * c.size, 2) / least_radii(c);
      EXPECT_LE(abs(truth.gap - c.gap), second + 0x1p-52 * std::abs(c.gap)) << family.name;
      EXPECT_EQ(c.smallest_semi_axis, least_axis(c));
      EXPECT_NEAR(c.size, distance(c) + most_axis(c.a) + most_axis(c.b), 1e-14 * c.size);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LE(abs(truth.normal[k] - c.normal[k]), 1e-9) << family.name;
      }
      const double ratio = least_axis(c.b) / least_axis(c.a);
      EXPECT_TRUE(ratio >= 0.999 / family.size_ratio && ratio <= 1.001 * family.size_ratio);
      EXPECT_LE(std::max(aspect(c.a), aspect(c.b)), 1.001 * family.aspect) << family.name;
    }
    EXPECT_TRUE(overlapping > 0 && overlapping < 20) << family.name;
  }
}

TEST(ManufacturedContact, OverlapsByNoMoreThanTheLeastRadiiOfCurvature) {
  for (const double aspect : {2.0, 1e4}) {
    const ContactFamily family{"", ContactFamily::Shape::triaxial, aspect,
                               3,  ContactFamily::GapUnit::rho,    10};
    ManufacturedContacts contacts(family, kSeed);
    bool far = false;
    for (int i = 0; i < 40; ++i) {
      const ManufacturedContact c = contacts.next();
      EXPECT_NEAR(most_axis(c.a) / least_axis(c.a) / aspect, 1, 1e-12);
      EXPECT_GE(c.gap, -least_radii(c) - 0x1p-52 * c.size);
      far = far || c.gap > 5 * least_radii(c);
    }
    EXPECT_TRUE(far);
  }
}

TEST(ExtremePair, HasTheShapesSizesAndPlacesOfItsFamily) {
  using Shape = ExtremeFamily::Shape;
  for (const ExtremeFamily& family : extreme_families()) {
    ExtremePairs pairs(family, kSeed);
    int needles = 0, discs = 0, others = 0;
    for (int i = 0; i < 40; ++i) {
      const EllipsoidPair pair = pairs.next();
      double least_size = std::numeric_limits<double>::infinity(), most_size = 0;
      for (const RawEllipsoid* e : {&pair.a, &pair.b}) {
        auto axes = e->semi_axes;
        std::ranges::sort(axes);
        EXPECT_NEAR(axes[2] / axes[0] / family.aspect, 1, 1e-12) << family.name;
        const bool needle = axes[1] / axes[0] <= 2.001, disc = axes[2] / axes[1] <= 2.001;
        needles += needle, discs += disc, others += !needle && !disc;
        EXPECT_TRUE(family.shape != Shape::needles || needle) << family.name;
        EXPECT_TRUE(family.shape != Shape::discs || disc) << family.name;
        least_size = std::min(least_size, axes[2] / family.scale);
        most_size = std::max(most_size, axes[2] / family.scale);
      }
      // One body is of the size of the scale.
      EXPECT_LE(std::min(std::abs(least_size - 1), std::abs(most_size - 1)), 1e-12) << family.name;
      EXPECT_LE(most_size / least_size, 1.001 * family.size_ratio) << family.name;
      if (family.origin > 0) {
        EXPECT_GE(std::hypot(pair.a.centre[0], pair.a.centre[1], pair.a.centre[2]),
                  0.1 * family.origin * family.scale);
      }
    }
    if (family.shape == Shape::mixed && family.aspect >= 100) {
      EXPECT_TRUE(needles > 5 && discs > 5 && others > 5) << family.name;
    }
  }
}

TEST(ExtremePair, IsApartAndOverlapsAndIsNearATouch) {
  ExtremePairs pairs(extreme_families()[1], kSeed);
  int apart = 0, near = 0;
  constexpr int kPairs = 60;
  for (int i = 0; i < kPairs; ++i) {
    const EllipsoidPair pair = pairs.next();
    const Real gap = signed_gap(pair.a, pair.b).gap;
    apart += gap > 0;
    near += abs(gap) < 1e-6 * least_axis(pair);
    EXPECT_GE(gap, -1.001 * least_radii(pair));
  }
  EXPECT_TRUE(apart > kPairs / 2 && apart < kPairs - 10) << apart;
  EXPECT_TRUE(near > 10 && near < kPairs - 10) << near;
}

TEST(DeepPair, OverlapsAsDeepAsItsFamilySays) {
  for (const DeepFamily& family : deep_families()) {
    DeepPairs pairs(family, kSeed);
    for (int i = 0; i < 10; ++i) {
      const EllipsoidPair pair = pairs.next();
      EXPECT_LE(std::max(aspect(pair.a), aspect(pair.b)), 1.001 * family.aspect) << family.name;
      EXPECT_TRUE(exact_overlaps(pair.a, pair.b)) << family.name;
      EXPECT_EQ(distance(pair) == 0, family.largest_depth == 0) << family.name;
      if (family.largest_depth > 0 && family.largest_depth < 1) {
        EXPECT_LE(distance(pair), family.largest_depth * (most_axis(pair.a) + most_axis(pair.b)));
      }
      if (family.within > 0) {
        EXPECT_GE(signed_gap(pair.a, pair.b).gap, -family.within * least_axis(pair) - 1e-12);
      }
    }
  }
}

TEST(HeaviestPair, HasNumbersOfTheWholeRangeAndEveryKindOfRelation) {
  HeaviestPairs pairs({40}, kSeed), widest({1074}, kSeed);
  std::set<Relation> seen;
  double least = 1, most = 1;
  for (int i = 0; i < 60; ++i) {
    const EllipsoidPair pair = pairs.next();
    seen.insert(exact_relation(pair.a, pair.b).relation);
    const EllipsoidPair wide = widest.next();
    for (const double axis : wide.a.semi_axes) {
      least = std::min(least, axis), most = std::max(most, axis);
    }
    for (const double v : numbers(wide)) EXPECT_TRUE(std::isfinite(v));
  }
  EXPECT_GE(seen.size(), 5U);
  EXPECT_LT(least, 1e-280);
  EXPECT_GT(most, 1e280);
}

}  // namespace
}  // namespace tangency::verify
