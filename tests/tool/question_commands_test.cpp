// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency point`, `ellipse-point`, `wall`, `ray` and `time`, run as their users run them.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include <tangency/tests/tool/help_examples.hpp>
#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
namespace {

const std::string kBody = "a.x,a.y,a.z,a.r1,a.r2,a.r3,";
const std::string kPointAnswers = "row,gap,nx,ny,nz,pa.x,pa.y,pa.z,gap_error,status\n";
const std::string kWall = "w.nx,w.ny,w.nz,w.offset";
const std::string kRay = "r.ox,r.oy,r.oz,r.dx,r.dy,r.dz";
const std::string kMotions =
    "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.vx,a.vy,a.vz,a.wx,a.wy,a.wz,"
    "b.x,b.y,b.z,b.r1,b.r2,b.r3,b.vx,b.vy,b.vz,b.wx,b.wy,b.wz";

/// The cells of a column, without its name.
std::vector<std::string> column(const std::string& table, std::size_t number) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (std::size_t end = table.find('\n'); end != std::string::npos;
       begin = end + 1, end = table.find('\n', begin)) {
    std::string line = table.substr(begin, end - begin) + ',';
    for (std::size_t i = 0; i < number; ++i) line.erase(0, line.find(',') + 1);
    cells.push_back(line.substr(0, line.find(',')));
  }
  cells.erase(cells.begin());
  return cells;
}

std::string refusal(const std::vector<std::string>& arguments, const std::string& input) {
  const Finished run = run_tool(arguments, input);
  EXPECT_EQ(run.status, 2);
  return run.err;
}

TEST(QuestionCommands, AnswerAsTheirHelpShows) {
  for (const char* name : {"point", "ellipse-point", "wall", "ray", "time"})
    expect_help_examples(name);
}

TEST(PointCommand, AnswersTheSameForEveryFormOfABody) {
  const std::string point = ",0,0,4\n";
  const std::string by_axes = kBody + "p.x,p.y,p.z\n1,0,0,3,2,1" + point;
  const Finished axes = run_tool({"point"}, by_axes);
  EXPECT_EQ(axes.status, 0) << axes.err;
  const std::string shape =
      "a.x,a.y,a.z,a.m.xx,a.m.yy,a.m.zz,a.m.xy,a.m.yz,a.m.zx,p.x,p.y,p.z\n1,0,0,9,4,1,0,0,0";
  const Finished matrix = run_tool({"point"}, shape + point);
  EXPECT_EQ(matrix.err, "");
  EXPECT_EQ(column(matrix.out, 1), column(axes.out, 1));
  EXPECT_EQ(column(matrix.out, 7), column(axes.out, 7));
}

TEST(PointCommand, NamesWhatItRefuses) {
  EXPECT_EQ(refusal({"point"}, kBody + "p.x,p.z\n0,0,0,1,1,1,0,0\n"),
            "<stdin>:1: the point without p.y: a point has the columns p.x, p.y and p.z\n");
  EXPECT_EQ(refusal({"ellipse-point"}, "a.x,a.y,a.r1,a.r2,a.angle\n0,0,1,1,0\n"),
            "<stdin>:1: the point without p.x, p.y: a point has the columns p.x and p.y\n");
  EXPECT_EQ(refusal({"point"}, kBody + "p.x,p.y,p.z\n0,0,0,1,1,1,0,nan,0\n")
                .rfind("<stdin>:2: p.y = nan: ", 0),
            0U);
}

TEST(PointCommand, KeepsGoingAndSaysWhatIsBeyondRange) {
  const Finished run = run_tool({"point", "--keep-going"}, kBody +
                                                               "p.x,p.y,p.z\n"
                                                               "0,0,0,1,-1,1,0,0,4\n"
                                                               "1e308,0,0,1,1,1,-1e308,0,0\n"
                                                               "0,0,0,1,1,1,0,0,2\n");
  EXPECT_EQ(run.status, 1);
  const std::string last = "2,1,0,0,1,0,0,1,";
  EXPECT_EQ(run.out.rfind(kPointAnswers +
                              "0,,,,,,,,,invalid\n"
                              "1,,,,,,,,,not_applicable\n" +
                              last,
                          0),
            0U)
      << run.out;
}

