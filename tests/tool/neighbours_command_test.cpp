// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency neighbours`, run as its users run it.
#include <gtest/gtest.h>

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/tests/tool/help_examples.hpp>
#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
namespace {

using Row = std::vector<std::string>;

/// Cells of all lines, the header's first.
std::vector<Row> table(const std::string& text) {
  std::vector<Row> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line + ',');
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// Cells from `first` to the end, with commas between them.
std::string joined(const Row& row, std::size_t first) {
  std::string text;
  for (std::size_t k = first; k < row.size(); ++k) text += (k > first ? "," : "") + row[k];
  return text;
}

const std::vector<std::string> kBodies{
    "0,0,0,3,2,1,1,0,0.25,0", "2,1,0.5,1,2,1.5,0,1,0,1", "5.5,0,0.25,0.5,2,1,1,1,1,0.5",
    "0.5,4,0,1,2,2.5,1,0,0,0.125", "0.5,0,0,0.25,0.25,0.25,1,0,0,0"};

std::string bodies_table() {
  std::string text = "x,y,z,r1,r2,r3,qw,qx,qy,qz\n";
  for (const std::string& body : kBodies) text += body + '\n';
  return text;
}

TEST(NeighboursCommand, AnswersAsItsHelpShows) { expect_help_examples("neighbours"); }

TEST(NeighboursCommand, ContactsAreThoseOfTheContactCommand) {
  const Finished run = run_tool({"neighbours", "--contacts"}, bodies_table());
  ASSERT_EQ(run.status, 0) << run.err;
  const std::vector<Row> found = table(run.out);
  ASSERT_GE(found.size(), 4U);
  std::string pairs =
      "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,"
      "b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b.qz\n";
  for (std::size_t k = 1; k < found.size(); ++k)
    pairs += kBodies[std::stoul(found[k][0])] + ',' + kBodies[std::stoul(found[k][1])] + '\n';
  const std::vector<Row> contacts = table(run_tool({"contact"}, pairs).out);
  ASSERT_EQ(contacts.size(), found.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_EQ(joined(found[k], 5), joined(contacts[k], 0)) << k;
}

TEST(NeighboursCommand, BodyBIsTheImageThatIsNamed) {
  const std::string one = "x,y,z,r1,r2,r3\n0.5,7,0,1,2,1\n";
  const Finished run = run_tool({"neighbours", "--contacts", "--periodic", "2,0,0.5"}, one);
  ASSERT_EQ(run.status, 0) << run.err;
  const std::vector<Row> found = table(run.out);
  // Along x two unit circles touch; along z images at 0.5, 1, 1.5 and 2; and some that lie between.
  ASSERT_GE(found.size(), 6U);
  bool along_x = false;
  for (std::size_t k = 1; k < found.size(); ++k) {
    const Row& row = found[k];
    EXPECT_EQ(row[0] + row[1] + row[3], "000");
    along_x = along_x || joined(row, 2) == "1,0,0," + std::to_string(k - 1) +
                                               ",external_touch,0,1,0,0,1.5,7,0,1.5,7,0,0,ok,";
  }
  EXPECT_TRUE(along_x) << run.out;
}

TEST(NeighboursCommand, WritesImagesAsIntegersHoweverLargeTheyAre) {
  const std::string far = "x,y,z,r1,r2,r3\n0,0,0,1,1,1\n200000,0,0,1,1,1\n";
  EXPECT_EQ(run_tool({"neighbours", "--periodic", "2,0,0"}, far).out,
            "i,j,ix,iy,iz\n0,0,1,0,0\n0,1,-100001,0,0\n0,1,-100000,0,0\n0,1,-99999,0,0\n"
            "1,1,1,0,0\n");
}

TEST(NeighboursCommand, ListsTheSameForEveryFormOfABody) {
  const std::string axes = "x,y,z,r1,r2,r3\n0,0,0,1,2,3\n3,0,0,2,1,1\n3,3,0,1,2,1\n";
  const std::string shape =
      "x,y,z,m.xx,m.yy,m.zz,m.xy,m.yz,m.zx\n"
      "0,0,0,1,4,9,0,0,0\n3,0,0,4,1,1,0,0,0\n3,3,0,1,4,1,0,0,0\n";
  for (const char* reach : {"0", "0.75"}) {
    const Finished by_axes = run_tool({"neighbours", "--reach", reach}, axes);
    EXPECT_EQ(by_axes.status, 0) << by_axes.err;
    EXPECT_EQ(run_tool({"neighbours", "--reach", reach}, shape).out, by_axes.out);
  }
  EXPECT_EQ(run_tool({"neighbours"}, axes).out, "i,j,ix,iy,iz\n0,1,0,0,0\n1,2,0,0,0\n");
}

TEST(NeighboursCommand, OfBodiesByMatricesIsExactForTheNumbersAsTheyAreRead) {
  const std::string head = "x,y,z,m.xx,m.yy,m.zz,m.xy,m.yz,m.zx\n";
  // Balls of radius sqrt(2) along (1, 1, 0): they touch where the centres are (2, 2, 0) apart.
  const std::string ball = ",0,2,2,2,0,0,0\n";
  const std::string touch = head + "0,0" + ball + "2,2" + ball;
  const std::string apart = head + "0,0" + ball + "2,2.0000000000000004" + ball;
  const std::string beyond = head + "0,0" + ball + "-2,6" + ball;
  EXPECT_EQ(table(run_tool({"neighbours"}, touch).out).size(), 2U);
  EXPECT_EQ(table(run_tool({"neighbours"}, apart).out).size(), 1U);
  EXPECT_EQ(run_tool({"neighbours", "--periodic", "4,4,0"}, beyond).out,
            "i,j,ix,iy,iz\n0,1,0,-2,0\n0,1,0,-1,0\n0,1,1,-2,0\n0,1,1,-1,0\n");
}

TEST(NeighboursCommand, IsTheSameForEveryNumberOfThreads) {
  std::string text = "x,y,z,r1,r2,r3\n";
  for (int k = 0; k < 3000; ++k)
    text += std::to_string(k % 17) + "." + std::to_string(k % 7) + "," + std::to_string(k % 13) +
            "," + std::to_string(k % 11) + ",0.5,0.625,0.75\n";
  const auto run = [&](const char* threads) {
    return run_tool({"neighbours", "--contacts", "--periodic", "17,13,0", "--threads", threads},
                    text)
        .out;
  };
  const std::string one = run("1");
  EXPECT_GT(table(one).size(), 3000U);
  EXPECT_EQ(run("3"), one);
}

TEST(NeighboursCommand, RefusesWithOneLine) {
  const auto refusal = [](std::vector<std::string> arguments, const std::string& input) {
    arguments.insert(arguments.begin(), "neighbours");
    const Finished run = run_tool(arguments, input);
    EXPECT_EQ(run.status, 2);
    return run.err;
  };
  const std::string head = "x,y,z,r1,r2,r3\n", body = "0,0,0,1,1,1\n";
  EXPECT_EQ(refusal({}, head + body + "0,0,0,1,-1,1\n"),
            "<stdin>:3: r2 = -1: a semi-axis must be finite and > 0\n");
  EXPECT_NE(refusal({"--reach", "-1"}, head).find("-1: a reach must be >= 0"), std::string::npos);
  for (const char* bad : {"1,2", "1,2,3,4", "1,2,-3", "1,2,x", "1,,3"})
    EXPECT_NE(
        refusal({"--periodic", bad}, head).find(std::string(bad) + ": three lengths LX,LY,LZ"),
        std::string::npos)
        << bad;
  EXPECT_EQ(refusal({"--periodic", "1e-7,0,0", "--max-images", "1000000000"}, head + body),
            "<stdin>: edges: the cell is 1e-07 high, and a ball 2: at most 2^20 images\n");
  EXPECT_EQ(refusal({"--periodic", "1,0,0"}, head + body + "1e18,0,0,1,1,1\n"),
            "<stdin>: centres[1]: 1e+18 edges away: at most 2^29\n");
  EXPECT_EQ(refusal({"--reach", "1.7e308"}, head + "0,0,0,1.7e308,1,1\n"),
            "<stdin>: reach = 1.7e+308: that and a semi-axis of body 0 are beyond the range of "
            "doubles\n");
  EXPECT_NE(refusal({"--keep-going"}, head).find("--keep-going"), std::string::npos);
  const TemporaryFolder folder;
  const std::string file = folder.write("out.csv", "as it was\n");
  refusal({"--out", file}, head + body + "0,0,0,1,1,x\n");
  EXPECT_EQ(read_file(file), "as it was\n");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"out.csv"});
}

