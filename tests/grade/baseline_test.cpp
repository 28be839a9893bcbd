// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency-verify grade --baseline`: what is worse fails, what is better is named.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <tangency/tests/grade/report.hpp>

namespace tangency::testing {
namespace {

/// The grade of answers that are all of one line a row, beside a baseline.
class Baseline {
 public:
  explicit Baseline(const std::string& tool) : tool_(tool) {
    const Finished run = run_tool(
        {"grade", "--tool", tool, "--corpus", "near", "--corpus", "classes", "--json", file()});
    EXPECT_EQ(run.err, "");
  }
  std::string file() const { return folder_.path("baseline.json"); }
  /// Changes the value of a name in the file.
  void set(const std::string& name, double value) {
    auto values = nlohmann::json::parse(read_file(file()));
    bool found = false;
    for (auto& one : values) {
      if (one.at("name") == name) one["value"] = value, found = true;
    }
    EXPECT_TRUE(found) << name;
    folder_.write("baseline.json", values.dump());
  }
  Report grade_near(std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--baseline", file()});
    return grade_tool(tool_, "near", more);
  }

 private:
  TemporaryFolder folder_;
  std::string tool_;
};

TEST(GradeBaseline, AGradeBesideItselfIsNeitherWorseNorBetter) {
  const Baseline baseline(kKernel);
  const Report report = baseline.grade_near();
  EXPECT_EQ(report.run.status, 0) << report.run.out;
  for (const char* text : {"FAILED", "BETTER", "NEW"}) EXPECT_FALSE(report.says(text)) << text;
  EXPECT_TRUE(report.says("for information: near/time: "));
}

TEST(GradeBaseline, EveryLargerErrorOrCountFailsTheLargestChangeFirst) {
  Baseline baseline(kKernel);
  const double median = baseline.grade_near().value("near/gap 1e-05/normal error, median");
  ASSERT_GT(median, 0);
  baseline.set("near/gap 1e-05/normal error, median", median / 2);
  baseline.set("near/gap 1e-03/gap error, largest", 1e-30);
  const Report report = baseline.grade_near();
  EXPECT_EQ(report.run.status, 1);
  const std::size_t first =
      report.run.out.find("FAILED worse than the baseline: near/gap 1e-03/gap error, largest: ");
  const std::size_t second =
      report.run.out.find("FAILED worse than the baseline: near/gap 1e-05/normal error, median: ");
  EXPECT_LT(first, second) << report.run.out;
  EXPECT_NE(second, std::string::npos) << report.run.out;
  EXPECT_TRUE(report.says(", was 1e-30\n"));
}

TEST(GradeBaseline, AWrongAnswerThatWasRightFailsWithoutAThreshold) {
  const Baseline baseline(kKernel);
  const Report report = grade_tool(changed("NR == 2 { $2 = \"equal\" } { print }"), "near",
                                   {"--baseline", baseline.file()});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("FAILED worse than the baseline: near/all/wrong relations: 1, was 0\n"))
      << report.run.out;
}

TEST(GradeBaseline, WhatIsNoLongerAnsweredFails) {
  const Baseline baseline(kKernel);
  const Report report =
      grade_tool(changed("{ print $1, $2, $3 }"), "near", {"--baseline", baseline.file()});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("near/all/broken bounds: in the baseline, and not graded now"));
  EXPECT_FALSE(report.says("classes/"));  // was not graded here
}

TEST(GradeBaseline, AnotherCorpusFails) {
  Baseline baseline(kKernel);
  baseline.set("near/all/pairs", 361);
  const Report report = baseline.grade_near();
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("FAILED worse than the baseline: near/all/pairs: 360, was 361\n"));
}

TEST(GradeBaseline, OneThatKnowsNothingOfTheCorpusFails) {
  const Baseline baseline(kKernel);
  const Report report =
      grade({"--tool", kKernel, "--corpus", "near", "deep", "--baseline", baseline.file()});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("FAILED worse than the baseline: deep: nothing of it is there\n"))
      << report.run.out;
  EXPECT_FALSE(report.says("near: nothing"));
}

