// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency-verify grade` on points, rays, times, lists of neighbours and floats: what is wrong is
// counted, and no more.
#include <gtest/gtest.h>

#include <string>

#include <tangency/tests/grade/report.hpp>

namespace tangency::testing {
namespace {

/// The kernel's answers to `call`, changed by an awk program.
std::string asked(const std::string& call, const std::string& program) {
  return TANGENCY_CONTACT " " + call + " | awk -F, -v OFS=, '" + program + "'";
}

TEST(GradeKinds, AnExchangedSignOfAPointsGapIsWrong) {
  const Report report =
      grade_tool(asked("point", "NR == 5 { $2 = -$2 } { print $1, $2 }"), "points");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_EQ(report.value("points/all/wrong relations"), 1);
  EXPECT_EQ(report.value("points/outside/wrong relations"), 1);
  EXPECT_EQ(grade_tool(asked("point", "{ print $1, $2 }"), "points").run.status, 0);
}

TEST(GradeKinds, AnInwardNormalOfAPointIsReversed) {
  const Report report =
      grade_tool(asked("point", "NR > 1 { $3 = -$3; $4 = -$4; $5 = -$5 } { print }"), "points");
  EXPECT_EQ(report.run.status, 1);
  // But where the point is on the medial set, and the far normal is another true one.
  EXPECT_GT(report.value("points/all/reversed normals"), 280);
  EXPECT_EQ(report.value("points/outside/reversed normals"), 40);
}

TEST(GradeKinds, AHitThatIsLeftOutIsMissingAndOneTooManyIsWrong) {
  const Report less =
      grade_tool(asked("ray", "NR > 1 && $4 != \"\" { $4 = \"\" } { print }"), "rays");
  EXPECT_EQ(less.run.status, 1);
  EXPECT_EQ(less.value("rays/all/wrong relations"), 0);
  EXPECT_EQ(less.value("rays/from inside/missing answers"), 0);  // one hit
  EXPECT_GT(less.value("rays/anywhere/missing answers"), 10);
  const Report more = grade_tool(asked("ray", "NR > 1 && $4 == \"\" { $4 = 1 } { print }"), "rays");
  EXPECT_EQ(more.value("rays/from inside/wrong relations"), 40);
  EXPECT_EQ(more.value("rays/all/missing answers"), 0);
}

TEST(GradeKinds, ATangentThatIsCalledAHitIsWrong) {
  const Report report =
      grade_tool(asked("ray", "$2 == \"grazing\" { $2 = \"hit\" } { print }"), "rays");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_GT(report.value("rays/grazing/wrong relations"), 10);
  EXPECT_EQ(report.value("rays/anywhere/wrong relations"), 0);
}

TEST(GradeKinds, ATimeIsGradedInTolerancesAndALatestThatIsTooSoonIsBroken) {
  const Report late = grade_tool(
      asked("time", "NR > 1 && $2 == \"contact\" { $3 = $3 * 1.5; $4 = $3 } { print }"), "times");
  EXPECT_EQ(late.run.status, 1);
  EXPECT_GT(late.value("times/straight/time error, largest"), 1e3);
  EXPECT_GT(late.value("times/all/broken bounds"), 50);
  const Report soon = grade_tool(
      asked("time", "NR > 1 && $2 == \"contact\" { $3 = $3 / 2; $4 = $3 } { print }"), "times");
  EXPECT_EQ(soon.value("times/all/broken bounds"), late.value("times/all/broken bounds"));
  EXPECT_EQ(soon.value("times/grazing/broken bounds"), 0);  // which claim no contact
}

TEST(GradeKinds, AGrazeMayBeCalledAContactAndNotNothing) {
  const auto called = [](const std::string& word) {
    return grade_tool(asked("time", "$2 == \"grazing\" { $2 = \"" + word + "\" } { print $1, $2 }"),
                      "times")
        .value("times/grazing/wrong relations");
  };
  EXPECT_EQ(called("contact"), 0);
  EXPECT_EQ(called("none"), 20);
}

TEST(GradeKinds, OfAListWhatIsLeftOutIsMissingAndWhatIsTooMuchIsWrong) {
  const Report less = grade_tool(asked("neighbours", "NR != 3 { print }"), "neighbours");
  EXPECT_EQ(less.run.status, 1);
  EXPECT_EQ(less.value("neighbours/all/missing answers"), 1);
  EXPECT_EQ(less.value("neighbours/all/wrong relations"), 0);
  const Report more = grade_tool(
      asked("neighbours", "{ print } END { print 0, 213, 0, 0, 0; print 1, 1, 1, 0, 0 }"),
      "neighbours");
  EXPECT_EQ(more.run.status, 1);
  EXPECT_EQ(more.value("neighbours/all/wrong relations"), 2);
  EXPECT_EQ(more.value("neighbours/all/missing answers"), 0);
  const Report none = grade_tool("echo i,j,ix,iy,iz", "neighbours");
  EXPECT_EQ(none.value("neighbours/all/missing answers"), 169);
}

// Nor does the order of the lines.
TEST(GradeKinds, TheSamePairFromItsOtherSideIsRight) {
  const std::string turned =
      asked("neighbours --periodic 80,16,8",
            "NR > 1 { t = $1; $1 = $2; $2 = t; $3 = -$3; $4 = -$4; $5 = -$5 } { print }");
  EXPECT_EQ(grade_tool(turned, "neighbours-periodic").run.status, 0);
  const std::string unturned =
      asked("neighbours --periodic 80,16,8", "NR > 1 { t = $1; $1 = $2; $2 = t } { print }");
  EXPECT_GT(
      grade_tool(unturned, "neighbours-periodic").value("neighbours-periodic/all/missing answers"),
      10);
}

TEST(GradeKinds, APairThatIsListedTwiceIsAFault) {
  const Report report =
      grade_tool(asked("neighbours", "{ print } NR == 2 { print }"), "neighbours");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("this pair is listed again")) << report.run.out;
}

// Answers rounded to float are off by half of a unit at most, where none is deeper than L.
TEST(GradeKinds, FloatsAreGradedInTheirOwnUnit) {
  const Report rounded =
      grade_tool(asked("contact",
                       "NR > 1 { for (k = 3; k < 7; ++k) $k = sprintf(\"%.8g\", $k) } "
                       "{ print $1, $2, $3, $4, $5, $6 }"),
                 "float32");
  EXPECT_EQ(rounded.run.status, 0) << rounded.run.out;
  for (const char* name : {"gap", "normal"}) {
    const double largest = rounded.value("float32/all/" + std::string(name) + " error, largest");
    EXPECT_LT(largest, 1) << name;
    EXPECT_GT(largest, 1e-3) << name;
  }
  EXPECT_TRUE(rounded.says("gap error / 2^-24 L"));
}

TEST(GradeKinds, JsonCountsWhatTheRowsOfAKindAre) {
  const auto unit = [](const std::string& corpus, const std::string& count) {
    const Report report = grade_tool("true", corpus);
    for (const auto& entry : report.values) {
      if (entry.at("name") == corpus + "/all/" + count) return entry.at("unit").get<std::string>();
    }
    return std::string("none");
  };
  for (const char* corpus : {"near", "ellipses", "matrices", "float32"}) {
    EXPECT_EQ(unit(corpus, "pairs"), "pairs") << corpus;
  }
  for (const char* corpus : {"quadrics", "points", "walls", "rays", "times"}) {
    EXPECT_EQ(unit(corpus, "pairs"), "rows") << corpus;
    EXPECT_EQ(unit(corpus, "missing answers"), "rows") << corpus;
  }
  EXPECT_EQ(unit("neighbours", "pairs"), "bodies");
  EXPECT_EQ(unit("neighbours", "missing answers"), "pairs");
}

TEST(GradeKinds, TheHelpNamesTheCommandAndTheErrorsOfEveryKind) {
  const std::string help = run_tool({"grade", "--help"}).out;
  for (const char* text :
       {"`tangency contact`", "`ellipse`", "`classify`", "`point`", "`wall`", "`ray`", "`time`",
        "`neighbours`", "t error", "time error", "area error", "2^-24", "i j ix iy iz"}) {
    EXPECT_NE(help.find(text), std::string::npos) << text;
  }
}

TEST(GradeKinds, AToolThatAnswersPairsIsAskedForNoOtherKind) {
  const Report report = grade({"--tool", kKernel});
  EXPECT_EQ(report.run.status, 0);
  EXPECT_TRUE(report.says("passed: 2894 rows in 8 corpora")) << report.run.out;
}

}  // namespace
}  // namespace tangency::testing
