// SPDX-License-Identifier: GPL-3.0-or-later
/// Cases that others published or asked about, from the shell: bodies by covariance and precision
/// matrices, ellipses by conics.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/geometry/vectors.hpp>
#include <tangency/tests/tool/process.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::testing {
namespace {

using Cells = std::vector<std::string>;

/// The rows of a table, without its header, in cells.
std::vector<Cells> rows_of(const std::string& table) {
  std::vector<Cells> rows;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back(1);
    for (const char c : line) {
      if (c == ',') {
        rows.back().emplace_back();
      } else {
        rows.back().back() += c;
      }
    }
  }
  return rows;
}

std::vector<Cells> answers(const std::vector<std::string>& arguments, const std::string& input) {
  const Finished run = run_tool(arguments, input);
  EXPECT_EQ(run.status, 0) << run.err;
  return rows_of(run.out);
}

double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

// (a) Covariances that are proportional but for 1e-12, and for what rounding does to each entry.

using Entries = std::array<double, 6>;  // xx, yy, zz, xy, yz, zx

/// The same in every standard library.
double uniform(std::mt19937_64& source, double low, double high) {
  return low + (high - low) * (static_cast<double>(source() >> 11) * 0x1p-53);
}

/// With semi-axes 1 to `aspect`, turned at random.
Entries drawn_covariance(std::mt19937_64& source, double aspect) {
  const double w = uniform(source, 0.1, 1), x = uniform(source, -1, 1);
  const double y = uniform(source, -1, 1), z = uniform(source, -1, 1);
  const Mat3 r = Quaternion(w, x, y, z).normalized().toRotationMatrix();
  const Vec3 axes(1, std::pow(aspect, uniform(source, 0, 1)), aspect);
  const Mat3 m = r * axes.cwiseAbs2().asDiagonal() * r.transpose();
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}

std::string listed(const Entries& m) {
  std::string text = "0,0,0";
  for (const double entry : m) {
    std::array<char, 40> cell;
    std::snprintf(cell.data(), cell.size(), ",%a", entry);
    text += cell.data();
  }
  return text;
}

/// The ellipsoids x' M x <= 1 of two matrices, as the oracle of quadrics sees them.
verify::ExactRelation of_precisions(const Entries& a, const Entries& b) {
  const auto raw = [](const Entries& m) {
    return verify::RawQuadric{m[0], m[1], m[2], m[3], m[4], m[5], 0, 0, 0, -1};
  };
  return verify::exact_relation_by_pencil(raw(a), raw(b));
}

/// Those of x' M^-1 x <= 1 are the polar bodies, whose inclusions are the other way round.
verify::ExactRelation of_covariances(const Entries& a, const Entries& b) {
  return of_precisions(b, a);
}

std::string expected(const verify::ExactRelation& truth) {
  const char* inner = truth.inner == verify::Inner::none ? ""
                      : truth.inner == verify::Inner::a  ? "a"
                                                         : "b";
  return std::string(verify::name(truth.relation)) + ' ' + inner;
}

/// Proportional pairs, each nearer or farther than t = 1.
struct Proportional {
  Entries a, b;
};
std::vector<Proportional> proportional_pairs() {
  std::mt19937_64 source(20261130);
  std::vector<Proportional> pairs;
  for (int k = 0; k < 60; ++k) {
    const Entries a = drawn_covariance(source, std::pow(10.0, k % 7));
    const double t = k % 3 == 0 ? 1 - 1e-12 : k % 3 == 1 ? 1 + 1e-12 : 1;
    Entries b = a;
    for (double& entry : b) entry *= t * t;
    pairs.push_back({a, b});
  }
  return pairs;
}

TEST(PublicCases, ProportionalMatricesLieAsTheirRoundedEntriesDo) {
  const std::vector<Proportional> pairs = proportional_pairs();
  for (const std::string form : {"m", "p"}) {
    std::string table = "a.x,a.y,a.z";
    for (const char* body : {"a", "b"}) {
      if (body[0] == 'b') table += ",b.x,b.y,b.z";
      for (const char* entry : {"xx", "yy", "zz", "xy", "yz", "zx"}) {
        table += std::string(",") + body + '.' + form + '.' + entry;
      }
    }
    table += '\n';
    for (const Proportional& pair : pairs) table += listed(pair.a) + ',' + listed(pair.b) + '\n';
    const std::vector<Cells> rows = answers({"contact"}, table);
    ASSERT_EQ(rows.size(), pairs.size());
    std::set<std::string> seen;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto& [a, b] = pairs[k];
      const std::string truth = expected(form == "m" ? of_covariances(a, b) : of_precisions(a, b));
      EXPECT_EQ(rows[k][1] + ' ' + rows[k][14], truth) << form << ", row " << k;
      EXPECT_LT(number(rows[k][2]), 0) << form << ", row " << k;
      seen.insert(rows[k][1]);
    }
    // Rounding makes an overlap of what is nested but for it.
    for (const char* relation : {"a_in_b", "b_in_a", "equal", "overlap"}) {
      EXPECT_TRUE(seen.contains(relation)) << form << ": " << relation;
    }
  }
}

// (b) An ellipse of semi-axes 10 and 5 along (3, 4) and a circle of radius 5 that touches its tip:
// 73 x^2 - 72 xy + 52 y^2 = 2500 and (x - 9)^2 + (y - 12)^2 = 25.

const std::string kConics = "a.A,a.B,a.C,a.D,a.E,a.F,b.A,b.B,b.C,b.D,b.E,b.F\n";
const std::string kFull = "73,-72,52,0,0,-2500,1,0,1,-18,-24,";
const std::string kHalf = "73,-36,52,0,0,-2500,1,0,1,-9,-12,";