// Without a limit the first table has 10^12 pairs with images, and no memory ever holds them.
TEST(NeighboursCommand, RefusesABodyWithMoreImagesThanAreAllowedBeforeItSearches) {
  const std::string head = "x,y,z,r1,r2,r3\n", small = "0,0,0,1,1,1\n";
  const Finished huge =
      run_tool({"neighbours", "--periodic", "10,10,10"}, head + small + "1,1,1,1e5,1,1\n" + small);
  EXPECT_EQ(huge.status, 2);
  EXPECT_EQ(huge.err,
            "<stdin>:3: images = 64004800120001: a body may meet at most 100000 of its images "
            "(--max-images)\n");
  EXPECT_EQ(huge.out, "");
  // A ball of radius 1 in a cell of 2 x 1: 3 by 5 images have boxes that meet its own.
  const auto run = [&](const char* most, const char* reach, const char* cell = "2,1,0") {
    return run_tool({"neighbours", "--periodic", cell, "--max-images", most, "--reach", reach},
                    head + small);
  };
  EXPECT_EQ(run("15", "0").status, 0);
  EXPECT_EQ(run("14", "0").err,
            "<stdin>:2: images = 15: a body may meet at most 14 of its images (--max-images)\n");
  EXPECT_EQ(run("20", "0.5").status, 0);
  EXPECT_EQ(run("20", "1").err,
            "<stdin>:2: images = 21: a body may meet at most 20 of its images (--max-images)\n");
  EXPECT_EQ(run("1", "1e300", "0,0,0").status, 0) << "without a cell there is one image";
  for (const char* bad : {"0", "-1", "x"}) EXPECT_EQ(run(bad, "0").status, 2) << bad;
}

TEST(NeighboursCommand, OfNoBodiesIsAHeader) {
  const Finished run = run_tool({"neighbours", "--periodic", "1,1,1"}, "x,y,z,r1,r2,r3\n");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "i,j,ix,iy,iz\n");
}

}  // namespace
}  // namespace tangency::testing
