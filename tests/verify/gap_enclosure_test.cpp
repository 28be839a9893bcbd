// SPDX-License-Identifier: GPL-3.0-or-later
//
// The enclosure of the global gap against gaps worked out by hand, against the 100-digit gap and
// against values of f at directions of this file's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>

#include <tangency/tests/verify/raw_sampler.hpp>
#include <tangency/verify/oracles/gap.hpp>
#include <tangency/verify/oracles/gap_enclosure.hpp>

namespace tangency::verify {
namespace {

void expect_enclosed(const GapEnclosure& found, const Real& gap, double width) {
  EXPECT_LE(found.lower, gap) << gap.str(20);
  EXPECT_GE(found.upper, gap) << gap.str(20);
  EXPECT_LE(found.upper - found.lower, width) << gap.str(20);
}

class Sampler : public RawSampler {
 public:
  using RawSampler::RawSampler;

  // Smallest semi-axis 1 or more, centres from 0 to 1.2 times as far apart as at a touch of spheres
  // as large as the bodies.
  std::array<RawEllipsoid, 2> pair(double aspect, double size_ratio) {
    const RawEllipsoid a = body(1, aspect);
    RawEllipsoid b = body(log_uniform(1, size_ratio), aspect);
    const double reach = std::ranges::max(a.semi_axes) + std::ranges::max(b.semi_axes);
    const auto way = vector();
    const double far = uniform(0, 1.2) * reach / std::hypot(way[0], way[1], way[2]);
    for (std::size_t i = 0; i < 3; ++i) b.centre[i] = a.centre[i] + far * way[i];
    return {a, b};
  }
};

// f, in long doubles, by the support function of the matrix of the stored quaternion.
long double f(const RawEllipsoid& a, const RawEllipsoid& b, const std::array<double, 3>& n) {
  const auto h = [&](const RawEllipsoid& e) {
    const auto& q = e.orientation;
    const long double w = q[0], x = q[1], y = q[2], z = q[3], qq = w * w + x * x + y * y + z * z;
    const long double along[3] = {n[0] * (w * w + x * x - y * y - z * z) +
                                      2 * n[1] * (x * y + w * z) + 2 * n[2] * (x * z - w * y),
                                  2 * n[0] * (x * y - w * z) +
                                      n[1] * (w * w - x * x + y * y - z * z) +
                                      2 * n[2] * (y * z + w * x),
                                  2 * n[0] * (x * z + w * y) + 2 * n[1] * (y * z - w * x) +
                                      n[2] * (w * w - x * x - y * y + z * z)};
    return std::hypot(along[0] * e.semi_axes[0], along[1] * e.semi_axes[1],
                      along[2] * e.semi_axes[2]) /
           qq;
  };
  long double sum = -h(a) - h(b), nn = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += n[i] * (static_cast<long double>(b.centre[i]) - a.centre[i]);
    nn += static_cast<long double>(n[i]) * n[i];
  }
  return sum / std::sqrt(nn);
}

TEST(GapEnclosure, EnclosesGapsWorkedOutByHand) {
  const RawEllipsoid unit{{0, 0, 0}, {1, 1, 1}};
  expect_enclosed(gap_enclosure(unit, {{4, 0, 0}, {2, 2, 2}}), 1, 1e-14);
  expect_enclosed(gap_enclosure(unit, {{0, -0.5, 0}, {2, 2, 2}}), -2.5, 1e-14);
  const RawEllipsoid body{{0, 0, 0}, {2, 3, 4}}, needle{{0, 0, 0}, {1, 1, 1e6}};
  expect_enclosed(gap_enclosure(body, {{0, 0, 0}, {3, 1, 7}}), -4, 1e-14);
  expect_enclosed(gap_enclosure(body, {{10, 0, 0}, {3, 1, 7}}), 5, 3e-14);
  expect_enclosed(gap_enclosure(needle, {{0, 0, 0}, {1, 1e6, 1}}), -2, 1e-8);
}

// A ball in a body's plane of symmetry y = 0, the short way out of which is along y.
TEST(GapEnclosure, ListsBothWaysOutOfAnEvenTieAndNoOther) {
  const RawEllipsoid a{{0, 0, 0}, {5, 2, 9}}, b{{1, 0, 3}, {1, 1, 1}};
  const GapEnclosure found = gap_enclosure(a, b);
  ASSERT_TRUE(found.isolated);
  ASSERT_EQ(found.caps.size(), 2U);
  EXPECT_DOUBLE_EQ(found.caps[0].centre[1], -found.caps[1].centre[1]);
  const auto gaps = highest_gaps(real(a), real(b), 0);
  ASSERT_EQ(gaps.size(), 2U);
  EXPECT_TRUE(gaps[0].global);
  EXPECT_LE(abs(gaps[0].gap - gaps[1].gap), Real("1e-138"));
  EXPECT_LE(abs(gaps[0].normal[1] + gaps[1].normal[1]), Real("1e-90"));
}

TEST(GapEnclosure, KeepsTheMaximaThatAreLowerByWhatIsAskedFor) {
  const RealEllipsoid a = real(RawEllipsoid{{0, 0, 0}, {2, 3, 4}});
  const RealEllipsoid b = real(RawEllipsoid{{0.125, 0, 0}, {2, 3, 4}});
  EXPECT_EQ(highest_gaps(a, b, 0.2).size(), 1U);
  const auto gaps = highest_gaps(a, b, 0.3);  // the way back is 0.25 longer
  ASSERT_EQ(gaps.size(), 2U);
  EXPECT_TRUE(gaps[0].global);
  EXPECT_EQ(gaps[0].gap, -3.875);
  EXPECT_EQ(gaps[1].gap, -4.125);
}

TEST(GapEnclosure, MissesNoMaximumWithinWhatIsAskedFor) {
  Sampler sample(20261130);
  std::size_t several = 0;
  for (int i = 0; i < 60; ++i) {
    auto [a, b] = sample.pair(5, 3);
    if (i % 2 == 0) b.centre = a.centre;
    const RealEllipsoid ra = real(a), rb = real(b);
    const double within = sample.log_uniform(0.01, 1);
    const auto gaps = highest_gaps(ra, rb, within);
    ASSERT_TRUE(gaps.front().global);
    EXPECT_LE(abs(gaps.front().gap - signed_gap(a, b).gap), Real("1e-138"));
    if (gaps.size() > 1) ++several;
    for (int k = 0; k < 40; ++k) {
      const Real found = stationary_gap(ra, rb, sample.vector()).gap;
      EXPECT_LE(found, gaps.front().gap + Real("1e-138"));
      if (found < gaps.front().gap - within) continue;
      EXPECT_TRUE(std::ranges::any_of(
          gaps, [&](const GapTruth& known) { return abs(known.gap - found) < Real("1e-138"); }))
          << "pair " << i;
    }
  }
  EXPECT_GE(several, 30U);  // all concentric pairs, and some others
}

// By the formula of the gap oracle's test; the normals tie on a circle.
TEST(GapEnclosure, HonoursTheWidthWhereMaximaTieAlongACurve) {
  const double d = 0.5;
  const Real c = d / sqrt(Real(2304 - 24 * d * d));
  const RawEllipsoid a{{0, 0, 0}, {1, 1, 5}}, b{{0, 0, d}, {1, 1, 5}};
  for (const double width : {1e-3, 1e-6, 1e-9}) {
    const GapEnclosure found = gap_enclosure(a, b, {.width = width});
    expect_enclosed(found, c * (d - 96 / d), width);
    EXPECT_FALSE(found.isolated);
  }
  const GapTruth truth = signed_gap(a, b);
  EXPECT_FALSE(truth.global);
  EXPECT_GT(truth.unproven, 0);
  EXPECT_LE(truth.unproven, 1e-7);
}

TEST(GapEnclosure, HoldsTheGapHoweverSmallTheBudget) {
  Sampler sample(20261126);
  for (int i = 0; i < 100; ++i) {
    const auto [a, b] = sample.pair(30, 10);
    const Real gap = signed_gap(a, b).gap;
    double last = INFINITY;
    for (const std::size_t boxes : {0U, 30U, 100U, 1000U}) {
      const GapEnclosure found = gap_enclosure(a, b, {.most_boxes = boxes});
      expect_enclosed(found, gap, last);
      last = found.upper - found.lower;
      EXPECT_LE(found.boxes, boxes + 28);
    }
  }
}

void expect_isolated(double aspect, double size_ratio, int pairs, double width) {
  Sampler sample(20261127);
  int isolated = 0;
  for (int i = 0; i < pairs; ++i) {
    const auto [a, b] = sample.pair(aspect, size_ratio);
    const GapEnclosure found = gap_enclosure(a, b);
    const GapTruth truth = signed_gap(a, b);
    expect_enclosed(found, truth.gap, width);
    if (!found.isolated) continue;
    ++isolated;
    EXPECT_TRUE(truth.global);
    EXPECT_TRUE(std::ranges::any_of(found.caps, [&](const NormalCap& cap) {
      Real chord2 = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Real part = truth.normal[k] - cap.centre[k];
        chord2 += part * part;
      }
      return chord2 <= Real(cap.radius) * cap.radius;
    }));
    if (::testing::Test::HasFailure()) FAIL() << "pair " << i;
  }
  EXPECT_EQ(isolated, pairs);
}

