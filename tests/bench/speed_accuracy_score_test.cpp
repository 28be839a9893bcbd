// SPDX-License-Identifier: GPL-3.0-or-later
// The scores of bench_speed_accuracy see every kind of wrong answer, and rank errors as they say.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tangency/bench/speed_accuracy/methods.hpp>
#include <tangency/bench/speed_accuracy/pairs.hpp>
#include <tangency/bench/speed_accuracy/score.hpp>

namespace tangency::speed_accuracy {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBroken = 7;

/// Right answers to real pairs, for a test to break one of.
class BrokenAnswer : public ::testing::Test {
 protected:
  void SetUp() override {
    pairs_ = draw_pairs("class2", 20);
    for (std::size_t i = 0; i < pairs_->size(); ++i) truth_.push_back(truth_of(*pairs_, i));
    for (const Method& method : methods_on(*pairs_, {})) {
      if (method.name != "signed_gap" && method.name != "overlaps") continue;
      method.run();
      (method.name == "overlaps" ? yes_or_no_ : answers_) = method.answers();
    }
    ASSERT_EQ(score(answers_, truth_).wrong, 0u);
    ASSERT_EQ(score(yes_or_no_, truth_).wrong, 0u);
  }
  void expect_caught() const {
    const Score s = score(answers_, truth_);
    EXPECT_EQ(s.wrong, 1u);
    EXPECT_EQ(s.first_wrong, kBroken);
  }

  std::unique_ptr<Pairs> pairs_;
  std::vector<Truth> truth_;
  std::vector<Answer> answers_, yes_or_no_;
};

TEST_F(BrokenAnswer, BeyondItsProvenErrorIsCaught) {
  Answer& a = answers_[kBroken];
  a.gap += 2.5 * a.gap_error;
  expect_caught();
  a.gap -= 5 * a.gap_error;
  expect_caught();
}

TEST_F(BrokenAnswer, OfTheWrongSignIsCaughtWhateverItPromises) {
  Answer& a = answers_[kBroken];
  a.gap = -a.gap;
  a.gap_error = 10;
  expect_caught();
  a.standing = Standing::estimate;
  expect_caught();
  a.gap = 0;
  expect_caught();
}

TEST_F(BrokenAnswer, ThatIsNotFiniteIsCaught) {
  Answer& a = answers_[kBroken];
  const Answer right = a;
  a.normal.y() = kNaN;
  expect_caught();
  a = right, a.arm_b.z() = kNaN;
  expect_caught();
  a = right, a.gap_error = HUGE_VAL;
  expect_caught();
  a = right, a.gap = kNaN, a.standing = Standing::estimate;
  expect_caught();
  EXPECT_EQ(score(answers_, truth_).gap->largest, HUGE_VAL);
}

TEST_F(BrokenAnswer, OfYesOrNoIsCaught) {
  yes_or_no_[kBroken].overlaps = !*yes_or_no_[kBroken].overlaps;
  const Score s = score(yes_or_no_, truth_);
  EXPECT_EQ(s.wrong, 1u);
  EXPECT_EQ(s.first_wrong, kBroken);
}

TEST_F(BrokenAnswer, ThatIsNoAnswerIsCountedAndNotHeldAgainstTheTruth) {
  answers_[kBroken].gap = kNaN;
  answers_[kBroken].standing = Standing::none;
  const Score s = score(answers_, truth_);
  EXPECT_EQ(s.wrong, 0u);
  EXPECT_EQ(s.unanswered, 1u);
  EXPECT_LT(s.gap->largest, 1e-13);
}

/// A made-up pair of gap -1, and an answer to it.
const Truth kTruth{-1, 0, Vec3::UnitX(), Vec3::UnitX(), -Vec3::UnitX(), 0, true, 2};

Answer answer(double gap, Standing standing, double gap_error = 0) {
  return {standing, std::nullopt, gap, gap_error, kTruth.normal, kTruth.arm_a, kTruth.arm_b};
}

Score score_one(const Answer& answer, const Truth& truth) {
  return score(std::span(&answer, 1), std::span(&truth, 1));
}

TEST(Score, LocalAnswersMayBeTooLowButNotTooHigh) {
  const Score low = score_one(answer(-1.5, Standing::local, 0.1), kTruth);
  EXPECT_EQ(low.wrong, 0u);
  EXPECT_EQ(low.local, 1u);
  EXPECT_FALSE(low.gap);
  EXPECT_EQ(low.local_error, 0.25);
  EXPECT_EQ(score_one(answer(-0.8, Standing::local, 0.1), kTruth).wrong, 1u);
}

TEST(Score, OpenTruthBoundsFromBelowAlone) {
  Truth open = kTruth;
  open.unproven = 0.5;
  EXPECT_EQ(score_one(answer(-0.7, Standing::proven, 0.1), open).wrong, 0u);
  EXPECT_EQ(score_one(answer(-1.2, Standing::proven, 0.1), open).wrong, 1u);
  EXPECT_EQ(score_one(answer(-0.3, Standing::proven, 0.1), open).wrong, 1u);
  EXPECT_FALSE(score_one(answer(-0.7, Standing::proven, 0.1), open).gap);
  EXPECT_EQ(score_one(answer(-0.7, Standing::proven, 0.1), open).open, 1u);
}

TEST(Score, ReadsTheSecondHalfOfTheTrueGap) {
  Truth fine = kTruth;
  fine.gap_rest = 3e-17;
  EXPECT_EQ(score_one(answer(-1, Standing::proven, 2e-17), fine).wrong, 1u);
  EXPECT_EQ(score_one(answer(-1, Standing::proven, 4e-17), fine).wrong, 0u);
  EXPECT_EQ(score_one(answer(-1, Standing::proven, 4e-17), fine).gap->largest, 1.5e-17);
}

TEST(Score, RanksErrorsInTheUnitOfThePair) {
  std::vector<Answer> answers;
  for (int i = 100; i >= 1; --i) {  // errors of 1 ... 100 in units of 2
    Answer a = answer(-1.0 - 2 * i, Standing::estimate);
    a.normal = Vec3(std::cos(1e-3 * i), std::sin(1e-3 * i), 0);
    a.arm_b += Vec3(0, 0, 4.0 * i);
    answers.push_back(a);
  }
  const std::vector<Truth> truth(100, kTruth);
  Score s = score(answers, truth);
  EXPECT_EQ(s.gap->median, 50);
  EXPECT_EQ(s.gap->percentile_99, 99);
  EXPECT_EQ(s.gap->largest, 100);
  EXPECT_NEAR(s.normal->median, 0.05, 1e-15);
  EXPECT_EQ(s.point->largest, 200);
  EXPECT_FALSE(s.gap_error);  // nothing proven

  std::vector<Truth> ties = truth;
  for (Truth& t : ties) t.unique = false;
  s = score(answers, ties);
  EXPECT_EQ(s.gap->largest, 100);
  EXPECT_FALSE(s.normal);
  EXPECT_FALSE(s.point);
}

}  // namespace
}  // namespace tangency::speed_accuracy
