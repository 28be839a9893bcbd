// SPDX-License-Identifier: GPL-3.0-or-later
// gap_error of the lanes in float has in it what section 6 of docs/derivations/gap-batch.md
// derives: recomputed here from the bodies, the normal and the answer. No error of a lane comes
// near enough to its bound for a constant that is too small to be noticed by the error itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <tangency/geometry/batch/float_lanes.hpp>
#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/body_array.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/tests/geometry/followed_pairs.hpp>

namespace tangency {
namespace {

using detail::LaneBlock;
using testing::Draw;
using testing::FollowedPairs;
using testing::Indexed;
using testing::kSeed;

constexpr std::size_t kBlock = LaneBlock::kPairs;
constexpr double kToNearest = 0x1p-24, kInAnyMode = 0x1p-23;

/// What is derived of a pair at a normal. Lengths are the caller's.
struct Derived {
  double value;  ///< (v)
  double rest;   ///< (r)
  double thin;   ///< the larger a/h
  double radii;  ///< both least radii of curvature
  double unit;   ///< the power of two at or below L
};

Derived derived(const Ellipsoid& a, const Ellipsoid& b, const Vec3& n, double u) {
  const Vec3 d = b.centre() - a.centre();
  double over_h = 0, thin = 0, axes = 0, gap = n.dot(d), radii = 0;
  for (const Ellipsoid* body : {&a, &b}) {
    const double h = body->support(n), most = body->largest_semi_axis();
    const Symmetric3& m = body->shape();
    const auto row = [](double x, double y, double z) {
      return std::abs(x) + std::abs(y) + std::abs(z);
    };
    over_h += std::max({row(m.xx, m.xy, m.zx), row(m.xy, m.yy, m.yz), row(m.zx, m.yz, m.zz)}) / h;
    thin = std::max(thin, most / h);
    axes += most, gap -= h, radii += body->least_radius();
  }
  const double size = d.cwiseAbs().maxCoeff() + axes;
  const double unit = std::exp2(std::floor(std::log2(size)));
  return {u * (4 * d.norm() + 3.57 * over_h + 4.1 * axes + 7.7 * std::abs(gap)),
          u * (7.6 * thin * over_h + 17.4 * unit), thin, radii, unit};
}

/// Of pairs that are settled at the normal that is given, whatever their error is.
/// @param rounded  what the roundings of the ball may do to a bound, relative
void expect_bounds(const FollowedPairs& followed, double rounded) {
  const Indexed in(followed.pairs);
  ASSERT_EQ(in.pairs.size(), kBlock);
  testing::at_every_level([&] {
    const BodyArray array(in.bodies);
    std::array<double, kBlock> gap, gap_error;
    LaneBlock block{};
    block.bodies_a = block.bodies_b = array.lanes();
    block.floats_a = block.floats_b = array.floats();
    block.pairs = in.pairs.data();
    block.count = LaneBlock::kPairs;
    block.normals = followed.previous[0].data();
    block.tolerance_of_size = 1.0;
    block.gap = gap.data();
    block.gap_error = gap_error.data();
    std::array<Vec3, kBlock> normal;
    block.normal = normal[0].data();
    const std::uint64_t settled = detail::float_gap_lanes(block);
    std::size_t at_once = 0;
    for (std::size_t i = 0; i < kBlock; ++i) {
      if ((settled >> i & 1) == 0) continue;
      const Vec3 n = followed.previous[i].normalized();
      const Ellipsoid &a = followed.pairs.a[i], &b = followed.pairs.b[i];
      const Derived of = derived(a, b, normal[i], kToNearest);
      EXPECT_LE(of.thin, 128 * (1 + 0x1p-10)) << i;
      if ((normal[i] - n).norm() > 0x1p-21) continue;  // a step further
      ++at_once;
      const Vec3 d = b.centre() - a.centre();
      Vec3 across = (d - a.support_point(n)) - b.support_point(n);
      across -= across.dot(n) * n;
      const double ball = gap[i] - gap_error[i] + of.radii - 12 * kToNearest * of.unit;
      const double above = (0.5625 * across.squaredNorm() + 4.5 * of.rest * of.rest) / ball;
      EXPECT_GE(gap_error[i], (of.value + 0.5 * above) * (1 - rounded)) << i;
    }
    EXPECT_GE(at_once, kBlock / 3);
  });
}

TEST(FloatBounds, HaveTheRoundingsOfTheValueNearAndFar) {
  FollowedPairs followed;
  Draw draw{std::mt19937_64(kSeed)};
  while (followed.previous.size() < kBlock) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 2), draw.power(0, 2)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    const double gap = draw.power(-8, followed.previous.size() % 2 == 0 ? -2 : 10);
    followed.place(draw, a, b, draw.direction(), gap, 0);
  }
  expect_bounds(followed, 0x1p-8);
}

