// SPDX-License-Identifier: GPL-3.0-or-later
// What `tangency-verify grade` says of a grade that fails, on a screen and to CI systems.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/tests/grade/report.hpp>

namespace tangency::testing {
namespace {

/// Sets a variable of the environment as long as it lives.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value, 1);
  }
  ~Variable() { before_.empty() ? ::unsetenv(name_) : ::setenv(name_, before_.c_str(), 1); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::string before_;
};

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The kernel, with an opposite relation in the lines that an awk condition names.
std::string wrong_where(const std::string& condition) {
  return changed("NR > 1 && (" + condition +
                 ") { $2 = \"separate\" == $2 ? \"overlap\" : \"separate\" } { print $1, $2 }");
}

// Row 7 of near stands in line 12: three comments and a header come before row 0.
TEST(Explanation, AWrongRowIsNamedByLineAndRowWithWhatWasAnsweredAndWhatIsTrue) {
  const Report report = grade_tool(wrong_where("$1 == 7"), "near");
  EXPECT_TRUE(report.says("near.csv:12: row 7: relation = overlap, true is separate\n"))
      << report.run.out;
  EXPECT_TRUE(report.says("FAILED 1 wrong answers are more than 0; the first: near row 7 ("));
  EXPECT_TRUE(report.says("to look at a row: tangency-verify show near 7\n"));
}

TEST(Explanation, TenRowsOfAFamilyAreNamedAndTheOthersCounted) {
  const Report report = grade_tool(wrong_where("1"), "near");
  EXPECT_EQ(report.value("near/gap 1e-03/wrong relations"), 24);
  EXPECT_EQ(count(report.run.out, "  gap 1e-03: "), 11U);
  EXPECT_TRUE(report.says("  gap 1e-03: and 14 more\n")) << report.run.out;
}

TEST(Explanation, EveryKindOfFaultSaysWhatWasAnswered) {
  const Report report = grade_tool(
      changed(
          "$1 == 1 { $3 = 7 } $1 == 2 { $2 = \"none\" } $1 == 3 { $4 = -$4; $5 = -$5; $6 = -$6 "
          "} $1 == 4 { $13 = 1e-300 } $1 == 6 { x = $4; $4 = cos(0.01) * x - sin(0.01) * $5; $5 = "
          "sin(0.01) * x + cos(0.01) * $5 } $1 == 8 { $3 = \"\" } $1 != 5 { print }"),
      "near", {"--max-gap-error", "1e-12", "--max-normal-error", "1e-6"});
  for (const char* text :
       {"row 1: gap = 7, true is \\S+: off by \\S+ L\n",
        "row 2: relation = none, which is no answer\n",
        "row 3: nx ny nz = [^,]*, true is [^:]*: the other way\n",
        "row 4: gap_error = 1e-300, but the error is \\S+\n", "row 5: no answer\n",
        "row 6: nx ny nz = [^,]*, true is [^:]*: off by 0\\.0\\S+\n", "row 8: no gap\n"}) {
    EXPECT_TRUE(std::regex_search(report.run.out, std::regex(text))) << text << '\n'
                                                                     << report.run.out;
  }
}

// Relations from bounding spheres that are 1 % too large.
TEST(Explanation, AToyOfBlownBoundingSpheresFailsByDefaultAndIsToldWhy) {
  const Report report = grade(
      {"--tool", TANGENCY_SPHERE_TOOL " 1.01 | cut -d, -f1,2", "--corpus", "classes", "near"});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("times relation = overlap, true is separate\n")) << report.run.out;
  EXPECT_TRUE(report.says(" wrong answers are more than 0; the first: classes row "));
  EXPECT_EQ(lines(report.run.out).back().find("FAILED: 810 rows in 2 corpora: "), 0U);
}

TEST(Explanation, ADeadToolIsSaidOnceWithItsStatusAndLastWords) {
  const Report report =
      grade({"--tool", "echo no licence >&2; exit 3", "--corpus", "near", "deep", "classes"});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_EQ(count(report.run.out,
                  "FAILED the tool ended with status 3 without an answer, in near, "
                  "deep, classes; its last words: no licence\n"),
            1U)
      << report.run.out;
  EXPECT_EQ(count(report.run.out, "no licence"), 2U);  // where it happens, and at the end
  EXPECT_TRUE(report.says("deep: no answer to 360 rows, in the same way\n"));
  EXPECT_FALSE(report.says("row 0: "));
}

TEST(Explanation, WhatIsAllowedFailsNothing) {
  const TemporaryFolder folder;
  const Report report = grade_tool(wrong_where("$1 == 7"), "near",
                                   {"--max-wrong", "1", "--junit", folder.path("grade.xml")});
  EXPECT_EQ(report.run.status, 0);
  EXPECT_TRUE(report.says("row 7: relation = overlap, true is separate\n"));
  EXPECT_FALSE(report.says("FAILED"));
  EXPECT_EQ(read_file(folder.path("grade.xml")).find("<failure"), std::string::npos);
}

