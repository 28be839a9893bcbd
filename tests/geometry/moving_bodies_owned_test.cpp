// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that own their numbers: from columns of any kind, changed one by one, with centres.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Columns;
using testing::kSeed;
using testing::same_bits;

/// Numbers that floats have exactly.
struct Numbers {
  explicit Numbers(std::size_t count, std::uint64_t seed = kSeed) {
    std::mt19937_64 random(seed);
    const auto number = [&] { return 0x1p-10 * static_cast<double>(1 + random() % 2048); };
    for (std::size_t i = 0; i < count; ++i) {
      std::array<double, 10> x;
      for (double& one : x) one = number();
      axes.emplace_back(x[0], x[1], x[2]);
      turns.emplace_back(x[3], x[4] - 1.0, x[5] - 1.0, x[6] - 1.0);
      centres.emplace_back(3.0 * x[7], 3.0 * x[8], 3.0 * x[9]);
    }
  }
  MovingBodies bodies() const { return {axes, {turns, centres}}; }

  std::vector<Vec3> axes, centres;
  std::vector<Quaternion> turns;
};

/// All rows that the lanes read, as bytes.
std::vector<std::byte> rows(const MovingBodies& bodies) {
  std::vector<std::byte> all;
  const auto add = [&](const auto* kind) {
    const auto bytes = std::as_bytes(std::span(kind, bodies.size()));
    all.insert(all.end(), bytes.begin(), bytes.end());
  };
  add(bodies.lanes());
  add(bodies.rows());
  add(bodies.floats());
  return all;
}

/// Records of numbers of one type with others between them, as an owner may have them.
template <class Number>
struct Records {
  explicit Records(const Numbers& from) {
    for (std::size_t i = 0; i < from.axes.size(); ++i) {
      const auto add = [&](double x) { numbers.push_back(static_cast<Number>(x)); };
      for (const double x : from.axes[i]) add(x);
      numbers.push_back(-1);
      for (const double x : from.centres[i]) add(x);
      const Quaternion& q = from.turns[i];
      for (const double x : {q.w(), q.x(), q.y(), q.z()}) add(x);
    }
  }
  static constexpr std::size_t kRecord = 11;
  Strided<Number> column(std::size_t first) const {
    return {numbers.data() + first, numbers.size() / kRecord,
            static_cast<std::ptrdiff_t>(kRecord * sizeof(Number))};
  }
  VectorColumn axes() const { return column(0); }
  PoseColumns poses() const { return {{column(7), QuaternionOrder::wxyz}, column(4)}; }
  std::vector<Number> numbers;
};

// geometry/moving_bodies.hpp (1)
TEST(OwnedBodies, AreTheSameFromColumnsOfEveryKind) {
  const Numbers numbers(21);
  at_every_level([&] {
    const auto expected = rows(numbers.bodies());
    const Records<double> doubles(numbers);
    EXPECT_EQ(rows(MovingBodies(doubles.axes(), doubles.poses())), expected);
    const Records<float> floats(numbers);
    EXPECT_EQ(rows(MovingBodies(floats.axes(), floats.poses())), expected);
    MovingBodies looking(numbers.axes, numbers.turns);
    looking.set_poses(0, {numbers.turns, numbers.centres});
    EXPECT_EQ(rows(looking), expected);
  });
}

TEST(OwnedBodies, HaveRowsInReverseOrderOrInCommon) {
  const Numbers numbers(9);
  std::vector<Vec3> axes(9, numbers.axes[4]);
  std::vector<Quaternion> turns(numbers.turns.rbegin(), numbers.turns.rend());
  const Strided<double> common{numbers.axes[4].data(), 9, 0};
  const Strided<double> reversed{numbers.turns[8].coeffs().data(), 9,
                                 -static_cast<std::ptrdiff_t>(sizeof(Quaternion))};
  EXPECT_EQ(rows(MovingBodies(common, {{reversed, QuaternionOrder::xyzw}, numbers.centres})),
            rows(MovingBodies(axes, {turns, numbers.centres})));
}

