// SPDX-License-Identifier: GPL-3.0-or-later
// The grade of calls, which the benchmarks ask for before they take a time, sees every kind of
// wrong answer, and ranks errors as it says.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tangency/bench/pairs.hpp>
#include <tangency/bench/speed_accuracy/methods.hpp>
#include <tangency/verify/grade/calls.hpp>

namespace tangency::testing {
namespace {

using bench::Pairs;
using speed_accuracy::Answer;
using speed_accuracy::Method;
using verify::CallAnswer;
using verify::CallGrade;
using verify::CallTruth;
using verify::grade_calls;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBroken = 7;

/// Right answers to real pairs, for a test to break one of.
class BrokenAnswer : public ::testing::Test {
 protected:
  void SetUp() override {
    pairs_ = bench::drawn_pairs("class2", 20);
    for (std::size_t i = 0; i < pairs_->size(); ++i) truth_.push_back(truth_of(*pairs_, i));
    for (const Method& method : speed_accuracy::methods_on(*pairs_, {})) {
      if (method.name != "signed_gap" && method.name != "overlaps") continue;
      method.run();
      (method.name == "overlaps" ? yes_or_no_ : answers_) = method.answers();
    }
    ASSERT_EQ(grade_calls(answers_, truth_).wrong, 0u);
    ASSERT_EQ(grade_calls(yes_or_no_, truth_).wrong, 0u);
  }
  void expect_caught() const {
    const CallGrade s = grade_calls(answers_, truth_);
    EXPECT_EQ(s.wrong, 1u);
    EXPECT_EQ(s.first_wrong, kBroken);
  }

