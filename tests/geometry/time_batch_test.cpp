// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/time_batch.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::same_bits;
using Status = ContactTimeStatus;

constexpr double kHorizon = 1.0, kTolerance = 1e-4;

/// Bodies of aspect to 30 that fly, spin and swing, some of them at rest; each with the next few.
struct Scene {
  explicit Scene(std::uint64_t seed, std::size_t count = 300, double side = 2.5) : random(seed) {
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 turn = in_cube(1.0), centre = in_cube(side);
      const double aspect = i % 5 == 0 ? 30.0 : 3.0;
      Vec3 axes;
      for (double& r : axes) r = std::pow(aspect, -uniform(0.0, 1.0));
      if (i % 7 == 0) axes = Vec3::Constant(axes[0]);
      bodies.emplace_back(centre, axes,
                          Quaternion(uniform(0.1, 1.0), turn.x(), turn.y(), turn.z()));
      Motion motion;
      if (i % 6 != 0) motion.velocity = in_cube(2.0);
      if (i % 3 != 0) motion.angular_velocity = in_cube(i % 9 == 1 ? 10.0 : 1.0);
      if (i % 4 == 0) motion.pivot_arm = in_cube(1.0);
      motions.push_back(motion);
    }
    for (std::uint32_t a = 0; a < count; ++a) {
      for (std::uint32_t b = a + 1; b < std::min<std::size_t>(a + 12, count); ++b)
        pairs.push_back({a, b});
    }
  }
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  }
  Vec3 in_cube(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
  }

  std::mt19937_64 random;
  std::vector<Ellipsoid> bodies;
  std::vector<Motion> motions;
  std::vector<IndexedPair> pairs;
};

struct Times {
  explicit Times(std::size_t pairs)
      : status(pairs), time(pairs), latest(pairs), resolution(pairs), normal(pairs) {}
  TimeColumns columns() { return {status, time, latest, resolution, normal}; }
  bool same(std::size_t i, const Times& other, std::size_t j) const {
    return status[i] == other.status[j] && same_bits(time[i], other.time[j]) &&
           same_bits(latest[i], other.latest[j]) && same_bits(resolution[i], other.resolution[j]) &&
           same_bits(normal[i], other.normal[j]);
  }

  std::vector<Status> status;
  std::vector<double> time, latest, resolution;
  std::vector<Vec3> normal;
};

Times ask(const Scene& s, std::span<const IndexedPair> pairs, int threads = 1) {
  Times found(pairs.size());
  const BodyArray array{std::span<const Ellipsoid>(s.bodies)};
  times_of_contact(array, s.motions, {pairs, {}}, kHorizon, kTolerance, found.columns(), threads);
  return found;
}

/// What the answer itself promises, and the single call's beside it.
void expect_agreement(const Times& found, std::size_t i, const TimeOfContact& single) {
  ASSERT_TRUE(found.status[i] == single.status || single.status == Status::grazing) << i;
  ASSERT_LE(found.time[i], single.status == Status::contact ? single.latest : kHorizon) << i;
  ASSERT_LE(found.latest[i] - found.time[i], kTolerance) << i;
  ASSERT_GT(found.resolution[i], 0) << i;
  if (found.status[i] == Status::contact) {
    ASSERT_GE(found.latest[i], single.time) << i;
    ASSERT_NEAR(found.normal[i].norm(), 1, 1e-14) << i;
  } else if (found.status[i] == Status::none || found.status[i] == Status::touching_at_start) {
    ASSERT_EQ(found.time[i], found.status[i] == Status::none ? kHorizon : 0) << i;
    ASSERT_EQ(found.normal[i], Vec3::Zero()) << i;
  }
}

