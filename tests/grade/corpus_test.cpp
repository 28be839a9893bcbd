// SPDX-License-Identifier: GPL-3.0-or-later
//
// The golden corpora: that they are what the generator makes, and that they say the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/tests/tool/process.hpp>
#include <tangency/verify/answers/corpus_source.hpp>
#include <tangency/verify/answers/truth_table.hpp>
#include <tangency/verify/corpus/coaxial.hpp>
#include <tangency/verify/corpus/corpus.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/placing.hpp>
#include <tangency/verify/oracles/ellipse.hpp>
#include <tangency/verify/oracles/gap.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::verify {
namespace {

const std::string kFolder = TANGENCY_CORPORA "/";

std::string committed(std::string_view name, const char* suffix) {
  return testing::read_file(kFolder + std::string(name) + suffix);
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

// The rows of each family: inputs, and truth lines without their row numbers.
struct FamilyRows {
  std::vector<std::string> inputs, truth;
};

std::map<std::string, FamilyRows> by_family(const CorpusText& text, std::size_t most) {
  std::vector<std::string> inputs;
  for (const std::string& line : lines(text.inputs)) {
    if (!line.starts_with('#')) inputs.push_back(line);
  }
  std::map<std::string, FamilyRows> families;
  std::string last_row;
  bool header = true;
  for (const std::string& line : lines(text.truth)) {
    if (line.starts_with('#')) continue;
    if (std::exchange(header, false)) continue;
    const std::size_t first = line.find(','), second = line.find(',', first + 1);
    const std::string row = line.substr(0, first);
    FamilyRows& family = families[line.substr(first + 1, second - first - 1)];
    if (row != last_row && family.inputs.size() == most) continue;
    if (row != last_row) family.inputs.push_back(inputs.at(std::stoul(row) + 1));
    last_row = row;
    family.truth.push_back(line.substr(second));
  }
  return families;
}

TEST(Corpus, FirstRowsOfEveryFamilyAreGeneratedAgainByteForByte) {
  for (const CorpusInfo& corpus : corpora()) {
    // Neighbours are made whole, and all of them compared.
    const std::size_t most = corpus.kind == CorpusKind::neighbours ? kWholeFamily : 2;
    const auto made = by_family(generate(corpus.name, most), most);
    const auto kept =
        by_family({committed(corpus.name, ".csv"), committed(corpus.name, ".truth.csv")}, most);
    ASSERT_EQ(made.size(), kept.size()) << corpus.name;
    for (const auto& [family, rows] : made) {
      ASSERT_TRUE(kept.contains(family)) << family;
      EXPECT_EQ(rows.inputs.size(), std::min(most, kept.at(family).inputs.size())) << family;
      EXPECT_EQ(rows.inputs, kept.at(family).inputs) << corpus.name << ' ' << family;
      EXPECT_EQ(rows.truth, kept.at(family).truth) << corpus.name << ' ' << family;
    }
  }
}

TEST(Corpus, WholeFilesAreWrittenByteForByte) {
  for (const char* name : {"quadrics", "near"}) {
    const testing::TemporaryFolder folder;
    const testing::Finished run =
        testing::run_tool({"generate", name, "--out", folder.path("made")});
    EXPECT_EQ(run.status, 0) << run.err;
    for (const char* suffix : {".csv", ".truth.csv"}) {
      EXPECT_EQ(testing::read_file(folder.path("made/" + std::string(name) + suffix)),
                committed(name, suffix));
    }
  }
}

TEST(Corpus, TheProgramHoldsEveryFileByteForByte) {
  const CorpusSource inside, folder{std::filesystem::path(kFolder)};
  EXPECT_EQ(inside.names(), folder.names());
  ASSERT_FALSE(inside.names().empty());
  for (const std::string& name : folder.names()) {
    EXPECT_EQ(inside.inputs(name).text, folder.inputs(name).text) << name;
    EXPECT_EQ(inside.truth(name).text, folder.truth(name).text) << name;
    EXPECT_EQ(inside.kind(name), folder.kind(name)) << name;
  }
}

TEST(Corpus, AllTogetherStayBelowFourMebibytes) {
  std::uintmax_t bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(kFolder)) bytes += file.file_size();
  EXPECT_LE(bytes, std::uintmax_t{4} << 20);
}

TEST(Corpus, HoldsEveryRelationTypeResultAndStatus) {
  std::map<CorpusKind, std::set<Relation>> relations;
  std::map<CorpusKind, std::set<std::string>> words;
  for (const CorpusInfo& corpus : corpora()) {
    const TruthTable truth =
        read_truth(tables::Reader(kFolder + std::string(corpus.name) + ".truth.csv"),
                   Definition::common_normal);
    EXPECT_EQ(truth.kind, corpus.kind);
    for (const TruthRow& row : truth.rows) {
      relations[truth.kind].insert(row.relation);
      words[truth.kind].insert(row.word);
    }
  }
  for (const CorpusKind kind : {CorpusKind::pairs, CorpusKind::ellipses, CorpusKind::matrices})
    EXPECT_EQ(relations[kind].size(), 7U) << name(kind);
  EXPECT_EQ(relations[CorpusKind::floats].size(), 6U);  // all but equal
  EXPECT_EQ(relations[CorpusKind::walls].size(), 5U);   // neither equal nor b_in_a
  EXPECT_EQ(words[CorpusKind::quadrics].size(), 20U);
  EXPECT_EQ(words[CorpusKind::rays].size(), 3U);
  EXPECT_EQ(words[CorpusKind::times].size(), 4U);
}

RawEllipsoid body(const tables::RowCursor& row, const tables::Header& header,
                  const std::string& who) {
  const auto cell = [&](const char* field) { return row.number(header.require(who + field)); };
  return {{cell(".x"), cell(".y"), cell(".z")},
          {cell(".r1"), cell(".r2"), cell(".r3")},
          {cell(".qw"), cell(".qx"), cell(".qy"), cell(".qz")}};
}

// f(n) is the gap at every normal that the truth names, and nowhere on a coarse grid more.
TEST(Corpus, EveryTrueNormalReachesTheGapAndNoneOfAGridExceedsIt) {
  Draw draw(1);
  for (const CorpusInfo& corpus : corpora()) {
    if (corpus.kind != CorpusKind::pairs && corpus.kind != CorpusKind::floats) continue;
    const double unit = corpus.kind == CorpusKind::floats ? 0x1p24 : 1;
    const std::string path = kFolder + std::string(corpus.name);
    const TruthTable truth =
        read_truth(tables::Reader(path + ".truth.csv"), Definition::common_normal);
    tables::Reader reader(path + ".csv");
    tables::for_each_row(reader, [&](const tables::RowCursor& line) {
      if (line.index() % 5 != 0) return;
      const TruthRow& row = truth.rows.at(line.index());
      const auto pair = separation(real(body(line, reader.header(), "a")),
                                   real(body(line, reader.header(), "b")));
      const Real gap = Real(row.gap.value().high) + row.gap->low;
      const double size = unit * row.size;
      ASSERT_LT(abs(ascent::extent(pair) / size - 1), 1e-15);
      const auto f = [&](const std::array<double, 3>& n) {
        return ascent::value(pair, ascent::normalised(Real3{n[0], n[1], n[2]})).f;
      };
      for (std::size_t i = 0; i < row.normals; ++i) {
        const Real off = f(truth.maximisers.at(row.first_normal + i).normal) - gap;
        // A rounded normal loses up to the square of its error times the curvature, never gains.
        EXPECT_LT(abs(off), 1e-15 * size) << corpus.name << " row " << line.index();
      }
      EXPECT_TRUE(row.every_normal || row.normals > 0);
      for (int i = 0; i < 20; ++i) {
        const Real3 n = drawn_direction(draw);
        EXPECT_LE(ascent::value(pair, n).f, gap + 1e-30 * size)
            << corpus.name << " row " << line.index();
      }
    });
  }
}

RawEllipse ellipse(const tables::RowCursor& row, const tables::Header& header,
                   const std::string& who) {
  const auto cell = [&](const char* field) { return row.number(header.require(who + field)); };
  return {{cell(".x"), cell(".y")}, {cell(".r1"), cell(".r2")}, {cell(".ux"), cell(".uy")}};
}

Real support(const RawEllipse& e, const std::array<Real, 2>& n) {
  const Real ux = e.direction[0], uy = e.direction[1];
  const Real p = e.semi_axes[0] * (ux * n[0] + uy * n[1]),
             q = e.semi_axes[1] * (ux * n[1] - uy * n[0]);
  return sqrt((p * p + q * q) / (ux * ux + uy * uy));
}

// A normal that is right to 1e-16 loses no more than 1e-32 by the bend of f, which is that of a
// flat body at its end: up to the aspect ratio squared, 1e12, of the size.
TEST(Corpus, EveryTrueNormalOfEllipsesReachesTheGapAndNoneOfAGridExceedsIt) {
  const std::string path = kFolder + "ellipses";
  const TruthTable truth =
      read_truth(tables::Reader(path + ".truth.csv"), Definition::common_normal);
  tables::Reader reader(path + ".csv");
  std::size_t ties = 0;
  tables::for_each_row(reader, [&](const tables::RowCursor& line) {
    const TruthRow& row = truth.rows.at(line.index());
    const RawEllipse a = ellipse(line, reader.header(), "a"),
                     b = ellipse(line, reader.header(), "b");
    const Real gap = Real(row.gap.value().high) + row.gap->low;
    const auto f = [&](Real x, Real y) {
      const Real norm = sqrt(x * x + y * y);
      x /= norm, y /= norm;
      return Real(x * (Real(b.centre[0]) - a.centre[0]) + y * (Real(b.centre[1]) - a.centre[1]) -
                  support(a, {x, y}) - support(b, {x, y}));
    };
    EXPECT_TRUE(row.every_normal || row.normals > 0) << line.index();
    ties += row.normals > 1;
    const double bend = truth.families.at(row.family) == "extreme" ? 1e12 : 1e6;
    for (std::size_t i = 0; i < row.normals; ++i) {
      const auto& n = truth.maximisers.at(row.first_normal + i).normal;
      EXPECT_LT(abs(f(n[0], n[1]) - gap), 1e-31 * bend * row.size) << line.index();
    }
    for (int i = 0; i < 64; ++i) {
      EXPECT_LE(f(cos(Real(i) / 10), sin(Real(i) / 10)), gap + 1e-30 * row.size) << line.index();
    }
  });
  EXPECT_GT(ties, 70U);
}

TEST(CoaxialGap, IsTheGlobalGapOfTheSearchOverAllNormals) {
  Draw draw(2);
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const double round_a = draw.log_uniform(0.2, 5), round_b = draw.log_uniform(0.2, 5);
    const double polar_a = draw.log_uniform(0.2, 5), polar_b = draw.log_uniform(0.2, 5);
    const double distance = draw.real(0, 1.1) * (polar_a + polar_b);
    const RealEllipsoid a = real({{}, {round_a, polar_a, round_a}, {1, 0, 0, 0}});
    const RealEllipsoid b = real({{0, distance, 0}, {round_b, polar_b, round_b}, {1, 0, 0, 0}});
    const auto found = coaxial_gap(a, b);
    ASSERT_TRUE(found);
    const GapTruth truth = signed_gap(a, b);
    EXPECT_LT(abs(found->gap - truth.gap), Real("1e-100"));
    ASSERT_FALSE(found->cosines.empty());
    for (const Real& cosine : found->cosines) {
      const Real3 n{sqrt(1 - cosine * cosine), cosine, 0};
      EXPECT_LT(abs(ascent::value(separation(a, b), n).f - found->gap), Real("1e-100"));
    }
    compared += truth.global;
  }
  EXPECT_GT(compared, 20);  // the search proves those whose best normal is the axis
}

TEST(CoaxialGap, SaysNothingOfPairsWithoutACommonAxis) {
  const RealEllipsoid a = real({{}, {1, 2, 1}, {1, 0, 0, 0}});
  EXPECT_FALSE(coaxial_gap(a, real({{0, 1, 0x1p-300}, {1, 2, 1}, {1, 0, 0, 0}})));
  EXPECT_FALSE(coaxial_gap(a, real({{0, 1, 0}, {1, 2, 1}, {1, 0x1p-52, 0, 0}})));
  EXPECT_FALSE(coaxial_gap(a, real({{0, 1, 0}, {1, 2, 1.5}, {1, 0, 0, 0}})));
  EXPECT_TRUE(coaxial_gap(a, real({{0, -1, 0}, {2, 2, 2}, {1, 2, 3, 4}})));
}

}  // namespace
}  // namespace tangency::verify
