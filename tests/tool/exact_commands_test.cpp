// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency overlap` and `tangency classify`, run as their users run them.
#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
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

/// The types of quadrics, by rows.
std::vector<std::string> types(const std::vector<std::string>& options, const std::string& rows) {
  std::vector<std::string> arguments{"classify"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Finished run = run_tool(arguments, kQuadricHeader + rows);
  EXPECT_EQ(run.status, 0) << run.err;
  std::vector<std::string> found;
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t begin = line.find(',') + 1;
    found.push_back(line.substr(begin, line.find(',', begin) - begin));
  }
  return found;
}

// As radiation transport codes write them; pasted into the other convention all three are wrong.
TEST(ClassifyCommand, ReadsMixedTermsInFullWhereAsked) {
  const std::string rows =
      "1,3,1,2,2,2,-2,4,2,12\n5,2,5,-4,-4,-2,6,-12,18,-3\n"
      "9,36,4,-36,-24,12,-16,-24,-48,56\n";
  const std::vector<std::string> right{"elliptic_paraboloid", "real_elliptic_cylinder",
                                       "parabolic_cylinder"};
  EXPECT_EQ(types({"--mixed-terms", "full"}, rows), right);
  EXPECT_EQ(types({}, rows), std::vector<std::string>(3, "hyperboloid_one_sheet"));
  EXPECT_EQ(types({"--mixed-terms", "half"}, rows), types({}, rows));
}

// A product of two planes, (x + y)^2 = 1, told from its neighbours by one unit in the last place,
// where half of a term or twice a square is no double: D = 2 A at both ends of the range.
TEST(ClassifyCommand, ReadsMixedTermsInFullExactlyAtEverySize) {
  const auto parallel = [](const std::string& a, const std::string& d) {
    return a + ',' + a + ",0," + d + ",0,0,0,0,0,-" + a + '\n';
  };
  const std::string rows =
      parallel("1", "2") + parallel("1", "0x1.fffffffffffffp0") +
      parallel("1", "0x1.0000000000001p1") + parallel("0x1p-1074", "0x1p-1073") +
      parallel("0x1p-1074", "0x1p-1074") + parallel("0x1p-1074", "0x1.8p-1073") +
      parallel("0x1p1022", "0x1p1023") + parallel("0x1p1022", "0x1.0000000000001p1023") +
      parallel("0x1p1022", "0x1.fffffffffffffp1022") +
      // Twice the squares overflows, and half of the terms is not there: planes, or a cylinder.
      "0x1p1023,0,0,0,0,0,0x1p-1074,0,0,0\n0x1p1023,0,0,0,0,0,0,0x1p-1074,0,0\n"
      "0,0,0x1p1023,0,0,0,0,0x1p-1074,0,-0x1p1023\n";
  const std::vector<std::string> right{
      "real_parallel_planes", "real_elliptic_cylinder", "hyperbolic_cylinder",
      "real_parallel_planes", "real_elliptic_cylinder", "hyperbolic_cylinder",
      "real_parallel_planes", "hyperbolic_cylinder",    "real_elliptic_cylinder",
      "real_parallel_planes", "parabolic_cylinder",     "parabolic_cylinder"};
  EXPECT_EQ(types({"--mixed-terms", "full"}, rows), right);
}

TEST(ClassifyCommand, NamesBothConventionsAndRefusesOthers) {
  const std::string help = run_tool({"classify", "--help"}).out;
  for (const char* word : {"2D xy", " D xy", "half", "full"}) {
    EXPECT_NE(help.find(word), std::string::npos) << word;
  }
  const Finished run = run_tool({"classify", "--mixed-terms", "whole"}, kQuadricHeader);
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err.find("tangency classify: --mixed-terms: whole not in {half,full}"), 0U)
      << run.err;
}

// What R writes: quotes around every text, row names under no name.
TEST(OverlapCommand, ReadsAQuotedTable) {
  const Finished run =
      run_tool({"overlap"},
               "\"\",\"a.x\",\"a.y\",\"a.z\",\"a.r1\",\"a.r2\",\"a.r3\",\"b.x\",\"b.y\",\"b.z\","
               "\"b.r1\",\"b.r2\",\"b.r3\"\n\"1\",0,0,0,1,1,1,3,0,0,2,1,1\n");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out, "row,relation,overlaps,tier\n0,external_touch,0,exact\n");
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
}  // namespace tangency::testing
