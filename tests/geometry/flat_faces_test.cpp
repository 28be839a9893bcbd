// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of flat discs and edges of thin needles against huge bodies, their tips among them: the
// value has all but a kink where the normal lies across the face. Held against the bounded gap,
// against 100 digits and against the batch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <utility>
#include <vector>

#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/power_of_two.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Columns;
using testing::kSeed;

/// A body with semi-axes to 2^30 and 2^-16 of that, and one that lies with its face or its edge on
/// it, or nearly so.
class FlatPairs {
 public:
  /// @param thinnest, thickest  of the thin semi-axis over the long one, by exponent
  /// @param least, most  of the gap over the huge body's largest semi-axis, by exponent
  FlatPairs(double thinnest, double thickest, double least, double most)
      : thinnest_(thinnest), thickest_(thickest), least_(least), most_(most), random_(kSeed) {}

  struct Pair {
    Ellipsoid a, b;
  };

  Pair next() {
    ++count_;
    const double huge = power(0, 30), length = huge * power(-30, 0);
    Vec3 axes(huge * power(-16, 0), huge * power(-16, 0), huge);
    std::swap(axes[count_ % 3], axes[2]);
    const Ellipsoid a(Vec3::Zero(), axes, turn());
    Vec3 n = direction();
    if (count_ % 2 == 0) n = (a.rotation().col(count_ % 3) + power(-20, 0) * n).normalized();

    const double thin = length * power(thinnest_, thickest_);
    const bool disc = count_ % 4 < 2;
    const Vec3 across = disc ? Vec3::UnitZ() : Vec3::UnitY();
    Quaternion q = Quaternion::FromTwoVectors(across, n);
    q = q * Quaternion(Eigen::AngleAxisd(draw(0, 6), across));
    if (count_ % 3 == 0) {
      const Vec3 tilt = power(-50, 0) * direction();
      q = Quaternion(1, tilt[0], tilt[1], tilt[2]).normalized() * q;
    }
    const Vec3 flat =
        disc ? Vec3(length, length * power(-2, 0), thin) : Vec3(length, thin, thin * power(-3, 0));
    const Vec3 inside = draw(0, 1) * direction();
    const Vec3 face = Ellipsoid(Vec3::Zero(), flat, q).rotation() * flat.cwiseProduct(inside);
    const double gap = huge * power(least_, most_);
    return {a, Ellipsoid(a.support_point(n) + gap * n - face, flat, q)};
  }

 private:
  // Of the unit ball, a length squared: shorter vectors keep fewer digits of a direction. Chosen.
  static constexpr double kShortest2 = 1e-3;

  double draw(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  double power(double low, double high) { return std::exp2(draw(low, high)); }
  Vec3 direction() {
    Vec3 v;
    do {
      for (double& x : v) x = draw(-1, 1);
    } while (!(v.squaredNorm() <= 1 && v.squaredNorm() > kShortest2));
    return v.normalized();
  }
  Quaternion turn() {
    return Quaternion(draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(0.1, 1)).normalized();
  }

  double thinnest_, thickest_, least_, most_;
  std::mt19937_64 random_;
  int count_ = 0;
};

/// The same body in units of 2^-power.
Ellipsoid scaled(const Ellipsoid& body, int power) {
  return {scaled_by_power(body.centre(), power), scaled_by_power(body.semi_axes(), power),
          body.orientation()};
}

/// Pairs apart and pairs that overlap, each also exchanged and at both ends of the range.
std::vector<Ellipsoid> bodies_of_pairs(int count) {
  std::vector<Ellipsoid> bodies;
  FlatPairs apart(-45, -10, -40, -4), thinner(-200, -45, -40, -4);
  for (int i = 0; i < count; ++i) {
    const auto [a, b] = i % 5 == 4 ? thinner.next() : apart.next();
    // Into each other: by the centre of B moved through the surface.
    const bool meet = i % 8 == 7;
    const Ellipsoid c = meet ? b.moved_to(b.centre() * (1.0 - 0x1p-20)) : b;
    for (const int power : {0, 900, -700}) {
      bodies.push_back(scaled(a, power)), bodies.push_back(scaled(c, power));
      bodies.push_back(scaled(c, power)), bodies.push_back(scaled(a, power));
    }
  }
  return bodies;
}

TEST(FlatFaces, GapApartIsOkToTheThinnestThatANormalTells) {
  FlatPairs pairs(-45, -10, -40, -4);
  int hard = 0, unsettled = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto [a, b] = pairs.next();
    for (const auto& [x, y] : {std::pair(&a, &b), {&b, &a}}) {
      const Gap gap = signed_gap(*x, *y);
      hard += gap.tier > GapTier::safeguarded;
      unsettled += gap.status != GapStatus::ok && gap.gap > 0;
    }
  }
  std::printf("%d of 3000 in double-double\n", hard);
  EXPECT_GT(hard, 1000) << "the pairs are meant to be hard";
  EXPECT_EQ(unsettled, 0);
}

TEST(FlatFaces, MostGapsApartOfThinnerBodiesAreOk) {
  FlatPairs pairs(-200, -45, -40, -4);
  int settled = 0;
  for (int i = 0; i < 150; ++i) {
    const auto [a, b] = pairs.next();
    settled += signed_gap(a, b).status == GapStatus::ok;
  }
  std::printf("%d of 150 ok\n", settled);
  EXPECT_GT(settled, 75) << "by normals in doubles alone";
}

