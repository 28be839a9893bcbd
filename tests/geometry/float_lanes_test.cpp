// SPDX-License-Identifier: GPL-3.0-or-later
// The lanes in single precision, at every instruction set: what they decide is true, at the edges
// of their bounds too, and what they leave open goes to the lanes in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include <tangency/geometry/batch/float_lanes.hpp>
#include <tangency/geometry/floating_point.hpp>
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

/// Needles whose directions and separations are drawn, of aspect ratios between two.
Family thin_pairs(double least, double most) {
  Family thin{"needles", {}, {}};
  std::mt19937_64 random(testing::kSeed);
  std::uniform_real_distribution<double> one(-1.0, 1.0), aspect(least, most);
  const auto body = [&](const Vec3& centre) {
    const double x = one(random), y = one(random), z = one(random), w = one(random);
    const double width = 1.0 / aspect(random);
    return Ellipsoid(centre, Vec3(1.0, width, width), Quaternion(w, x, y, z));
  };
  for (int i = 0; i < 2000; ++i) {
    thin.a.push_back(body(Vec3::Zero()));
    thin.b.push_back(body(Vec3(one(random), one(random), one(random))));
  }
  return thin;
}

Counts count_float(const Family& family) {
  const Indexed in(family);
  const BodyArray array(in.bodies);
  return count(in, array, exactly(in), detail::float_overlap_lanes);
}