// Where subnormal numbers are read as 0 a conversion from float would make 0 of one.
// geometry/moving_bodies.hpp (1)
TEST(OwnedBodies, MeanTheFloatsExactlyInEveryEnvironment) {
  const float tiny = 0x1p-140F;
  const std::array<float, 3> axes{1.0F, 0.1F, 2.0F};
  const std::array<float, 4> turn{tiny, 0.0F, 0.0F, -tiny};
  for (const auto& environment : testing::all_environments()) {
    SCOPED_TRACE(environment.name);
    MovingBodies bodies;
    {
      const testing::EnvironmentGuard guard(environment);
      bodies.assign(Strided<float>{axes.data(), 1, 0},
                    {{Strided<float>{turn.data(), 1, 0}, QuaternionOrder::wxyz}});
    }
    EXPECT_EQ(bodies[0].semi_axes(), Vec3(1.0, static_cast<double>(0.1F), 2.0));
    EXPECT_EQ(bodies[0].orientation().w(), 0x1p-140);
    EXPECT_EQ(bodies[0].orientation().z(), -0x1p-140);
  }
}

// geometry/moving_bodies.hpp (1)
TEST(OwnedBodies, DependOnTheirNumbersAloneWhateverWasSetBefore) {
  const Numbers numbers(37), others(90, kSeed + 1);
  at_every_level([&] {
    const auto expected = rows(numbers.bodies());
    MovingBodies bodies = others.bodies();
    bodies.resize(30);
    bodies.set_semi_axes(0, std::span<const Vec3>(numbers.axes).first(30));
    for (std::size_t i = 0; i < 30; i += 7) {
      const std::size_t count = std::min<std::size_t>(7, 30 - i);
      bodies.set_poses(i, {std::span<const Quaternion>(numbers.turns).subspan(i, count),
                           std::span<const Vec3>(numbers.centres).subspan(i, count)});
    }
    for (std::size_t i = 30; i < 37; ++i)
      EXPECT_EQ(bodies.add(numbers.axes[i], numbers.turns[i], numbers.centres[i]), i);
    EXPECT_EQ(rows(bodies), expected);
    bodies.set_pose(5, others.turns[5], others.centres[5]);
    EXPECT_NE(rows(bodies), expected);
    bodies.set_pose(5, numbers.turns[5], numbers.centres[5]);
    EXPECT_EQ(rows(bodies), expected);
    bodies.set_poses(3, {std::span<const Quaternion>(others.turns).subspan(3, 2)});
    EXPECT_EQ(bodies[4].centre(), numbers.centres[4]);
    EXPECT_EQ(bodies[4].orientation().coeffs(), others.turns[4].coeffs());
  });
}

// geometry/moving_bodies.hpp (3)
TEST(OwnedBodies, RemovedLeaveTheOthersAsTheyAre) {
  const Numbers numbers(10);
  MovingBodies bodies = numbers.bodies();
  bodies.remove(2);
  Numbers left = numbers;
  const auto moved = [](auto& column) {
    column[2] = column.back();
    column.pop_back();
  };
  moved(left.axes), moved(left.turns), moved(left.centres);
  EXPECT_EQ(rows(bodies), rows(left.bodies()));
  EXPECT_EQ(bodies[2].centre(), numbers.centres[9]);
  bodies.remove(8);
  EXPECT_EQ(bodies.size(), 8u);
  EXPECT_EQ(bodies[2].semi_axes(), numbers.axes[9]);
  while (bodies.size() > 0) bodies.remove(0);
  EXPECT_EQ(bodies.add(Vec3::Ones(), Quaternion::Identity(), Vec3::UnitX()), 0u);
  EXPECT_EQ(bodies.centres()[0], Vec3::UnitX());
  bodies.resize(3);
  EXPECT_EQ(bodies[2].semi_axes(), Vec3::Ones());
  EXPECT_EQ(bodies[2].centre(), Vec3::Zero());
}

// geometry/moving_bodies.hpp (2)
TEST(OwnedBodies, WithCentresNeedNoSeparations) {
  const Numbers numbers(80);
  const MovingBodies with = numbers.bodies(), without(numbers.axes, numbers.turns);
  std::vector<IndexedPair> pairs;
  std::vector<Vec3> separations, normals;
  for (std::uint32_t a = 0; a < 80; ++a)
    for (std::uint32_t b = a + 1; b < 80; b += 7) {
      pairs.push_back({a, b});
      separations.push_back(numbers.centres[b] - numbers.centres[a]);
    }
  const std::size_t count = pairs.size();
  at_every_level([&] {
    Columns given(count), own(count), followed(count), own_followed(count);
    signed_gaps(without, {pairs, separations}, given.all());
    signed_gaps(with, {pairs, {}}, own.all());
    follow_gaps(without, {pairs, separations}, given.normal, followed.all());
    follow_gaps(with, {pairs, {}}, given.normal, own_followed.all());
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(own.gap[i] < 0.0, given.gap[i] < 0.0);
      ASSERT_EQ(own.status[i], given.status[i]);
      ASSERT_TRUE(same_bits(own_followed[i], followed[i])) << i;
      if (own.status[i] != GapStatus::ok) continue;
      ASSERT_LE(std::abs(own.gap[i] - given.gap[i]), own.gap_error[i] + given.gap_error[i]);
    }
  });
}

