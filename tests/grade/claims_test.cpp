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

/// The features of a row that stands alone in a corpus, in their order.
std::string features_of(const verify::TruthRow& row, const std::string& family = "plain",
                        const std::string& corpus = "own",
                        verify::CorpusKind kind = verify::CorpusKind::pairs) {
  const TruthTable truth{kind, {family}, {row}, {{{1, 0, 0}, {}}, {{1, 0, 0}, {{0, 0, 1}}}}, {}};
  std::string names;
  for (const Feature& feature : verify::features()) {
    if (verify::has_feature(feature.name, corpus, truth, truth.rows.front()))
      names += (names.empty() ? "" : " ") + std::string(feature.name);
  }
  return names;
}

/// A row of one true normal, with a gap in L.
verify::TruthRow row_at(verify::Relation relation, double gap, double size = 4) {
  verify::TruthRow row;
  row.relation = relation;
  row.size = size;
  row.gap = {gap * 4, 0};
  row.normals = 1;
  return row;
}

// With a row on either side of each bound.
TEST(Claims, AFeatureIsOfTheRowsThatItsSentenceNames) {
  using enum verify::Relation;
  EXPECT_EQ(features_of(row_at(separate, 1)), "");
  EXPECT_EQ(features_of(row_at(separate, 1.1e-9)), "");
  EXPECT_EQ(features_of(row_at(separate, 0.9e-9)), "near");
  EXPECT_EQ(features_of(row_at(overlap, -0.9e-9)), "near");
  EXPECT_EQ(features_of(row_at(overlap, -0.09)), "");
  EXPECT_EQ(features_of(row_at(overlap, -0.11)), "deep");
  EXPECT_EQ(features_of(row_at(external_touch, 0)), "touching");
  EXPECT_EQ(features_of(row_at(internal_touch, -0.09)), "touching nested");
  for (const verify::Relation nested : {a_in_b, b_in_a, equal})
    EXPECT_EQ(features_of(row_at(nested, -0.09)), "nested");
  // Of rays and times the word alone says so.
  verify::TruthRow word;
  for (const char* touching : {"grazing", "touching_at_start"}) {
    word.word = touching;
    EXPECT_EQ(features_of(word), "touching") << touching;
  }
  word.word = "contact";
  EXPECT_EQ(features_of(word), "");
  // Two normals, all of them, and the turns of one about an axis.
  verify::TruthRow tied = row_at(overlap, -0.05);
  tied.normals = 2;
  EXPECT_EQ(features_of(tied), "ties");
  tied.normals = 1, tied.first_normal = 1;
  EXPECT_EQ(features_of(tied), "ties");
  tied.normals = 0, tied.every_normal = true;
  EXPECT_EQ(features_of(tied), "ties");
  for (const char* family : {"extreme", "extreme_scale", "far_origin"})
    EXPECT_EQ(features_of(row_at(separate, 1), family), "extreme") << family;
  EXPECT_EQ(features_of(row_at(separate, 1), "plain", "extreme"), "extreme");
  // The errors of floats are in 2^-24 L, and the features in L.
  const auto of_floats = [](double gap) {
    return features_of(row_at(gap < 0 ? overlap : separate, gap, 4 * 0x1p-24), "plain", "own",
                       verify::CorpusKind::floats);
  };
  EXPECT_EQ(of_floats(0.9e-9), "near");
  EXPECT_EQ(of_floats(-0.09), "");
  EXPECT_EQ(of_floats(-0.11), "deep");
}

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
  for (const auto& entry : usual.values) {
    const auto name = entry.at("name").get<std::string>();
    if (name == "deep/time") continue;
    EXPECT_EQ(same.value(name), entry.at("value").get<double>()) << name;
  }
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
    const std::string one = verify::generate(name, 1, 1).inputs;
    EXPECT_NE(one.find("tangency-verify generate " + std::string(name) + " --seed 1 --rows 1`"),
              std::string::npos);
    std::set<std::string> all;
    std::size_t rows = 0;
    for (const std::string& text :
         {one, verify::generate(name, 1, 2).inputs, verify::generate(name, 1).inputs}) {
      std::set<std::string> some = lines_of_rows(text);
      rows += some.size();
      all.merge(some);
    }
    EXPECT_GE(rows, 9U) << name;
    EXPECT_EQ(all.size(), rows) << name;
  }
  EXPECT_EQ(verify::generate("classes", 1, 1).inputs, verify::generate("classes", 1, 1).inputs);
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
