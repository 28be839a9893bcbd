// SPDX-License-Identifier: GPL-3.0-or-later
// What the certificate is made of. That it bounds the true error is held against the 100-digit
// oracle by tests/verify/gap_agreement.cpp.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap/proof.hpp>
#include <tangency/geometry/gap/search.hpp>
#include <tangency/geometry/gap/sign.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/tests/support/generators.hpp>
#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency {
namespace {

using verify::to_ellipsoid;

constexpr double kU = kUnitRoundoff;
constexpr std::uint64_t kSeed = 20261122;

double size_of(const Ellipsoid& a, const Ellipsoid& b) {
  return (b.centre() - a.centre()).stableNorm() + a.largest_semi_axis() + b.largest_semi_axis();
}

std::array<int, 5> tiers_of(const verify::ExtremeFamily& family, int count) {
  verify::ExtremePairs pairs(family, kSeed);
  std::array<int, 5> tiers{};
  for (int i = 0; i < count; ++i) {
    const auto pair = pairs.next();
    ++tiers[static_cast<std::size_t>(signed_gap(to_ellipsoid(pair.a), to_ellipsoid(pair.b)).tier)];
  }
  return tiers;
}

TEST(GapTiers, OrdinaryContactsAreAnsweredByTheFastPath) {
  for (std::size_t k = 0; k < 2; ++k) {
    verify::ManufacturedContacts contacts(verify::contact_classes()[k], kSeed);
    int fast = 0;
    for (int i = 0; i < 2000; ++i) {
      const auto c = contacts.next();
      fast += signed_gap(to_ellipsoid(c.a), to_ellipsoid(c.b)).tier == GapTier::fast;
    }
    EXPECT_GE(fast, 1990) << verify::contact_classes()[k].name;
  }
}

TEST(GapTiers, FollowedOrdinaryContactsAreAnsweredByTheFastPathToo) {
  for (std::size_t k = 0; k < 2; ++k) {
    verify::ManufacturedContacts contacts(verify::contact_classes()[k], kSeed);
    for (int i = 0; i < 500; ++i) {
      const auto c = contacts.next();
      const Ellipsoid a = to_ellipsoid(c.a), b = to_ellipsoid(c.b);
      const Vec3 before(c.normal[0] + 0.01, c.normal[1] - 0.02, c.normal[2] + 0.01);
      const Gap gap = follow_gap(a, b, Vec3(b.centre() - a.centre()), before);
      ASSERT_EQ(gap.tier, GapTier::fast) << k << ' ' << i;
    }
  }
}

TEST(GapTiers, ExtremeShapesNeedEveryTierAndAreAnswered) {
  std::array<int, 5> total{};
  for (const auto& family : verify::extreme_families()) {
    const auto tiers = tiers_of(family, 200);
    for (std::size_t t = 0; t < 5; ++t) total[t] += tiers[t];
  }
  std::printf("fast %d, safeguarded %d, factored %d, search %d, exact %d\n", total[0], total[1],
              total[2], total[3], total[4]);
  for (const int count : total) EXPECT_GT(count, 0);
}

TEST(GapSign, IsThatOfTheExactRelationForHostilePairs) {
  int touches = 0;
  verify::for_each_adversarial_pair(kSeed, 4000, [&](const verify::AdversarialPair& p) {
    const Ellipsoid a = to_ellipsoid(p.a), b = to_ellipsoid(p.b);
    const Gap gap = signed_gap(a, b);
    switch (relation(a, b).relation) {
      case Relation::separate:
        ASSERT_GT(gap.gap, 0.0) << p.family;
        break;
      case Relation::external_touch:
        ++touches;
        ASSERT_EQ(gap.gap, 0.0) << p.family;
        ASSERT_EQ(gap.gap_error, 0.0) << p.family;
        break;
      default:
        ASSERT_LT(gap.gap, 0.0) << p.family;
    }
  });
  EXPECT_GT(touches, 100);
}

TEST(GapSign, IsThatOfTheExactRelationWithAGivenSeparationToo) {
  verify::for_each_adversarial_pair(kSeed + 1, 2000, [&](const verify::AdversarialPair& p) {
    const Ellipsoid a = to_ellipsoid(p.a).moved_to(Vec3::Zero());
    const Vec3 d(p.b.centre[0], p.b.centre[1], p.b.centre[2]);
    const Ellipsoid b = to_ellipsoid(p.b);
    const Gap gap = signed_gap(a, b, d), other = signed_gap(a, b);
    ASSERT_EQ(gap.gap, other.gap) << p.family;
    const Gap followed = follow_gap(a, b, d, gap.normal);
    ASSERT_EQ(followed.gap < 0, gap.gap < 0) << p.family;
    ASSERT_EQ(followed.gap > 0, gap.gap > 0) << p.family;
  });
}

TEST(GapError, IsAtMostThePublishedConstantForAspectsTo100) {
  double largest = 0.0;
  for (const auto& family : verify::extreme_families()) {
    if (family.aspect > 100) continue;
    verify::ExtremePairs pairs(family, kSeed);
    for (int i = 0; i < 500; ++i) {
      const auto pair = pairs.next();
      const Ellipsoid a = to_ellipsoid(pair.a), b = to_ellipsoid(pair.b);
      const Gap gap = signed_gap(a, b);
      ASSERT_EQ(gap.status, GapStatus::ok) << family.name;
      largest = std::max(largest, gap.gap_error / (kU * size_of(a, b)));
    }
  }
  std::printf("largest gap_error %.2f u L\n", largest);
  EXPECT_LE(largest, kOrdinaryGapErrorBound);
  EXPECT_GT(largest, 0.5 * kOrdinaryGapErrorBound);  // a much better bound is to be published
}

// A flat face of aspect 1e16 on a sphere, and on what is not quite one: at the sphere a normal has
// f = 4.93922345342781e-07, 50 times the error that was given above what was given.
TEST(GapError, HoldsAtTheFaceOfABodyOfAspect1e16) {
  const verify::RawEllipsoid disc{
      {0, 0, 0},
      {1, 0x1.6b1260e893c2bp-1, 0x1.bb5c232aac737p-57},
      {-0x1.8274dae13223dp-1, -0x1.7289ec23675cep-3, 0x1.e39d7d8c041bep-1, 0x1.70a3f3d571b48p-1}};
  const double r = 0x1.92cad67f16bbep-2;
  verify::RawEllipsoid round{
      {-0x1.a7fad9e162f94p-2, 0x1.186f42052c5bcp-4, 0x1.e0c6e31853078p-4},
      {r, r, r},
      {0x1.31a65d84e910ep+0, -0x1.1d24d0e932789p+1, 0x1.0ebdbb20af063p-9, 0x1.00cf13a540f24p-2}};
  for (const double other : {r, std::nextafter(r, 1.0), 1.01 * r}) {
    round.semi_axes[2] = other;
    const verify::Real truth = verify::signed_gap(disc, round).gap;
    const Ellipsoid a = to_ellipsoid(disc), b = to_ellipsoid(round);
    for (const Gap& gap : {signed_gap(a, b), signed_gap(b, a)}) {
      const double error = abs(truth - verify::Real(gap.gap)).convert_to<double>();
      if (other == r) {
        EXPECT_EQ(gap.status, GapStatus::ok);
      }
      if (gap.status == GapStatus::ok) {
        EXPECT_LE(error, gap.gap_error) << other;
      }
      EXPECT_TRUE(verify::Real(gap.gap) - gap.gap_error <= truth) << other;
    }
  }
}

// A sphere in a thin body: what signed_gap(Sphere, Ellipsoid) proves is proven of the pair too.
TEST(GapStatusOfSpheres, IsOkAtEveryDepthAndAspect) {
  std::mt19937_64 random(kSeed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  for (const double aspect : {10.0, 1e2, 1e4, 1e8, 1e16, 1e30, 1e150}) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 axes(1, std::pow(aspect, -uniform(0, 1)), 1 / aspect);
      const Ellipsoid a({0, 0, 0}, axes,
                        Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), 0.2));
      const Vec3 side(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      const Vec3 place = uniform(0, 1) * a.support_point(side);
      const double radius = std::exp(uniform(-5, 0));
      const Ellipsoid b(place, Vec3::Constant(radius));
      const Gap gap = signed_gap(a, b), other = signed_gap(a, Sphere{place, radius});
      ASSERT_EQ(gap.status, GapStatus::ok) << aspect << ' ' << i;
      ASSERT_LE(std::abs(gap.gap - other.gap), gap.gap_error + other.gap_error) << aspect;
      const Gap followed = follow_gap(a, b, place, gap.normal);
      ASSERT_EQ(followed.status, GapStatus::ok) << aspect << ' ' << i;
      ASSERT_LE(std::abs(followed.gap - other.gap), followed.gap_error + other.gap_error);
    }
  }
}

