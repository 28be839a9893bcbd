// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency overlap` and `tangency classify`, run as their users run them.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include <tangency/tests/tool/process.hpp>

namespace tangency::test {
namespace {

const std::string kPairHeader = "a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3\n";
const std::string kQuadricHeader = "A,B,C,D,E,F,G,H,J,K\n";

TEST(OverlapCommand, TellsEveryRelationByName) {
  const Finished run = run_tool({"overlap"}, kPairHeader +
                                                 "0,0,0,1,1,1,3,0,0,1,1,1\n"
                                                 "0,0,0,1,1,1,2,0,0,1,1,1\n"
                                                 "0,0,0,1,1,1,1,0,0,1,1,1\n"
                                                 "0,0,0,1,1,1,1,0,0,2,2,2\n"
                                                 "0,0,0,1,1,1,0,0,0,2,2,3\n"
                                                 "0,0,0,2,3,2,0,0,0,1,1,1\n"
                                                 "0,0,0,1,2,3,0,0,0,1,2,3\n");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out,
            "row,relation,overlaps,tier\n"
            "0,separate,0,filter\n"
            "1,external_touch,0,exact\n"
            "2,overlap,1,filter\n"
            "3,internal_touch,1,exact\n"
            "4,a_in_b,1,filter\n"
            "5,b_in_a,1,filter\n"
            "6,equal,1,exact\n");
  EXPECT_EQ(run.status, 0);
}

TEST(OverlapCommand, KeepsGoingWithInvalidInTheRelationColumn) {
  const std::string pairs = kPairHeader + "0,0,0,1,-1,1,3,0,0,1,1,1\n0,0,0,1,1,1,3,0,0,1,1,1\n";
  const Finished strict = run_tool({"overlap"}, pairs);
  EXPECT_EQ(strict.status, 2);
  EXPECT_EQ(strict.err, "<stdin>:2: a.r2 = -1: a semi-axis must be finite and > 0\n");
  const Finished lenient = run_tool({"overlap", "--keep-going"}, pairs);
  EXPECT_EQ(lenient.status, 1);
  EXPECT_EQ(lenient.out, "row,relation,overlaps,tier\n0,invalid,,\n1,separate,0,filter\n");
}

TEST(OverlapCommand, AnswersEveryRegressionAsTheOracleDoes) {
  const std::string path = TANGENCY_TEST_DATA "/regressions/pairs.csv";
  const Finished run = run_tool({"overlap", path});
  ASSERT_EQ(run.status, 0) << run.err;
  std::istringstream answers(run.out);
  std::string answer, line;
  std::getline(answers, answer);  // the header
  std::ifstream expected(path);
  int rows = -1;  // the header is no row
  while (std::getline(expected, line)) {
    if (line.empty() || line[0] == '#') continue;
    if (++rows == 0) continue;
    ASSERT_TRUE(std::getline(answers, answer));
    const std::string relation = line.substr(line.rfind(',') + 1);
    EXPECT_EQ(answer.substr(0, answer.find(',', answer.find(',') + 1)),
              std::to_string(rows - 1) + ',' + relation);
  }
  EXPECT_GE(rows, 1);
}

TEST(ClassifyCommand, TellsTypesRanksAndTier) {
  const Finished run = run_tool({"classify"}, kQuadricHeader +
                                                  "1,1,1,0,0,0,0,0,0,-1\n"
                                                  "1,1,-1,0,0,0,0,0,0,0\n"
                                                  "0,0,0,0,0,0,0,0,0x1p-1074,0\n"
                                                  "0,0,0,0,0,0,0,0,0,-2\n"
                                                  "0,0,0,0,0,0,0,0,0,0\n");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out,
            "row,type,rank4,rank3,tier\n"
            "0,real_ellipsoid,4,3,filter\n"
            "1,real_elliptic_cone,3,3,exact\n"
            "2,plane,2,0,exact\n"
            "3,no_points,1,0,exact\n"
            "4,all_space,0,0,exact\n");
  EXPECT_EQ(run.status, 0);
}

TEST(ClassifyCommand, NamesTheColumnsThatAreMissing) {
  const Finished run = run_tool({"classify"}, "A,B,C,D,E,F,G,H\n");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "<stdin>:1: quadric without J, K: a quadric has the columns A, B, C, D, E, F, G, H, J "
            "and K\n");
}

TEST(ClassifyCommand, RefusesACoefficientThatIsNotFinite) {
  const Finished run = run_tool({"classify"}, kQuadricHeader + "1,1,nan,0,0,0,0,0,0,-1\n");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err.rfind("<stdin>:2: C = nan: ", 0), 0U) << run.err;
}

}  // namespace
}  // namespace tangency::test
