// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a tool does not claim, where it is known to fail, and rows that are drawn anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/tests/grade/report.hpp>
#include <tangency/verify/answers/claims.hpp>
#include <tangency/verify/corpus/corpus.hpp>

namespace tangency::testing {
namespace {

using verify::CorpusSource;
using verify::Feature;
using verify::Standing;
using verify::TruthTable;

TruthTable truth_of(const CorpusSource& source, const std::string& corpus) {
  const verify::CorpusTable table = source.truth(corpus);
  return verify::read_truth(tables::Reader(table.named()), verify::Definition::common_normal);
}

std::size_t with_standing(const TruthTable& truth, Standing standing) {
  return static_cast<std::size_t>(
      std::ranges::count(truth.rows, standing, &verify::TruthRow::standing));
}

std::string last_line(const Report& report) {
  const std::string& out = report.run.out;
  const std::size_t end = out.rfind('\n', out.size() - 2);
  return out.substr(end == out.npos ? 0 : end + 1);
}

TEST(Claims, EveryFeatureHasRowsOfTheCommittedCorporaAndNoneHasAll) {
  const CorpusSource source;
  std::map<std::string_view, std::size_t> rows;
  std::size_t all = 0;
  for (const std::string& corpus : source.chosen({})) {
    const TruthTable truth = truth_of(source, corpus);
    all += truth.rows.size();
    for (const Feature& feature : verify::features()) {
      TruthTable left = truth;
      verify::leave_out(std::vector{std::string(feature.name)}, corpus, left);
      rows[feature.name] += with_standing(left, Standing::not_claimed);
    }
  }
  EXPECT_EQ(rows.size(), 6U);
  for (const auto& [feature, count] : rows) {
    EXPECT_GT(count, 100U) << feature;
    EXPECT_LT(count, all / 2) << feature;
  }
}

// The sphere tool knows no touch: all that it gets wrong elsewhere it gets wrong still.
TEST(Claims, RowsThatAreNotClaimedAreCountedApartAndNothingElseChanges) {
  const Report whole = grade_tool(kKernel, "touching", {});
  const Report part = grade_tool(kKernel, "touching", {"--not-claimed", "touching,extreme"});
  EXPECT_EQ(part.run.status, 0) << part.run.out;
  const double left_out = part.value("touching/all/rows not claimed");
  EXPECT_EQ(part.value("touching/all/pairs"), 390 - left_out);
  EXPECT_GT(left_out, 100);
  EXPECT_NE(last_line(part).find(std::to_string(static_cast<int>(left_out)) +
                                 " rows not claimed (touching,extreme)"),
            std::string::npos)
      << last_line(part);
  EXPECT_EQ(part.value("touching/far_origin/pairs"), 0);
  EXPECT_EQ(whole.value("touching/next_float_grid/pairs"),
            part.value("touching/next_float_grid/pairs") +
                part.value("touching/next_float_grid/rows not claimed"));
  // Where nothing is left out nothing is different.
  const Report same = grade_tool(kKernel, "deep", {"--not-claimed", "touching"});
  const Report usual = grade_tool(kKernel, "deep", {});
  EXPECT_EQ(same.value("deep/all/gap error, largest"), usual.value("deep/all/gap error, largest"));
  EXPECT_EQ(same.value("deep/all/pairs"), usual.value("deep/all/pairs"));
}

// Wrong on a touch alone, and rubbish there.
TEST(Claims, WhatIsWrongOnARowThatIsNotClaimedFailsNoGrade) {
  const std::string tool = changed(
      "NR == 1 { print $1, $2; next } $2 ~ /touch/ { print $1, \"perhaps\"; next } { print $1, $2 "
      "}");
  EXPECT_EQ(grade_tool(tool, "touching").run.status, 1);
  const Report part = grade_tool(tool, "touching", {"--not-claimed", "touching"});
  EXPECT_EQ(part.run.status, 0) << part.run.out;
}

TEST(Claims, AWordThatIsNoFeatureIsRefused) {
  EXPECT_EQ(grade_tool("true", "near", {"--not-claimed", "touching,touchy"}).run.err,
            "--not-claimed: touchy is not a feature; these are: touching near nested deep ties "
            "extreme\n");
}

TEST(ExpectedFailures, AreCountedApartAndThoseThatPassAreNamed) {
  const TemporaryFolder folder;
  const std::string tool =
      changed("NR == 9 { $2 = \"equal\" } NR == 1 || NR == 9 || NR > 1 { print $1, $2 }");
  EXPECT_EQ(grade_tool(tool, "near").run.status, 1);
  const std::string expected =
      folder.write("known.csv", "# why\ncorpus,row\nnear,7\nnear,8\ndeep,0\n");
  const Report report = grade_tool(tool, "near", {"--expected", expected});
  EXPECT_EQ(report.run.status, 0) << report.run.out;
  EXPECT_EQ(report.value("near/all/expected failures"), 1);
  EXPECT_EQ(report.value("near/all/pairs"), 359);
  EXPECT_NE(last_line(report).find(", 1 failed as expected"), std::string::npos);
  EXPECT_TRUE(report.says("BETTER than " + expected + " expects, which need not name it: near,8\n"))
      << report.run.out;
}

TEST(ExpectedFailures, OfNoRowOrNoCorpusAreRefusedByLine) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& rows) {
    const Report report =
        grade_tool("true", "near", {"--expected", folder.write("x.csv", "corpus,row\n" + rows)});
    EXPECT_EQ(report.run.status, 2);
    return report.run.err.substr(std::min(report.run.err.find("x.csv"), report.run.err.size()));
  };
  EXPECT_EQ(refusal("near,7\nnear,360\n"), "x.csv:3: row = 360: near has the rows 0 to 359\n");
  EXPECT_EQ(refusal("far,7\n"), "x.csv:2: corpus = far: there is no corpus of this name\n");
  EXPECT_EQ(refusal("near,-1\n"), "x.csv:2: row = -1: a row is a whole number from 0\n");
  EXPECT_EQ(refusal("near,7\nnear,7\n"), "x.csv:3: row = 7: a row must be named only once\n");
}

