// SPDX-License-Identifier: GPL-3.0-or-later
/// Overlap against displacement: exact values in tests/data/profiles, and the expansions with
/// bounds of the first term left out (docs/derivations/displacement-profiles.md). docs/profiles.md
/// shows the curves.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/trace_contact.hpp>
#include <tangency/verify/families/displacement.hpp>

namespace tangency {
namespace {

using verify::DisplacementContact;
using verify::Motion;

constexpr double kU = kUnitRoundoff;
constexpr double kShortOverLong = 0.7, kOverlap = 0.02;

std::vector<DisplacementContact> contacts() {
  return verify::displacement_contacts(kShortOverLong, kOverlap);
}

/// Overlap after a motion in 16 steps, the same local answer followed.
double followed(const DisplacementContact& contact, Motion motion, double amount) {
  constexpr int kSteps = 16;
  Vec3 normal = contact.normal;
  double overlap = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const Ellipsoid b = displaced(contact, motion, amount * i / kSteps);
    const Gap gap = follow_gap(contact.a, b, b.centre(), normal);
    normal = gap.normal;
    overlap = -gap.gap;
  }
  return overlap;
}

/// Of prolate spheroids with the semi-axes a, c, c: the names of the derivation.
struct Shape {
  double a = 1 / kShortOverLong, c = 1;
  double largest_radius = a * a / c;
  double rho = 2 * c * c / a;               ///< of both
  double kappa = (a * a - c * c) / c;       ///< bounds |R - h| for radii of curvature R
  double tangential = a - c;                ///< bounds the support point's tangential part
  double stiffness = 1 / (rho - kOverlap);  ///< bounds dn/ds of a translation
};

TEST(DisplacementProfile, NormalMotionHasSlopeMinusOneThroughTheTouchAndBeyond) {
  for (const DisplacementContact& contact : contacts()) {
    for (const double s : {-0.03, -0.01, 0.005, 0.02, 0.03}) {
      EXPECT_NEAR(followed(contact, Motion::normal, s), kOverlap - s, 32 * kU) << contact.name;
    }
  }
}

TEST(DisplacementProfile, TangentialMotionIsTheParabolaWithinTheBoundOfTheNextTerms) {
  const Shape e;
  const double stiffness3 = std::pow(e.stiffness, 3);
  for (const DisplacementContact& contact : contacts()) {
    const double curvature = expected_overlap(contact, Motion::tangential).curvature;
    double tilt = 0;  // tangential parts of the support points: 0 where planes of symmetry meet
    for (const Ellipsoid* body : {&contact.a, &contact.b}) {
      const Vec3 x = body->support_point(contact.normal);
      tilt += (x - x.dot(contact.normal) * contact.normal).norm();
    }
    const double third = 3 * stiffness3 * e.largest_radius * tilt / e.c;
    const double fourth = 3 * stiffness3 * (2 * e.largest_radius * e.kappa * e.stiffness / e.c + 1);
    for (const double s : {-0.2, -0.1, -0.03, 0.03, 0.1, 0.2}) {
      const double parabola = kOverlap + 0.5 * curvature * s * s;
      const double bound = third * std::pow(std::abs(s), 3) / 6 + fourth * std::pow(s, 4) / 24;
      EXPECT_NEAR(followed(contact, Motion::tangential, s), parabola, bound + 32 * kU)
          << contact.name << ' ' << s;
    }
  }
}

TEST(DisplacementProfile, RotationStartsWithTheLeverOfTheContactPoint) {
  const Shape e;
  for (const DisplacementContact& contact : contacts()) {
    const Vec3 lever = -contact.b.support_point(contact.normal);  // p_B - c_B
    const double slope = contact.normal.dot(lever.cross(contact.rotation_axis));
    EXPECT_NEAR(slope, expected_overlap(contact, Motion::rotation).slope, 1e-15);
    EXPECT_EQ(std::abs(slope) > 1e-12, contact.name == "skew");  // elsewhere there is no line
    for (const double s : {-0.1, -0.01, -0.001, 0.001, 0.01, 0.1}) {
      const double least = e.rho - kOverlap - e.tangential * std::abs(s);
      const double second =
          e.kappa + e.tangential / 2 + (e.kappa * e.kappa + e.tangential * e.tangential) / least;
      EXPECT_NEAR(followed(contact, Motion::rotation, s), kOverlap + slope * s,
                  second * s * s / 2 + 32 * kU)
          << contact.name << ' ' << s;
    }
  }
}

TEST(DisplacementProfile, ExpansionOfARotationIsRightToSecondOrder) {
  for (const DisplacementContact& contact : contacts()) {
    const auto expansion = expected_overlap(contact, Motion::rotation);
    const auto error = [&](double s) {
      return std::abs(followed(contact, Motion::rotation, s) -
                      (kOverlap + s * (expansion.slope + 0.5 * expansion.curvature * s)));
    };
    EXPECT_GE(std::log2(error(0.1) / error(0.05)), 2.8) << contact.name;  // 3, or 4 by symmetry
  }
}

// The erratum: for ellipsoids the published formula of the tangential motion is off by more than
// the true drop itself.
TEST(DisplacementProfile, PublishedTangentialFormulaIsRightForSpheresOnly) {
  const DisplacementContact side = contacts().front();
  ASSERT_EQ(side.name, "side-side");
  const double drop = kOverlap - followed(side, Motion::tangential, 0.1);
  const double published = kOverlap - published_overlap(side, Motion::tangential, 0.1);
  EXPECT_NEAR(drop, 0.00123, 5e-6);
  EXPECT_NEAR(published, 0.00252, 5e-6);
  const DisplacementContact spheres = verify::displacement_contacts(1.0, kOverlap).front();
  for (const double s : {0.01, 0.1, 0.3}) {
    EXPECT_NEAR(followed(spheres, Motion::tangential, s),
                published_overlap(spheres, Motion::tangential, s), 32 * kU);
  }
}

/// A row of tests/data/profiles/displacement.csv.
struct Golden {
  Ellipsoid a, b;
  std::string contact, motion;
  double displacement, overlap;
  std::string trace;  ///< empty: none
};

std::vector<Golden> golden_rows() {
  std::ifstream file(TANGENCY_TEST_DATA "/profiles/displacement.csv");
  std::vector<Golden> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#') || line.starts_with("a.x")) continue;
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    cells.resize(25);
    const auto body = [&](std::size_t first) {
      std::array<double, 10> v;
      for (std::size_t i = 0; i < 10; ++i) v[i] = std::stod(cells[first + i]);
      return Ellipsoid({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8], v[9]});
    };
    rows.push_back({body(0), body(10), cells[20], cells[21], std::stod(cells[22]),
                    std::stod(cells[23]), cells[24]});
  }
  return rows;
}

TEST(DisplacementProfile, CommonNormalIsTheGoldenOverlapWithinItsProvenError) {
  const std::vector<Golden> rows = golden_rows();
  ASSERT_EQ(rows.size(), 4U * 3U * 17U);
  for (const Golden& row : rows) {
    const Gap gap = signed_gap(row.a, row.b);
    EXPECT_NEAR(-gap.gap, row.overlap, gap.gap_error + kU * std::abs(row.overlap));
    EXPECT_LE(gap.gap_error, 1e-14);
  }
}

TEST(DisplacementProfile, TraceIsTheGoldenDepthAndNothingWhereTheBodiesAreApart) {
  int answers = 0;
  for (const Golden& row : golden_rows()) {
    const TraceContact trace = trace_contact(row.a, row.b);
    EXPECT_EQ(trace.status == TraceStatus::ok, !row.trace.empty());
    EXPECT_EQ(trace.status == TraceStatus::ok, row.overlap > 0);
    if (row.trace.empty()) continue;
    ++answers;
    EXPECT_NEAR(-trace.gap, std::stod(row.trace), 1e-13);
  }
  EXPECT_GT(answers, 100);
}

}  // namespace
}  // namespace tangency
