// SPDX-License-Identifier: GPL-3.0-or-later
// What neighbours.hpp promises beyond what tests/verify/neighbour_agreement.cpp holds against all
// images of all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/image_gap.hpp>
#include <tangency/geometry/neighbours.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>

namespace tangency {
namespace {

using testing::same_bits;

std::vector<Ellipsoid> crowd(std::size_t count, double length) {
  std::mt19937_64 random(20261130);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  std::vector<Ellipsoid> bodies;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, 9> x;
    for (double& one : x) one = between(0.0, 1.0);
    bodies.emplace_back(length * Vec3(x[0], x[1], x[2]), Vec3(0.4 + x[3], 0.4 + x[4], 0.4 + x[5]),
                        Quaternion(0.5 + x[6], x[7] - 0.5, x[8] - 0.5, 0.25));
  }
  return bodies;
}

MovingBodies moving(const std::vector<Ellipsoid>& bodies) {
  std::vector<Vec3> axes, centres;
  std::vector<Quaternion> turns;
  for (const Ellipsoid& body : bodies) {
    axes.push_back(body.semi_axes());
    centres.push_back(body.centre());
    turns.push_back(body.orientation());
  }
  return {axes, {turns, centres}};
}

Lattice cubic(double length) { return {length * Mat3::Identity()}; }

std::vector<Ellipsoid> balls(const std::vector<double>& places) {
  std::vector<Ellipsoid> all;
  for (const double x : places) all.emplace_back(Vec3(x, 0.0, 0.0), Vec3::Constant(0.5));
  return all;
}

// geometry/neighbours.hpp (1) (3)
TEST(Neighbours, TouchWhateverTheCentreOfTheImageIsRoundedTo) {
  const double length = 6.0 + 0x1p-50;
  const Lattice lattice{Vec3(length, 1.0, 1.0).asDiagonal(), {true, false, false}};
  const std::vector<NearPair> touching{{0, 1, {4, 0, 0}}};
  EXPECT_EQ(neighbours(balls({4.0 * length - 1.0, 0.0}), {.lattice = lattice}).pairs, touching);
  EXPECT_TRUE(
      neighbours(balls({4.0 * length - 1.0 - 0x1p-48, 0.0}), {.lattice = lattice}).pairs.empty());
  const Lattice small{Vec3(0.5, 1.0, 1.0).asDiagonal(), {true, false, false}};
  const std::vector<NearPair> own{{0, 0, {1, 0, 0}}, {0, 0, {2, 0, 0}}};
  EXPECT_EQ(neighbours(balls({7.0}), {.lattice = small}).pairs, own);
}

// In units of 2^-53 beyond 1 the rounded separation is 4, and the true one is 4 - off: what is told
// of the rounded one, apart or overlapping, is not so.
// geometry/neighbours.hpp (1)
TEST(Neighbours, AreThoseOfTheTrueSeparationWhereTheRoundedOneTellsOtherwise) {
  const Lattice lattice{Vec3(3.0 + 0x1p-51, 1.0, 1.0).asDiagonal(), {true, false, false}};
  const auto pairs = [&](double off, double radii) {
    const std::vector<Ellipsoid> two{
        Ellipsoid(Vec3(0x1p-53 * off, 0.0, 0.0), Vec3::Constant(0.5 - 0x1p-54)),
        Ellipsoid(Vec3(-2.0, 0.0, 0.0), Vec3::Constant(0.5 + 0x1p-53 * (radii + 0.5)))};
    const Neighbours found =
        neighbours(two, {.lattice = lattice, .answers = NeighbourAnswers::gaps});
    EXPECT_EQ(neighbours(two, {.lattice = lattice}).pairs, found.pairs);
    EXPECT_EQ(neighbours(moving(two), {.lattice = lattice}).pairs, found.pairs);
    for (const double gap : found.gap) EXPECT_EQ(gap < 0.0, 4.0 - off < radii);
    return found.size();
  };
  EXPECT_EQ(pairs(1.0, 3.5), 1u);  // overlap by 1/2, rounded apart
  EXPECT_EQ(pairs(1.0, 2.5), 0u);
  EXPECT_EQ(pairs(-1.0, 4.5), 0u);  // apart by 1/2, rounded overlapping
  EXPECT_EQ(pairs(-1.0, 5.5), 1u);
}

// geometry/neighbours.hpp (2)
TEST(Neighbours, AreThoseWithinTheReachAndNoOthers) {
  const std::vector<Ellipsoid> row = balls({0.0, 1.25, 3.0, 5.0});
  const auto pairs = [&](double reach) {
    const Neighbours found = neighbours(row, {.reach = reach});
    EXPECT_EQ(neighbours(moving(row), {.reach = reach}).pairs, found.pairs);
    return found.size();
  };
  EXPECT_EQ(pairs(0.0), 0u);
  EXPECT_EQ(pairs(0.25 - 1e-9), 0u);
  EXPECT_EQ(pairs(0.25), 1u);
  EXPECT_EQ(pairs(0.75), 2u);
  EXPECT_EQ(pairs(1.0), 3u);
  EXPECT_EQ(pairs(4.0), 6u);
}

void expect_same(const NeighbourBlock& x, const NeighbourBlock& y, std::size_t at) {
  ASSERT_LE(at + x.pairs.size(), y.pairs.size());
  for (std::size_t k = 0; k < x.pairs.size(); ++k) {
    ASSERT_EQ(x.pairs[k], y.pairs[at + k]);
    ASSERT_EQ(x.overlaps[k], y.overlaps[at + k]);
    ASSERT_TRUE(same_bits(x.gap[k], y.gap[at + k]));
    ASSERT_TRUE(same_bits(x.gap_error[k], y.gap_error[at + k]));
    ASSERT_EQ(x.status[k], y.status[at + k]);
    ASSERT_TRUE(same_bits(x.normal[k], y.normal[at + k]));
    ASSERT_TRUE(same_bits(x.arm_a[k], y.arm_a[at + k]));
    ASSERT_TRUE(same_bits(x.arm_b[k], y.arm_b[at + k]));
    ASSERT_TRUE(same_bits(x.separation[k], y.separation[at + k]));
  }
}

// geometry/neighbours.hpp (4)
TEST(Neighbours, AreTheSameToTheBitForEveryNumberOfThreads) {
  const std::vector<Ellipsoid> bodies = crowd(2500, 20.0);
  for (const double reach : {0.0, 0.05}) {
    NeighbourQuestion question{reach, cubic(20.0), NeighbourAnswers::contacts};
    const Neighbours one = neighbours(bodies, question);
    ASSERT_GT(one.size(), 2500u);
    EXPECT_TRUE(std::is_sorted(one.pairs.begin(), one.pairs.end()));
    std::vector<NearPair> blocks_of_one;
    for_each_neighbours(bodies, question, [&](const NeighbourBlock& block) {
      EXPECT_TRUE(std::is_sorted(block.pairs.begin(), block.pairs.end()));
      blocks_of_one.insert(blocks_of_one.end(), block.pairs.begin(), block.pairs.end());
    });
    for (const int threads : {0, 2, 5}) {
      question.threads = threads;
      const Neighbours many = neighbours(bodies, question);
      ASSERT_EQ(many.size(), one.size());
      expect_same(many.all(), one.all(), 0);
      std::size_t at = 0;
      for_each_neighbours(bodies, question, [&](const NeighbourBlock& block) {
        ASSERT_TRUE(std::equal(block.pairs.begin(), block.pairs.end(),
                               blocks_of_one.begin() + static_cast<std::ptrdiff_t>(at)));
        for (std::size_t k = 0; k < block.pairs.size(); ++k) {
          const auto place = std::lower_bound(one.pairs.begin(), one.pairs.end(), block.pairs[k]);
          const auto i = static_cast<std::size_t>(place - one.pairs.begin());
          ASSERT_TRUE(same_bits(block.gap[k], one.gap[i]));
          ASSERT_TRUE(same_bits(block.arm_b[k], one.arm_b[i]));
        }
        at += block.pairs.size();
      });
      EXPECT_EQ(at, one.size());
    }
  }
}

// geometry/neighbours.hpp (5)
TEST(Neighbours, AnswersAreThoseOfThePair) {
  const std::vector<Ellipsoid> bodies = crowd(300, 8.0);
  const Lattice lattice = cubic(8.0 + 0x1p-45);
  const NeighbourQuestion question{0.1, lattice, NeighbourAnswers::contacts};
  const Neighbours found = neighbours(bodies, question),
                   of_columns = neighbours(moving(bodies), question);
  ASSERT_GT(found.size(), 300u);
  EXPECT_EQ(of_columns.pairs, found.pairs);
  std::size_t apart = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const auto& [a, b, image] = found.pairs[k];
    const Gap gap = signed_gap(bodies[a], bodies[b], lattice.edges, image);
    const bool meet = overlaps(bodies[a].moved_to(Vec3::Zero()),
                               bodies[b].moved_to(found.separation[k]));  // none is that near
    EXPECT_EQ(found.overlaps[k] == 1, meet);
    EXPECT_EQ(found.gap[k] < 0.0, meet);
    EXPECT_EQ(of_columns.overlaps[k], found.overlaps[k]);
    apart += meet ? 0 : 1;
    if (gap.status != GapStatus::ok) continue;
    EXPECT_LE(std::abs(found.gap[k] - gap.gap), found.gap_error[k] + gap.gap_error);
    EXPECT_LE(std::abs(of_columns.gap[k] - gap.gap), of_columns.gap_error[k] + gap.gap_error);
    const Vec3 between = found.separation[k] + found.arm_b[k] - found.arm_a[k];
    EXPECT_LE((between - found.gap[k] * found.normal[k]).norm(), 1e-7);
  }
  EXPECT_GT(apart, 20u);
}

