// SPDX-License-Identifier: GPL-3.0-or-later
// The lanes in single precision, at every instruction set: what they decide is true, at the edges
// of their bounds too, and what they leave open goes to the lanes in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <tangency/geometry/batch/float_lanes.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>

namespace tangency {
namespace {

using detail::LaneBlock;
using detail::LaneOverlaps;
using testing::Family;
using testing::Indexed;

constexpr std::size_t kBlock = LaneBlock::kPairs;

struct Counts {
  int decided = 0, open = 0, wrong = 0;
};

/// What the lanes of either kind say of all pairs, against `truth`.
template <class Lanes>
Counts count(const Indexed& in, const BodyArray& array, const std::vector<bool>& truth,
             const Lanes& lanes) {
  Counts counts;
  std::vector<IndexedPair> pairs = in.pairs;
  pairs.resize((pairs.size() + kBlock - 1) / kBlock * kBlock, pairs[0]);
  for (std::size_t first = 0; first < in.pairs.size(); first += kBlock) {
    LaneBlock block{};
    block.bodies_a = block.bodies_b = array.lanes();
    block.floats_a = block.floats_b = array.floats();
    block.pairs = pairs.data() + first;
    block.count = static_cast<int>(std::min(kBlock, in.pairs.size() - first));
    const LaneOverlaps said = lanes(block);
    for (std::size_t k = 0; k < static_cast<std::size_t>(block.count); ++k) {
      if ((said.decided >> k & 1) == 0) {
        ++counts.open;
      } else {
        ++counts.decided;
        if (((said.meet >> k & 1) != 0) != truth[first + k]) ++counts.wrong;
      }
    }
  }
  return counts;
}

std::vector<bool> exactly(const Indexed& in) {
  std::vector<bool> truth;
  for (const IndexedPair& pair : in.pairs)
    truth.push_back(overlaps(in.bodies[pair.a], in.bodies[pair.b]));
  return truth;
}

/// Pairs of a family, B moved along the normal until the gap is about one that is drawn, of the
/// smallest semi-axis, by its logarithm: +-10^least to +-10^most.
Family moved_near_touch(const Family& from, double least, double most) {
  Family near{from.name, {}, {}};
  std::mt19937_64 random(testing::kSeed);
  std::uniform_real_distribution<double> power(least, most);
  for (std::size_t i = 0; i < from.a.size(); ++i) {
    const Gap now = signed_gap(from.a[i], from.b[i]);
    const double size = std::min(from.a[i].smallest_semi_axis(), from.b[i].smallest_semi_axis());
    const double wanted = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, power(random)) * size;
    near.a.push_back(from.a[i]);
    near.b.push_back(from.b[i].moved_to(from.b[i].centre() + (wanted - now.gap) * now.normal));
  }
  return near;
}

/// The same pairs at another scale.
Family scaled(const Family& from, double by) {
  Family to{from.name, {}, {}};
  const auto body = [&](const Ellipsoid& e) {
    return Ellipsoid(by * e.centre(), by * e.semi_axes(), e.orientation());
  };
  for (std::size_t i = 0; i < from.a.size(); ++i) {
    to.a.push_back(body(from.a[i]));
    to.b.push_back(body(from.b[i]));
  }
  return to;
}

Counts count_float(const Family& family) {
  const Indexed in(family);
  const BodyArray array(in.bodies);
  return count(in, array, exactly(in), detail::float_overlap_lanes);
}

TEST(FloatOverlapLanes, AreNeverWrongInAnyEnvironment) {
  std::vector<Family> families = testing::drawn_families();
  for (const auto& shape : verify::contact_classes())
    families.push_back(moved_near_touch(testing::contacts(shape, 1000), -9.0, -3.0));
  for (const Family& family : families) {
    const Indexed in(family);
    const BodyArray array(in.bodies);
    const std::vector<bool> truth = exactly(in);
    testing::at_every_level([&] {
      for (const auto& environment : testing::all_environments()) {
        const Counts counts = [&] {
          const testing::EnvironmentGuard guard(environment);
          return count(in, array, truth, detail::float_overlap_lanes);
        }();
        EXPECT_EQ(counts.wrong, 0) << family.name << ", " << environment.name;
      }
    });
  }
}

// How near to a touch float still tells: else a bound is wider than it has to be, and everything is
// left to the lanes in double.
TEST(FloatOverlapLanes, DecideOrdinaryPairsAndLeaveTouchesToDouble) {
  const auto& shape = verify::contact_classes()[0];
  const Family contacts = testing::contacts(shape, 1000);
  testing::at_every_level([&] {
    const Counts far = count_float(moved_near_touch(contacts, -4.0, -2.0));
    EXPECT_EQ(far.open, 0);
    const Counts edge = count_float(moved_near_touch(contacts, -8.0, -5.0));
    EXPECT_GT(edge.decided, 100);
    EXPECT_GT(edge.open, 100);
    const Counts touching = count_float(moved_near_touch(contacts, -14.0, -13.0));
    EXPECT_EQ(touching.decided, 0);
  });
}

TEST(FloatOverlapLanes, WhatTheyLeaveOpenTheLanesInDoubleDecide) {
  const Indexed in(
      moved_near_touch(testing::contacts(verify::contact_classes()[0], 1000), -8.0, -7.0));
  const BodyArray array(in.bodies);
  const std::vector<bool> truth = exactly(in);
  testing::at_every_level([&] {
    EXPECT_EQ(count(in, array, truth, detail::float_overlap_lanes).decided, 0);
    const Counts doubles = count(in, array, truth, detail::overlap_lanes);
    EXPECT_EQ(doubles.wrong, 0);
    EXPECT_GT(doubles.decided, 900);
    std::vector<std::uint8_t> answers(in.pairs.size());
    overlaps(array, {in.pairs, {}}, answers);
    for (std::size_t i = 0; i < answers.size(); ++i) ASSERT_EQ(answers[i] != 0, truth[i]) << i;
  });
}

// What is scaled by a power of two is scaled exactly: the answers are those of scale 1 up to the
// ends of the range, and none beyond.
TEST(FloatOverlapLanes, ReachAllModerateSizesAndNoOthers) {
  const Family contacts = testing::contacts(verify::contact_classes()[1], 500);
  testing::at_every_level([&] {
    const Counts one = count_float(contacts);
    EXPECT_GT(one.decided, 400);
    for (const double by : {0x1p-50, 0x1p-20, 0x1p20, 0x1p50}) {
      const Counts there = count_float(scaled(contacts, by));
      EXPECT_EQ(there.decided, one.decided) << by;
      EXPECT_EQ(there.wrong, 0) << by;
    }
    for (const double by : {0x1p-70, 0x1p70, 0x1p-200, 0x1p200})
      EXPECT_EQ(count_float(scaled(contacts, by)).decided, 0) << by;
  });
}

TEST(FloatOverlapLanes, SayNothingOfSeparationsThatAreNoNumbers) {
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(), 0x1p200};
  const std::vector<Ellipsoid> bodies{Ellipsoid(Vec3::Zero(), Vec3(1, 2, 3)),
                                      Ellipsoid(Vec3::Zero(), Vec3(2, 1, 1))};
  const BodyArray array(bodies);
  const std::vector<IndexedPair> pairs(kBlock, {0, 1});
  testing::at_every_level([&] {
    for (const double value : bad) {
      for (int component = 0; component < 3; ++component) {
        std::vector<Vec3> separations(kBlock, Vec3(0.5, 7.0, -0.25));
        separations[5][component] = value;
        LaneBlock block{};
        block.floats_a = block.floats_b = array.floats();
        block.pairs = pairs.data();
        block.count = kBlock;
        block.separations = separations[0].data();
        EXPECT_EQ(detail::float_overlap_lanes(block).decided, ~(std::uint64_t{1} << 5));
      }
    }
  });
}

// Separations of subnormal components, and bodies of very unlike sizes.
TEST(FloatOverlapLanes, AreRightWhereFloatsUnderflow) {
  Family f{"underflow", {}, {}};
  std::mt19937_64 random(testing::kSeed);
  std::uniform_real_distribution<double> power(-60.0, 0.0), tiny(-1070.0, -100.0), one(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const double size = std::exp2(power(random)), other = std::exp2(power(random));
    const double distance = (size + other) * (1.0 + 0.01 * one(random));
    f.a.emplace_back(Vec3::Zero(), size * Vec3(1.0, 0.9, 0.8));
    f.b.emplace_back(Vec3(std::exp2(tiny(random)), distance, std::exp2(tiny(random))),
                     other * Vec3(0.7, 1.0, 0.6));
  }
  testing::at_every_level([&] {
    const Counts counts = count_float(f);
    EXPECT_EQ(counts.wrong, 0);
    EXPECT_GT(counts.decided, 100);
  });
}

}  // namespace
}  // namespace tangency