TEST(GradeBaseline, AnErrorBeyondDoublesIsTheLargestOfThem) {
  const std::string tool = changed("NR > 1 { $3 = \"1e308\" } { print }");
  const TemporaryFolder folder;
  const std::string file = folder.path("baseline.json");
  const Report report = grade_tool(tool, "touching");
  EXPECT_EQ(report.value("touching/extreme_scale/gap error, largest"),
            std::numeric_limits<double>::max());
  folder.write("baseline.json", report.values.dump());
  const Report again = grade_tool(tool, "touching", {"--baseline", file});
  EXPECT_FALSE(again.says("worse than the baseline")) << again.run.out;
}

TEST(GradeBaseline, AnImprovementPassesAndSaysHowToKeepIt) {
  Baseline baseline(kKernel);
  baseline.set("near/all/gap error, median", 1e-3);
  baseline.set("near/gap 1e-03/missing answers", 7);
  const Report report = baseline.grade_near();
  EXPECT_EQ(report.run.status, 0) << report.run.out;
  EXPECT_TRUE(report.says("BETTER near/gap 1e-03/missing answers: 0, was 7\n"));
  EXPECT_TRUE(report.says("BETTER near/all/gap error, median: "));
  EXPECT_TRUE(report.says("2 values are better than in " + baseline.file()));
  EXPECT_TRUE(report.says("run this again with --json " + baseline.file() + " added\n"));
}

TEST(GradeBaseline, TheSlackIsAShareOfTheError) {
  Baseline baseline(kKernel);
  const char* name = "near/all/gap error, largest";
  const double largest = baseline.grade_near().value(name);
  baseline.set(name, largest / 1.1);
  EXPECT_EQ(baseline.grade_near({"--baseline-slack", "0.05"}).run.status, 1);
  EXPECT_EQ(baseline.grade_near({"--baseline-slack", "0.2"}).run.status, 0);
}

TEST(GradeBaseline, ACountHasNoSlack) {
  Baseline baseline(TANGENCY_SPHERE_TOOL);
  const char* name = "near/all/wrong relations";
  const double wrong = baseline.grade_near().value(name);
  ASSERT_GT(wrong, 1);
  EXPECT_EQ(baseline.grade_near({"--max-wrong", "1000", "--baseline-slack", "9"}).run.status, 0);
  baseline.set(name, wrong - 1);
  EXPECT_EQ(baseline.grade_near({"--max-wrong", "1000", "--baseline-slack", "9"}).run.status, 1);
}

TEST(GradeBaseline, RefusesWhatIsNoGrade) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const std::string file = folder.write("baseline.json", text);
    const Report report = grade_tool(kKernel, "near", {"--baseline", file});
    EXPECT_EQ(report.run.status, 2);
    EXPECT_EQ(report.run.out, "");
    return report.run.err.substr(std::min(report.run.err.size(), file.size()));
  };
  const std::string rule =
      ": a baseline must be what --json writes, an array of {name, unit, value}, none of them "
      "below 0\n";
  EXPECT_EQ(refusal(""), ":1" + rule);
  EXPECT_EQ(refusal("{}"), ":1" + rule);
  EXPECT_EQ(refusal("[\n{\"name\":\"a\",\"value\":1},\n{\"name\":\"b\",\"value\":\"2\"}\n]\n"),
            ":3" + rule);
  EXPECT_EQ(refusal("[{\"name\":\"a\",\"value\":1e999}]"), rule);
  EXPECT_EQ(refusal("[{\"name\":\"a\",\"value\":null}]"), ":2" + rule);
  EXPECT_EQ(refusal("[{\"name\":\"a\",\"value\":-1}]"), ":2" + rule);
  EXPECT_EQ(refusal("[\n{\"name\":\"a\",\"value\":1},\n{\"name\":\n"), ":4" + rule);
  const Report none = grade_tool(kKernel, "near", {"--baseline", folder.path("none.json")});
  EXPECT_EQ(none.run.status, 2);
  EXPECT_NE(none.run.err.find("none.json: cannot be read: "), std::string::npos);
  const Report place = grade_tool(kKernel, "near", {"--baseline", folder.path("")});
  EXPECT_EQ(place.run.status, 2);
  EXPECT_NE(place.run.err.find(": cannot be read: Is a directory"), std::string::npos);
}

}  // namespace
}  // namespace tangency::testing