std::set<std::string> lines_of_rows(const std::string& text) {
  std::set<std::string> rows;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with('#') && !line.starts_with('a') && !line.starts_with('A')) {
      rows.insert(line);
    }
  }
  return rows;
}

// Of a corpus that is drawn, one of integers, one that is computed, ellipses and quadrics.
TEST(FreshSeeds, DrawOtherRowsOfEveryFamilyTheSameForASeed) {
  for (const char* name : {"classes", "touching", "profiles", "ellipses", "quadrics"}) {
    constexpr std::size_t kRows = 2;
    const verify::CorpusText committed = verify::generate(name, kRows);
    const verify::CorpusText one = verify::generate(name, kRows, 1),
                             two = verify::generate(name, kRows, 2);
    EXPECT_EQ(one.inputs, verify::generate(name, kRows, 1).inputs) << name;
    std::set<std::string> all = lines_of_rows(committed.inputs);
    const std::size_t rows = all.size();
    for (const auto* text : {&one, &two}) all.merge(lines_of_rows(text->inputs));
    EXPECT_EQ(all.size(), 3 * rows) << name;
    EXPECT_NE(
        one.inputs.find(std::string("tangency-verify generate ") + name + " --seed 1 --rows 2`"),
        std::string::npos);
  }
}

TEST(FreshSeeds, AreGradedByTheOraclesAndSaid) {
  const TemporaryFolder folder;
  const std::string page = folder.path("page.md");
  const Report report =
      grade({"--tool", kKernel, "--seed", "20261201", "--rows", "1", "--summary-md", page});
  EXPECT_EQ(report.run.status, 0) << report.run.out;
  EXPECT_EQ(last_line(report).find("passed: 69 rows in 8 corpora: 0 wrong, 0 missing"), 0U)
      << last_line(report);
  EXPECT_NE(read_file(page).find("drawn from seed 20261201, 1 rows a family"), std::string::npos);
}

TEST(FreshSeeds, GoWithNoCommittedRows) {
  const auto refused = [](const std::vector<std::string>& options) {
    const Report report = grade_tool("true", "near", options);
    EXPECT_EQ(report.run.status, 2);
    return report.run.err;
  };
  EXPECT_NE(refused({"--rows", "3"}).find("it needs a --seed other than 0"), std::string::npos);
  EXPECT_NE(refused({"--seed", "1", "--corpora", "."}).find("give one of the two"),
            std::string::npos);
  EXPECT_NE(refused({"--seed", "1", "--expected", "x"}).find("--expected names committed rows"),
            std::string::npos);
  EXPECT_NE(refused({"--seed", "-1"}).find("--seed: -1 is not a whole number from 0"),
            std::string::npos);
  EXPECT_NE(refused({"--seed", "1", "--rows", "301"}).find("from 1 to 300"), std::string::npos);
}

TEST(CorpusVersion, IsSaidByTheProgramAndItsPages) {
  const std::string version = CorpusSource().version();
  EXPECT_EQ(version, CorpusSource(std::filesystem::path(TANGENCY_CORPORA)).version());
  EXPECT_NE(run_tool({"--version"}).out.find(", corpora " + version + '\n'), std::string::npos);
  const TemporaryFolder folder;
  const std::string page = folder.path("page.md");
  grade_tool(kKernel, "near", {"--summary-md", page});
  EXPECT_NE(read_file(page).find("corpus version"), std::string::npos);
}

}  // namespace
}  // namespace tangency::testing