TEST(Annotations, AreTenAtMostBeforeTheVerdictAndOnlyForGitHub) {
  const Variable runner("GITHUB_ACTIONS", "true");
  const std::vector<std::string> said =
      lines(grade({"--tool", wrong_where("1"), "--corpus", "near", "deep"}).run.out);
  const auto is_error = [](const std::string& line) { return line.starts_with("::error "); };
  EXPECT_EQ(std::ranges::count_if(said, is_error), 10);
  EXPECT_TRUE(is_error(said[said.size() - 2]));
  EXPECT_TRUE(said.back().starts_with("FAILED: "));
  // In turn: of each corpus the first row of its first family comes first.
  const auto first = std::ranges::find_if(said, is_error);
  EXPECT_NE(first->find("near.csv,line=5,title=near row 0::relation = "), first->npos) << *first;
  EXPECT_NE((first + 1)->find("deep.csv,line=5,title=deep row 0::"), first->npos) << first[1];
  const Variable other("GITHUB_ACTIONS", "false");
  EXPECT_EQ(grade_tool(wrong_where("1"), "near").run.out.find("::error"), std::string::npos);
}

TEST(Annotations, EscapeWhatWouldEndThem) {
  const Variable runner("GITHUB_ACTIONS", "true");
  const Report report = grade_tool("printf '100%%: a,b' >&2; exit 4", "near");
  EXPECT_TRUE(
      report.says("::error title=grade::the tool ended with status 4 without an answer, in "
                  "near; its last words: 100%25: a,b\n"))
      << report.run.out;
  const TemporaryFolder folder;
  folder.write("a,b:c%.csv", "x\n1\n");
  folder.write("a,b:c%.truth.csv", "row,family,type\n0,f,plane\n");
  const Report named = grade({"--tool", "printf 'row,type\\n0,no_points\\n'", "--corpus", "a,b:c%",
                              "--corpora", folder.path("")});
  EXPECT_TRUE(named.says("a%2Cb%3Ac%25.csv,line=2,title=a%2Cb%3Ac%25 row 0::type = no_points, "))
      << named.run.out << named.run.err;
}

TEST(JsonSummary, HasAtMostFortySeriesAndErrorsInDigitsLost) {
  const TemporaryFolder folder;
  const std::string file = folder.path("summary.json");
  const Report report =
      grade({"--tool", changed("$1 == 1 { $3 += 1e-4 } { print }"), "--corpus", "near", "deep",
             "extreme", "classes", "nested", "symmetric", "profiles", "touching", "ellipses",
             "quadrics", "--json-summary", file});
  const auto series = nlohmann::json::parse(read_file(file));
  EXPECT_LE(series.size(), 40U);
  EXPECT_GE(series.size(), 20U);
  const double error = report.value("near/all/gap error, largest");
  bool is_there = false;
  for (const auto& one : series) {
    EXPECT_EQ(one.size(), 3U);
    EXPECT_GE(one.at("value").get<double>(), 0) << one;
    if (one.at("name") != "near/gap error") continue;
    is_there = true;
    EXPECT_EQ(one.at("unit"), "digits lost");
    EXPECT_NEAR(one.at("value").get<double>(), std::log10(error / 1e-16), 0.006);
  }
  EXPECT_TRUE(is_there) << series;
}

TEST(Outputs, HaveTheDateOfTheSourceAndAreTheSameBytesAgain) {
  const Variable moment("SOURCE_DATE_EPOCH", "86400");
  const TemporaryFolder folder;
  const std::string answers = folder.write("answers.csv", "row,relation\n0,equal\n");
  const auto written = [&](const std::string& option) {
    const std::string file = folder.path("output");
    EXPECT_EQ(run_tool({"grade", "--answers", answers, "--corpus", "near", option, file}).err, "");
    return read_file(file);
  };
  for (const char* option : {"--html", "--junit", "--sarif", "--summary-md"}) {
    const std::string text = written(option);
    EXPECT_NE(text.find("1970-01-02T00:00:00"), text.npos) << option;
    EXPECT_EQ(text, written(option)) << option;
  }
  const Variable none("SOURCE_DATE_EPOCH", "tomorrow");
  const Finished refused = run_tool({"grade", "--answers", answers, "--corpus", "near"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err, "SOURCE_DATE_EPOCH: tomorrow is not a number of seconds since 1970\n");
}

TEST(Outputs, AreRefusedBeforeTheToolIsStarted) {
  const TemporaryFolder folder;
  for (const char* option :
       {"--json", "--json-summary", "--junit", "--sarif", "--summary-md", "--html"}) {
    const Finished run = run_tool({"grade", "--tool", "touch " + folder.path("started"), "--corpus",
                                   "near", option, "/none/file"});
    EXPECT_EQ(run.status, 2) << option;
    EXPECT_EQ(run.err.find("/none/file: "), 0U) << run.err;
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(Outputs, HoldWhateverAToolSays) {
  const TemporaryFolder folder;
  const std::string page = folder.path("page.html"), xml = folder.path("grade.xml"),
                    sarif = folder.path("grade.sarif");
  const Report report = grade_tool("printf '<a>&\"\\001\\377|' >&2; exit 5; # <b>\xff", "near",
                                   {"--html", page, "--junit", xml, "--sarif", sarif,
                                    "--summary-md", folder.path("summary.md")});
  EXPECT_EQ(report.run.status, 1);
  for (const std::string& text : {read_file(page), read_file(xml)}) {
    EXPECT_NE(text.find("&lt;a&gt;&amp;&quot;??|"), text.npos) << text;
    EXPECT_EQ(text.find("<b>"), text.npos);
    EXPECT_EQ(text.find('\xff'), text.npos);
  }
  EXPECT_TRUE(nlohmann::json::accept(read_file(sarif)));
  EXPECT_NE(read_file(folder.path("summary.md")).find("&lt;a&gt;&amp;&quot;??\\|"),
            std::string::npos);
}

}  // namespace
}  // namespace tangency::testing
