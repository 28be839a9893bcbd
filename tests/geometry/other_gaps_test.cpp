// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/oracles/perram_wertheim.hpp>

namespace tangency {
namespace {

using verify::Real;
using verify::Real3;
using verify::to_ellipsoid;

constexpr double kU = kUnitRoundoff;
constexpr std::uint64_t kSeed = 20261122;
constexpr int kPairs = 16;  // of each family
constexpr double kOfSize = 0x1p-6;

using Definition = OtherGap (*)(const Ellipsoid&, const Ellipsoid&) noexcept;
constexpr std::array<Definition, 2> kDefinitions{perram_wertheim_gap, midpoint_potential_gap};

double size_of(const Ellipsoid& a, const Ellipsoid& b) {
  return (b.centre() - a.centre()).stableNorm() + a.largest_semi_axis() + b.largest_semi_axis();
}

double distance(const Vec3& v, const Real3& truth) {
  Real square = 0;
  for (int i = 0; i < 3; ++i) {
    const Real off = Real(v[i]) - truth[static_cast<std::size_t>(i)];
    square += off * off;
  }
  return static_cast<double>(Real(sqrt(square)));
}

double difference(double value, const Real& truth) {
  return static_cast<double>(Real(abs(Real(value) - truth)));
}

TEST(OtherGaps, OfTwoSpheresAreTheirDistanceAlongTheLineOfCentres) {
  for (const auto& find : kDefinitions) {
    const OtherGap found =
        find(Ellipsoid({1, 1, 1}, {1, 1, 1}, {1, 2, 3, 4}), Ellipsoid({4, 5, 1}, {2, 2, 2}));
    ASSERT_EQ(found.status, OtherGapStatus::ok);
    EXPECT_EQ(found.gap, 2);
    EXPECT_LE((found.normal - Vec3(0.6, 0.8, 0)).norm(), 2 * kU);
    EXPECT_LE((found.arm_a - Vec3(0.6, 0.8, 0)).norm(), 2 * kU);
    EXPECT_LE((found.arm_b - Vec3(-1.2, -1.6, 0)).norm(), 4 * kU);
  }
}

TEST(OtherGaps, OnACommonAxisAreTheSignedGap) {
  const Ellipsoid a({0, 0, 0}, {1, 3, 2});
  for (const double z : {5.5, 4.5, 0.25}) {
    for (const auto& find : kDefinitions) {
      const OtherGap found = find(a, Ellipsoid({0, 0, z}, {4, 1, 3}));
      EXPECT_EQ(found.gap, z - 5);
      EXPECT_EQ(found.normal, Vec3(0, 0, 1));
      EXPECT_EQ(found.arm_a, Vec3(0, 0, 2));
      EXPECT_EQ(found.arm_b, Vec3(0, 0, -3));
    }
  }
}

TEST(OtherGaps, AreFoundWhereTheRatioOfSupportsIsTheGreatestPossible) {
  // A's longest axis meets B's shortest, so that s/(1-s) is at the end of its range.
  const Ellipsoid a({0, 0, 0}, {0.2, 0.3, 0.43}), ball({0, 0, -1.46}, {2.73, 2.73, 2.73});
  for (const auto& find : kDefinitions) {
    const OtherGap found = find(a, ball);
    EXPECT_EQ(found.normal, Vec3(0, 0, -1));
    EXPECT_NEAR(found.gap, 1.46 - 0.43 - 2.73, 2 * kU);
    EXPECT_NEAR(found.arm_a[2], -0.43, kU);
    EXPECT_NEAR(found.arm_b[2], 2.73, 2 * kU);
  }
}

TEST(OtherGaps, OfEqualParallelBodiesAreThoseOfHalfWayBetweenThem) {
  // s = 1/2, v = M^-1 d = (1/2, 2, 0) s, F = d'v / 4 s^2 for d = s (2, 2, 0).
  for (const double s : {1.0, 0.75}) {
    const Vec3 axes(2, 1, 1), d = s * Vec3(2, 2, 0), n = Vec3(1, 4, 0) / std::sqrt(17.0);
    const double level = 1.25 * s * s;
    const OtherGap planes = perram_wertheim_gap(Ellipsoid({0, 0, 0}, axes), Ellipsoid(d, axes));
    EXPECT_NEAR(planes.gap, (1 - 1 / std::sqrt(level)) * 10 * s / std::sqrt(17.0), 8 * kU);
    EXPECT_LE((planes.normal - n).norm(), 2 * kU);
    const OtherGap midpoint =
        midpoint_potential_gap(Ellipsoid({0, 0, 0}, axes), Ellipsoid(d, axes));
    // (d/2 + t n)' M^-1 (d/2 + t n) = 1, and as much on the other side.
    const double square = 65.0 / 68.0, slope = s * std::sqrt(17.0) / 4;
    const double t = (std::sqrt(slope * slope + square * (1 - level)) - slope) / square;
    EXPECT_NEAR(midpoint.gap, -2 * t, 8 * kU);
    EXPECT_LE((midpoint.arm_a - (0.5 * d + t * n)).norm(), 8 * kU);
    EXPECT_LE((midpoint.arm_a + midpoint.arm_b).norm(), 8 * kU);
  }
}

TEST(OtherGaps, AreNotApplicableToCoincidingCentres) {
  for (const auto& find : kDefinitions) {
    const OtherGap found = find(Ellipsoid({1, 2, 3}, {1, 1, 1}), Ellipsoid({1, 2, 3}, {1, 2, 3}));
    EXPECT_EQ(found.status, OtherGapStatus::not_applicable);
    EXPECT_EQ(found.gap, 0);
    EXPECT_EQ(found.gap_error, 0);
  }
}

TEST(OtherGaps, AreApplicableToCentresAsNearAsDoublesTell) {
  const Ellipsoid a({0, 0, 0}, {2, 3, 4}), b({0, 0, 0x1p-1074}, {1e100, 2e100, 1e100});
  for (const auto& find : kDefinitions) {
    EXPECT_EQ(find(a, b).status, OtherGapStatus::ok);
    EXPECT_EQ(find(a, b).normal, Vec3(0, 0, 1));
    EXPECT_EQ(find(a, b).gap, -1e100);
  }
}

TEST(OtherGaps, MidpointPotentialIsNotApplicableWhereTheLineMissesABody) {
  const Ellipsoid disc({0, 0, 0}, {10, 10, 1}), ball({100, 0, 30}, {1, 1, 1});
  EXPECT_EQ(midpoint_potential_gap(disc, ball).status, OtherGapStatus::not_applicable);
  EXPECT_EQ(midpoint_potential_gap(ball, disc).status, OtherGapStatus::not_applicable);
  EXPECT_EQ(perram_wertheim_gap(disc, ball).status, OtherGapStatus::ok);
}

TEST(OtherGaps, TakeAGivenSeparationForThatOfTheCentres) {
  const Ellipsoid a({0, 0, 0}, {1, 2, 3}), b({3, 1, 2}, {3, 2, 1}, {1, 2, 3, 4});
  const Ellipsoid elsewhere = b.moved_to({-7, 0, 1});
  EXPECT_EQ(perram_wertheim_gap(a, elsewhere, b.centre()).gap, perram_wertheim_gap(a, b).gap);
  EXPECT_EQ(midpoint_potential_gap(a, elsewhere, b.centre()).gap, midpoint_potential_gap(a, b).gap);
}

TEST(OtherGaps, EndTheProcessWithALineAtASeparationThatIsNotFinite) {
  const Ellipsoid e({0, 0, 0}, {1, 2, 3});
  const Vec3 bad(0, 0, std::numeric_limits<double>::infinity());
  EXPECT_DEATH((void)perram_wertheim_gap(e, e, bad),
               "tangency: perram_wertheim_gap: separation = .0, 0, inf");
  EXPECT_DEATH((void)midpoint_potential_gap(e, e, bad), "tangency: midpoint_potential_gap: sep");
  EXPECT_DEATH((void)perram_wertheim_factor(e, e, bad), "tangency: perram_wertheim_factor: sep");
}

// geometry/other_gaps.hpp (4)
TEST(OtherGaps, DifferFromTheSignedGapByItsSquare) {
  verify::ManufacturedContacts contacts(verify::contact_classes()[1], kSeed);
  double largest = 0;
  for (int i = 0; i < 100; ++i) {
    const auto contact = contacts.next();
    const Ellipsoid a = to_ellipsoid(contact.a), b = to_ellipsoid(contact.b);
    const Vec3 normal(contact.normal.data());
    const double rho = a.least_radius() + b.least_radius();
    // The gap is 1/100 and 1/1000 of rho, of either sign.
    const auto off = [&](const auto& find, double share) {
      const double way = share * rho - contact.gap;
      const Ellipsoid there = b.moved_to(b.centre() + way * normal);
      return std::abs(find(a, there).gap - signed_gap(a, there).gap) / rho;
    };
    for (const auto& find : kDefinitions) {
      for (const double sign : {1.0, -1.0}) {
        const double far = off(find, sign * 1e-2), near = off(find, sign * 1e-3);
        EXPECT_LE(near, 0.02 * far + 1e-12) << i;
        largest = std::max(largest, far / 1e-4);
      }
    }
  }
  std::printf("differences to %.2f gap^2 / rho\n", largest);
  EXPECT_LE(largest, 1);
}

/// Of F and of its root, over their errors.
double factor_ratio(const Ellipsoid& a, const Ellipsoid& b,
                    const verify::PerramWertheimTruth& truth) {
  const PerramWertheimFactor found = perram_wertheim_factor(a, b);
  EXPECT_EQ(found.status, OtherGapStatus::ok);
  const Real& level = truth.contact_function;
  return std::max(difference(found.factor, level) / found.factor_error,
                  difference(found.scale, Real(sqrt(level))) / found.scale_error);
}

/// Largest errors in units of what is promised: u of each number + u L / 64, 8 u for the normal.
struct Errors {
  double gap = 0, normal = 0, arms = 0;
  double certificate = 0;  ///< of the gap over gap_error
  double widest = 0;       ///< gap_error over what is promised of it