/// The greatest f on a fan of normals around the proof's, out to its cap's edge.
RC_GTEST_PROP(GapCap, BoundsTheValueInAllOfItself, ()) {
  const testing::Pair p = *testing::pair_at(100, testing::uniform(0, 1));
  const Vec3 d = p.b.centre() - p.a.centre();
  const detail::Pair pair({p.a, p.b, &d});
  const detail::FactoredPair factored(pair.a, pair.b, pair.d);
  const detail::Stationary found = factored.climb(*testing::direction());
  RC_PRE(found.accepted);
  // Off the maximum, so that the rest is not rounding.
  const Vec3 off = (found.normal + 1e-6 * *testing::direction()).normalized();
  detail::GapProof at;
  detail::prove_gap(pair, off, at);
  const Vec3& n = off;
  const double h_a = p.a.support(n), h_b = p.b.support(n);
  const detail::DoubleDoubleSide side_a(p.a, detail::exactly(n)), side_b(p.b, detail::exactly(n));
  const detail::Hessian hessian =
      detail::hessian_at({side_a, p.a.support_point(n)}, {side_b, p.b.support_point(n)}, n);
  const Vec3 r = pair.d - at.arm_a + at.arm_b - at.gap * n;
  const detail::Gradient gradient{
      at.gap, {hessian.tangent[0].dot(r), hessian.tangent[1].dot(r)}, 1e-13};
  const detail::Cap cap = detail::cap_around(hessian, gradient, 1.0);
  RC_PRE(cap.proven);
  const double slack = 64 * kU * size_of(p.a, p.b);
  for (int i = 0; i < 64; ++i) {
    const double angle = 2 * M_PI * i / 64;
    const Vec3 e = std::cos(angle) * hessian.tangent[0] + std::sin(angle) * hessian.tangent[1];
    const auto stretch = [&](const Ellipsoid& body) {
      return body.semi_axes().cwiseProduct(body.rotation().transpose() * e).norm();
    };
    double edge = std::min(cap.width * h_a / stretch(p.a), cap.width * h_b / stretch(p.b));
    if (at.gap > 0) edge = std::min(edge, 2 * std::sqrt(cap.width));
    for (const double part : {1e-7, 1e-5, 1e-3, 0.1, 0.5, 1.0}) {
      const Vec3 v = (n + part * edge * e).normalized();
      RC_ASSERT(factored.value(v) <= at.gap + cap.height + slack);
    }
  }
}