TEST(OwnedBodies, AreAddedAtTheCentreOfOneOfThem) {
  const Numbers numbers(3);
  MovingBodies bodies = numbers.bodies();
  for (int k = 0; k < 20; ++k) {  // some of these move the centres to other memory
    bodies.add(numbers.axes[1], numbers.turns[1], bodies.centres()[0]);
    EXPECT_EQ(bodies.centres().back(), numbers.centres[0]) << k;
  }
}

TEST(OwnedBodies, TellTheSeparationsOfImages) {
  const Numbers numbers(3);
  const Mat3 edges = Vec3(8.0, 4.0, 2.0).asDiagonal();
  const std::array pairs{NearPair{0, 1, {}}, NearPair{1, 1, {1, 0, 0}}, NearPair{0, 2, {-1, 2, 3}}};
  std::array<Vec3, 3> found;
  numbers.bodies().separations(pairs, edges, found);
  EXPECT_EQ(found[0], numbers.centres[1] - numbers.centres[0]);
  EXPECT_EQ(found[1], Vec3(8.0, 0.0, 0.0));
  EXPECT_EQ(found[2], numbers.centres[2] + Vec3(-8.0, 8.0, 6.0) - numbers.centres[0]);
}

TEST(OwnedBodies, AreCopiedAndMovedWhole) {
  const Numbers numbers(5);
  MovingBodies bodies = numbers.bodies();
  const MovingBodies copy(bodies);
  const auto expected = rows(bodies);
  MovingBodies moved(std::move(bodies));
  EXPECT_EQ(bodies.size(), 0u);  // NOLINT: what is left of it is promised
  EXPECT_EQ(rows(moved), expected);
  moved.set_pose(0, numbers.turns[1], numbers.centres[1]);
  EXPECT_EQ(rows(copy), expected);
  EXPECT_EQ(copy[4].centre(), numbers.centres[4]);
  bodies = copy;
  bodies.refresh(0, 5);
  EXPECT_EQ(rows(bodies), expected);
  bodies.look_at(numbers.axes, numbers.turns);
  EXPECT_FALSE(bodies.has_centres());
  bodies.refresh(0, 5);
  EXPECT_EQ(rows(bodies), rows(MovingBodies(numbers.axes, numbers.turns)));
}

TEST(BrokenContract, OfOwnedBodiesEndsTheProcessAndNamesIt) {
  const Numbers numbers(4);
  MovingBodies bodies = numbers.bodies();
  const std::span<const Quaternion> turns(numbers.turns);
  const std::span<const Vec3> centres(numbers.centres);
  EXPECT_DEATH(bodies.set_poses(2, {turns.first(3)}),
               "MovingBodies::set_poses: body 4, and there are 4 bodies");
  EXPECT_DEATH(bodies.set_poses(0, {turns.first(2), centres.first(1)}),
               "MovingBodies::set_poses: centres: 1 entries, and there are 2 bodies");
  EXPECT_DEATH(bodies.assign(numbers.axes, {turns.first(1)}),
               "MovingBodies::assign: orientations: 1 entries, and there are 4 bodies");
  EXPECT_DEATH(bodies.remove(4), "MovingBodies::remove: body 4, and there are 4 bodies");
  EXPECT_DEATH(bodies.set_semi_axes(1, centres), "MovingBodies::set_semi_axes: body 4");
  const std::array pair{NearPair{0, 4, {}}};
  std::array<Vec3, 1> found;
  EXPECT_DEATH(bodies.separations(pair, Mat3::Identity(), found), "pairs.0..b = 4");
  const MovingBodies without(numbers.axes, PoseColumns{numbers.turns});
  EXPECT_DEATH(without.separations(pair, Mat3::Identity(), found),
               "MovingBodies::separations: centres: 0 entries, and there are 4 bodies");
}

}  // namespace
}  // namespace tangency
