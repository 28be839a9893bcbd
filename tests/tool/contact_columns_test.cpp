// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency contact --columns` from outside.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
namespace {

using Cells = std::vector<std::string>;

const std::string kHeader = "a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3\n";
const std::string kDiscAndNeedle = "0,0,0,10,10,.1,.7,-.7,1.1,5,.5,.5\n";
const std::string kConcentric = "0,0,0,1,2,3,0,0,0,2,3,4\n";

/// Line `i` of a table, 0 for the header, in cells.
Cells cells_of(const std::string& table, std::size_t i) {
  std::istringstream lines(table);
  std::string line;
  for (std::size_t k = 0; k <= i; ++k) std::getline(lines, line);
  Cells cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

TEST(ContactColumns, StandAtTheEndInTheOrderOfTheirNames) {
  const std::string text = kHeader + kDiscAndNeedle;
  const Finished usual = run_tool({"contact"}, text);
  const Finished run = run_tool({"contact", "--columns", "F_error,curvature_max,F"}, text);
  EXPECT_EQ(run.status, 0) << run.err;
  const Cells names = cells_of(run.out, 0), row = cells_of(run.out, 1);
  const Cells usual_row = cells_of(usual.out, 1);
  ASSERT_EQ(names.size(), 18U);
  ASSERT_EQ(row.size(), 18U);
  EXPECT_EQ(Cells(names.begin() + 15, names.end()), (Cells{"F_error", "curvature_max", "F"}));
  EXPECT_EQ(Cells(row.begin(), row.begin() + 15), usual_row);
  const Ellipsoid disc({0, 0, 0}, {10, 10, 0.1}), needle({0.7, -0.7, 1.1}, {5, 0.5, 0.5});
  const PerramWertheimFactor factor = perram_wertheim_factor(disc, needle);
  EXPECT_EQ(number(row[15]), factor.factor_error);
  EXPECT_EQ(number(row[17]), factor.factor);
  const Vec3 normal(number(row[3]), number(row[4]), number(row[5]));
  EXPECT_EQ(number(row[16]), contact_curvature(disc, needle, normal).relative.curvature[0]);
}

TEST(ContactColumns, OfADiscAndANeedleIncludeThePublishedFactor) {
  const std::string text = kHeader + kDiscAndNeedle;
  const Cells row = cells_of(run_tool({"contact", "--columns", "F,mu"}, text).out, 1);
  ASSERT_EQ(row.size(), 17U);
  EXPECT_NEAR(number(row[15]), 3.36270604063863, 5e-15);
  EXPECT_NEAR(number(row[16]) * number(row[16]), 3.36270604063863, 5e-15);
}

TEST(ContactColumns, OfDerivativesAreThoseOfTheLibraryByEveryMethodAndEmptyWhereNormalsTie) {
  const std::string text = kHeader + kDiscAndNeedle + kConcentric;
  const Ellipsoid disc({0, 0, 0}, {10, 10, 0.1}), needle({0.7, -0.7, 1.1}, {5, 0.5, 0.5});
  const GapDerivatives found = gap_derivatives(disc, needle, signed_gap(disc, needle));
  const std::string names = "dgap.a.x,dgap.a.wz,dgap.a.r3,dgap.b.y,dgap.b.wx,dgap.b.r1";
  const std::array<int, 6> places{0, 5, 8, 10, 12, 15};
  for (const char* method : {"common-normal", "perram-wertheim"}) {
    const std::string out = run_tool({"contact", "--method", method, "--columns", names}, text).out;
    const Cells row = cells_of(out, 1), tied = cells_of(out, 2);
    ASSERT_EQ(row.size(), 21U);
    for (std::size_t k = 0; k < places.size(); ++k) {
      EXPECT_NEAR(number(row[15 + k]), found.gradient[places[k]], 1e-12) << names << k;
    }
    EXPECT_EQ(Cells(tied.begin() + 15, tied.end()), Cells(6));
  }
}

TEST(ContactColumns, OfDerivativesBySemiAxesAreEmptyForABodyByAMatrix) {
  const std::string text =
      "a.x,a.y,a.z,a.m.xx,a.m.yy,a.m.zz,a.m.xy,a.m.yz,a.m.zx,b.x,b.y,b.z,b.r1,b.r2,b.r3\n"
      "0,0,0,2,1,1,0,0,0,4,0,0,1,1,1\n";
  const std::string names = "dgap.a.r1,dgap.b.r1,dgap.a.x";
  const Cells row = cells_of(run_tool({"contact", "--columns", names}, text).out, 1);
  ASSERT_EQ(row.size(), 18U);
  EXPECT_EQ(row[15], "");
  EXPECT_EQ(number(row[16]), -1);
  EXPECT_EQ(number(row[17]), -1);
}

TEST(ContactColumns, AreEmptyWhereTheRowHasNoSuchNumber) {
  // No normal by this method; F is 0 whatever the method. The second F overflows, mu does not.
  const std::string text = kHeader + kConcentric + "0,0,0,1,1,1,1e200,0,0,3,1,1\n";
  const Finished run = run_tool({"contact", "--method", "perram-wertheim", "--columns",
                                 "F,mu,F_error,curvature_min,curvature_max"},
                                text);
  EXPECT_EQ(run.status, 1);
  const Cells first = cells_of(run.out, 1), second = cells_of(run.out, 2);
  EXPECT_EQ(Cells(first.begin() + 13, first.end()),
            (Cells{"not_applicable", "", "0", "0", "0", "", ""}));
  ASSERT_EQ(second.size(), 20U);
  EXPECT_EQ(second[15], "");
  EXPECT_NEAR(number(second[16]), 2.5e199, 1e184);
  EXPECT_EQ(second[17], "");
}

TEST(ContactColumns, OfEveryFormOfABodyAreAnswered) {
  const std::string text =
      "a.x,a.y,a.z,a.m.xx,a.m.yy,a.m.zz,a.m.xy,a.m.yz,a.m.zx,b.x,b.y,b.z,b.r1,b.r2,b.r3\n"
      "0,0,0,2,1,1,0,0,0,4,0,0,1,1,1\n";
  const Cells row = cells_of(run_tool({"contact", "--columns", "mu,F,F_error"}, text).out, 1);
  ASSERT_EQ(row.size(), 18U);
  EXPECT_NEAR(number(row[15]), 4 / (1 + 1.4142135623730951), 1e-15);
  EXPECT_GT(number(row[17]), 2 * 1.2e-16 * number(row[16])) << "rounding of the root of 2";
}

TEST(ContactColumns, OfARefusedRowAreEmptyCells) {
  const Finished run = run_tool({"contact", "--keep-going", "--columns", "F,mu"},
                                kHeader + "0,0,0,1,1,0,3,0,0,1,1,1\n");
  EXPECT_EQ(cells_of(run.out, 1).size(), 17U);
  EXPECT_EQ(cells_of(run.out, 1)[13], "invalid");
}

TEST(ContactColumns, TellHowFarABodyLiesInsideTheOther) {
  const std::string names = "clearance,clearance_error,margin,margin_error";
  const std::string text = kHeader + "0,0,0,1,2,3,.1,.2,0,2,3,5\n" + "0,0,0,2,3,5,.1,.2,0,1,2,3\n" +
                           "0,0,0,1,1,1,1,0,0,2,2,2\n" + "0,0,0,1,2,3,0,0,0,1,2,3\n" +
                           kDiscAndNeedle + "0,0,0,1,1,1,9,0,0,2,2,2\n";
  const Finished run = run_tool({"contact", "--columns", names}, text);
  EXPECT_EQ(run.status, 0) << run.err;
  const auto last = [&](std::size_t line) {
    const Cells row = cells_of(run.out, line);
    return Cells(row.end() - 4, row.end());
  };
  EXPECT_EQ(last(0), (Cells{"clearance", "clearance_error", "margin", "margin_error"}));
  const Vec3 d(0.1, 0.2, 0);
  const Ellipsoid small({0, 0, 0}, {1, 2, 3}), large({0, 0, 0}, {2, 3, 5});
  const Clearance c = clearance(small, large, d);
  const ContainmentMargin m = containment_margin(small, large, d);
  EXPECT_EQ(number(last(1)[0]), c.clearance);
  EXPECT_EQ(number(last(1)[1]), c.clearance_error);
  EXPECT_EQ(number(last(1)[2]), m.margin);
  EXPECT_EQ(number(last(1)[3]), m.margin_error);
  // The bodies exchanged, the inner one moved the other way: all is point-symmetric.
  EXPECT_NEAR(number(last(2)[0]), c.clearance, 2 * c.clearance_error);
  EXPECT_EQ(last(2)[2], last(1)[2]);
  EXPECT_EQ(number(last(3)[0]), 0);  // touching from inside
  EXPECT_EQ(number(last(3)[2]), 1);
  EXPECT_EQ(last(4), (Cells{"0", "0", "1", "0"}));  // equal
  EXPECT_EQ(last(5), Cells(4));                     // crossing
  EXPECT_EQ(last(6), Cells(4));                     // apart
}

TEST(ContactColumns, RefusesNamesWithALineThatSaysWhichAreAllowed) {
  const std::string see = " (`tangency contact --help` says what is allowed)\n";
  const auto refused = [&](const std::string& names) {
    const Finished run = run_tool({"contact", "--columns", names}, kHeader + kDiscAndNeedle);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  const std::string unknown = refused("F,nu");
  EXPECT_TRUE(unknown.starts_with("tangency contact: --columns: nu is not a further column; F, mu"))
      << unknown;
  EXPECT_TRUE(unknown.ends_with(" are, separated by commas" + see)) << unknown;
  EXPECT_EQ(refused("mu,F,mu"),
            "tangency contact: --columns: mu is named twice; each column may be named once" + see);
  EXPECT_TRUE(refused("").starts_with("tangency contact: --columns: an empty name is not"));
  EXPECT_TRUE(refused("F,").starts_with("tangency contact: --columns: an empty name is not"));
}

/// The words at the left of a help text: what stands two spaces in, until two spaces follow.
std::set<std::string> explained(const std::string& help) {
  std::set<std::string> names;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    if (line.size() < 3 || !line.starts_with("  ") || line[2] == ' ') continue;
    std::istringstream words(line.substr(2, line.find("  ", 2) - 2));
    for (std::string word; words >> word;) names.insert(word);
  }
  return names;
}

TEST(ContactColumns, AreAllInTheHelp) {
  const std::set<std::string> in_help = explained(run_tool({"contact", "--help"}).out);
  // What a refusal names is the table.
  const std::string refusal = run_tool({"contact", "--columns", "?"}).err;
  std::string names = refusal.substr(refusal.find("; ") + 2);
  names.resize(names.find(" are, separated"));
  int count = 0;
  std::istringstream words(names);
  for (std::string word; words >> word; ++count) {
    if (word == "and") continue;
    if (word.ends_with(',')) word.pop_back();
    EXPECT_TRUE(in_help.contains(word)) << word;
  }
  EXPECT_GT(count, 5);
}

TEST(ContactColumns, OfTheCommonVolumeAreThoseOfTheLibrary) {
  const std::string text =
      kHeader + "0,0,0,1,2,3,.5,1,0,2,3,1\n" + kConcentric +
      "0,0,0,1,1,1,2,0,0,1,1,1\n0,0,0,1e110,1e110,1e110,0,0,0,2e110,2e110,2e110\n";
  const std::string out = run_tool({"contact", "--columns", "volume,volume_error"}, text).out;
  const CommonVolume overlap =
      common_volume(Ellipsoid({0, 0, 0}, {1, 2, 3}), Ellipsoid({0.5, 1, 0}, {2, 3, 1}));
  const Cells row = cells_of(out, 1), nested = cells_of(out, 2), huge = cells_of(out, 4);
  ASSERT_EQ(row.size(), 17U);
  EXPECT_EQ(number(row[15]), overlap.volume);
  EXPECT_EQ(number(row[16]), overlap.volume_error);
  EXPECT_NEAR(number(nested[15]), 25.132741228718345, 1e-14);
  const Cells touching = cells_of(out, 3);
  EXPECT_EQ(Cells(touching.begin() + 15, touching.end()), (Cells{"0", "0"}));
  EXPECT_EQ(Cells(huge.begin() + 15, huge.end()), Cells(2));
}

}  // namespace
}  // namespace tangency::testing