// An ascent to a body that is thinner than normals in doubles tell can end where the curvatures
// prove nothing, and the rolling ball has to bound the gap.
TEST(GapProof, OfBodiesApartHoldsFromAPoorNormalToo) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> exponent(-60, 0);
  std::normal_distribution<double> any;
  int without_cap = 0;
  for (const auto& family : verify::extreme_families()) {
    if (family.aspect != 1e4 || family.scale != 1) continue;
    verify::ExtremePairs pairs(family, kSeed);
    for (int i = 0; i < 40; ++i) {
      const auto raw = pairs.next();
      const Ellipsoid b = to_ellipsoid(raw.b);
      // Now and then so thin that no normal in doubles lies across it.
      const Vec3 thin(1, 1, i % 8 == 7 ? 0x1p-70 : 1);
      const Ellipsoid shape = to_ellipsoid(raw.a);
      const Ellipsoid a(shape.centre(), shape.semi_axes().cwiseProduct(thin), shape.orientation());
      const Vec3 d = b.centre() - a.centre();
      const Gap truth = signed_gap(a, b, d);
      const detail::Pair pair({a, b, &d});
      for (int k = 0; k < 10; ++k) {
        const Vec3 off(any(random), any(random), any(random)), axis = a.rotation().col(k % 3);
        const Vec3 near = (axis + std::exp2(exponent(random)) * off).normalized();
        const auto proof =
            detail::prove_gap_in_double_double(pair, near.dot(pair.d) < 0 ? Vec3(-near) : near);
        if (!proof.global) continue;
        without_cap += proof.cap.proven ? 0 : 1;
        ASSERT_LT(proof.high, std::numeric_limits<double>::infinity()) << family.name << ' ' << i;
        ASSERT_LE(proof.low, truth.gap + truth.gap_error) << family.name << ' ' << i;
        ASSERT_GE(proof.high, truth.gap - truth.gap_error) << family.name << ' ' << i;
      }
    }
  }
  EXPECT_GT(without_cap, 0);
}

