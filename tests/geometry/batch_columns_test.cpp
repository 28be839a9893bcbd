// SPDX-License-Identifier: GPL-3.0-or-later
// What batch calls offer beside the gap: threads, contact points, enclosures, bytes, plain pairs
// with separations, pairs of any integers.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>

namespace tangency {
namespace {

using testing::Columns;
using testing::Family;
using testing::Indexed;
using testing::same_bits;

/// Contacts and deep pairs, some 4,000: enough for three threads.
Family several() {
  Family all{"several", {}, {}};
  const auto add = [&](const Family& f) {
    all.a.insert(all.a.end(), f.a.begin(), f.a.end());
    all.b.insert(all.b.end(), f.b.begin(), f.b.end());
  };
  for (const Family& f : testing::drawn_families()) {
    if (f.name != "adversarial" && f.a.size() < 2000) add(f);
  }
  return all;
}

const Indexed& pairs_of_several() {
  static const Indexed indexed(several());
  return indexed;
}

/// The bodies of pairs with deep ones answered at once.
struct Deep {
  Deep() {
    for (const auto& family : verify::deep_families()) {
      verify::DeepPairs source(family, testing::kSeed);
      for (int i = 0; i < 40; ++i) {
        const auto pair = source.next();
        f.a.push_back(verify::to_ellipsoid(pair.a));
        f.b.push_back(verify::to_ellipsoid(pair.b));
      }
    }
    for (const auto& kind : verify::contact_classes()) {
      const Family contacts = testing::contacts(kind, 100);
      f.a.insert(f.a.end(), contacts.a.begin(), contacts.a.end());
      f.b.insert(f.b.end(), contacts.b.begin(), contacts.b.end());
    }
  }
  Family f{"deep", {}, {}};
};

// geometry/gap_batch.hpp (2)
TEST(BatchThreads, LeaveEveryAnswerAsItIsToTheBit) {
  const Indexed& in = pairs_of_several();
  const std::size_t n = in.pairs.size();
  ASSERT_GE(n, 3100u);
  const BodyArray array(in.bodies);
  const PairList list{in.pairs, {}};
  Columns one(n), three(n), followed_one(n), followed_three(n);
  signed_gaps(array, list, one.all());
  signed_gaps(array, list, three.all(), {}, 3);
  follow_gaps(array, list, one.normal, followed_one.all());
  follow_gaps(array, list, one.normal, followed_three.all(), {}, 3);
  std::vector<Gap> whole(n);
  signed_gaps(array, list, whole, {}, 3);
  std::vector<GapDerivatives> derivatives(n), with_threads(n);
  gap_derivatives(array, list, whole, derivatives);
  gap_derivatives(array, list, whole, with_threads, 3);
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_TRUE(same_bits(one[i], three[i])) << i;
    ASSERT_TRUE(same_bits(one[i].gap, whole[i].gap)) << i;
    ASSERT_TRUE(same_bits(followed_one[i], followed_three[i])) << i;
    ASSERT_TRUE(same_bits(derivatives[i].least_radius, with_threads[i].least_radius)) << i;
  }
}

// geometry/overlap_batch.hpp (1)
TEST(OverlapBatch, BytesAndThreadsSayWhatTheSingleCallSays) {
  const Indexed& in = pairs_of_several();
  const std::size_t n = in.pairs.size();
  const BodyArray array(in.bodies);
  std::vector<std::uint8_t> bytes(n, 7), shared(n, 7);
  std::vector<std::optional<bool>> filtered(n);
  const std::unique_ptr<bool[]> bools(new bool[n]);
  overlaps(array, {in.pairs, {}}, bytes);
  overlaps(array, {in.pairs, {}}, shared, 3);
  // The centres have other differences, and a call that took those would say otherwise.
  std::vector<Vec3> half;
  for (const Vec3& d : in.separations) half.push_back(0.5 * d);
  overlaps(array, {in.pairs, half}, std::span(bools.get(), n), 2);
  overlaps_by_filter(array, {in.pairs, {}}, filtered, 3);
  for (std::size_t i = 0; i < n; ++i) {
    const bool meet = overlaps(in.bodies[2 * i], in.bodies[2 * i + 1]);
    ASSERT_EQ(bytes[i], meet ? 1 : 0) << i;
    ASSERT_EQ(shared[i], bytes[i]) << i;
    if (filtered[i]) {
      ASSERT_EQ(*filtered[i], meet) << i;
    }
    const bool meet_there =
        overlaps(in.bodies[2 * i].moved_to(Vec3::Zero()), in.bodies[2 * i + 1].moved_to(half[i]));
    ASSERT_EQ(bools[i], meet_there) << i;
  }
}

// geometry/gap_batch.hpp (7)
TEST(GapBatch, PointIsTheMidpointOfTheWitnessPoints) {
  const Indexed& in = pairs_of_several();
  const std::size_t n = in.pairs.size();
  const BodyArray array(in.bodies);
  Columns with(n);
  std::vector<Vec3> beside(n), alone(n), apart(n);
  GapColumns all = with.all();
  all.point = beside;
  signed_gaps(array, {in.pairs, {}}, all);
  signed_gaps(array, {in.pairs, {}}, {.point = alone});
  signed_gaps(array, {in.pairs, in.separations}, {.point = apart});
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& d = in.separations[i];
    const double size = d.stableNorm() + in.bodies[2 * i].largest_semi_axis() +
                        in.bodies[2 * i + 1].largest_semi_axis();
    const Vec3 middle = with.arm_a[i] + 0.5 * (d + with.arm_b[i] - with.arm_a[i]);
    ASSERT_LE((beside[i] - middle).stableNorm(), 4 * kUnitRoundoff * size) << i;
    ASSERT_TRUE(same_bits(beside[i], alone[i])) << i;
    // p_B - p_A = gap n: half of the gap on either side of it.
    if (with.status[i] == GapStatus::ok && with.gap_error[i] < 1e-9 * size) {
      ASSERT_NEAR((beside[i] - with.arm_a[i]).dot(with.normal[i]), 0.5 * with.gap[i], 1e-9 * size);
    }
  }
  Columns second(n);
  GapColumns second_all = second.all();
  std::vector<Vec3> again(n);
  second_all.point = again;
  signed_gaps(array, {in.pairs, in.separations}, second_all);
  for (std::size_t i = 0; i < n; ++i) ASSERT_TRUE(same_bits(again[i], apart[i])) << i;
}