  std::unique_ptr<Pairs> pairs_;
  std::vector<CallTruth> truth_;
  std::vector<Answer> answers_, yes_or_no_;
};

TEST_F(BrokenAnswer, BeyondItsProvenErrorIsCaught) {
  CallAnswer& a = *answers_[kBroken];
  *a.gap += 2.5 * *a.gap_error;
  expect_caught();
  *a.gap -= 5 * *a.gap_error;
  expect_caught();
}

TEST_F(BrokenAnswer, OfTheWrongSignIsCaughtWhateverItPromises) {
  CallAnswer& a = *answers_[kBroken];
  a.gap = -*a.gap;
  a.gap_error = 10;
  expect_caught();
  a.gap_error.reset();
  expect_caught();
  a.gap = 0;
  expect_caught();
}

TEST_F(BrokenAnswer, ThatIsNotFiniteIsCaught) {
  CallAnswer& a = *answers_[kBroken];
  const CallAnswer right = a;
  (*a.normal)[1] = kNaN;
  expect_caught();
  EXPECT_EQ(grade_calls(answers_, truth_).normal.largest, HUGE_VAL);
  a = right, (*a.arm_b)[2] = kNaN;
  expect_caught();
  EXPECT_EQ(grade_calls(answers_, truth_).point.largest, HUGE_VAL);
  a = right, a.gap_error = HUGE_VAL;
  expect_caught();
  a = right, a.gap = kNaN, a.gap_error.reset();
  expect_caught();
  EXPECT_EQ(grade_calls(answers_, truth_).gap.largest, HUGE_VAL);
}

TEST_F(BrokenAnswer, OfYesOrNoIsCaught) {
  yes_or_no_[kBroken]->overlaps = !*yes_or_no_[kBroken]->overlaps;
  const CallGrade s = grade_calls(yes_or_no_, truth_);
  EXPECT_EQ(s.wrong, 1u);
  EXPECT_EQ(s.first_wrong, kBroken);
}

TEST_F(BrokenAnswer, ThatIsNoAnswerIsCountedAndNotHeldAgainstTheTruth) {
  answers_[kBroken].reset();
  const CallGrade s = grade_calls(answers_, truth_);
  EXPECT_EQ(s.wrong, 0u);
  EXPECT_EQ(s.unanswered, 1u);
  EXPECT_LT(s.gap.largest, 1e-13);
}

/// A made-up pair of gap -1, and an answer to it.
const CallTruth kTruth{{-1, 0}, 2, 0, CallTruth::Contact{{1, 0, 0}, {1, 0, 0}, {-1, 0, 0}}};

CallAnswer answer(double gap, std::optional<double> gap_error = {}, bool is_local = false) {
  const CallTruth::Contact& contact = *kTruth.contact;
  return {{}, gap, gap_error, is_local, contact.normal, contact.arm_a, contact.arm_b};
}

CallGrade grade_one(const Answer& answer, const CallTruth& truth) {
  return grade_calls(std::span(&answer, 1), std::span(&truth, 1));
}

TEST(GradeOfCalls, LocalAnswersMayBeTooLowButNotTooHigh) {
  const CallGrade low = grade_one(answer(-1.5, 0.1, true), kTruth);
  EXPECT_EQ(low.wrong, 0u);
  EXPECT_EQ(low.local, 1u);
  EXPECT_EQ(low.gap.count, 0u);
  EXPECT_EQ(low.local_error, 0.25);
  EXPECT_EQ(grade_one(answer(-0.8, 0.1, true), kTruth).wrong, 1u);
}

TEST(GradeOfCalls, OpenTruthBoundsFromBelowAlone) {
  CallTruth open = kTruth;
  open.unproven = 0.5;
  EXPECT_EQ(grade_one(answer(-0.7, 0.1), open).wrong, 0u);
  EXPECT_EQ(grade_one(answer(-1.2, 0.1), open).wrong, 1u);
  EXPECT_EQ(grade_one(answer(-0.3, 0.1), open).wrong, 1u);
  EXPECT_EQ(grade_one(answer(-0.7, 0.1), open).gap.count, 0u);
  EXPECT_EQ(grade_one(answer(-0.7, 0.1), open).open, 1u);
}

TEST(GradeOfCalls, ReadsTheSecondHalfOfTheTrueGap) {
  CallTruth fine = kTruth;
  fine.gap.low = 3e-17;
  EXPECT_EQ(grade_one(answer(-1, 2e-17), fine).wrong, 1u);
  EXPECT_EQ(grade_one(answer(-1, 4e-17), fine).wrong, 0u);
  EXPECT_EQ(grade_one(answer(-1, 4e-17), fine).gap.largest, 1.5e-17);
}

TEST(GradeOfCalls, RanksErrorsInTheUnitOfThePair) {
  std::vector<Answer> answers;
  for (int i = 100; i >= 1; --i) {  // errors of 1 ... 100 in units of 2
    CallAnswer a = answer(-1.0 - 2 * i);
    a.normal = {std::cos(1e-3 * i), std::sin(1e-3 * i), 0};
    (*a.arm_b)[2] += 4.0 * i;
    answers.push_back(a);
  }
  const std::vector<CallTruth> truth(100, kTruth);
  CallGrade s = grade_calls(answers, truth);
  EXPECT_EQ(s.gap.median, 50);
  EXPECT_EQ(s.gap.percentile_99, 99);
  EXPECT_EQ(s.gap.largest, 100);
  EXPECT_NEAR(s.normal.median, 0.05, 1e-15);
  EXPECT_EQ(s.point.largest, 200);
  EXPECT_FALSE(s.gap_error);  // nothing proven

  std::vector<CallTruth> ties = truth;
  for (CallTruth& t : ties) t.contact.reset();
  s = grade_calls(answers, ties);
  EXPECT_EQ(s.gap.largest, 100);
  EXPECT_EQ(s.normal.count, 0u);
  EXPECT_EQ(s.point.count, 0u);
}

// As of codes that say yes or no beside their gap: the gap's sign decides nothing then.
TEST(GradeOfCalls, CountsWrongAndMissingYesOrNoBesideGaps) {
  const CallTruth apart{{1000, 0}, 2};
  std::vector<Answer> answers;
  for (int i = 1; i <= 100; ++i)
    answers.push_back(CallAnswer{.overlaps = false, .gap = 1000.0 + 2 * i});
  const std::vector<CallTruth> truth(100, apart);
  CallGrade s = grade_calls(answers, truth);
  EXPECT_EQ(s.pairs, 100u);
  EXPECT_EQ(s.gap.count, 100u);
  EXPECT_EQ(s.wrong + s.unanswered, 0u);
  EXPECT_EQ(s.gap.median, 50.0);
  EXPECT_EQ(s.gap.percentile_99, 99.0);
  EXPECT_EQ(s.gap.largest, 100.0);

  answers[0].reset();
  answers[1] = CallAnswer{.overlaps = true};                // wrong, and no gap
  answers[2] = CallAnswer{.overlaps = true, .gap = -1};     // wrong
  answers[3] = CallAnswer{.overlaps = false, .gap = -1.0};  // says no, and gives a depth
  s = grade_calls(answers, truth);
  EXPECT_EQ(s.unanswered, 1u);
  EXPECT_EQ(s.wrong, 2u);
  EXPECT_EQ(s.gap.count, 98u);
  EXPECT_EQ(s.gap.largest, 500.5);

  answers[3] = CallAnswer{.overlaps = false, .gap = kNaN};
  EXPECT_EQ(grade_calls(answers, truth).gap.largest, HUGE_VAL);
}

TEST(GradeOfCalls, OfNoGapsIsZeroErrors) {
  const CallGrade s = grade_one(CallAnswer{.overlaps = true}, CallTruth{{-1, 0}});
  EXPECT_EQ(s.gap.count, 0u);
  EXPECT_EQ(s.wrong, 0u);
  EXPECT_EQ(s.gap.largest, 0.0);
}

}  // namespace
}  // namespace tangency::testing