// The width is one of rounding: the extents are up to aspect ratio times size ratio.
TEST(GapEnclosure, IsolatesTheAnswersOfAspectRatio5) { expect_isolated(5, 3, 1500, 1e-13); }
TEST(GapEnclosure, IsolatesTheAnswersOfAspectRatio20) { expect_isolated(20, 3, 700, 1e-12); }
TEST(GapEnclosure, IsolatesTheAnswersOfAspectRatio1000) { expect_isolated(1000, 10, 100, 1e-10); }

TEST(GapEnclosure, IsNotExceededByAnyDirection) {
  Sampler sample(20261128);
  for (int i = 0; i < 300; ++i) {
    const double aspect = i % 3 == 0 ? 3 : (i % 3 == 1 ? 30 : 1000);
    const auto [a, b] = sample.pair(aspect, 10);
    const double upper = gap_enclosure(a, b, {.most_boxes = 2000}).upper;
    const double rounding = 1e-15 * 12 * aspect;
    for (int k = 0; k < 3000; ++k) {
      ASSERT_LE(f(a, b, sample.vector()), upper + rounding) << "pair " << i;
    }
  }
}

TEST(GapEnclosure, ScalesByPowersOfTwoToTheLastBitAndGoesWithExchange) {
  Sampler sample(20261129);
  for (int i = 0; i < 100; ++i) {
    auto [a, b] = sample.pair(20, 3);
    const GapEnclosure found = gap_enclosure(a, b), exchanged = gap_enclosure(b, a);
    EXPECT_LE(found.lower, exchanged.upper);
    EXPECT_LE(exchanged.lower, found.upper);
    EXPECT_LE(exchanged.upper - exchanged.lower, 1e-12);
    for (const int power : {-500, 498}) {
      RawEllipsoid sa = a, sb = b;
      for (RawEllipsoid* e : {&sa, &sb}) {
        for (double& v : e->centre) v = std::ldexp(v, power);
        for (double& v : e->semi_axes) v = std::ldexp(v, power);
        for (double& v : e->orientation) v *= -0.25;
      }
      const GapEnclosure scaled = gap_enclosure(sa, sb);
      EXPECT_EQ(scaled.lower, std::ldexp(found.lower, power));
      EXPECT_EQ(scaled.upper, std::ldexp(found.upper, power));
    }
  }
}

TEST(GapEnclosure, LeavesTheRoundingModeAsItWas) {
  const RawEllipsoid a{{0, 0, 0}, {1, 2, 3}}, b{{1, 0, 0}, {1, 1, 1}};
  EXPECT_LT(gap_enclosure(a, b).upper, 0);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(GapEnclosure, RefusesWhatIsNoEllipsoid) {
  const RawEllipsoid good{{0, 0, 0}, {1, 2, 3}};
  EXPECT_THROW(gap_enclosure(good, {{0, 0, 0}, {1, -1, 1}}), std::invalid_argument);
  EXPECT_THROW(gap_enclosure(RawEllipsoid{{INFINITY, 0, 0}, {1, 1, 1}}, good),
               std::invalid_argument);
}

}  // namespace
}  // namespace tangency::verify