// geometry/gap_batch.hpp (6)
TEST(BoundedBatch, EnclosesTheGapAndIsTheSingleCallWhereNoLaneSettles) {
  const Deep deep;
  const Indexed in(deep.f);
  const std::size_t n = in.pairs.size();
  const BodyArray array(in.bodies);
  testing::at_every_level([&] {
    Columns found(n);
    std::vector<double> above(n), alone(n);
    bounded_gaps(array, {in.pairs, {}}, {found.all(), above});
    bounded_gaps(array, {in.pairs, {}}, {{}, alone}, {}, 2);
    std::size_t by_lane = 0, local = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Gap exact = signed_gap(deep.f.a[i], deep.f.b[i]);
      ASSERT_TRUE(same_bits(above[i], alone[i])) << i;
      ASSERT_GE(found.gap[i] + above[i], exact.gap - exact.gap_error) << i;
      if (exact.status == GapStatus::ok) {
        ASSERT_LE(found.gap[i] - found.gap_error[i], exact.gap + exact.gap_error) << i;
      }
      local += found.status[i] == GapStatus::local;
      const BoundedGap one = bounded_gap(deep.f.a[i], deep.f.b[i]);
      if (same_bits(found[i], one) && same_bits(above[i], one.above)) continue;
      ++by_lane;
      ASSERT_EQ(found.status[i], GapStatus::ok) << i;
      ASSERT_EQ(above[i], found.gap_error[i]) << i;
    }
    EXPECT_GE(by_lane, 200u);
    EXPECT_GE(local, 100u);
  });
}

