// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts deeper than the least radii of curvature, where the lanes answer for a branch alone:
// held against what the single call answers for the same previous normal.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Columns;
using testing::kSeed;

enum class Shape { needles, discs, triaxial };

/// Overlapping pairs, the shortest semi-axis of every body 1, that move and turn a little at a
/// time.
class DeepPairs {
 public:
  /// @param shallowest, deepest  of their overlaps
  DeepPairs(Shape shape, double aspect, double deepest, std::size_t count, double shallowest = 0.0,
            std::uint64_t seed = kSeed)
      : columns(count), random_(seed), axes_(2 * count), turns_(2 * count) {
    for (std::size_t i = 0; i < count; ++i) {
      pairs_.push_back({static_cast<std::uint32_t>(2 * i), static_cast<std::uint32_t>(2 * i + 1)});
      draw_pair(i, shape, aspect, shallowest, deepest);
    }
    bodies = MovingBodies(axes_, turns_);
  }

  /// Some 1e-3 of the shortest semi-axis, and as many rad.
  void move() {
    for (Vec3& d : separations) d += 1e-3 * direction();
    for (std::size_t i = 0; i < turns_.size(); i += 2) {
      const Vec3 turn = 5e-4 * direction();
      turns_[i] = (Quaternion(1, turn[0], turn[1], turn[2]) * turns_[i]).normalized();
    }
    bodies.refresh(0, bodies.size());
  }

