// SPDX-License-Identifier: GPL-3.0-or-later
// The points on the curve of speed against accuracy keep their promises at every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/verify/families/extreme.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Family;
using testing::Indexed;
using testing::kSeed;

constexpr double kU = kUnitRoundoff;

const std::vector<std::pair<std::string, Accuracy>>& points() {
  static const std::vector<std::pair<std::string, Accuracy>> all = {
      {"fast", Accuracy::fast()},
      {"standard", Accuracy::standard()},
      {"certified", Accuracy::certified()},
      {"within 1e-3", Accuracy::within(1e-3)},
      {"within 1e-9", Accuracy::within(1e-9)}};
  return all;
}

/// The classes and overlaps of any depth, all of aspect ratios to 20.
std::vector<Family> ordinary_families() {
  std::vector<Family> all;
  for (int i = 0; i < 2; ++i)
    all.push_back(testing::contacts(verify::contact_classes()[static_cast<std::size_t>(i)], 1000));
  for (const auto& shape : verify::deep_families()) {
    if (shape.aspect > 20) continue;
    Family f{shape.name, {}, {}};
    verify::DeepPairs source(shape, kSeed);
    for (int i = 0; i < 40; ++i) {
      const verify::EllipsoidPair p = source.next();
      f.a.push_back(verify::to_ellipsoid(p.a));
      f.b.push_back(verify::to_ellipsoid(p.b));
    }
    all.push_back(std::move(f));
  }
  return all;
}

double size(const Ellipsoid& a, const Ellipsoid& b) {
  return (b.centre() - a.centre()).norm() + a.largest_semi_axis() + b.largest_semi_axis();
}

int sign(double x) { return (x > 0) - (x < 0); }

/// What is promised of one answer, held against the single call's.
void expect_promise(const Gap& gap, const Gap& single, double size, const Accuracy& accuracy) {
  ASSERT_EQ(sign(gap.gap), sign(single.gap));
  ASSERT_EQ(gap.status, single.status);
  if (gap.status != GapStatus::ok) return;
  ASSERT_LE(std::abs(gap.gap - single.gap), gap.gap_error + single.gap_error);
  const double tolerance = accuracy.of_size * size + accuracy.length;
  ASSERT_LE(gap.gap_error, (kOrdinaryGapErrorBound * kU * size + tolerance) * (1 + 4 * kU));
}

// geometry/gap_batch.hpp (1) (4)
TEST(GapBatchAccuracy, EveryPointKeepsSignStatusAndItsBoundOfTheError) {
  for (const Family& f : ordinary_families()) {
    SCOPED_TRACE(f.name);
    std::vector<Gap> single;
    for (std::size_t i = 0; i < f.a.size(); ++i) single.push_back(signed_gap(f.a[i], f.b[i]));
    at_every_level([&] {
      for (const auto& [name, accuracy] : points()) {
        SCOPED_TRACE(name);
        std::vector<Gap> gaps(f.a.size());
        signed_gaps(f.a, f.b, gaps, accuracy);
        for (std::size_t i = 0; i < gaps.size(); ++i) {
          SCOPED_TRACE(i);
          expect_promise(gaps[i], single[i], size(f.a[i], f.b[i]), accuracy);
        }
      }
    });
  }
}

TEST(GapBatchAccuracy, FollowingKeepsThePromisesToo) {
  for (const Family& f : ordinary_families()) {
    SCOPED_TRACE(f.name);
    const Indexed in(f);
    const BodyArray bodies(in.bodies);
    std::vector<Vec3> previous;
    std::vector<Gap> single;
    for (std::size_t i = 0; i < f.a.size(); ++i) {
      const Vec3 n = signed_gap(f.a[i], f.b[i]).normal;
      previous.push_back(n + 1e-4 * Vec3(0.3, -0.5, 0.8).cross(n));
      single.push_back(follow_gap(f.a[i], f.b[i], in.separations[i], previous[i]));
    }
    at_every_level([&] {
      for (const auto& [name, accuracy] : points()) {
        SCOPED_TRACE(name);
        std::vector<Gap> gaps(in.pairs.size());
        follow_gaps(bodies, {in.pairs, {}}, previous, gaps, accuracy);
        for (std::size_t i = 0; i < gaps.size(); ++i) {
          SCOPED_TRACE(i);
          expect_promise(gaps[i], single[i], size(f.a[i], f.b[i]), accuracy);
        }
      }
    });
  }
}

TEST(GapBatchAccuracy, CertifiedNormalsAreTheSingleCallsAndStandardOnesAreCoarser) {
  for (int which = 0; which < 2; ++which) {
    const Family f =
        testing::contacts(verify::contact_classes()[static_cast<std::size_t>(which)], 1000);
    SCOPED_TRACE(f.name);
    at_every_level([&] {
      std::vector<Gap> certified(f.a.size()), standard(f.a.size());
      signed_gaps(f.a, f.b, certified, Accuracy::certified());
      signed_gaps(f.a, f.b, standard, Accuracy::standard());
      double worst = 0, coarse = 0;
      for (std::size_t i = 0; i < f.a.size(); ++i) {
        const ContactBounds bounds = contact_bounds(f.a[i], f.b[i], certified[i]);
        worst = std::max(worst, bounds.normal);
        coarse = std::max(coarse, contact_bounds(f.a[i], f.b[i], standard[i]).normal);
        const Gap single = signed_gap(f.a[i], f.b[i]);
        ASSERT_LE((certified[i].normal - single.normal).norm(),
                  bounds.normal + contact_bounds(f.a[i], f.b[i], single).normal);
      }
      // 250 u (a_max / a_min)^2 is what doubles give normals of aspect 5 times a size ratio of 3.
      EXPECT_LE(worst, 1e-12);
      EXPECT_GT(coarse, 2 * worst);
    });
  }
}

TEST(GapBatchAccuracy, ATighterToleranceGivesATighterBound) {
  const Family f = testing::contacts(verify::contact_classes()[0], 1000);
  at_every_level([&] {
    const auto largest = [&](Accuracy accuracy) {
      std::vector<Gap> gaps(f.a.size());
      signed_gaps(f.a, f.b, gaps, accuracy);
      double worst = 0;
      for (const Gap& g : gaps) worst = std::max(worst, g.gap_error);
      return worst;
    };
    EXPECT_GE(largest(Accuracy::fast()), largest(Accuracy::within(1e-12)));
    EXPECT_LE(largest(Accuracy::within(1e-12)), 1.1e-12);
  });
}

}  // namespace
}  // namespace tangency