TEST(BoundedBatch, AnswersMovingBodiesByTheirSeparations) {
  const Deep deep;
  const Indexed in(deep.f);
  const std::size_t n = in.pairs.size();
  std::vector<Vec3> axes;
  std::vector<Quaternion> turns;
  for (const Ellipsoid& body : in.bodies) {
    axes.push_back(body.semi_axes());
    turns.push_back(body.orientation());
  }
  const MovingBodies moving(axes, turns);
  std::vector<double> gap(n), error(n), above(n);
  bounded_gaps(moving, {in.pairs, in.separations}, {{.gap = gap, .gap_error = error}, above});
  std::vector<Vec3> centres, points(n);
  for (const Ellipsoid& body : in.bodies) centres.push_back(body.centre());
  const MovingBodies placed(VectorColumn(axes), {turns, centres});
  std::vector<double> gap_there(n), error_there(n), above_there(n);
  bounded_gaps(placed, {in.pairs, {}},
               {{.gap = gap_there, .gap_error = error_there, .point = points}, above_there});
  for (std::size_t i = 0; i < n; ++i) {
    const Gap exact = signed_gap(deep.f.a[i], deep.f.b[i], in.separations[i]);
    ASSERT_GE(gap[i] + above[i], exact.gap - exact.gap_error) << i;
    if (exact.status == GapStatus::ok) {
      ASSERT_LE(gap[i] - error[i], exact.gap + exact.gap_error) << i;
    }
    // The centres' difference is the separation but for its rounding.
    const double rounded = 4 * kUnitRoundoff * in.separations[i].norm();
    ASSERT_GE(gap_there[i] + above_there[i], gap[i] - error[i] - rounded) << i;
    ASSERT_LE(gap_there[i] - error_there[i], gap[i] + above[i] + rounded) << i;
    ASSERT_LE((points[i] - 0.5 * in.separations[i]).norm(),
              in.bodies[2 * i].largest_semi_axis() + in.bodies[2 * i + 1].largest_semi_axis());
  }
}

// geometry/gap_batch.hpp (5)
TEST(GapBatch, PlainPairsTakeSeparationsAsIndexedOnesDo) {
  const Deep deep;
  const Indexed in(deep.f);
  const std::size_t n = in.pairs.size();
  std::vector<Ellipsoid> a;
  for (const Ellipsoid& body : deep.f.a) a.push_back(body.moved_to({5, 6, 7}));
  std::vector<Gap> plain(n), indexed(n);
  signed_gaps(a, deep.f.b, in.separations, plain, {}, 2);
  signed_gaps(BodyArray(in.bodies), {in.pairs, in.separations}, indexed);
  for (std::size_t i = 0; i < n; ++i) ASSERT_TRUE(same_bits(plain[i], indexed[i])) << i;
}

TEST(IndexedPair, OfAnyIntegersIsTheirsOrNone) {
  const IndexedPair plain = indexed_pair(3, std::size_t{4});
  EXPECT_EQ(plain.a, 3u);
  EXPECT_EQ(plain.b, 4u);
  const std::vector<Ellipsoid> two(2, Ellipsoid({0, 0, 0}, {1, 1, 1}));
  const BodyArray bodies(two);
  std::vector<double> gap(1);
  for (const IndexedPair wrong : {indexed_pair(0, -1), indexed_pair(0LL, 1LL << 32)}) {
    const std::vector<IndexedPair> pairs{wrong};
    EXPECT_DEATH(signed_gaps(bodies, {pairs, {}}, {.gap = gap}),
                 "pairs\\[0\\].b = 4294967295, and there are 2 bodies");
  }
}

}  // namespace
}  // namespace tangency