// geometry/time_batch.hpp (1)
TEST(TimeBatch, AnswersAsTheSingleCallDoesAtEveryLevel) {
  const Scene s(1);
  std::vector<TimeOfContact> single;
  std::size_t counts[5] = {};
  for (const auto [a, b] : s.pairs) {
    single.push_back(time_of_contact(s.bodies[a], s.motions[a], s.bodies[b], s.motions[b], kHorizon,
                                     kTolerance));
    ++counts[static_cast<std::size_t>(single.back().status)];
  }
  EXPECT_GE(counts[0], 500u);  // none
  EXPECT_GE(counts[1], 100u);  // contact
  EXPECT_GE(counts[2], 50u);   // touching at the start
  at_every_level([&] {
    const Times found = ask(s, s.pairs);
    for (std::size_t i = 0; i < s.pairs.size(); ++i) expect_agreement(found, i, single[i]);
  });
}

// geometry/time_batch.hpp (1)
TEST(TimeBatch, SolidsAreApartUntilTimeAndOverlapAtLatest) {
  const Scene s(2);
  const Times found = ask(s, s.pairs);
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    const auto [a, b] = s.pairs[i];
    const auto gap_at = [&, a = a, b = b](double t) {
      return signed_gap(moved(s.bodies[a], s.motions[a], t), moved(s.bodies[b], s.motions[b], t));
    };
    if (found.status[i] == Status::touching_at_start) {
      ASSERT_TRUE(overlaps(s.bodies[a], s.bodies[b])) << i;
      continue;
    }
    for (int k = 0; k <= 4; ++k) {
      const Gap gap = gap_at(found.time[i] * k / 4);
      ASSERT_GE(gap.gap, -found.resolution[i]) << i << ", part " << k;
    }
    if (found.status[i] != Status::contact) continue;
    const Gap there = gap_at(found.latest[i]);
    ASSERT_LT(there.gap, 0) << i;
    if (there.status != GapStatus::ok) continue;
    ASSERT_GE(there.normal.dot(found.normal[i]), 0.9) << i;
  }
}

// geometry/time_batch.hpp (2)
TEST(TimeBatch, AnswersDoNotDependOnPlaceOrderNumberOrThreads) {
  const Scene s(3);
  const Times all = ask(s, s.pairs);
  std::vector<std::size_t> order(s.pairs.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(7));
  order.resize(order.size() - 37);
  std::vector<IndexedPair> shuffled;
  for (const std::size_t i : order) shuffled.push_back(s.pairs[i]);
  for (const int threads : {1, 2, 3}) {
    const Times some = ask(s, shuffled, threads);
    for (std::size_t k = 0; k < order.size(); ++k)
      ASSERT_TRUE(all.same(order[k], some, k)) << order[k] << ", threads " << threads;
  }
}

// geometry/time_batch.hpp (3)
TEST(TimeBatch, SeparationStandsInPlaceOfCentresAlsoOfMovingBodies) {
  const Scene s(4, 120, 2.0);
  std::vector<Vec3> separations, axes;
  std::vector<Quaternion> turns;
  std::vector<Ellipsoid> elsewhere;
  for (const auto [a, b] : s.pairs)
    separations.push_back(s.bodies[b].centre() - s.bodies[a].centre());
  for (const Ellipsoid& body : s.bodies) {
    elsewhere.push_back(body.moved_to(Vec3(7, 2, 3) - 0.5 * body.centre()));
    axes.push_back(body.semi_axes());
    turns.push_back(body.orientation());
  }
  const BodyArray array{std::span<const Ellipsoid>(elsewhere)};
  const MovingBodies moving(axes, turns);
  std::vector<Vec3> centres;
  for (const Ellipsoid& body : s.bodies) centres.push_back(body.centre());
  const MovingBodies placed(VectorColumn(axes), {turns, centres});
  Times of_array(s.pairs.size()), of_moving(s.pairs.size()), of_placed(s.pairs.size());
  const PairList list{s.pairs, separations};
  times_of_contact(placed, s.motions, {s.pairs, {}}, kHorizon, kTolerance, of_placed.columns());
  times_of_contact(array, s.motions, list, kHorizon, kTolerance, of_array.columns());
  times_of_contact(moving, s.motions, list, kHorizon, kTolerance, of_moving.columns());
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    const auto [a, b] = s.pairs[i];
    const TimeOfContact single = time_of_contact(
        s.bodies[a], s.motions[a], s.bodies[b], s.motions[b], separations[i], kHorizon, kTolerance);
    expect_agreement(of_array, i, single);
    expect_agreement(of_moving, i, single);
    expect_agreement(of_placed, i,
                     time_of_contact(s.bodies[a], s.motions[a], s.bodies[b], s.motions[b], kHorizon,
                                     kTolerance));
  }
}

