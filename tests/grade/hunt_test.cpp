// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a hunt, on subjects that are called.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tangency/verify/hunt/findings.hpp>

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