// A body of axes 1, 2 and 3 against floors at whole heights.
TEST(WallCommand, TellsEveryRelationOfBothKindsOfWall) {
  std::string rows = kBody + kWall + '\n';
  for (const char* offset : {"-4", "-3", "0", "3", "4"})
    rows += std::string("0,0,0,1,2,3,0,0,1,") + offset + '\n';
  const Finished solid = run_tool({"wall"}, rows);
  EXPECT_EQ(solid.status, 0) << solid.err;
  const std::vector<std::string> relations{"separate", "external_touch", "overlap",
                                           "internal_touch", "a_in_b"};
  EXPECT_EQ(column(solid.out, 1), relations);
  EXPECT_EQ(column(solid.out, 2), (std::vector<std::string>{"1", "0", "-3", "-6", "-7"}));
  EXPECT_EQ(column(solid.out, 14), (std::vector<std::string>{"", "", "", "a", ""}));
  const Finished thin = run_tool({"wall", "--two-sided"}, rows);
  EXPECT_EQ(column(thin.out, 1), (std::vector<std::string>{"separate", "external_touch", "overlap",
                                                           "external_touch", "separate"}));
  EXPECT_EQ(column(thin.out, 2), (std::vector<std::string>{"1", "0", "-3", "0", "1"}));
  EXPECT_EQ(column(thin.out, 5), (std::vector<std::string>{"-1", "-1", "-1", "1", "1"}));
}

TEST(WallCommand, NamesWhatItRefuses) {
  EXPECT_EQ(refusal({"wall"}, kBody + "w.nx,w.ny,w.nz\n0,0,0,1,1,1,0,0,1\n"),
            "<stdin>:1: the wall without w.offset: a wall has the columns w.nx, w.ny, w.nz and "
            "w.offset\n");
  EXPECT_EQ(refusal({"wall"}, kBody + kWall + "\n0,0,0,1,1,1,0,0,0,1\n"),
            "<stdin>:2: w.nx = 0: a wall's normal must not be all 0\n");
}

// The last hit's body is given by a precision matrix and a level, and touched exactly.
TEST(RayCommand, TellsHitsTouchesAndMissesExactlyForEveryForm) {
  const std::string header = "a.x,a.y,a.z,a.p.xx,a.p.yy,a.p.zz,a.p.xy,a.p.yz,a.p.zx,a.level,";
  const Finished run =
      run_tool({"ray"}, header + kRay +
                            "\n0,0,0,1,1,3,0,0,0,3,-5,0,1,1,0,0\n"
                            "0,0,0,1,1,3,0,0,0,0x1.8000000000001p1,-5,0,1,1,0,0\n"
                            "0,0,0,1,1,3,0,0,0,0x1.7ffffffffffffp1,-5,0,1,1,0,0\n");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(column(run.out, 1), (std::vector<std::string>{"grazing", "hit", "miss"}));
  EXPECT_EQ(column(run.out, 2)[0], "5");
}

TEST(RayCommand, BeginsAndEndsWhereTheColumnsSay) {
  const std::string rows =
      kBody + kRay + ",r.t0,r.t1\n0,0,0,1,1,1,-3,0,0,1,0,0,0,3\n0,0,0,1,1,1,-3,0,0,1,0,0,2,4\n" +
      "0,0,0,1,1,1,-3,0,0,1,0,0,2.5,3.5\n0,0,0,1,1,1,3,0,0,1,0,0,-9,0\n";
  const Finished run = run_tool({"ray"}, rows);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out, "row,result,t1,t2\n0,hit,2,\n1,hit,2,4\n2,miss,,\n3,hit,-4,-2\n");
  EXPECT_EQ(refusal({"ray"}, kBody + kRay + ",r.t1\n0,0,0,1,1,1,-3,0,0,1,0,0,-1\n"),
            "<stdin>:2: r.t1 = -1: a ray ends at or after r.t0\n");
  EXPECT_EQ(refusal({"ray"}, kBody + kRay + "\n0,0,0,1,1,1,-3,0,0,0,0,0\n"),
            "<stdin>:2: r.dx = 0: a ray's direction must not be all 0\n");
}