TEST(Neighbours, HaveTheColumnsThatAreAskedFor) {
  const std::vector<Ellipsoid> bodies = crowd(50, 3.0);
  const auto columns = [&](NeighbourAnswers answers, double reach) {
    const Neighbours found = neighbours(bodies, {.reach = reach, .answers = answers});
    EXPECT_GT(found.size(), 0u);
    std::string there;
    for (const std::size_t size :
         {found.overlaps.size(), found.gap.size(), found.gap_error.size(), found.status.size(),
          found.normal.size(), found.arm_a.size(), found.arm_b.size(), found.separation.size()})
      there += size == 0 ? '-' : size == found.size() ? 'x' : '?';
    return there;
  };
  for (const double reach : {0.0, 0.1}) {
    EXPECT_EQ(columns(NeighbourAnswers::pairs, reach), "--------");
    EXPECT_EQ(columns(NeighbourAnswers::overlaps, reach), "x-------");
    EXPECT_EQ(columns(NeighbourAnswers::gaps, reach), "xxxx----");
    EXPECT_EQ(columns(NeighbourAnswers::contacts, reach), "xxxxxxxx");
  }
}

TEST(Neighbours, AreTheSameInEveryEnvironment) {
  const std::vector<Ellipsoid> bodies = crowd(200, 6.0);
  const NeighbourQuestion question{0.05, cubic(6.1), NeighbourAnswers::contacts, {}, 2};
  const Neighbours expected = neighbours(bodies, question);
  for (const auto& environment : testing::all_environments()) {
    SCOPED_TRACE(environment.name);
    Neighbours found;
    {
      const testing::EnvironmentGuard guard(environment);
      found = neighbours(bodies, question);
    }
    ASSERT_EQ(found.size(), expected.size());
    expect_same(found.all(), expected.all(), 0);
  }
}

