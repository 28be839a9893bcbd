// SPDX-License-Identifier: GPL-3.0-or-later
// The quick oracle against the exact ones, on every family of pairs that there is.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/families.hpp>
#include <tangency/verify/oracles/gap.hpp>
#include <tangency/verify/oracles/gap_bracket.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::testing {
namespace {

using verify::EllipsoidPair;
using verify::GapBracket;
using verify::Real;

constexpr std::uint64_t kSeed = 20261201;
constexpr std::array<std::string_view, 8> kCorpora{"classes", "near",    "touching", "symmetric",
                                                   "nested",  "extreme", "deep",     "profiles"};

template <class Use>
void for_each_pair(std::size_t count, const Use& use) {
  for (const std::string_view corpus : kCorpora) {
    for (const auto& family : verify::pair_families(corpus)) {
      const auto next = family.sequence(kSeed);
      for (std::size_t i = 0; i < count; ++i) use(next());
    }
  }
}

TEST(GapBracket, TheRelationIsTheExactOneWhereItSaysOne) {
  std::size_t pairs = 0, said = 0;
  const auto check = [&](const EllipsoidPair& pair) {
    const auto relation = verify::gap_bracket(pair.a, pair.b).relation;
    const auto truth = verify::exact_relation(pair.a, pair.b).relation;
    ++pairs;
    if (!relation) return;
    ++said;
    EXPECT_EQ(verify::name(*relation), verify::name(truth)) << "seed " << kSeed;
  };
  for_each_pair(40, check);
  verify::for_each_adversarial_pair(kSeed, 1500, check);
  // It is of use: it says more than half of pairs that were chosen to be hard for it.
  EXPECT_GT(2 * said, pairs) << said << " of " << pairs;
}

TEST(GapBracket, TheBoundsEncloseTheGap) {
  std::size_t bounded = 0, tight = 0, pairs = 0;
  for_each_pair(2, [&](const EllipsoidPair& pair) {
    const GapBracket bracket = verify::gap_bracket(pair.a, pair.b);
    const auto truth = verify::signed_gap(pair.a, pair.b);
    ++pairs;
    EXPECT_LE(Real(bracket.lower), truth.gap + truth.unproven) << "seed " << kSeed;
    if (!(bracket.upper < std::numeric_limits<long double>::infinity())) return;
    ++bounded;
    EXPECT_GE(Real(bracket.upper), truth.gap) << "seed " << kSeed;
    // 2^-56 of the size: the last digits of doubles are seen.
    tight += static_cast<double>(bracket.upper - bracket.lower) <= 0x1p-56 * bracket.size;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(bracket.normal[i], truth.normal[i].convert_to<double>(),
                  bracket.normal_error + 0x1p-52);
    }
  });
  EXPECT_GT(2 * bounded, pairs) << bounded << " of " << pairs;
  EXPECT_GT(100 * tight, 99 * bounded) << tight << " of " << bounded;
}

// The claim is a start, no premise: whatever it is the bounds hold.
TEST(GapBracket, TheBoundsEncloseTheGapWhateverNormalIsClaimed) {
  std::size_t right = 0, tight = 0, deep = 0;
  for_each_pair(2, [&](const EllipsoidPair& pair) {
    const auto truth = verify::signed_gap(pair.a, pair.b);
    const std::array<double, 3> best{truth.normal[0].convert_to<double>(),
                                     truth.normal[1].convert_to<double>(),
                                     truth.normal[2].convert_to<double>()};
    const bool is_deep =
        !(verify::gap_bracket(pair.a, pair.b).upper < std::numeric_limits<long double>::infinity());
    for (const auto& claimed : {best, std::array<double, 3>{-best[1], best[0], best[2]},
                                std::array<double, 3>{0, 0, 1}, std::array<double, 3>{}}) {
      const GapBracket bracket = verify::gap_bracket(pair.a, pair.b, {0, claimed});
      EXPECT_LE(Real(bracket.lower), truth.gap + truth.unproven) << "seed " << kSeed;
      EXPECT_GE(Real(bracket.upper), truth.gap) << "seed " << kSeed;
    }
    if (!is_deep || !truth.global) return;
    const GapBracket bracket = verify::gap_bracket(pair.a, pair.b, {0, best});
    ++deep;
    right += bracket.upper < std::numeric_limits<long double>::infinity();
    tight += static_cast<double>(bracket.upper - bracket.lower) <= 0x1p-56 * bracket.size;
  });
  // Two thirds of those that the least radii of curvature leave open, to the digits of doubles.
  EXPECT_GT(3 * tight, 2 * deep) << tight << " and " << right << " of " << deep;
}

}  // namespace
}  // namespace tangency::testing