  PairList list() const { return {pairs_, separations}; }
  Gap followed(std::size_t i) const {
    return follow_gap(bodies[2 * i], bodies[2 * i + 1], separations[i], normals[i]);
  }
  double draw(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  Vec3 direction() {
    Vec3 v;
    do {
      v = Vec3(draw(-1, 1), draw(-1, 1), draw(-1, 1));
    } while (!(v.norm() > 0.1 && v.norm() < 1));
    return v.normalized();
  }

  MovingBodies bodies;
  std::vector<Vec3> separations, normals;
  Columns columns;

 private:
  void draw_pair(std::size_t i, Shape shape, double aspect, double shallowest, double deepest) {
    for (const std::size_t k : {2 * i, 2 * i + 1}) {
      const double middle = shape == Shape::needles ? 1.0
                            : shape == Shape::discs ? aspect
                                                    : draw(1.0, aspect);
      axes_[k] = Vec3(aspect, middle, 1.0);
      turns_[k] =
          Quaternion(draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(-1, 1) + 1e-3).normalized();
    }
    const Ellipsoid a(Vec3::Zero(), axes_[2 * i], turns_[2 * i]),
        b(Vec3::Zero(), axes_[2 * i + 1], turns_[2 * i + 1]);
    for (;;) {
      const Vec3 n = direction();
      const Vec3 d = a.support_point(n) + b.support_point(n) - draw(shallowest, deepest) * n;
      const Gap gap = signed_gap(a, b, d);
      if (!(gap.gap < -shallowest && gap.gap > -deepest)) continue;
      separations.push_back(d);
      normals.push_back(gap.normal);
      return;
    }
  }

  std::mt19937_64 random_;
  std::vector<Vec3> axes_;
  std::vector<Quaternion> turns_;
  std::vector<IndexedPair> pairs_;
};

int sign(double x) { return (x > 0) - (x < 0); }

void expect_the_same_branch(const Gap& lane, const Gap& single, std::size_t i) {
  ASSERT_EQ(lane.status, single.status) << i;
  ASSERT_EQ(sign(lane.gap), sign(single.gap)) << i;
  ASSERT_LE(std::abs(lane.gap - single.gap), lane.gap_error + single.gap_error) << i;
}

struct Counts {
  std::size_t deep = 0, of_lanes = 0;
};

/// Follows the pairs for some steps.
void follow(DeepPairs& pairs, int steps, Counts& counts, Accuracy accuracy = {}) {
  const std::size_t count = pairs.normals.size();
  for (int step = 0; step < steps; ++step) {
    pairs.move();
    follow_gaps(pairs.bodies, pairs.list(), pairs.normals, pairs.columns.all(), accuracy);
    for (std::size_t i = 0; i < count; ++i) {
      const Gap lane = pairs.columns[i], single = pairs.followed(i);
      ASSERT_NO_FATAL_FAILURE(expect_the_same_branch(lane, single, i));
      if (accuracy.of_size == 0.0) {
        ASSERT_LE((lane.normal - single.normal).norm(), 1e-5) << i;
      }
      // What a lane hands on has the bits of the single call.
      if (single.status != GapStatus::local) continue;
      ++counts.deep;
      if (lane.gap_error != single.gap_error) ++counts.of_lanes;
    }
    pairs.normals = pairs.columns.normal;
  }
}

TEST(DeepFollowing, StaysOnTheBranchOfTheSingleCallAndInTheLanes) {
  for (const double aspect : {3.0, 5.0, 10.0}) {
    for (const Shape shape : {Shape::needles, Shape::discs, Shape::triaxial}) {
      SCOPED_TRACE(std::to_string(aspect) + " shape " + std::to_string(static_cast<int>(shape)));
      at_every_level([&] {
        Counts counts;
        DeepPairs pairs(shape, aspect, 1.0, 203);
        ASSERT_NO_FATAL_FAILURE(follow(pairs, 12, counts));
        EXPECT_GE(counts.deep, 200u);
        EXPECT_GE(counts.of_lanes, counts.deep * 9 / 10) << counts.deep;
      });
    }
  }
}

TEST(DeepFollowing, ProvesWhatACoarseAnswerClaims) {
  // Where Newton's method ends early the bound is no longer rounding.
  for (const double of_size : {0x1p-20, 1e-4}) {
    DeepPairs pairs(Shape::triaxial, 5.0, 0.7, 300);
    Counts counts;
    double widest = 0.0;
    for (int step = 0; step < 6; ++step) {
      ASSERT_NO_FATAL_FAILURE(follow(pairs, 1, counts, {of_size, 0.0, false}));
      for (const double error : pairs.columns.gap_error) widest = std::max(widest, error);
    }
    EXPECT_GE(counts.of_lanes, counts.deep * 9 / 10);
    EXPECT_GE(widest, 1e-9);
  }
}

// geometry/gap.hpp: the true gap is at least gap - gap_error of a local answer.
TEST(DeepFollowing, IsNeverAboveTheGlobalGap) {
  DeepPairs pairs(Shape::triaxial, 5.0, 1.5, 300);
  // Away from the shortest way out, so that some branches are not the global one.
  for (Vec3& n : pairs.normals) n = (n + 0.8 * pairs.direction()).normalized();
  std::size_t others = 0;
  for (int step = 0; step < 3; ++step) {
    pairs.move();
    follow_gaps(pairs.bodies, pairs.list(), pairs.normals, pairs.columns.all());
    for (std::size_t i = 0; i < pairs.normals.size(); ++i) {
      const Gap lane = pairs.columns[i];
      const Gap global =
          signed_gap(pairs.bodies[2 * i], pairs.bodies[2 * i + 1], pairs.separations[i]);
      if (global.status != GapStatus::ok) continue;
      ASSERT_LE(lane.gap - lane.gap_error, global.gap + global.gap_error) << i;
      if (lane.gap < global.gap - 1e-3) ++others;
    }
    pairs.normals = pairs.columns.normal;
  }
  EXPECT_GE(others, 10u);
}

TEST(DeepFollowing, CertifiedNormalsAreTheSingleCalls) {
  double standard = 0.0, certified = 0.0;
  for (std::uint64_t seed = kSeed; seed < kSeed + 8; ++seed) {
    DeepPairs pairs(Shape::triaxial, 5.0, 0.7, 300, 0.0, seed);
    const auto worst = [&](Accuracy accuracy) {
      follow_gaps(pairs.bodies, pairs.list(), pairs.normals, pairs.columns.all(), accuracy);
      double off = 0.0;
      for (std::size_t i = 0; i < pairs.normals.size(); ++i) {
        const Gap single = pairs.followed(i);
        if (single.status != GapStatus::local || pairs.columns[i].gap_error == single.gap_error)
          continue;
        off = std::max(off, (pairs.columns[i].normal - single.normal).norm());
      }
      return off;
    };
    pairs.move();
    standard = std::max(standard, worst(Accuracy::standard()));
    certified = std::max(certified, worst(Accuracy::certified()));
  }
  std::printf("normals off by at most %.1e, certified %.1e\n", standard, certified);
  EXPECT_GT(standard, 1e-10);
  EXPECT_LE(certified, 1e-12);
}

/// One pair, one previous normal, in every lane.
void expect_the_single_answer(const std::vector<Vec3>& axes, const std::vector<Quaternion>& turns,
                              const Vec3& separation, const Vec3& previous, GapStatus status) {
  const MovingBodies bodies(axes, turns);
  const std::vector<IndexedPair> pairs(20, IndexedPair{0, 1});
  const std::vector<Vec3> separations(20, separation), normals(20, previous);
  const Gap single = previous == Vec3::Zero()
                         ? signed_gap(bodies[0], bodies[1], separation)
                         : follow_gap(bodies[0], bodies[1], separation, previous);
  ASSERT_EQ(single.status, status);
  at_every_level([&] {
    Columns answers(20);
    follow_gaps(bodies, {pairs, separations}, normals, answers.all());
    for (std::size_t i = 0; i < 20; ++i)
      ASSERT_NO_FATAL_FAILURE(expect_the_same_branch(answers[i], single, i));
  });
}

TEST(DeepFollowing, DoesNotTakeAFalseMaximumOfFlatBodiesThatAreApart) {
  // B is below A; up is a strict maximum of -1.2 all the same, down the true one of 0.8.
  expect_the_single_answer({{10, 9, 0.1}, {10, 9, 0.1}}, {{1, 0, 0, 0}, {1, 0, 0, 0}},
                           {0.5, 0.25, -1}, {0, 0, 1}, GapStatus::ok);
}

TEST(DeepFollowing, IsGlobalWhereABodyIsASphere) {
  expect_the_single_answer({{1, 1, 1}, {5, 4, 1}}, {{1, 0, 0, 0}, {1, 0, 0, 0}}, {0.25, 0.125, 0.5},
                           {0, 0, 1}, GapStatus::ok);
  expect_the_single_answer({{5, 4, 1}, {1, 1, 1}}, {{1, 0, 0, 0}, {1, 0, 0, 0}}, {0.25, 0.125, 0.5},
                           {0, 0, 1}, GapStatus::ok);
}

TEST(DeepFollowing, IsAskedForAllNormalsWhereThereIsNoPreviousOne) {
  // The branch alone would be `local`.
  const std::vector<Vec3> axes{{5, 4, 1}, {5, 3, 1}};
  const std::vector<Quaternion> turns{{1, 0, 0, 0}, {1, 0.125, 0, 0}};
  expect_the_single_answer(axes, turns, {0.25, 0.125, 1.25}, {0, 0, 1}, GapStatus::local);
  expect_the_single_answer(axes, turns, {0.25, 0.125, 1.25}, {0, 0, 0}, GapStatus::ok);
}

/// Followed from normals that are off by `turn` rad, across their way.
void follow_from_afar(DeepPairs& pairs, double turn, std::size_t& deep) {
  for (Vec3& n : pairs.normals) n += std::tan(turn) * pairs.direction().cross(n).normalized();
  follow_gaps(pairs.bodies, pairs.list(), pairs.normals, pairs.columns.all());
  for (std::size_t i = 0; i < pairs.normals.size(); ++i) {
    const Gap single = pairs.followed(i);
    const Gap lane = pairs.columns[i];
    ASSERT_NO_FATAL_FAILURE(expect_the_same_branch(lane, single, i));
    if (single.status != GapStatus::local) continue;
    ++deep;
    // Of 46,000 pairs 0.6 rad off one was on another branch in the lanes.
    const bool far = pairs.normals[i].normalized().dot(lane.normal) < 0.98;
    if (far) {
      ASSERT_EQ(lane.gap_error, single.gap_error) << i;
    }
  }
}

TEST(DeepFollowing, IsLeftToTheSingleCallWhereTheNormalIsFarFromItsBranch) {
  std::size_t deep = 0;
  for (const double turn : {0.1, 0.3, 0.6, 1.0}) {
    SCOPED_TRACE(turn);
    DeepPairs pairs(Shape::triaxial, 10.0, 0.7, 400);
    ASSERT_NO_FATAL_FAILURE(follow_from_afar(pairs, turn, deep));
  }
  EXPECT_GE(deep, 400u);
}

TEST(DeepFollowing, HasTheStatusOfTheSingleCallAboutTheDepthWhereThatChanges) {
  // rho of two needles of aspect 3 is 2/3: at the first normal most are deeper, at the best half.
  constexpr double kDepth = 2.0 / 3.0, kAbout = 1e-3;
  std::size_t deep = 0;
  for (const double turn : {0.0, 0.02, 0.05, 0.1}) {
    SCOPED_TRACE(turn);
    DeepPairs pairs(Shape::needles, 3.0, kDepth + kAbout, 300, kDepth - kAbout);
    ASSERT_NO_FATAL_FAILURE(follow_from_afar(pairs, turn, deep));
  }
  EXPECT_GE(deep, 400u);
  EXPECT_LE(deep, 800u);
}

}  // namespace
}  // namespace tangency