TEST(PublicCases, ConicsTouchExactlyAndNoLongerOneUnitFurther) {
  const std::string last[] = {"200\n", "0x1.9000000000001p7\n", "0x1.8ffffffffffffp7\n"};
  for (const bool half : {false, true}) {
    std::string table = kConics;
    for (const std::string& f : last) table += (half ? kHalf : kFull) + f;
    const std::vector<Cells> rows =
        answers({"ellipse", "--mixed-terms", half ? "half" : "full"}, table);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0][1] + ' ' + rows[0][2], "external_touch 1");
    EXPECT_EQ(rows[1][1] + ' ' + rows[1][2], "separate 0");
    EXPECT_EQ(rows[2][1] + ' ' + rows[2][2], "overlap 2");
    EXPECT_EQ(number(rows[0][4]), 0);
    EXPECT_NEAR(number(rows[0][5]), 0.6, 1e-15);
    EXPECT_NEAR(number(rows[0][6]), 0.8, 1e-15);
  }
}

TEST(PublicCases, AFactorAndASignOfAConicChangeNothing) {
  const std::vector<Cells> rows = answers(
      {"ellipse"}, kConics + kFull + "200\n" + "-146,144,-104,0,0,5000,3,0,3,-54,-72,600\n");
  EXPECT_EQ(Cells(rows.at(0).begin() + 1, rows[0].end()),
            Cells(rows.at(1).begin() + 1, rows[1].end()));
}

// Read in the other convention the same numbers are other ellipses, or none.
TEST(PublicCases, ConicsAreReadInFullUnlessHalfIsAskedFor) {
  EXPECT_EQ(answers({"ellipse"}, kConics + kFull + "200\n"),
            answers({"ellipse", "--mixed-terms", "full"}, kConics + kFull + "200\n"));
  EXPECT_EQ(answers({"ellipse", "--points"}, kConics + kFull + "180\n"),
            answers({"ellipse", "--points", "--mixed-terms", "half"}, kConics + kHalf + "180\n"));
  EXPECT_EQ(answers({"ellipse"}, kConics + kHalf + "56.24\n")[0][1], "b_in_a");
  EXPECT_EQ(answers({"ellipse", "--mixed-terms", "half"}, kConics + kHalf + "56.24\n")[0][1],
            "overlap");
  const std::string point = "a.A,a.B,a.C,a.D,a.E,a.F,p.x,p.y\n";
  EXPECT_EQ(
      answers({"ellipse-point", "--mixed-terms", "half"}, point + "73,-36,52,0,0,-2500,9,12\n"),
      answers({"ellipse-point"}, point + "73,-72,52,0,0,-2500,9,12\n"));
  const std::string help = run_tool({"ellipse", "--help"}).out;
  for (const char* words : {"2B xy", " B xy", "full (default)", "--mixed-terms half"}) {
    EXPECT_NE(help.find(words), std::string::npos) << words;
  }
}

// (c) Two ellipses by precision matrices. The gaps: the maximum of n.d - h_A(n) - h_B(n) over unit
// n by Newton's method in 60 digits, of which 13 stand here.

TEST(PublicCases, EllipsesByPrecisionMatricesAreNestedOverlapOrAreApart) {
  const std::string a = ",4,6,.5,", b = ",.4,.5,-.1\n";
  const std::vector<Cells> rows =
      answers({"ellipse"},
              "a.x,a.y,a.p.xx,a.p.yy,a.p.xy,b.x,b.y,b.p.xx,b.p.yy,b.p.xy\n"
              "1.5,1.5" +
                  a + "1.6,1.4" + b +  //
                  "0,0" + a + "1.49,1.49" + b + "0,0" + a + "1.5,1.5" + b);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0][1], "a_in_b");
  EXPECT_EQ(rows[1][1], "overlap");
  EXPECT_NEAR(number(rows[1][4]), -0.009689202661867, 1e-15);
  EXPECT_EQ(rows[2][1], "separate");
  EXPECT_NEAR(number(rows[2][4]), 0.004283783103824, 1e-15);
}

// (d) A disc whose axis is z and a needle along x, which is turned from z: F = mu^2.

TEST(PublicCases, TheFactorOfADiscAndANeedleIsThePublishedOne) {
  const std::vector<Cells> rows =
      answers({"contact", "--columns", "F,mu,F_error"},
              "a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b.qz\n"
              "0,0,0,10,10,.1,.7,-.7,1.1,.5,.5,5,1,0,1,0\n");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_NEAR(number(rows[0][15]), 3.36270604063863, 5e-15);
  EXPECT_NEAR(number(rows[0][16]), std::sqrt(3.36270604063863), 2e-15);
  EXPECT_LE(number(rows[0][17]), 1e-15);
}

// (e) Parallel ellipses about one centre. The clearance: the minimum of h_A(n) - h_B(n) by thirds
// in 50 digits. It is not on an axis.

TEST(PublicCases, AnEllipseInAnotherHasItsGapClearanceAndMargin) {
  const std::vector<Cells> rows =
      answers({"ellipse", "--columns", "clearance,clearance_error,margin,margin_error"},
              "a.x,a.y,a.r1,a.r2,a.angle,b.x,b.y,b.r1,b.r2,b.angle\n0,0,3,1,0,0,0,5,2.5,0\n");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0][1], "a_in_b");
  EXPECT_EQ(number(rows[0][4]), -3.5);
  EXPECT_NEAR(number(rows[0][13]), 1.4965237496723305, 1e-15);
  EXPECT_LE(number(rows[0][14]), 1e-15);
  EXPECT_EQ(number(rows[0][15]), 5.0 / 3.0);
  EXPECT_LE(number(rows[0][16]), 1e-15);
}

}  // namespace
}  // namespace tangency::testing
