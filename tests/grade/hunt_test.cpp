// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a hunt, on subjects that are called.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tangency/tests/tool/process.hpp>
#include <tangency/verify/hunt/findings.hpp>
#include <tangency/verify/hunt/found_corpus.hpp>
#include <tangency/verify/hunt/tool_subject.hpp>

namespace tangency::testing {
namespace {

using namespace verify;

constexpr std::uint64_t kSeed = 20261201;
constexpr std::size_t kNoEnd = 1000000;

const RawEllipsoid kBall{{0, 0, 0}, {1, 1, 1}};

EllipsoidPair balls(double distance) { return {kBall, {{distance, 0, 0}, {1, 1, 1}}}; }

/// Says yes where the bounding spheres meet or nearly so, and remembers what it was asked.
class Spheres final : public Subject {
 public:
  Answers answers(std::span<const EllipsoidPair> pairs) override {
    Answers said;
    for (const EllipsoidPair& pair : pairs) {
      asked.push_back(numbers(pair));
      double square = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        square += std::pow(pair.b.centre[i] - pair.a.centre[i], 2);
      }
      const double reach = std::ranges::max(pair.a.semi_axes) + std::ranges::max(pair.b.semi_axes);
      said.emplace_back(Answer{.overlaps = square < 1.0001 * reach * reach});
    }
    return said;
  }
  std::vector<std::array<double, 20>> asked;
};

std::vector<Source> near_alone() { return {{"near", {balls(2.5)}, pair_families("near")}}; }

std::string fault_of(const Answer& answer, const EllipsoidPair& pair, Goal goal = Goal::relation) {
  return Judge(goal, {}).verdict(pair, answer).fault;
}

TEST(Verdict, WordsAreJudgedAsByTheGrade) {
  EXPECT_EQ(fault_of({.relation = Relation::separate}, balls(2.5)), "");
  EXPECT_EQ(fault_of({.relation = Relation::overlap}, balls(2.5)), "overlap where separate");
  EXPECT_EQ(fault_of({.overlaps = true}, balls(2)), "");
  EXPECT_EQ(fault_of({.overlaps = false}, balls(2)), "");
  EXPECT_EQ(fault_of({.overlaps = true}, balls(2.5)), "overlaps 1 where separate");
  EXPECT_EQ(fault_of({.overlaps = false}, balls(1)), "overlaps 0 where overlap");
  EXPECT_EQ(fault_of({.gap = 0.5}, balls(1)), "gap above 0 where overlap");
  EXPECT_EQ(fault_of({.gap = -0.5}, balls(2.5)), "gap below 0 where separate");
  EXPECT_EQ(Judge(Goal::relation, {}).verdict(balls(1), std::nullopt).fault, "no answer");
}

TEST(Verdict, NumbersAreJudgedToTheirLastDigits) {
  const double off = 0.5 + 0x1p-38;  // L is 4.5
  EXPECT_EQ(fault_of({.gap = 0.5}, balls(2.5), Goal::gap), "");
  EXPECT_EQ(fault_of({.gap = off + 0x1p-36}, balls(2.5), Goal::gap), "gap off");
  EXPECT_EQ(fault_of({.gap = off, .gap_error = 0x1p-38}, balls(2.5), Goal::certificate), "");
  EXPECT_EQ(fault_of({.gap = off, .gap_error = std::nextafter(0x1p-38, 0)}, balls(2.5),
                     Goal::certificate),
            "bound broken");
  Answer answer{.gap = 0.5, .normal = std::array{1.0, 0.0, 0.0}};
  EXPECT_EQ(fault_of(answer, balls(2.5), Goal::normal), "");
  answer.normal = {-1, 0, 0};
  EXPECT_EQ(fault_of(answer, balls(2.5), Goal::normal), "normal reversed");
  answer.normal = {1, 0.001, 0};
  EXPECT_EQ(fault_of(answer, balls(2.5), Goal::normal), "normal off");
  // Concentric balls: every normal is true.
  EXPECT_EQ(fault_of({.gap = -2, .normal = std::array{0.0, 0.6, 0.8}}, balls(0), Goal::normal), "");
  // A local bound holds from below alone.
  const Answer local{.gap = -2, .gap_error = 0.25, .is_local = true};
  EXPECT_EQ(fault_of(local, balls(0.5), Goal::certificate), "");
  EXPECT_EQ(fault_of({.gap = -2, .gap_error = 0.25}, balls(0.5), Goal::certificate),
            "bound broken");
}

std::string fault_without(const char* feature, const EllipsoidPair& pair, Relation answered) {
  Judge judge(Goal::relation, {}, {feature});
  const Verdict verdict = judge.verdict(pair, Answer{.relation = answered});
  return verdict.not_claimed ? "not claimed" : verdict.fault;
}

TEST(Verdict, APairWithAFeatureThatIsNotClaimedHasNoFault) {
  const EllipsoidPair needles{{{0, 0, 0}, {1, 1, 1001}}, {{3, 0, 0}, {1, 1, 1}}};
  const EllipsoidPair nested{kBall, {{0, 0, 0}, {0.5, 0.5, 0.5}}};
  using enum Relation;
  EXPECT_EQ(fault_without("touching", balls(2), overlap), "not claimed");
  EXPECT_EQ(fault_without("near", balls(2 + 0x1p-32), overlap), "not claimed");
  EXPECT_EQ(fault_without("near", balls(2 - 0x1p-32), separate), "not claimed");
  EXPECT_EQ(fault_without("nested", nested, overlap), "not claimed");
  EXPECT_EQ(fault_without("deep", balls(1.5), separate), "not claimed");
  EXPECT_EQ(fault_without("extreme", needles, overlap), "not claimed");
  EXPECT_EQ(fault_without("extreme", balls(1e7), overlap), "not claimed");
}

TEST(Verdict, WhatIsNotClaimedChangesNoVerdictOnOtherPairs) {
  const EllipsoidPair stout{{{0, 0, 0}, {1, 1, 1000}}, {{3, 0, 0}, {1, 1, 1}}};
  using enum Relation;
  EXPECT_EQ(fault_without("touching", balls(2 + 0x1p-51), overlap), "overlap where separate");
  EXPECT_EQ(fault_without("near", balls(2), separate), "separate where external_touch");
  EXPECT_EQ(fault_without("near", balls(2 + 0x1p-26), overlap), "overlap where separate");
  EXPECT_EQ(fault_without("nested", balls(1.5), separate), "separate where overlap");
  EXPECT_EQ(fault_without("deep", balls(1.9), separate), "separate where overlap");
  EXPECT_EQ(fault_without("extreme", stout, overlap), "overlap where separate");
  EXPECT_EQ(fault_without("extreme", stout, separate), "");
}

// A small ball in the middle of a body of semi-axes 3, 2, 1: the gap is -1.5 along z, below minus
// the least radii of curvature. The answered normal is enough, and no claim is believed.
TEST(Verdict, DeepAnswersAreJudgedFromTheirNormal) {
  const EllipsoidPair deep{{{0, 0, 0}, {3, 2, 1}}, {{0, 0, 0x1p-60}, {0.5, 0.5, 0.5}}};
  const auto judged = [&](double gap, double gap_error, const std::array<double, 3>& normal) {
    Judge judge(Goal::certificate, {});
    const Answer answer{.gap = gap, .gap_error = gap_error, .normal = normal};
    const std::string fault = judge.verdict(deep, answer).fault;
    return std::pair(fault, judge.counts().gaps);
  };
  const std::array<double, 3> up{0, 0, 1}, astray{0.6, 0, 0.8};
  const std::size_t none = 0, one = 1;
  EXPECT_EQ(judged(-1.5, 1e-15, up), std::pair(std::string(), none));
  EXPECT_EQ(judged(-1.5 + 1e-13, 9e-14, up), std::pair(std::string("bound broken"), none));
  EXPECT_EQ(judged(-1.5 - 1e-13, 9e-14, up), std::pair(std::string("bound broken"), none));
  EXPECT_EQ(judged(-1.5, 0, up), std::pair(std::string("bound broken"), none));
  EXPECT_EQ(judged(-1.5, 1e-15, astray).first, "");
  // What is no ascent away from the truth is left to the slow oracle: along x f is -3.5.
  EXPECT_EQ(judged(-3.5, 1e-15, {1, 0, 0}), std::pair(std::string("bound broken"), one));
}

// Crossed bodies of one centre: f is -3 along x and -3 - tie along y, lower between.
EllipsoidPair crossed(double tie) { return {{{0, 0, 0}, {1, 2, 3}}, {{0, 0, 0}, {2, 1 + tie, 3}}}; }

// near_tie.hpp (1), (2)
TEST(Verdict, NormalsThatTheRoundingOfTheInputsMakesTrueAreNoFaults) {
  const Answer along_y{.gap = -3, .normal = std::array{0.0, 1.0, 0.0}};
  const Verdict tied = Judge(Goal::normal, {}).verdict(crossed(0x1p-52), along_y);
  EXPECT_EQ(tied.fault, "");
  EXPECT_FALSE(tied.open);
  EXPECT_EQ(fault_of(along_y, crossed(1e-9), Goal::normal), "normal off");
  const Answer between{.gap = -3, .normal = std::array{std::sqrt(0.5), std::sqrt(0.5), 0.0}};
  EXPECT_EQ(fault_of(between, crossed(0x1p-52), Goal::normal), "normal off");
  const Answer longer{.gap = -3, .normal = std::array{0.0, 1.001, 0.0}};
  EXPECT_EQ(fault_of(longer, crossed(0x1p-52), Goal::normal), "normal off");
  // On a tip f falls by less than its rounding, and the witness points part by more.
  const EllipsoidPair tip{{{0, 0, 0}, {100, 1, 1}}, {{100.0011, 0, 0}, {0.001, 0.001, 0.001}}};
  EXPECT_EQ(fault_of({.gap = 1e-4, .normal = std::array{1.0, 3e-6, 0.0}}, tip, Goal::normal),
            "normal off");
}

// The same word in every form of a cell.
TEST(Verdict, ACellThatCannotBeReadIsAFaultOfEveryGoal) {
  for (const char* cells : {"banana,0.5,1,0,0,0", "separate,1e999,1,0,0,0",
                            "separate,0.5,nan,0,0,0", "separate,0.5,1,0,0,x"}) {
    const std::atomic<bool> never = false;
    ToolSubject tool("printf 'row,relation,gap,nx,ny,nz,gap_error\\n0," + std::string(cells) + "'",
                     60, never);
    const EllipsoidPair pair = balls(2.5);
    const Answers answers = tool.answers(std::span(&pair, 1));
    ASSERT_TRUE(answers.at(0));
    for (const Goal goal : {Goal::relation, Goal::gap, Goal::normal, Goal::certificate}) {
      EXPECT_EQ(fault_of(*answers[0], pair, goal), "unreadable cell") << cells;
    }
  }
}

TEST(FoundCorpus, KeepsItsRowsAndAppendsThoseOfOtherPairs) {
  const TemporaryFolder folder;
  const NamedPair apart{"one kind", "first", balls(2.5)}, deep{"another", "second", balls(1)};
  FoundCorpus first(folder.path("found"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("found/hunt.csv")));
  EXPECT_EQ(first.add(std::vector{apart}), 1U);
  const std::string inputs = read_file(folder.path("found/hunt.csv"));
  const std::string truth = read_file(folder.path("found/hunt.truth.csv"));
  FoundCorpus second(folder.path("found"));
  EXPECT_EQ(second.rows(), 1U);
  EXPECT_EQ(second.add(std::vector{apart}), 0U);
  EXPECT_EQ(read_file(folder.path("found/hunt.csv")), inputs);
  EXPECT_EQ(second.add(std::vector{apart, deep}), 1U);
  const std::array both{apart, deep};
  const CorpusText whole = corpus_of(both, "Found by `tangency-verify hunt`.");
  EXPECT_EQ(read_file(folder.path("found/hunt.csv")), whole.inputs);
  EXPECT_EQ(read_file(folder.path("found/hunt.truth.csv")), whole.truth);
  EXPECT_TRUE(whole.truth.starts_with(truth));
}

TEST(FoundCorpus, RefusesTablesOfOtherColumns) {
  const TemporaryFolder folder;
  folder.write("hunt.csv", "a.x\n1\n");
  EXPECT_THROW(FoundCorpus{folder.path("")}, tables::Error);  // and no truth
  folder.write("hunt.truth.csv", "row,family\n");
  EXPECT_THROW(FoundCorpus{folder.path("")}, tables::Error);
  EXPECT_EQ(read_file(folder.path("hunt.csv")), "a.x\n1\n");
}

TEST(Moves, EachMakesOtherPairsOfEllipsoids) {
  for (const Move& move : moves()) {
    Draw draw(kSeed);
    std::size_t changed = 0, fair = 0;
    for (int i = 0; i < 50; ++i) {
      const EllipsoidPair before{{{1, 2, 3}, {3, 2, 1}, {1, 2, 3, 4}},
                                 {{4, 3.5, 4}, {1.25, 0.5, 2}, {4, 1, 1, 2}}};
      EllipsoidPair after = before;
      move.change(draw, after, nearness(gap_bracket(before.a, before.b)));
      changed += numbers(after) != numbers(before);
      fair += is_fair(after);
    }
    EXPECT_GT(changed, 30U) << move.name;
    EXPECT_GT(fair, 45U) << move.name;
  }
}

TEST(Moves, PlaceBAtTheGapThatIsAskedFor) {
  for (const double distance : {2.5, 1.75}) {
    for (const double gap : {0.125, -0.125}) {
      EllipsoidPair pair = balls(distance);
      place_at_gap(pair, nearness(gap_bracket(pair.a, pair.b)), gap);
      EXPECT_NEAR(pair.b.centre[0], 2 + gap, 1e-12) << distance;
    }
  }
}

TEST(Search, LeadsToFaultsAndMakesThemSimple) {
  Judge judge(Goal::relation, {});
  Search search(judge, near_alone(), kSeed);
  Spheres spheres;
  while (search.answers() < 500) search.step(spheres, kNoEnd);
  const auto found = findings(search, spheres, 2, 2000);
  ASSERT_FALSE(found.empty());
  for (const HuntFinding& one : found) {
    EXPECT_EQ(one.fault, "overlaps 1 where separate");
    EXPECT_TRUE(one.again);
    EXPECT_LE(most_digits(one.simple.pair), 3) << pair_text(one.simple.pair);
    EXPECT_LT(complexity(one.simple.pair), complexity(one.before));
    const auto truth = exact_relation(one.simple.pair.a, one.simple.pair.b).relation;
    EXPECT_EQ(truth, Relation::separate);
  }
}

// search.hpp (1), (2)
TEST(Search, AsksTheSameAfterABreak) {
  Judge judge(Goal::relation, {});
  Spheres whole, broken;
  Search without(judge, near_alone(), kSeed), before(judge, near_alone(), kSeed);
  for (int i = 0; i < 5; ++i) without.step(whole, kNoEnd);
  for (int i = 0; i < 2; ++i) before.step(broken, kNoEnd);
  Search after(judge, near_alone(), kSeed);
  ASSERT_EQ(after.resume(before.saved("the same"), "the same"), "");
  for (int i = 2; i < 5; ++i) after.step(broken, kNoEnd);
  EXPECT_EQ(broken.asked, whole.asked);
  EXPECT_EQ(after.saved(""), without.saved(""));
  EXPECT_NE(after.resume(before.saved("the same"), "another"), "");
}

TEST(Search, APartOfAGenerationCountsAndIsNotWhole) {
  Judge judge(Goal::relation, {});
  Search search(judge, near_alone(), kSeed);
  Spheres spheres;
  EXPECT_TRUE(search.step(spheres, kNoEnd));
  EXPECT_FALSE(search.step(spheres, 5));
  EXPECT_EQ(search.answers(), 21U);
}

}  // namespace
}  // namespace tangency::testing