TEST(FloatOverlapLanes, OfOrdinarySizesAreNeverWrongInAnyEnvironment) {
  std::vector<Family> families = testing::drawn_families();
  for (Family& family : families) {
    family.a.erase(family.a.begin() + std::min<std::ptrdiff_t>(300, std::ssize(family.a)),
                   family.a.end());
    family.b.erase(family.b.begin() + std::ssize(family.a), family.b.end());
  }
  for (const auto& shape : verify::contact_classes())
    families.push_back(moved_near_touch(testing::contacts(shape, 300), -9.0, -3.0));
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
    EXPECT_GT(doubles.decided, 400);  // those that are apart; the others the single call decides
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

// Rows of float are not those of the first tier of the gap, which has no bodies of an aspect ratio
// above 45.
TEST(FloatOverlapLanes, DecideThinBodies) {
  const Family thin = thin_pairs(45.0, 120.0);
  testing::at_every_level([&] {
    const Counts counts = count_float(thin);
    EXPECT_EQ(counts.wrong, 0);
    EXPECT_GT(counts.decided, 1000);
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

/// What the lanes in float answer of a family, by the block.
struct FloatGaps {
  explicit FloatGaps(const Family& family, const std::vector<Vec3>& normals = {})
      : in(family), array(in.bodies), settled(in.pairs.size()) {
    const std::size_t n = in.pairs.size(), whole = (n + kBlock - 1) / kBlock * kBlock;
    std::vector<IndexedPair> pairs = in.pairs;
    std::vector<Vec3> starts = normals;
    pairs.resize(whole, pairs[0]);
    if (!starts.empty()) starts.resize(whole, starts[0]);
    gap.resize(whole), gap_error.resize(whole), normal.resize(whole);
    for (std::size_t first = 0; first < n; first += kBlock)
      ask(pairs.data() + first, starts.empty() ? nullptr : &starts[first], first,
          std::min(kBlock, n - first));
  }

  void ask(const IndexedPair* pairs, const Vec3* starts, std::size_t first, std::size_t some) {
    LaneBlock block{};
    block.bodies_a = block.bodies_b = array.lanes();
    block.floats_a = block.floats_b = array.floats();
    block.pairs = pairs;
    block.count = static_cast<int>(some);
    block.normals = starts != nullptr ? starts->data() : nullptr;
    block.tolerance_of_size = detail::kFloatTolerance;
    block.gap = &gap[first];
    block.gap_error = &gap_error[first];
    block.normal = normal[first].data();
    const std::uint64_t bits = detail::float_gap_lanes(block);
    for (std::size_t k = 0; k < some; ++k) settled[first + k] = (bits >> k & 1) != 0;
  }
  std::size_t settled_count() const {
    return static_cast<std::size_t>(std::count(settled.begin(), settled.end(), true));
  }

  Indexed in;
  BodyArray array;
  std::vector<bool> settled;
  std::vector<double> gap, gap_error;
  std::vector<Vec3> normal;
};

std::vector<Gap> single_gaps(const Family& f) {
  std::vector<Gap> truth;
  for (std::size_t i = 0; i < f.a.size(); ++i) truth.push_back(signed_gap(f.a[i], f.b[i]));
  return truth;
}

double size_of(const Ellipsoid& a, const Ellipsoid& b) {
  return (b.centre() - a.centre()).stableNorm() + a.largest_semi_axis() + b.largest_semi_axis();
}

void expect_proven(const FloatGaps& answers, const Family& f, const std::vector<Gap>& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!answers.settled[i]) continue;
    const double off = std::abs(answers.gap[i] - truth[i].gap), error = answers.gap_error[i];
    EXPECT_EQ(truth[i].status, GapStatus::ok) << f.name << " " << i;
    EXPECT_LE(off, error + truth[i].gap_error) << f.name << " " << i;
    EXPECT_EQ(answers.gap[i] > 0.0, truth[i].gap > 0.0) << f.name << " " << i;
    EXPECT_LE(error, detail::kFloatTolerance * size_of(f.a[i], f.b[i])) << f.name << " " << i;
    EXPECT_NEAR(answers.normal[i].norm(), 1.0, 6 * kUnitRoundoff) << f.name << " " << i;
    const double ball =
        truth[i].gap - truth[i].gap_error + f.a[i].least_radius() + f.b[i].least_radius();
    // The promise of Accuracy, and what standard() leaves of the other normal.
    EXPECT_LE((answers.normal[i] - truth[i].normal).norm(),
              2.0 * std::sqrt((error + truth[i].gap_error) / (ball - 2.0 * error)) + 1e-6)
        << f.name << " " << i;
    worst = std::max(worst, off / error);
  }
  std::printf("%s: largest error %.2f of what is proven\n", f.name.c_str(), worst);
}

/// Bodies of an aspect ratio to 100, which meet along any direction.
Family flat_pairs() {
  Family flat{"flat", {}, {}};
  std::mt19937_64 random(testing::kSeed);
  std::uniform_real_distribution<double> power(-2.0, 0.0), one(-1.0, 1.0);
  const auto body = [&](const Vec3& centre) {
    const double x = one(random), y = one(random), z = one(random), w = one(random);
    const double p = std::pow(10.0, power(random)), q = std::pow(10.0, power(random));
    return Ellipsoid(centre, Vec3(1.0, p, q), Quaternion(w, x, y, z));
  };
  for (int i = 0; i < 1000; ++i) {
    flat.a.push_back(body(Vec3::Zero()));
    flat.b.push_back(body(Vec3(2.0 * one(random), 2.0 * one(random), 1.5)));
  }
  return flat;
}

TEST(FloatGapLanes, ProveWhatTheyAnswerColdAndFollowing) {
  std::vector<Family> families;
  for (const auto& shape : verify::contact_classes()) {
    families.push_back(testing::contacts(shape, 1000));
    families.push_back(moved_near_touch(families.back(), -7.0, -2.0));
  }
  families.push_back(flat_pairs());
  families.push_back(moved_near_touch(flat_pairs(), -5.0, -1.0));
  for (const Family& f : families) {
    const std::vector<Gap> truth = single_gaps(f);
    std::vector<Vec3> near;
    for (const Gap& gap : truth) near.push_back(gap.normal + Vec3(3e-4, -2e-4, 1e-4));
    near[5] = Vec3::Zero();
    testing::at_every_level([&] {
      expect_proven(FloatGaps(f), f, truth);
      expect_proven(FloatGaps(f, near), f, truth);
    });
  }
}

TEST(FloatGapLanes, SettleOrdinaryContactsAndNoTouches) {
  const Family contacts = testing::contacts(verify::contact_classes()[0], 1000);
  const Family near = moved_near_touch(contacts, -3.0, -2.0);
  const Family touching = moved_near_touch(contacts, -14.0, -13.0);
  testing::at_every_level([&] {
    EXPECT_EQ(FloatGaps(near).settled_count(), 1000u);
    EXPECT_EQ(FloatGaps(touching).settled_count(), 0u);
  });
}

// geometry/gap_batch.hpp (2), (5)
TEST(FloatGapLanes, AnswerOfItsPairAloneWhateverTheNeighbours) {
  Family mixed = moved_near_touch(testing::contacts(verify::contact_classes()[1], 500), -8.0, -1.0);
  const Family flat = flat_pairs();
  for (std::size_t i = 0; i < mixed.a.size(); i += 3)
    mixed.a[i] = flat.a[i], mixed.b[i] = flat.b[i];
  testing::at_every_level([&] {
    const FloatGaps together(mixed);
    for (std::size_t i = 0; i < mixed.a.size(); ++i) {
      const FloatGaps one(Family{"one", {mixed.a[i]}, {mixed.b[i]}});
      ASSERT_EQ(one.settled[0], together.settled[i]) << i;
      if (!one.settled[0]) continue;
      ASSERT_TRUE(testing::same_bits(one.gap[0], together.gap[i])) << i;
      ASSERT_TRUE(testing::same_bits(one.gap_error[0], together.gap_error[i])) << i;
      ASSERT_TRUE(testing::same_bits(one.normal[0], together.normal[i])) << i;
    }
  });
}

// A power of two changes no bit but the exponent's.
TEST(FloatGapLanes, AreTheSameAtEveryModerateScale) {
  const Family contacts = testing::contacts(verify::contact_classes()[0], 300);
  testing::at_every_level([&] {
    const FloatGaps one(contacts);
    for (const double by : {0x1p-50, 0x1p-7, 0x1p50}) {
      const FloatGaps there(scaled(contacts, by));
      ASSERT_EQ(there.settled, one.settled) << by;
      for (std::size_t i = 0; i < one.settled.size(); ++i)
        ASSERT_TRUE(!one.settled[i] || testing::same_bits(there.gap[i], by * one.gap[i])) << i;
    }
  });
}

// In float the square of a short normal is a subnormal number or 0, and a normal is proven at only
// where it is of unit length.
TEST(FloatGaps, FromPreviousNormalsOfAnyLengthAreProven) {
  const Family f =
      moved_near_touch(testing::contacts(verify::contact_classes()[0], 200), -1.0, 0.0);
  const std::vector<Gap> truth = single_gaps(f);
  const Indexed in(f);
  const BodyArray array(in.bodies);
  const Accuracy asked[] = {Accuracy::fast(), {0x1p-20, 0.0, true}, {0x1p-21, 0.0, false}, {}};
  const double powers[] = {-100, -80, -76, -74, -73, -71, -70, -69, -67, -64, -60, 60, 80, 100};
  testing::at_every_level([&] {
    for (const Accuracy& accuracy : asked) {
      for (const double power : powers) {
        std::vector<Vec3> previous;
        for (const Gap& gap : truth) previous.push_back(std::exp2(power) * gap.normal);
        std::vector<Gap> gaps(truth.size());
        follow_gaps(array, {in.pairs, {}}, previous, gaps, accuracy);
        for (std::size_t i = 0; i < gaps.size(); ++i) {
          ASSERT_EQ(gaps[i].status, GapStatus::ok) << power << " " << i;
          ASSERT_LE(std::abs(gaps[i].gap - truth[i].gap), gaps[i].gap_error + truth[i].gap_error)
              << "2^" << power << ", of_size " << accuracy.of_size << ", pair " << i;
        }
      }
    }
  });
}

TEST(FloatGaps, OfMovingBodiesAndOfABodyArrayAreProvenAlike) {
  const Family f =
      moved_near_touch(testing::contacts(verify::contact_classes()[0], 500), -3.0, -1.0);
  const std::vector<Gap> truth = single_gaps(f);
  const Indexed in(f);
  std::vector<Vec3> axes;
  std::vector<Quaternion> turns;
  for (const Ellipsoid& body : in.bodies) {
    axes.push_back(body.semi_axes());
    turns.push_back(body.orientation());
  }
  testing::at_every_level([&] {
    const BodyArray array(in.bodies);
    const MovingBodies moving(axes, turns);
    std::vector<double> gap(500), error(500), moved_gap(500), moved_error(500);
    signed_gaps(array, {in.pairs, {}}, {.gap = gap, .gap_error = error}, Accuracy::fast());
    signed_gaps(moving, {in.pairs, in.separations}, {.gap = moved_gap, .gap_error = moved_error},
                Accuracy::fast());
    int in_float = 0;
    for (std::size_t i = 0; i < 500; ++i) {
      EXPECT_LE(std::abs(gap[i] - truth[i].gap), error[i] + truth[i].gap_error);
      EXPECT_LE(std::abs(moved_gap[i] - truth[i].gap), moved_error[i] + truth[i].gap_error);
      // Double proves far less of a doubt than float can.
      const double size = size_of(in.bodies[2 * i], in.bodies[2 * i + 1]);
      if (error[i] > 0x1p-25 * size && moved_error[i] > 0x1p-25 * size) ++in_float;
    }
    EXPECT_GE(in_float, 490);
  });
}

}  // namespace
}  // namespace tangency
