// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency ellipse`, run as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/tests/tool/help_examples.hpp>
#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
namespace {

const std::string kHeader = "a.x,a.y,a.r1,a.r2,a.ux,a.uy,b.x,b.y,b.r1,b.r2,b.ux,b.uy\n";
const std::string kAnswers =
    "row,relation,crossings,area,gap,nx,ny,chord_depth,chord_nx,chord_ny,status,inner,gap_error\n";

TEST(EllipseCommand, AnswersAsItsHelpShows) { expect_help_examples("ellipse"); }

TEST(EllipseCommand, TellsEveryRelationAndCount) {
  const Finished run = run_tool({"ellipse"}, kHeader +
                                                 "0,0,2,1,1,0,4,0,1,1,1,0\n"
                                                 "0,0,2,1,1,0,3,0,1,1,1,0\n"
                                                 "0,0,2,1,1,0,0,0,2,1,0,1\n"
                                                 "0,0,2,1,1,0,1,0,1,2,1,0\n"
                                                 "0,0,2,1,1,0,0,0,1,1,1,0\n"
                                                 "0,0,1,1,1,0,0,0,2,3,1,0\n"
                                                 "0,0,2,2,1,0,0,0,1,1,1,0\n"
                                                 "0,0,2,1,1,0,0,0,1,2,0,7\n");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.status, 0);
  std::istringstream lines(run.out);
  std::vector<std::string> found;
  std::string line;
  while (std::getline(lines, line)) {
    found.push_back(line.substr(0, line.find(',', line.find(',', line.find(',') + 1) + 1)));
  }
  EXPECT_EQ(found,
            (std::vector<std::string>{
                "row,relation,crossings", "0,separate,0", "1,external_touch,1", "2,overlap,4",
                "3,overlap,3", "4,internal_touch,2", "5,a_in_b,0", "6,b_in_a,0", "7,equal,"}));
}

TEST(EllipseCommand, ReadsAnAngleAsItsRoundedCosineAndSine) {
  const std::string common = "0.1,0.2,3,1,0x1.14a280fb5068cp-1,0x1.aed548f090ceep-1\n";
  const Finished by_direction =
      run_tool({"ellipse"},
               "a.x,a.y,a.r1,a.r2,a.ux,a.uy,b.x,b.y,b.r1,b.r2,b.ux,b.uy\n0,0,2,1,1,0," + common);
  const Finished by_angle =
      run_tool({"ellipse"},
               "a.x,a.y,a.r1,a.r2,a.angle,b.x,b.y,b.r1,b.r2,b.angle\n0,0,2,1,0,0.1,0.2,3,1,1\n");
  EXPECT_EQ(by_angle.err, "");
  EXPECT_EQ(by_angle.out, by_direction.out);
}

TEST(EllipseCommand, NamesTheCellThatItRefuses) {
  const auto refusal = [](const std::string& row) {
    const Finished run = run_tool({"ellipse"}, kHeader + row);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, kAnswers);
    return run.err;
  };
  EXPECT_EQ(refusal("0,0,2,-1,1,0,4,0,1,1,1,0\n"),
            "<stdin>:2: a.r2 = -1: a semi-axis must be finite and > 0\n");
  EXPECT_EQ(refusal("0,0,2,1,1,0,4,0,1,1,0,0\n"),
            "<stdin>:2: b.ux = 0: a direction must be finite and not both 0\n");
  EXPECT_EQ(refusal("0,0,2,1,1,nan,4,0,1,1,0,1\n").rfind("<stdin>:2: a.uy = nan: ", 0), 0U);
  const Finished angle = run_tool(
      {"ellipse"}, "a.x,a.y,a.r1,a.r2,a.angle,b.x,b.y,b.r1,b.r2,b.angle\n0,0,2,1,inf,0,0,1,1,0\n");
  EXPECT_EQ(angle.status, 2);
  EXPECT_EQ(angle.err.rfind("<stdin>:2: a.angle = inf: ", 0), 0U) << angle.err;
}

TEST(EllipseCommand, WantsADirectionOnceAndWhole) {
  const auto refusal = [](const std::string& columns) {
    const Finished run =
        run_tool({"ellipse"}, columns + ",b.x,b.y,b.r1,b.r2,b.angle\n0,0,1,1,1,1,1,0,0,1,1,0\n");
    EXPECT_EQ(run.status, 2);
    return run.err;
  };
  const std::string by_direction =
      ": a body given by semi-axes and a direction has the columns x, y, r1, r2, ux and uy\n";
  EXPECT_EQ(refusal("a.x,a.y,a.r1,a.r2"), "<stdin>:1: body a without a.ux, a.uy" + by_direction);
  EXPECT_EQ(refusal("a.x,a.y,a.r1,a.r2,a.ux"), "<stdin>:1: body a without a.uy" + by_direction);
  EXPECT_EQ(
      refusal("a.x,a.y,a.r1,a.r2,a.uy,a.angle")
          .rfind("<stdin>:1: body a with a.uy and a.angle: an ellipse is given in one form: ", 0),
      0U);
  EXPECT_EQ(
      refusal("a.x,a.y,a.r2,a.angle"),
      "<stdin>:1: body a without a.r1: a body given by semi-axes and an angle has the columns "
      "x, y, r1, r2 and angle\n");
}