  void add(const OtherGap& found, const verify::DefinedGap& truth, double size) {
    const auto promised = [&](double value) { return kU * (value + kOfSize * size); };
    const double off = difference(found.gap, truth.gap), allowed = promised(std::abs(found.gap));
    gap = std::max(gap, off / allowed);
    certificate = std::max(certificate, off / found.gap_error);
    widest = std::max(widest, found.gap_error / (1.01 * allowed + 0x1p-1072));
    normal = std::max(normal, distance(found.normal, truth.normal) / (8 * kU));
    arms = std::max({arms, distance(found.arm_a, truth.arm_a) / promised(found.arm_a.stableNorm()),
                     distance(found.arm_b, truth.arm_b) / promised(found.arm_b.stableNorm())});
  }
};

/// Both definitions of one pair, which has an answer by the first, against 100 digits.
void hold_against_oracle(const Ellipsoid& a, const Ellipsoid& b) {
  const auto truth = verify::perram_wertheim(verify::to_raw(a), verify::to_raw(b));
  ASSERT_TRUE(truth.has_value());
  const OtherGap planes = perram_wertheim_gap(a, b), midpoint = midpoint_potential_gap(a, b);
  ASSERT_EQ(planes.status, OtherGapStatus::ok);
  ASSERT_EQ(midpoint.status, truth->midpoint ? OtherGapStatus::ok : OtherGapStatus::not_applicable);
  Errors errors;
  errors.add(planes, truth->tangent_planes, size_of(a, b));
  if (truth->midpoint) errors.add(midpoint, *truth->midpoint, size_of(a, b));
  EXPECT_LE(factor_ratio(a, b, *truth), 1);
  EXPECT_LE(errors.gap, 1);
  EXPECT_LE(errors.certificate, 1);
  EXPECT_LE(errors.widest, 1);
  EXPECT_LE(errors.normal, 1);
  EXPECT_LE(errors.arms, 1);
}

TEST(OtherGaps, OfFlatFacesManyThicknessesApartAreRight) {
  // The discriminant of the midpoint's line is 1e-16 of its terms as they are usually written.
  for (const double thickness : {1e-5, 1e-6, 1e-7, 1e-8, 1e-12, 1e-15}) {
    SCOPED_TRACE(thickness);
    const Eigen::Quaterniond q(0.9, 0.1, 0.2, 0.3);
    const Ellipsoid a({0, 0, 0}, {1, 1, thickness}, q);
    hold_against_oracle(a, Ellipsoid(2 * a.rotation().col(2), {2, 2, 2 * thickness}, q));
  }
  // Was off by 3e7 times the bound, with status ok.
  const Eigen::Quaterniond q(0x1.9160f4cd9ee82p-1, -0x1.3fc6dfd057a28p-3, -0x1.7530ad53f47e8p-2,
                             -0x1.2c7e324abf4bcp-2);
  constexpr double r = 0x1.cac851c693b4dp+0, s = 0x1.77eb67ccaa501p+1;
  hold_against_oracle(
      Ellipsoid({0, 0, 0}, {r, r, 0x1.839a46c14d37fp-26}, q),
      Ellipsoid({0x1.0dfde276bb91ep+1, -0x1.022365ec248b7p+1, -0x1.31d8d99137544p+1},
                {s, s, 0x1.3d9888d5d1c1ap-25}, q));
}

TEST(OtherGaps, OfNearlyConcentricThinPairsAreRight) {
  // Was off by 3.9 times the bound: rounding of the shapes' sum times its condition.
  hold_against_oracle(
      Ellipsoid(
          {0, 0, 0}, {0x1.799f6dc1d1774p+2, 0x1.48dc376ef477fp-7, 0x1.fad631fdc07eep-25},
          {0x1.5dea88f7570fdp-2, -0x1.73185e203c26fp+0, 0x1.b8b76902d0be3p+0, 0x1.13cc06c32499p+0}),
      Ellipsoid({-0x1.2f5faf96089cfp-19, 0x1.1176fc0b2fea3p-19, -0x1.b06903be29646p-20},
                {0x1.ab5331a55e445p+0, 0x1.1ec5df35ef531p-26, 0x1.1ec5df35ef531p-26},
                {0x1.47b11a653d7f7p+0, 0x1.c13f2a9d89693p-3, 0x1.0e3de1631737ap+1,
                 0x1.e342297524b05p+0}));
}

TEST(OtherGaps, SayThatTheLineMissesTwoDiscsThatItMissesByLittle) {
  // Was answered as if the line met both.
  const Eigen::Quaterniond q(-0x1.53132ed15a45ap-2, 0x1.ed8fb63344ae1p+0, -0x1.97e85a19ca51ap-2,
                             0x1.74508bb4fa2b6p-2);
  constexpr double r = 0x1.db84f3758c184p-3, s = 0x1.3ca412c950052p+3;
  const Ellipsoid a({0, 0, 0}, {r, r, 0x1.91be2652a1a41p-29}, q);
  const Ellipsoid b({-0x1.3d97e949882a5p+8, 0x1.dc55e4f4fc2a4p+8, 0x1.850a724efd151p+10},
                    {s, s, 0x1.0b83a59fe01a7p-23}, q);
  hold_against_oracle(a, b);
  EXPECT_EQ(midpoint_potential_gap(a, b).status, OtherGapStatus::not_applicable);
}

TEST(OtherGaps, MidpointPotentialIsUnknownOnlyWhereTheLineTouchesABody) {
  // The line through the point half way, d / 2, along M^-1 d touches both bodies exactly.
  const Vec3 axes(90, 45, 45), d(510, 34, 0);
  const auto with = [&](double y) {
    return midpoint_potential_gap(Ellipsoid({0, 0, 0}, axes), Ellipsoid({d[0], y, d[2]}, axes));
  };
  EXPECT_EQ(with(d[1]).status, OtherGapStatus::not_converged);
  EXPECT_EQ(with(d[1]).gap, 0);
  const double less = std::nextafter(d[1], 0.0), more = std::nextafter(d[1], 35.0);
  EXPECT_EQ(with(less).status, OtherGapStatus::ok);
  EXPECT_EQ(with(more).status, OtherGapStatus::not_applicable);
  EXPECT_EQ(perram_wertheim_gap(Ellipsoid({0, 0, 0}, axes), Ellipsoid(d, axes)).status,
            OtherGapStatus::ok);
}

TEST(OtherGaps, AreRightOrSaidToBeUnknownAtEveryAspectRatio) {
  // Equal discs one above the other, so that the gap is known in closed form.
  int known = 0, unknown = 0;
  for (int power = 1; power <= 1000; power += power < 100 ? 9 : 50) {
    const double thickness = std::exp2(-power);
    const Ellipsoid a({0, 0, 0}, {1, 1, thickness}, {1, 2, 3, 4});
    // R of (1, 2, 3, 4) has the last column (22, 20, 4) / 30.
    const Ellipsoid b({11, 10, 2}, {1, 1, thickness}, {1, 2, 3, 4});
    for (const auto& find : kDefinitions) {
      const OtherGap found = find(a, b);
      ++(found.status == OtherGapStatus::ok ? known : unknown);
      if (found.status != OtherGapStatus::ok) {
        EXPECT_EQ(found.status, OtherGapStatus::not_converged) << power;
        EXPECT_GT(power, 80) << "an aspect ratio of 1e24";
        continue;
      }
      EXPECT_NEAR(found.gap, 15 - 2 * thickness, 16 * kU) << power;
      EXPECT_LE((found.normal - Vec3(11, 10, 2) / 15).norm(), 4 * kU) << power;
    }
  }
  EXPECT_GT(known, 20);
  EXPECT_GT(unknown, 20);
}

TEST(OtherGaps, AreRightInEveryRoundingModeAndWithSubnormalsFlushed) {
  verify::ManufacturedContacts contacts(verify::contact_classes()[1], kSeed);
  for (int i = 0; i < 4; ++i) {
    const auto contact = contacts.next();
    const Ellipsoid a = to_ellipsoid(contact.a), b = to_ellipsoid(contact.b);
    for (const auto& find : kDefinitions) {
      const OtherGap right = find(a, b);
      for (const auto& environment : testing::all_environments()) {
        const OtherGap found = [&] {
          const testing::EnvironmentGuard guard(environment);
          return find(a, b);
        }();
        EXPECT_EQ(found.status, right.status) << environment.name;
        EXPECT_NEAR(found.gap, right.gap, kU * kOfSize * size_of(a, b)) << environment.name;
        EXPECT_EQ(found.gap_error, right.gap_error) << environment.name;
        EXPECT_LE((found.normal - right.normal).norm(), 2 * kU) << environment.name;
        EXPECT_LE((found.arm_a - right.arm_a).norm(), 2 * kU * a.largest_semi_axis());
      }
    }
  }
}

/// Both definitions of every pair that next() draws against 100 digits.
template <class Next>
void hold_against_oracle(const std::string& family, const Next& next) {
  Errors planes, midpoint;
  double factor = 0;
  int along = 0;
  for (int i = 0; i < kPairs; ++i) {
    const auto pair = next();
    const Ellipsoid a = to_ellipsoid(pair.a), b = to_ellipsoid(pair.b);
    const auto truth = verify::perram_wertheim(pair.a, pair.b);
    const OtherGap tangent_planes = perram_wertheim_gap(a, b);
    const OtherGap on_the_line = midpoint_potential_gap(a, b);
    if (!truth) {
      EXPECT_EQ(tangent_planes.status, OtherGapStatus::not_applicable);
      EXPECT_EQ(on_the_line.status, OtherGapStatus::not_applicable);
      continue;
    }
    ASSERT_EQ(tangent_planes.status, OtherGapStatus::ok) << family << ' ' << i;
    planes.add(tangent_planes, truth->tangent_planes, size_of(a, b));
    factor = std::max(factor, factor_ratio(a, b, *truth));
    ASSERT_EQ(on_the_line.status == OtherGapStatus::ok, truth->midpoint.has_value())
        << family << ' ' << i;
    if (!truth->midpoint) continue;
    ++along;
    midpoint.add(on_the_line, *truth->midpoint, size_of(a, b));
  }
  std::printf(
      "%-28s tangent planes: gap %.2f normal %.2f arms %.2f; midpoint (%d pairs): "
      "gap %.2f arms %.2f; F %.2f of what is promised; gaps %.2f and %.2f of gap_error\n",
      family.c_str(), planes.gap, planes.normal, planes.arms, along, midpoint.gap, midpoint.arms,
      factor, planes.certificate, midpoint.certificate);
  EXPECT_LE(factor, 1) << family;
  for (const Errors& errors : {planes, midpoint}) {
    EXPECT_LE(errors.gap, 1) << family;
    EXPECT_LE(errors.certificate, 1) << family;
    EXPECT_LE(errors.widest, 1) << family;
    EXPECT_LE(errors.normal, 1) << family;
    EXPECT_LE(errors.arms, 1) << family;
  }
}

TEST(OtherGaps, OrdinaryContactsAreWhatTheOracleSaysToRounding) {
  for (const auto& family : verify::contact_classes()) {
    verify::ManufacturedContacts contacts(family, kSeed);
    hold_against_oracle(family.name, [&] { return contacts.next(); });
  }
}

TEST(OtherGaps, ExtremePairsAreWhatTheOracleSaysToRounding) {
  for (const auto& family : verify::extreme_families()) {
    verify::ExtremePairs pairs(family, kSeed);
    hold_against_oracle(family.name, [&] { return pairs.next(); });
  }
}

TEST(OtherGaps, DeepPairsAreWhatTheOracleSaysToRounding) {
  for (const auto& family : verify::deep_families()) {
    verify::DeepPairs pairs(family, kSeed);
    hold_against_oracle(family.name, [&] { return pairs.next(); });
  }
}

}  // namespace
}  // namespace tangency