TEST(TimeCommand, TellsEveryStatus) {
  const std::string still = ",0,0,0,0,0,0", a = "0,0,0,1,1,1", b = ",1,1,1" + still + "\n";
  const Finished run = run_tool({"time", "--horizon", "10", "--tolerance", "1e-6"},
                                kMotions + '\n' + a + ",2,0,0,0,0,0,6,0,0" + b +  // flies at it
                                    a + ",2,0,0,0,0,0,6,3,0" + b +                // past it
                                    a + still + ",2,0,0" + b +                    // touches it
                                    a + ",2,0,0,0,0,0,6,2,0" + b +                // along it
                                    a + ",1e308,0,0,0,0,0,6,2,0" + b);            // beyond range
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(column(run.out, 1), (std::vector<std::string>{"contact", "none", "touching_at_start",
                                                          "grazing", "not_applicable"}));
  EXPECT_EQ(column(run.out, 2)[1], "10");
  EXPECT_EQ(column(run.out, 2)[2], "0");
  EXPECT_EQ(column(run.out, 2)[4], "");
  const double time = std::stod(column(run.out, 2)[0]), latest = std::stod(column(run.out, 3)[0]);
  EXPECT_LE(time, 2);
  EXPECT_GE(latest, 2);
  EXPECT_LE(latest - time, 1e-6);
}

TEST(TimeCommand, WantsHorizonAndToleranceOnce) {
  const std::string row = "0,0,0,1,1,1,2,0,0,0,0,0,6,0,0,1,1,1,0,0,0,0,0,0";
  const std::string by_options = kMotions + '\n' + row + '\n';
  const std::string by_columns = kMotions + ",horizon,tolerance\n" + row + ",10,0x1p-20\n";
  const Finished options =
      run_tool({"time", "--horizon", "10", "--tolerance", "0x1p-20"}, by_options);
  EXPECT_EQ(options.status, 0) << options.err;
  EXPECT_EQ(run_tool({"time"}, by_columns).out, options.out);
  EXPECT_EQ(refusal({"time", "--tolerance", "1"}, by_options),
            "<stdin>:1: header without horizon: horizon is a column or --horizon\n");
  EXPECT_EQ(refusal({"time", "--tolerance", "1"}, by_columns),
            "<stdin>:1: header with tolerance: tolerance is a column or --tolerance, not both\n");
  EXPECT_NE(refusal({"time", "--horizon", "-1"}, by_options).find("a horizon must be >= 0"),
            std::string::npos);
  EXPECT_EQ(refusal({"time"}, kMotions + ",horizon,tolerance\n" + row + ",10,0\n"),
            "<stdin>:2: tolerance = 0: a tolerance must be > 0\n");
  EXPECT_EQ(refusal({"time", "--horizon", "1", "--tolerance", "1"},
                    "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.vx\n0,0,0,1,1,1,0\n")
                .rfind("<stdin>:1: body a without a.vy, a.vz, a.wx, a.wy, a.wz: ", 0),
            0U);
}

TEST(QuestionCommands, WriteTheSameForEveryNumberOfThreads) {
  std::string rows = kBody + "p.x,p.y,p.z," + kWall + ',' + kRay + '\n';
  for (int i = 0; i < 2000; ++i) {
    const std::string t = std::to_string(0.002 * i);
    rows += "0,0,0,1,2,3," + t + ",1,2,1,2," + t + ",3,9," + t + ",2,-1," + t + ",0.3\n";
  }
  for (const char* name : {"point", "wall", "ray"}) {
    const Finished one = run_tool({name, "--threads", "1"}, rows);
    EXPECT_EQ(one.status, 0) << one.err;
    EXPECT_EQ(run_tool({name, "--threads", "3"}, rows).out, one.out);
  }
}

}  // namespace
}  // namespace tangency::testing