TEST(EllipseCommand, KeepsGoingAndSaysWhatIsBeyondRange) {
  const std::string rows = kHeader +
                           "0,0,2,-1,1,0,4,0,1,1,1,0\n"
                           "0,0,1e200,1e200,1,0,0,0,1e201,1e201,1,0\n"
                           "0,0,2,1,1,0,4,0,1,1,1,0\n";
  const Finished run = run_tool({"ellipse", "--keep-going"}, rows);
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.out, kAnswers +
                         "0,,,,,,,,,,invalid,,\n"
                         "1,a_in_b,0,,,,,,,,not_applicable,,\n"
                         "2,separate,0,0,1,1,0,,,,ok,,5.5511151231257874e-15\n");
}

TEST(EllipseCommand, WritesTheSameForEveryNumberOfThreads) {
  std::string rows = kHeader;
  for (int i = 0; i < 2000; ++i) {
    rows += "0,0,2,1,1,0," + std::to_string(0.002 * i) + ",0.5,1,1.5,3," + std::to_string(i) + "\n";
  }
  const Finished one = run_tool({"ellipse", "--threads", "1"}, rows);
  EXPECT_EQ(one.status, 0);
  EXPECT_EQ(run_tool({"ellipse", "--threads", "3"}, rows).out, one.out);
}

// A published case: concentric, parallel, the first in the second.
TEST(EllipseCommand, GivesTheGapOfNestedEllipsesWithItsError) {
  const Finished run = run_tool({"ellipse"}, kHeader + "0,0,3,1,1,0,0,0,5,2.5,1,0\n");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out.rfind(kAnswers + "0,a_in_b,0,9.42477796076938,-3.5,", 0), 0U) << run.out;
  const double error = std::stod(run.out.substr(run.out.rfind(',') + 1));
  EXPECT_GE(error, 0);
  EXPECT_LE(error, 1e-14);
}

TEST(EllipseCommand, NamesTheEllipseThatTouchesInside) {
  const auto inner = [](const std::string& row) {
    const std::string out = run_tool({"ellipse"}, kHeader + row).out;
    const std::size_t end = out.rfind(','), begin = out.rfind(',', end - 1);
    return out.substr(begin + 1, end - begin - 1);
  };
  EXPECT_EQ(inner("0,0,2,1,1,0,0,0,1,1,1,0\n"), "b");
  EXPECT_EQ(inner("0,0,1,1,1,0,0,0,2,1,1,0\n"), "a");
  EXPECT_EQ(inner("0,0,2,1,1,0,1,0,1,2,1,0\n"), "");
}

TEST(EllipseCommand, ListsThePointsInWhichTheBoundariesMeet) {
  const Finished run = run_tool({"ellipse", "--points", "--keep-going"},
                                kHeader +
                                    "0,0,2,2,1,0,3,0,1,1,1,0\n"    // a touch
                                    "0,0,2,1,1,0,9,0,1,1,1,0\n"    // apart
                                    "0,0,2,-1,1,0,9,0,1,1,1,0\n"   // refused
                                    "0,0,5,5,1,0,6,0,5,5,1,0\n"    // two crossings
                                    "0,0,2,1,1,0,0,0,1,2,0,7\n"    // equal
                                    "0,0,2,1,1,0,1,0,1,2,1,0\n");  // a touch and two crossings
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.out.substr(0, run.out.find("\n5,") + 1),
            "row,x,y,multiplicity\n0,2,0,2\n2,,,invalid\n3,3,-4,1\n3,3,4,1\n4,,,equal\n");
  const std::string last = run.out.substr(run.out.find("\n5,") + 1);
  EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 3);
  // By increasing x; of the touch at (2, 0) the y is 0 to rounding.
  const std::size_t touch = last.find("\n5,2,");
  ASSERT_NE(touch, std::string::npos) << last;
  EXPECT_NEAR(std::stod(last.substr(touch + 5)), 0, 1e-15);
  EXPECT_TRUE(last.ends_with(",2\n")) << last;
}

// By conics whose quadratic terms are those of the example in the help: exactly a touch.
TEST(EllipseCommand, ListsPointsOfConicsWithTheirExactMultiplicities) {
  const Finished run = run_tool({"ellipse", "--points"},
                                "a.A,a.B,a.C,a.D,a.E,a.F,b.A,b.B,b.C,b.D,b.E,b.F\n"
                                "1,0,3,0,0,-3,1,0,1,0,0,-1\n");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.status, 0);
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  int touches = 0;
  while (std::getline(lines, line)) touches += line.ends_with(",2");
  EXPECT_EQ(touches, 2) << run.out;
}

}  // namespace
}  // namespace tangency::testing