/// What the exact relation says of a pair whose proof leaves the sign open.
struct Told {
  Relation answer;
  bool overlaps(GapTier&) const { return answer == Relation::overlap; }
  Relation relation() const { return answer; }
};

TEST(GapSign, ThatTheProofLeavesOpenPutsTheGapInTheMiddleOfWhatIsLeft) {
  const auto settled = [](double gap, Relation answer) {
    detail::GapProof proof{gap, -3e-17, 2e-17, true, Vec3::UnitX(), Vec3::Zero(), Vec3::Zero()};
    GapTier tier = GapTier::fast;
    detail::settle_sign(proof, tier, Told{answer}, 1.0);
    EXPECT_EQ(tier, GapTier::exact);
    return proof;
  };
  const auto overlap = settled(1e-17, Relation::overlap);
  EXPECT_EQ(overlap.low, -3e-17);
  EXPECT_EQ(overlap.gap, -1.5e-17);
  EXPECT_EQ(overlap.high, 0.0);
  const auto touch = settled(1e-17, Relation::external_touch);
  EXPECT_EQ(touch.low, 0.0);
  EXPECT_EQ(touch.gap, 0.0);
  EXPECT_EQ(touch.high, 0.0);
  EXPECT_TRUE(touch.global);
  const auto apart = settled(-1e-17, Relation::separate);
  EXPECT_EQ(apart.low, 0.0);
  EXPECT_EQ(apart.gap, 1e-17);
  EXPECT_EQ(apart.high, 2e-17);
}

// A touch proves the value 0 of its own normal only: a deep branch keeps its normal and is no `ok`.
TEST(GapSign, OfATouchDoesNotMakeABranchGlobalThatIsNotProvenToBe) {
  detail::GapProof proof{-0.3, -0.31, -0.29, false, Vec3::UnitX(), Vec3::Zero(), Vec3::Zero()};
  GapTier tier = GapTier::factored;
  detail::settle_sign(proof, tier, Told{Relation::external_touch}, 1.0);
  EXPECT_EQ(proof.gap, 0.0);
  EXPECT_FALSE(proof.global);
  // What is left of the error bounds the distance to the branch's value.
  EXPECT_EQ(proof.low, -0.31);
  EXPECT_EQ(proof.high, 0.0);
}

// The bound of the curvatures at thin bodies, and what it is made of: docs/derivations/
// gap-certificate.md, (S). A face of a/h = 2^k: the normal's own rounding would show in the roots
// 2^k times as large.
TEST(GapCap, CurvaturesOfThinFacesAreRightToTheirLoss) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 10; k <= 80; k += 5) {
    const double thin = std::ldexp(1.0, -k);
    const Eigen::Quaterniond q(any(random), any(random), any(random), any(random));
    const Ellipsoid a({0, 0, 0}, {1, 0.7, thin}, q), b({0, 0, 0}, {0.4, 0.4, 0.4});
    // At the face's own normal, which no double is: h and the roots are of what is stored.
    const Vec3 n = a.rotation().col(2).normalized();
    const detail::DoubleDoubleSide side_a(a, detail::exactly(n)), side_b(b, detail::exactly(n));
    const detail::Hessian hessian =
        detail::hessian_at({side_a, a.support_point(n)}, {side_b, b.support_point(n)}, n);
    // kappa kappa' of an ellipsoid is (h^2 / (a1 a2 a3))^2, exactly: det H_A of h's stored value.
    const double h = side_a.support.high;
    const double determinant = std::pow(0.7 * thin / (h * h), 2);
    const double sum = hessian.a.curvature[0] + hessian.a.curvature[1];
    // H = H_A + 0.4 I: its determinant is det H_A + 0.4 tr H_A + 0.16.
    const double expected = determinant + 0.4 * sum + 0.16;
    EXPECT_LE(std::abs(hessian.curvature[0] * hessian.curvature[1] - expected),
              (4 * hessian.loss + 1e-12) * expected)
        << k;
    EXPECT_LE(hessian.loss, std::ldexp(1.0, k - 88) + 0x1p-45) << k;
  }
}