template <class List>
concept GivesABlock = requires(List&& list) {
  std::forward<List>(list).all();
};

TEST(Neighbours, GiveNoBlockOfColumnsThatEndWithTheStatement) {
  EXPECT_TRUE(GivesABlock<const Neighbours&>);
  EXPECT_FALSE(GivesABlock<Neighbours>);
  EXPECT_FALSE(GivesABlock<const Neighbours>);
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "nothing";
}

TEST(Neighbours, RefuseWhatMakesNoSense) {
  const std::vector<Ellipsoid> bodies = balls({0.0, 2.0});
  for (const double reach :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_NE(
        refusal([&] { neighbours(bodies, {.reach = reach}); }).find("must be finite and >= 0"),
        std::string::npos);
  EXPECT_EQ(refusal([&] { neighbours(bodies, {.reach = -1e-9}); }),
            "reach = -1e-09: must be finite and >= 0");
  const std::vector<Ellipsoid> huge{
      Ellipsoid(Vec3::Zero(), Vec3::Constant(std::numeric_limits<double>::max()))};
  EXPECT_NE(refusal([&] {
              neighbours(huge, {.reach = std::numeric_limits<double>::max()});
            }).find("a semi-axis of body 0 are beyond"),
            std::string::npos);
  EXPECT_NE(refusal([&] { neighbours(bodies, {.lattice = cubic(0.0)}); }).find("edges"),
            std::string::npos);
  const std::vector<Vec3> axes(2, Vec3::Ones());
  const std::vector<Quaternion> turns(2, Quaternion::Identity());
  EXPECT_EQ(refusal([&] { neighbours(MovingBodies(axes, turns)); }),
            "bodies: without centres nothing is near");
  MovingBodies broken = moving(bodies);
  broken.set_semi_axes(1, std::vector<Vec3>{Vec3(1.0, -1.0, 1.0)});
  EXPECT_EQ(refusal([&] { neighbours(broken); }),
            "bodies[1]: r2 = -1: a semi-axis must be finite and > 0");
  EXPECT_TRUE(neighbours(std::vector<Ellipsoid>{}).pairs.empty());
  EXPECT_TRUE(neighbours(MovingBodies()).pairs.empty());
}

TEST(Neighbours, PassOnWhatTheReceiverOfBlocksThrows) {
  const std::vector<Ellipsoid> bodies = crowd(2000, 20.0);
  int calls = 0;
  EXPECT_THROW(for_each_neighbours(bodies, {.threads = 2},
                                   [&](const NeighbourBlock&) {
                                     ++calls;
                                     throw std::runtime_error("enough");
                                   }),
               std::runtime_error);
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace tangency