TEST(TimeBatch, HardPairsAreThoseOfTheSingleCallToTheBit) {
  // Beyond the range of the lanes, within rounding of a touch, and a pass that rounding hides.
  Scene s(5, 0);
  const auto add = [&](const Ellipsoid& a, const Motion& ma, const Ellipsoid& b, const Motion& mb) {
    const auto first = static_cast<std::uint32_t>(s.bodies.size());
    s.bodies.insert(s.bodies.end(), {a, b});
    s.motions.insert(s.motions.end(), {ma, mb});
    s.pairs.push_back({first, first + 1});
  };
  const Ellipsoid ball({0, 0, 0}, {1, 1, 1});
  Motion flight, spin;
  flight.velocity = Vec3(1, 0, 0);
  spin.angular_velocity = Vec3(0, 0, 1e150);
  add(ball, flight, Ellipsoid({1e200, 0, 0}, {1e199, 1, 1}), {});
  add(ball, spin, Ellipsoid({2.5, 0, 0}, {1, 1, 0.5}), {});
  add(Ellipsoid({-0.5, 2, 0}, {1, 1, 1}), flight, ball, {});
  add(ball, {}, Ellipsoid({2, 0, 0}, {1, 1, 1}), flight);
  add(ball, {}, Ellipsoid({std::nextafter(2, 3), 0, 0}, {1, 1, 1}), flight);
  const Times found = ask(s, s.pairs);
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    const TimeOfContact one =
        time_of_contact(s.bodies[2 * i], s.motions[2 * i], s.bodies[2 * i + 1],
                        s.motions[2 * i + 1], kHorizon, kTolerance);
    EXPECT_EQ(found.status[i], one.status) << i;
    EXPECT_TRUE(same_bits(found.time[i], one.time)) << i;
    EXPECT_TRUE(same_bits(found.latest[i], one.latest)) << i;
  }
  EXPECT_EQ(found.status[2], Status::grazing);
  EXPECT_EQ(found.status[3], Status::touching_at_start);
}

TEST(TimeBatchDeathTest, WrongQuestionsEndTheProcessWithALine) {
  const Scene s(6, 3);
  const BodyArray array{std::span<const Ellipsoid>(s.bodies)};
  Times found(s.pairs.size());
  const auto motions = std::span(s.motions);
  EXPECT_DEATH(times_of_contact(array, motions.first(2), {s.pairs, {}}, 1, 1e-3, found.columns()),
               "times_of_contact: motions: 2 entries, and there are 3 bodies");
  const std::vector<IndexedPair> wrong{{0, 3}, {0, 1}, {1, 2}};
  EXPECT_DEATH(times_of_contact(array, motions, {wrong, {}}, 1, 1e-3, found.columns()),
               "pairs\\[0\\].b = 3, and there are 3 bodies");
  Times few(1);
  EXPECT_DEATH(times_of_contact(array, motions, {s.pairs, {}}, 1, 1e-3, few.columns()),
               "status: 1 entries, and there are 3 pairs");
  const std::vector<Vec3> far(3, Vec3(0, std::numeric_limits<double>::infinity(), 0));
  EXPECT_DEATH(times_of_contact(array, motions, {s.pairs, far}, 1, 1e-3, found.columns()),
               "separation = \\(0, inf, 0\\)");
}

}  // namespace
}  // namespace tangency
