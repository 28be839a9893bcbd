// SPDX-License-Identifier: GPL-3.0-or-later
// Answers that are none, and grades of nothing: neither passes, and the reason says what was read.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include <tangency/tests/grade/report.hpp>

namespace tangency::testing {
namespace {

/// A tool that answers these cells to each of the 360 rows of `near`.
std::string always(const std::string& columns, const std::string& cells) {
  return "printf 'row," + columns + "\\n'; seq 0 359 | sed 's/$/," + cells + "/'";
}

TEST(NoAnswer, ANormalWhoseLengthIsNotOneIsAFaultyCellAndMissing) {
  for (const char* normal : {"0,0,0", "1e300,0,0", "0,0.998,0", "0,0,1.002"}) {
    const Report report = grade_tool(always("nx,ny,nz", normal), "near");
    EXPECT_EQ(report.run.status, 1) << normal;
    EXPECT_EQ(report.value("near/all/missing answers"), 360) << normal;
    EXPECT_EQ(report.value("near/faulty lines or cells"), 360) << normal;
    EXPECT_TRUE(report.says("the normal that begins here must have length 1")) << report.run.out;
  }
}

// Rounded to three digits it is a normal, and its error is measured.
TEST(NoAnswer, ANormalOfThreeDigitsIsAnAnswer) {
  const Report report = grade_tool(
      changed("NR > 1 { for (k = 4; k < 7; ++k) $k = sprintf(\"%.3f\", $k) } { print $1, $4, $5, "
              "$6 }"),
      "near");
  EXPECT_EQ(report.run.status, 0) << report.run.out;
  EXPECT_EQ(report.value("near/faulty lines or cells"), 0);
  EXPECT_GT(report.value("near/all/normal error, largest"), 1e-5);
}

TEST(NoAnswer, ABoundBelowZeroIsAFaultyCellAndNotABrokenBound) {
  const Report report =
      grade_tool(changed("NR == 1 { print $1, $3, $13; next } { print $1, $3, -1e-9 }"), "near");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_EQ(report.value("near/all/broken bounds"), 0);
  EXPECT_EQ(report.value("near/all/missing answers"), 360);
  EXPECT_TRUE(report.says("row 0, line 2: gap_error = -1e-09: a bound must be >= 0"))
      << report.run.out;
}

TEST(NoAnswer, AGradeThatJudgesNoRowFails) {
  const Report unclaimed = grade_tool("echo row,overlaps", "extreme", {"--not-claimed", "extreme"});
  EXPECT_EQ(unclaimed.run.status, 1);
  EXPECT_TRUE(unclaimed.says("FAILED no row is judged: ")) << unclaimed.run.out;
  EXPECT_TRUE(unclaimed.says("FAILED: 0 rows in 1 corpus: "));
  const TemporaryFolder folder;
  std::string rows = "corpus,row\n";
  for (int row = 0; row < 360; ++row) rows += "near," + std::to_string(row) + '\n';
  const Report expected =
      grade_tool(always("overlaps", "7"), "near", {"--expected", folder.write("every.csv", rows)});
  EXPECT_EQ(expected.run.status, 1);
  EXPECT_TRUE(expected.says("FAILED no row is judged: ")) << expected.run.out;
  // A corpus of which nothing is claimed fails no grade of others.
  EXPECT_EQ(grade({"--tool", kKernel, "--corpus", "extreme", "near", "--not-claimed", "extreme"})
                .run.status,
            0);
}

TEST(NoAnswer, WhatAToolPrintedInsteadOfAnswersIsInTheReason) {
  const auto reason = [](const std::string& tool) {
    const Report report = grade_tool(tool, "near");
    EXPECT_EQ(report.run.status, 1);
    const std::size_t at = report.run.out.find("FAILED the tool ");
    return report.run.out.substr(at, report.run.out.find('\n', at) - at);
  };
  const std::string dead = "FAILED the tool ended with status 0 without an answer, in near";
  EXPECT_EQ(reason("cat").find(dead + "; of what it printed, line 1: row: "), 0U) << reason("cat");
  EXPECT_EQ(reason("echo gap; echo 1").find(dead + "; of what it printed, line 1: row: "), 0U);
  EXPECT_EQ(reason("echo row,gap,gap").find(dead + "; of what it printed, line 1: "), 0U)
      << reason("echo row,gap,gap");
  EXPECT_EQ(reason("cat > /dev/null"), dead);
}

TEST(NoAnswer, OneFileForTwoOutputsIsRefused) {
  const TemporaryFolder folder;
  const std::string same = folder.path("same"), again = folder.path("./same");
  const Finished run = run_tool({"grade", "--tool", "touch " + folder.path("started"), "--corpus",
                                 "near", "--json", same, "--html", again});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "--html: " + again + " is the file of --json too; each needs one of its own\n");
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

// The inputs say no more than where a row stands.
TEST(NoAnswer, OfACorpusThatIsTruthAloneAnswersAreGradedAndNoToolIsAsked) {
  const TemporaryFolder folder;
  folder.write("near.truth.csv", read_file(TANGENCY_CORPORA "/near.truth.csv"));
  const std::string answers = folder.write("answers.csv", "row,overlaps\n");
  const Report report =
      grade({"--answers", answers, "--corpus", "near", "--corpora", folder.path("")});
  EXPECT_EQ(report.run.status, 1) << report.run.err;
  EXPECT_EQ(report.value("near/all/missing answers"), 360);
  EXPECT_TRUE(report.says("near: 360 missing answers, the first is row 0\n")) << report.run.out;
  const Report tool = grade_tool(kKernel, "near", {"--corpora", folder.path("")});
  EXPECT_EQ(tool.run.status, 2);
  EXPECT_NE(tool.run.err.find("near.csv: cannot be read: "), std::string::npos) << tool.run.err;
}

TEST(NoAnswer, ACorpusThatIsNotThereIsNamedByWhatTheUserTyped) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_tool({"show", "nope", "0"}).err.find("CORPUS: there is no corpus nope here; "), 0U);
  EXPECT_EQ(run_tool({"inputs", "nope"}).err.find("CORPUS: there is no corpus nope here; "), 0U);
  EXPECT_EQ(grade_tool("true", "nope").run.err.find("--corpus: there is no corpus nope here; "),
            0U);
  EXPECT_EQ(
      grade_tool("true", "nope", {"--corpora", folder.path("")}).run.err,
      folder.path("") + ": there is no corpus here: a corpus NAME is a file NAME.truth.csv\n");
}

}  // namespace
}  // namespace tangency::testing