// Along the thin axis of A, W/h of it is up to 3 * 2^7; a/h of every third is above the limit.
TEST(FloatBounds, HaveTheRoundingsOfTheValueOnFaces) {
  FollowedPairs followed;
  Draw draw{std::mt19937_64(kSeed + 1)};
  while (followed.previous.size() < kBlock) {
    const double thin = draw.power(followed.previous.size() % 3 == 0 ? -8 : -7, -5);
    const Ellipsoid a = draw.body({1, draw.real(0.5, 1), thin});
    const Ellipsoid b = draw.body({draw.real(0.1, 0.2), draw.real(0.1, 0.2), draw.real(0.1, 0.2)});
    followed.place(draw, a, b, a.rotation().col(2), draw.power(-6, 0), 0);
  }
  expect_bounds(followed, 0x1p-8);
}

TEST(FloatBounds, HaveWhatABetterNormalMayGain) {
  FollowedPairs followed;
  Draw draw{std::mt19937_64(kSeed + 2)};
  while (followed.previous.size() < kBlock) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 1), draw.power(0, 1)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    followed.place(draw, a, b, draw.direction(), draw.power(-3, 0), draw.power(-9, -6));
  }
  expect_bounds(followed, 0x1p-6);
}

// (r): of balls, whose rest has the roundings of L, and of slightly thin bodies, whose row sums
// over h are larger.
TEST(FloatBounds, HaveTheErrorOfTheRestWhereTheBallIsSmall) {
  FollowedPairs followed;
  Draw draw{std::mt19937_64(kSeed + 3)};
  while (followed.previous.size() < kBlock) {
    const bool round = followed.previous.size() % 2 == 0;
    const auto axes = [&] {
      return round ? Vec3(1, 1, 1) : Vec3(1, draw.power(1, 2), draw.power(1, 2));
    };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    const double rho = a.least_radius() + b.least_radius();
    const double ball = round ? draw.power(-18, -17) : draw.power(-16, -14);
    followed.place(draw, a, b, draw.direction(), -rho * (1 - ball), 0);
  }
  expect_bounds(followed, 0x1p-5);
}

// (o): a pair that is apart by less than (v) of any mode is not said to be.
TEST(FloatBounds, OfYesAndNoAreThoseOfEveryRoundingMode) {
  FollowedPairs followed;
  Draw draw{std::mt19937_64(kSeed + 4)};
  while (followed.previous.size() < kBlock) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 2), draw.power(0, 2)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    const Vec3 n = draw.direction();
    const Ellipsoid touching = b.moved_to(a.support_point(n) + b.support_point(n));
    const double gap = draw.real(0.6, 0.9) * derived(a, touching, n, kInAnyMode).value;
    followed.place(draw, a, b, n, gap, 0);
  }
  const Indexed in(followed.pairs);
  testing::at_every_level([&] {
    const BodyArray array(in.bodies);
    LaneBlock block{};
    block.bodies_a = block.bodies_b = array.lanes();
    block.floats_a = block.floats_b = array.floats();
    block.pairs = in.pairs.data();
    block.count = LaneBlock::kPairs;
    EXPECT_EQ(detail::float_overlap_lanes(block).decided, 0u);
  });
}

}  // namespace
}  // namespace tangency