TEST(FlatFaces, GapMeetsTheBoundedOneAndTheTruth) {
  FlatPairs pairs(-45, -10, -40, -4), thinner(-200, -45, -40, -4);
  for (int i = 0; i < 1500; ++i) {
    const auto [a, b] = i % 5 == 4 ? thinner.next() : pairs.next();
    const Gap gap = signed_gap(a, b);
    const BoundedGap bounded = bounded_gap(a, b);
    ASSERT_GE(gap.gap + gap.gap_error, bounded.gap - bounded.gap_error) << i;
    if (gap.status == GapStatus::ok) {
      ASSERT_LE(gap.gap - gap.gap_error, bounded.gap + bounded.above) << i;
    }
    if (i % 15 != 0) continue;  // of the thinner ones no ascent in 100 digits arrives
    const verify::GapTruth truth = verify::signed_gap(verify::to_raw(a), verify::to_raw(b));
    ASSERT_LE(gap.gap - verify::Real(gap.gap_error), truth.gap + truth.unproven) << i;
    if (gap.status == GapStatus::ok) {
      ASSERT_GE(gap.gap + verify::Real(gap.gap_error), truth.gap) << i;
    }
  }
}

TEST(FlatFaces, BatchHasStatusAndSignOfTheSingleCallAtEveryAccuracy) {
  const std::vector<Ellipsoid> bodies = bodies_of_pairs(80);
  const std::size_t count = bodies.size() / 2;
  std::vector<IndexedPair> pairs;
  std::vector<Gap> single;
  int apart = 0, meet = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    pairs.push_back({2 * i, 2 * i + 1});
    single.push_back(signed_gap(bodies[2 * i], bodies[2 * i + 1]));
    ++(single.back().gap > 0 ? apart : meet);
  }
  EXPECT_GT(apart, 350);
  EXPECT_GT(meet, 50);
  const BodyArray array(bodies);
  Columns columns(count);
  at_every_level([&] {
    for (const Accuracy accuracy :
         {Accuracy::fast(), Accuracy::standard(), Accuracy::certified()}) {
      signed_gaps(array, PairList{pairs}, columns.all(), accuracy);
      for (std::size_t i = 0; i < count; ++i) {
        const Gap gap = columns[i];
        ASSERT_EQ(gap.status, single[i].status)
            << i << ", " << accuracy.of_size << ": " << gap.gap << " +- " << gap.gap_error
            << ", the single call " << single[i].gap << " +- " << single[i].gap_error;
        ASSERT_EQ(gap.gap > 0, single[i].gap > 0) << i;
        ASSERT_LE(std::abs(gap.gap - single[i].gap), gap.gap_error + single[i].gap_error) << i;
      }
    }
  });
}

// Of a needle of 2e3 and 2e-17 float proves the gap to 4 of 3e7, of one of 44 and 4e-18 double to
// the length that is asked for; no normal in doubles proves either to rounding.
TEST(FlatFaces, BodiesThatNoNormalInDoublesTellsHaveTheStatusOfTheSingleCall) {
  const std::vector<Vec3> centres{
      {0x1.90b739ae0d80fp+23, 0x1.0799e0cb20f35p+17, -0x1.4c7d476dfa4c3p+24},
      {0, 0, 0},
      {0, 0, 0},
      {-0x1.21f2d7cedbe44p+16, -0x1.062935ece335dp+17, -0x1.ceab64215913ap+17}};
  const std::vector<Vec3> axes{
      {0x1.30d18c0449632p+11, 0x1.301ad17825bbbp-56, 0x1.4a07bf3051386p-58},
      {0x1.f26dc7e656dddp+22, 0x1.6e0506f06da44p+24, 0x1.468e5f2820412p+20},
      {0x1.139ccbd2da612p+18, 0x1.57559610d7b73p+7, 0x1.c6fb2c7ee85dep+16},
      {0x1.5fa266a61502dp+5, 0x1.1e5c280b1b91dp-58, 0x1.337cfda067e0ap-59}};
  const std::vector<Quaternion> turns{
      {0x1.2399fdd63ecefp-1, -0x1.12edd2f5bf0fcp-2, 0x1.b057e900a02e7p-2, -0x1.4de51d32c8a64p-1},
      {-0x1.521595fcbd52ap-1, 0x1.b86d80c13a9a4p-2, -0x1.08467d7a58331p-2, 0x1.1e2960750db4bp-1},
      {-0x1.37aa952943ad2p-1, -0x1.f1504611d2ac7p-7, -0x1.5b95f8af9f2d6p-1, 0x1.a426c41ca1e98p-2},
      {-0x1.5455afd0adc1p-2, 0x1.90c992b38947bp-2, 0x1.8acdb8c4945bfp-1, -0x1.818948e9374d8p-2}};
  std::vector<Ellipsoid> bodies, first, second;
  for (std::size_t i = 0; i < axes.size(); ++i) bodies.emplace_back(centres[i], axes[i], turns[i]);
  for (const std::size_t i : {0U, 2U}) first.push_back(bodies[i]), second.push_back(bodies[i + 1]);
  const std::vector<IndexedPair> pairs{{0, 1}, {2, 3}};
  const BodyArray array(bodies);
  const MovingBodies moving(axes, {turns, VectorColumn(centres)});
  at_every_level([&] {
    for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::within(1e3)}) {
      Columns indexed(2), moved(2);
      std::vector<Gap> plain(2);
      signed_gaps(array, PairList{pairs}, indexed.all(), accuracy);
      signed_gaps(first, second, plain, accuracy);
      signed_gaps(moving, PairList{pairs}, moved.all(), accuracy);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const GapStatus single = signed_gap(first[i], second[i]).status;
        EXPECT_EQ(indexed[i].status, single) << i << ", " << indexed[i].gap_error;
        EXPECT_EQ(plain[i].status, single) << i << ", " << plain[i].gap_error;
        EXPECT_EQ(moved[i].status, single) << i << ", " << moved[i].gap_error;
      }
    }
  });
}

}  // namespace
}  // namespace tangency