TEST(GapSearch, FindsAndProvesTheBestOfManyMaxima) {
  // Crossed discs about one centre: four maxima, two of them best.
  const Ellipsoid a({0, 0, 0}, {5, 4, 1}), b({0.1, 0.05, 0.02}, {5, 1.2, 4}, {0.9, 0.2, 0.1, 0.3});
  const detail::Pair pair({a, b});
  const detail::FactoredPair factored(a, b, pair.d);
  const auto proof = detail::search_sphere(pair, factored, Vec3::UnitX(), 20000);
  ASSERT_TRUE(proof);
  EXPECT_TRUE(proof->global);
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 200; ++j) {
      const double z = -1 + (j + 0.5) / 100, s = std::sqrt(1 - z * z), t = M_PI * i / 100;
      best = std::max(best, factored.value({s * std::cos(t), s * std::sin(t), z}));
    }
  }
  EXPECT_GE(proof->high, best);
  EXPECT_LE(proof->gap, best + 0.01);
}

TEST(GapSearch, SaysSoWhereItsBudgetIsSpent) {
  const Ellipsoid a({0, 0, 0}, {5, 4, 1}), b({0.1, 0.05, 0.02}, {5, 1.2, 4}, {0.9, 0.2, 0.1, 0.3});
  const detail::Pair pair({a, b});
  const auto proof =
      detail::search_sphere(pair, detail::FactoredPair(a, b, pair.d), Vec3::UnitX(), 3);
  ASSERT_TRUE(proof);
  EXPECT_FALSE(proof->global);
}

// Two axes tie exactly, at a value half-way between two doubles, so that each may round either way.
TEST(GapSearch, OfAConcentricTieTakesTheFirstAxisOfA) {
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> any;
  const double s = 1.25 + 0x1p-52;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond q(any(random), any(random), any(random), any(random));
    const Ellipsoid a({0, 0, 0}, {1, s, 1.2}, q), b({0, 0, 0}, {s, 1, 1.2}, q);
    const Gap gap = signed_gap(a, b);
    EXPECT_EQ(gap.status, GapStatus::ok);
    // Which of three axes at right angles: any bound far below 1 tells.
    EXPECT_LE((gap.normal - a.rotation().col(0)).norm(), 1e-12) << i;
  }
}

TEST(GapSearch, ProvesATieAlongACircleOfCoaxialBodies) {
  // Every normal across the common axis is as good: min(2 + 1, 3 + 9) = 3.
  const Ellipsoid a({0, 0, 0}, {2, 2, 3}), b({0, 0, 0}, {1, 1, 9});
  const Gap gap = signed_gap(a, b);
  EXPECT_EQ(gap.status, GapStatus::ok);
  EXPECT_LE(std::abs(gap.gap + 3), gap.gap_error);
  EXPECT_LE(gap.gap_error, 16 * kU * 12);
  // The documented one of the tied normals: the first equal axis of A.
  EXPECT_LE((gap.normal - Vec3::UnitX()).norm(), 4 * kU);
}

TEST(GapSearch, OfCoaxialBodiesIsThatAlongTheirMeridianAtEveryDepth) {
  std::mt19937_64 random(kSeed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  for (int i = 0; i < 300; ++i) {
    const Eigen::Quaterniond q(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), 0.3);
    const double ra = std::exp(uniform(-3, 3)), rb = i % 3 == 0 ? 1 : std::exp(uniform(-3, 3));
    const double size = std::exp(uniform(-1, 1));
    const Ellipsoid a(Vec3::Zero(), {1, 1, ra}, q), b0(Vec3::Zero(), {size, size, size * rb}, q);
    const Vec3 axis = a.rotation().col(2), across = a.rotation().col(0);
    const Ellipsoid b = b0.moved_to((i % 2) * uniform(0, 1) * (ra + size * rb) * axis);
    const Gap gap = signed_gap(a, b);
    ASSERT_EQ(gap.status, GapStatus::ok) << i;
    ASSERT_LE(gap.gap_error, 16 * kU * size_of(a, b)) << i;
    double best = -std::numeric_limits<double>::infinity();
    constexpr int kAngles = 20000;
    for (int k = 0; k <= kAngles; ++k) {
      const double t = M_PI * k / kAngles;
      const Vec3 n = std::cos(t) * axis + std::sin(t) * across;
      best = std::max(best, n.dot(b.centre()) - a.support(n) - b.support(n));
    }
    ASSERT_LE(best, gap.gap + gap.gap_error + 16 * kU * size_of(a, b)) << i;
    ASSERT_GE(best, gap.gap - 1e-4 * size_of(a, b)) << i;
  }
}

