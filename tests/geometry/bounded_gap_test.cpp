// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/gap/inner_ellipsoid.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/tests/support/generators.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency {
namespace {

using testing::Family;
using testing::same_bits;

double size_of(const Ellipsoid& a, const Ellipsoid& b) {
  return (b.centre() - a.centre()).stableNorm() + a.largest_semi_axis() + b.largest_semi_axis();
}

double low(const BoundedGap& g) { return g.gap - g.gap_error; }
double high(const BoundedGap& g) { return g.gap + g.above; }
/// Of the difference, which the tests form themselves, and of sums whose last bit may be lost.
double slack(const Gap& g) { return 4 * kUnitRoundoff * std::abs(g.gap) + 1e-320; }

/// Does the enclosure meet what the search says?
void expect_enclosed(const BoundedGap& found, const Gap& exact, std::size_t i) {
  if (!std::isfinite(exact.gap)) return;
  // Of any branch the value is no more than the true gap.
  ASSERT_GE(high(found) + slack(found), exact.gap - exact.gap_error) << i;
  if (exact.status == GapStatus::ok) {
    ASSERT_LE(low(found) - slack(found), exact.gap + exact.gap_error) << i;
  }
}

// geometry/bounded_gap.hpp (1)
TEST(BoundedGap, EnclosesTheGapOfEveryFamily) {
  for (const Family& f : testing::drawn_families()) {
    SCOPED_TRACE(f.name);
    for (std::size_t i = 0; i < f.a.size(); ++i)
      expect_enclosed(bounded_gap(f.a[i], f.b[i]), signed_gap(f.a[i], f.b[i]), i);
  }
}

// geometry/bounded_gap.hpp (1)
TEST(BoundedGap, EnclosesWhatTheOracleProvesOfDeepPairs) {
  for (const auto& family : verify::deep_families()) {
    SCOPED_TRACE(family.name);
    verify::DeepPairs source(family, testing::kSeed);
    for (int i = 0; i < 3; ++i) {
      const verify::EllipsoidPair pair = source.next();
      const BoundedGap found =
          bounded_gap(verify::to_ellipsoid(pair.a), verify::to_ellipsoid(pair.b));
      const verify::GapTruth truth = verify::signed_gap(pair.a, pair.b);
      ASSERT_LE(found.gap - verify::Real(found.gap_error), truth.gap + truth.unproven) << i;
      ASSERT_GE(found.gap + verify::Real(found.above), truth.gap) << i;
    }
  }
}

// geometry/bounded_gap.hpp (2)
TEST(BoundedGap, IsOkWhereBothErrorsAreRoundingAndThenIsTheGlobalAnswer) {
  std::size_t ok = 0, local = 0;
  for (const Family& f : testing::drawn_families()) {
    SCOPED_TRACE(f.name);
    for (std::size_t i = 0; i < f.a.size(); ++i) {
      const BoundedGap found = bounded_gap(f.a[i], f.b[i]);
      // Subnormal numbers of the caller's unit add theirs.
      const double rounding = 100 * kUnitRoundoff * size_of(f.a[i], f.b[i]) * (1 + 1e-12) + 1e-320;
      if (!std::isfinite(rounding)) continue;
      const bool narrow = std::max(found.gap_error, found.above) <= rounding;
      if (found.status != GapStatus::ok) {
        // The size itself is rounded, by the test and by the call.
        ASSERT_FALSE(std::max(found.gap_error, found.above) <
                     99 * kUnitRoundoff * size_of(f.a[i], f.b[i]))
            << i;
        ++local;
        continue;
      }
      ++ok;
      ASSERT_TRUE(narrow) << i;
      const Gap exact = signed_gap(f.a[i], f.b[i]);
      ASSERT_LE(std::abs(found.gap - exact.gap), found.gap_error + exact.gap_error) << i;
    }
  }
  EXPECT_GE(ok, 3000u);
  EXPECT_GE(local, 100u);
}

TEST(BoundedGap, ContactsOfAspectToFiveAndBallsAtAnyDepthAreOk) {
  for (std::size_t k = 0; k < 2; ++k) {
    const Family f = testing::contacts(verify::contact_classes()[k], 500);
    for (std::size_t i = 0; i < f.a.size(); ++i) {
      const BoundedGap found = bounded_gap(f.a[i], f.b[i]);
      ASSERT_EQ(found.status, GapStatus::ok) << f.name << i;
      ASSERT_EQ(found.gap_error, found.above);
      // The witness points are those of the normal.
      ASSERT_EQ(found.arm_a.array().isFinite().all(), true);
      const Vec3 d = f.b[i].centre() - f.a[i].centre();
      const double along = (d + found.arm_b - found.arm_a).dot(found.normal);
      ASSERT_LE(std::abs(along - found.gap), 64 * kUnitRoundoff * size_of(f.a[i], f.b[i])) << i;
    }
  }
  for (const double x : {3.5, 3.0, 2.0, 1e-3, 1e-30}) {
    const BoundedGap found =
        bounded_gap(Ellipsoid({0, 0, 0}, {1, 1, 1}), Ellipsoid({0, x, 0}, {2, 2, 2}));
    EXPECT_EQ(found.status, GapStatus::ok) << x;
    EXPECT_NEAR(found.gap, x - 3, found.gap_error) << x;
  }
}

TEST(BoundedGap, OfATouchHasADoubtfulSign) {
  const Ellipsoid a({0, 0, 0}, {1, 2, 3});
  for (const double x : {2.5, std::nextafter(2.5, 3), std::nextafter(2.5, 2)}) {
    const BoundedGap touch = bounded_gap(a, Ellipsoid({x, 0, 0}, {1.5, 1, 1}));
    EXPECT_EQ(touch.status, GapStatus::ok) << x;
    EXPECT_LE(low(touch), 0) << x;
    EXPECT_GE(high(touch), 0) << x;
  }
}

TEST(BoundedGap, OfFlatBodiesApartIsNotTheFalseMaximumBelowZero) {
  std::mt19937_64 random(3);  // five of these pairs have the value of such a maximum at hand
  const auto draw = [&](double least, double most) {
    return least + (most - least) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  for (int i = 0; i < 1000; ++i) {
    const double thin = std::pow(10, draw(-4, -2)), width = draw(0.3, 1), other = draw(0.3, 1);
    const double x = draw(-1.9, 1.9), y = draw(-1.9, 1.9), z = draw(-0.3, 0.3);
    const double qx = draw(-0.3, 0.3), qy = draw(-0.3, 0.3), qz = draw(-1, 1);
    const Ellipsoid a({0, 0, 0}, {1, width, thin});
    const Ellipsoid b({x, y, z}, {1, other, thin}, {1, qx, qy, qz});
    if (overlaps(a, b)) continue;
    const BoundedGap found = bounded_gap(a, b);
    ASSERT_GE(found.gap, 0) << i;
    ASSERT_GE(high(found) + slack(found), signed_gap(a, b).gap) << i;
  }
}

// The direction to begin with underflows: two discs, rim to rim, 2^28 to 2^45 times as wide as
// thick.
TEST(BoundedGap, EnclosesTheGapOfDiscsRimToRim) {
  const Quaternion turn(0x1.3333333333333p+0, -0x1.199999999999ap+1, 0x1.13404ea4a8c15p-9, 0.25);
  const Vec3 d(-0x1.9ea1a1c29c60ep-3, -0x1.ba5671dc9f52ep-2, -0x1.3bf494395921fp-1);
  for (int thin_a = 28; thin_a <= 45; ++thin_a) {
    for (int thin_b = 28; thin_b <= thin_a; ++thin_b) {
      SCOPED_TRACE(::testing::Message() << thin_a << ' ' << thin_b);
      const double r = 0x1.8f5c28f5c28f6p-2;
      const Ellipsoid a({0, 0, 0}, {r, r, std::ldexp(r, -thin_a)}, turn);
      const Ellipsoid b(d, {r, r, std::ldexp(r, -thin_b)}, turn);
      expect_enclosed(bounded_gap(a, b), signed_gap(a, b), 0);
    }
  }
}

// There it is a subnormal number.
TEST(BoundedGap, EnclosesTheGapOfTwoFlatNeedles) {
  const Ellipsoid a({0, 0, 0}, {0x1.469727f37aa51p-15, 0x1.e4ca53f619e2dp-20, 0x1.1455aebc0edbp-5});
  const Ellipsoid b({0x1.3c7a9ffc9bfc7p-8, 0x1.e1191c5b2b209p-12, -0x1.4e096cdda36e4p-5},
                    {0x1.df292e22919cdp-18, 0x1.63a1ff83b8f05p-22, 0x1.956d74b81bc53p-8});
  expect_enclosed(bounded_gap(a, b), signed_gap(a, b), 0);
}

// geometry/bounded_gap.hpp (3)
RC_GTEST_PROP(BoundedGapProperty, EnclosuresOfOneGapMeet, ()) {
  const testing::Pair p = *testing::pair_at(20, testing::uniform(0, 1.5));
  const double size = size_of(p.a, p.b), scale = std::exp2(*rc::gen::inRange(-300, 300));
  const BoundedGap one = bounded_gap(p.a, p.b);
  const auto scaled = [&](const Ellipsoid& e) {
    return Ellipsoid(scale * e.centre(), scale * e.semi_axes(), e.orientation());
  };
  BoundedGap large = bounded_gap(scaled(p.a), scaled(p.b));
  large.gap /= scale, large.gap_error /= scale, large.above /= scale;
  const Vec3 d = p.b.centre() - p.a.centre();  // rounded: the gap moves by no more
  const double rounded = 8 * kUnitRoundoff * (p.a.centre().norm() + p.b.centre().norm() + size);
  for (const BoundedGap& other :
       {bounded_gap(p.b, p.a), bounded_gap(p.a, p.b, d), bounded_gap(p.b, p.a, -d), large}) {
    RC_ASSERT(low(one) <= high(other) + rounded);
    RC_ASSERT(low(other) <= high(one) + rounded);
  }
}

TEST(BoundedGap, IsTheSameInEveryFloatingPointEnvironment) {
  const Family f = testing::drawn_families().back();
  for (std::size_t i = 0; i < f.a.size(); ++i) {
    const BoundedGap one = bounded_gap(f.a[i], f.b[i]);
    for (const auto& environment : testing::all_environments()) {
      const BoundedGap other = [&] {
        const testing::EnvironmentGuard guard(environment);
        return bounded_gap(f.a[i], f.b[i]);
      }();
      ASSERT_TRUE(same_bits(one, other) && same_bits(one.above, other.above))
          << i << " " << environment.name;
    }
  }
}

RC_GTEST_PROP(InnerEllipsoidProperty, NoMultiplierAndNoNormalProvesMoreThanIsTrue, ()) {
  const testing::Pair p = *testing::pair_at(10, testing::uniform(0, 0.95));
  const detail::Pair pair({p.a, p.b});
  if (!pair.in_own_unit()) return;
  const Vec3 normal = *testing::direction();
  const detail::InnerEllipsoid inner(pair, normal);
  const double gap = signed_gap(p.a, p.b).gap;  // no branch is above the true gap
  const double error = 100 * kUnitRoundoff * pair.size;
  RC_ASSERT(inner.best().high >= gap - error);
  for (int i = 0; i < 10; ++i) {
    const double share = *testing::uniform(0, 1);
    RC_ASSERT(inner.at(share * pair.size * pair.size).high >= gap - error);
    RC_ASSERT(inner.at(inner.multiplier(share * pair.size)).high >= gap - error);
  }
}

TEST(BoundedGapDeathTest, SeparationThatIsNotFiniteEndsTheProcess) {
  const Ellipsoid a({0, 0, 0}, {1, 1, 1});
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_DEATH(bounded_gap(a, a, Vec3(0, 0, infinite)),
               "bounded_gap: separation = \\(0, 0, inf\\): must be finite");
}

}  // namespace
}  // namespace tangency