TEST(GapProof, ArmsAfterTheLastStepAreSupportPointsAtItsNormal) {
  // (N) of the derivation: steps as long as it takes, in any direction, and no longer ones. Both
  // support points err, by (N) and by (R).
  std::mt19937_64 random(kSeed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto direction = [&] { return Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)); };
  const auto body = [&] {
    const auto axis = [&] { return std::exp(uniform(0.0, std::log(100.0))); };
    const Quaternion q(uniform(0.1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    return Ellipsoid(Vec3::Zero(), {axis(), axis(), axis()}, q);
  };
  double worst = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const Ellipsoid a = body(), b = body();
    const Vec3 n = direction().normalized(), rest = 10.0 * direction();
    const Vec3 d = a.support_point(n) + b.support_point(n) + rest;
    const double thin =
        std::max(a.largest_semi_axis() / a.support(n), b.largest_semi_axis() / b.support(n));
    for (const double length : {0.999, 1.001}) {
      // Of a step that is a multiple of the tangential rest.
      const double share = length * 0x1p-20 / thin / (rest - n.dot(rest) * n).norm();
      const detail::NearlyStationary near{{n, true}, {{}, Vec3::Zero(), share, 1.0, 0.0}};
      detail::GapProof proof;
      const bool last = detail::prove_gap_and_step(detail::Pair({a, b, &d}), near, proof);
      ASSERT_EQ(last, length < 1.0) << i;
      if (!last) continue;
      for (const bool of_a : {true, false}) {
        const Ellipsoid& e = of_a ? a : b;
        const double axis = e.largest_semi_axis(), h = e.support(proof.normal);
        const double bound = kU * (16.3 * axis * (axis / h) + 27.5 * axis);
        const Vec3 arm = of_a ? proof.arm_a : Vec3(-proof.arm_b);
        worst = std::max(worst, (arm - e.support_point(proof.normal)).norm() / bound);
      }
    }
  }
  std::printf("seed %llu: %.2f of the bound\n", static_cast<unsigned long long>(kSeed), worst);
  EXPECT_LE(worst, 1.0);
}

TEST(ContactBounds, OfOrdinaryContactsHoldNormalsToTheLastStep) {
  // A single step is left where its length times that of the one before is below 2^-36, and what
  // that leaves is a few times as much.
  double largest = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    verify::ManufacturedContacts contacts(verify::contact_classes()[k], kSeed);
    for (int i = 0; i < 1000; ++i) {
      const auto contact = contacts.next();
      const Ellipsoid a = to_ellipsoid(contact.a), b = to_ellipsoid(contact.b);
      largest = std::max(largest, contact_bounds(a, b, signed_gap(a, b)).normal);
    }
  }
  std::printf("seed %llu: normals within %.1e rad\n", static_cast<unsigned long long>(kSeed),
              largest);
  EXPECT_LT(largest, 0x1p-32);
}

TEST(ContactBounds, AreTightForAnOrdinaryContactAndEverythingAtATie) {
  const Ellipsoid a({0, 0, 0}, {1, 1.5, 2}), b({3, 1, 0.5}, {1.2, 1, 0.8}, {0.5, 0.5, 0.1, 0.3});
  // From its own normal a search ends at rounding.
  const Vec3 apart = b.centre() - a.centre();
  const ContactBounds bounds =
      contact_bounds(a, b, apart, follow_gap(a, b, apart, signed_gap(a, b).normal));
  EXPECT_LT(bounds.normal, 1e-14);
  EXPECT_LT(bounds.arm_a, 2e-14);
  EXPECT_LT(bounds.arm_b, 2e-14);
  EXPECT_GT(bounds.normal, 0.0);

  const Ellipsoid c({0, 0, 0}, {2, 2, 3}), d({0, 0, 0}, {1, 1, 9});
  const ContactBounds tie = contact_bounds(c, d, signed_gap(c, d));
  EXPECT_EQ(tie.normal, 2.0);
  EXPECT_EQ(tie.arm_a, 6.0);
  EXPECT_EQ(tie.arm_b, 18.0);
}

}  // namespace
}  // namespace tangency
